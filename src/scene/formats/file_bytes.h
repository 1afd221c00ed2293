// Numbers in the bytes of a file.
#pragma once

#include <cstdint>
#include <string>

#include "core/error.h"

namespace holomorph {

/// Reads numbers from the bytes of a file, which must outlive this object. Reading past the end
/// throws Error{bad_input}.
class FileBytes {
 public:
  FileBytes(const std::string& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  size_t at(size_t place) const {
    need(place, 1);
    return static_cast<unsigned char>(bytes_[place]);
  }
  /// Unsigned numbers of `count` bytes, with the lowest or the highest byte first.
  size_t little(size_t place, size_t count) const {
    need(place, count);
    size_t value = 0;
    for (size_t k = count; k-- > 0;) value = value << 8 | at(place + k);
    return value;
  }
  size_t big(size_t place, size_t count) const {
    need(place, count);
    size_t value = 0;
    for (size_t k = 0; k < count; ++k) value = value << 8 | at(place + k);
    return value;
  }
  /// A signed number of four bytes, with the highest byte first.
  int big_signed(size_t place) const {
    return static_cast<int>(static_cast<std::uint32_t>(big(place, 4)));
  }
  std::string text(size_t place, size_t count) const {
    need(place, count);
    return bytes_.substr(place, count);
  }
  const std::uint8_t* data(size_t place, size_t count) const {
    need(place, count);
    return reinterpret_cast<const std::uint8_t*>(bytes_.data()) + place;
  }
  /// Throws Error unless there are `count` bytes at offset `place`.
  void need(size_t place, size_t count) const {
    if (place > bytes_.size() || count > bytes_.size() - place)
      throw Error(ErrorKind::bad_input,
                  name_ + ": the picture is incomplete: the file ends too early");
  }
  [[noreturn]] void damaged(const std::string& why) const {
    throw Error(ErrorKind::bad_input, name_ + ": the picture is damaged (" + why + ")");
  }
  /// Throws Error for an intact file with a feature that is not supported.
  [[noreturn]] void unsupported(const std::string& what) const {
    throw Error(ErrorKind::bad_input, name_ + ": " + what);
  }
  size_t size() const { return bytes_.size(); }
  const std::string& name() const { return name_; }

 private:
  const std::string& bytes_;
  const std::string& name_;
};

}  // namespace holomorph
