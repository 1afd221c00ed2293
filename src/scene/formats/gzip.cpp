#include "scene/formats/gzip.h"

#include <zlib.h>

#include <memory>

#include "core/error.h"

namespace holomorph {

bool is_gzip(const std::string& bytes) {
  return bytes.starts_with("\x1f\x8b");
}

std::string unpacked_gzip(const std::string& bytes, const std::string& name, size_t most) {
  constexpr int kGzip = 16 + MAX_WBITS;
  constexpr size_t kBlock = 1 << 16;
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK)
    throw Error(ErrorKind::failed, name + ": there is not enough memory to unpack it");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string unpacked;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    const size_t before = unpacked.size();
    unpacked.resize(before + kBlock);
    stream.next_out = reinterpret_cast<Bytef*>(&unpacked[before]);
    stream.avail_out = kBlock;
    status = inflate(&stream, Z_NO_FLUSH);
    unpacked.resize(before + kBlock - stream.avail_out);
    if (status != Z_OK && status != Z_STREAM_END)
      throw Error(ErrorKind::bad_input, name + ": the compressed file is damaged or incomplete");
    if (unpacked.size() > most)
      throw Error(ErrorKind::bad_input, name + ": the compressed file unpacks to more than " +
                                            std::to_string(most >> 20) + " MB");
  }
  return unpacked;
}

}  // namespace holomorph
