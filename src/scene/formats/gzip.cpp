#include "scene/formats/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <memory>

#include "core/error.h"

namespace holomorph {

bool is_gzip(const std::string& bytes) {
  return bytes.starts_with("\x1f\x8b");
}

namespace {

/// Unpacks a gzip file in blocks, until it ends or there are `most` bytes. Returns whether it is
/// intact so far.
bool unpack_gzip(const std::string& bytes, size_t most, std::string& unpacked) {
  constexpr int kGzip = 16 + MAX_WBITS;
  constexpr size_t kBlock = 1 << 16;
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK) return false;
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(std::min<size_t>(bytes.size(), ~uInt{0}));
  for (int status = Z_OK; status != Z_STREAM_END && unpacked.size() < most;) {
    const size_t before = unpacked.size();
    unpacked.resize(before + kBlock);
    stream.next_out = reinterpret_cast<Bytef*>(&unpacked[before]);
    stream.avail_out = kBlock;
    status = inflate(&stream, Z_NO_FLUSH);
    unpacked.resize(before + kBlock - stream.avail_out);
    if (status != Z_OK && status != Z_STREAM_END) return false;
  }
  return true;
}

}  // namespace

std::string unpacked_gzip(const std::string& bytes, const std::string& name, size_t most) {
  std::string unpacked;
  if (!unpack_gzip(bytes, most + 1, unpacked))
    throw Error(ErrorKind::bad_input, name + ": the compressed file is damaged or incomplete");
  if (unpacked.size() > most)
    throw Error(ErrorKind::bad_input, name + ": the compressed file unpacks to more than " +
                                          std::to_string(most >> 20) + " MB");
  return unpacked;
}

std::string start_of_gzip(const std::string& bytes, size_t count) {
  std::string unpacked;
  unpack_gzip(bytes, count, unpacked);
  return unpacked.substr(0, count);
}

}  // namespace holomorph
