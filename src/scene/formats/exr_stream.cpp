#include "scene/formats/exr_stream.h"

#include <Iex.h>
#include <ImfVersion.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace holomorph {
namespace {

constexpr std::array kUsedTypes{"box2i", "chlist",    "chromaticities", "compression", "float",
                                "int",   "lineOrder", "string",         "tiledesc",    "v2f"};

}  // namespace

ExrStream::ExrStream(const std::string& bytes, const std::string& name)
    : IStream(name.c_str()), bytes_(bytes) {
  hide_unused_types();
  at_ = 0;
}

/// A header is a list of attributes: name, type, length and value. An empty name ends it. Files
/// with several parts have a list of headers, which an empty header ends.
void ExrStream::hide_unused_types() {
  skip(4);
  const bool has_parts = Imf::isMultiPart(static_cast<int>(number()));
  for (bool is_empty = false; !is_empty;) {
    is_empty = true;
    while (!text().empty()) {
      is_empty = false;
      const size_t type_at = at_;
      const std::string type = text();
      if (type.empty()) throw Iex::InputExc("an attribute has no type");
      if (std::ranges::find(kUsedTypes, type) == kUsedTypes.end()) hidden_.insert(type_at);
      skip(number());
    }
    if (!has_parts) break;
  }
}

/// A text that a zero ends.
std::string ExrStream::text() {
  const size_t end = bytes_.find('\0', at_);
  if (end == std::string::npos) throw Iex::InputExc("the file ends too early");
  const size_t start = std::exchange(at_, end + 1);
  return bytes_.substr(start, end - start);
}

std::uint32_t ExrStream::number() {
  const size_t start = at_;
  skip(4);
  std::uint32_t number = 0;
  for (size_t i = 0; i < 4; ++i)
    number |= std::uint32_t{static_cast<unsigned char>(bytes_[start + i])} << (8 * i);
  return number;
}

void ExrStream::skip(std::uint32_t count) {
  if (count > bytes_.size() - at_) throw Iex::InputExc("the file ends too early");
  at_ += count;
}

bool ExrStream::read(char* out, int count) {
  if (count < 0) throw Iex::InputExc("the file ends too early");
  const size_t start = at_;
  skip(static_cast<std::uint32_t>(count));
  std::memcpy(out, bytes_.data() + start, static_cast<size_t>(count));
  for (auto at = hidden_.lower_bound(start); at != hidden_.end() && *at < at_; ++at)
    out[*at - start] = '?';
  return at_ < bytes_.size();
}

void ExrStream::seekg(std::uint64_t at) {
  if (at > bytes_.size()) throw Iex::InputExc("the file ends too early");
  at_ = at;
}

}  // namespace holomorph
