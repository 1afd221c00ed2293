// An OpenEXR file in memory, as the stream from which the library OpenEXR reads it.
#pragma once

#include <ImfIO.h>

#include <set>
#include <string>

namespace holomorph {

/// The library allocates what a file's attributes ask for before it reads them. This stream
/// therefore checks their lengths, and hides the types of those that pictures do not need, so that
/// they are read as plain bytes.
class ExrStream final : public Imf::IStream {
 public:
  /// Throws Iex::InputExc if an attribute is longer than the rest of the file. The bytes must
  /// outlive the stream.
  ExrStream(const std::string& bytes, const std::string& name);

  bool read(char* out, int count) override;
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override;

 private:
  std::string text();
  std::uint32_t number();
  void skip(std::uint32_t count);
  void hide_unused_types();

  const std::string& bytes_;
  size_t at_ = 0;
  std::set<size_t> hidden_;  ///< where the names of types begin that are not used
};

}  // namespace holomorph
