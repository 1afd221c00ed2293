// Uses POSIX calls, because the checks and the reading must refer to the same open file.
#include "system/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "system/descriptor.h"
#include "system/text.h"

namespace holomorph {
namespace {

/// Reads up to the end; `name` is used in messages.
std::string read_descriptor(int descriptor, const Path& name, size_t limit) {
  std::string bytes;
  std::vector<char> block(1 << 16);
  while (true) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      throw Error(ErrorKind::bad_input,
                  name.string() + ": cannot be read: " + std::strerror(errno));
    }
    if (count == 0) return bytes;
    bytes.append(block.data(), static_cast<size_t>(count));
    if (bytes.size() > limit)
      throw Error(ErrorKind::bad_input, name.string() + ": the input is larger than " +
                                            std::to_string(limit >> 20) + " MB");
  }
}

/// The reason why a file cannot be opened.
std::string unreadable(const Path& path, int reason) {
  std::error_code error;
  if (reason == ENOENT && std::filesystem::is_symlink(path, error))
    return "this is a link to " + std::filesystem::read_symlink(path, error).string() +
           ", which does not exist";
  if (reason == ENOENT || reason == ENOTDIR) return "no such file";
  if (reason == ELOOP) return "this link leads back to itself";
  if (reason == ENAMETOOLONG) return "the name is too long";
  return std::string("cannot be read: ") + std::strerror(reason);
}

std::string shortened(const Path& path) {
  constexpr size_t kMost = 300;
  const std::string name = path.string();
  return name.size() <= kMost ? name : name.substr(0, kMost) + "...";
}

enum class IfLarger { fail, cut };

std::string read_path(const Path& path, size_t limit, bool streams,
                      IfLarger if_larger = IfLarger::fail) {
  const auto refuse = [&](const std::string& why) {
    return Error(ErrorKind::bad_input, shortened(path) + ": " + why);
  };
  if (path.native().find('\0') != std::string::npos) throw refuse("this is not a valid file name");
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) throw refuse(unreadable(path, errno));
  if (S_ISDIR(found.st_mode)) throw refuse("this is a directory, not a file");
  // Devices are not even opened, because opening some of them has side effects.
  if (!S_ISREG(found.st_mode) && !streams) throw refuse("this is not a regular file");
  const bool waits = !S_ISREG(found.st_mode);  // until another program writes into the pipe
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | (waits ? 0 : O_NONBLOCK));
  if (fd < 0) throw refuse(unreadable(path, errno));
  const Descriptor closed{fd};
  if (waits) return read_descriptor(fd, path, limit);
  // The name may now refer to a different file from the one that was checked.
  if (::fstat(fd, &found) != 0 || !S_ISREG(found.st_mode))
    throw refuse("this is not a regular file");
  const size_t size = static_cast<size_t>(found.st_size);
  if (size > limit && if_larger == IfLarger::fail)
    throw refuse("the file is larger than " + std::to_string(limit >> 20) + " MB");
  // Read no more than the size of the file, because some system files have no end.
  std::string bytes(std::min(size, limit), '\0');
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(fd, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw refuse(unreadable(path, errno));
    if (count == 0) break;
    done += static_cast<size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace

Path absolute_path(const Path& path) {
  std::error_code error;
  const Path absolute = std::filesystem::absolute(path.empty() ? "." : path, error);
  return (error ? path : absolute).lexically_normal();
}

bool path_exists(const Path& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

bool is_file(const Path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

std::string read_file(const Path& path, size_t limit) {
  return read_path(path, limit, false);
}

std::string read_start(const Path& path, size_t count) {
  return read_path(path, count, false, IfLarger::cut);
}

std::string read_stream(const Path& path, size_t limit) {
  return read_path(path, limit, true);
}

std::string read_standard_input(size_t limit) {
  return read_descriptor(STDIN_FILENO, "standard input", limit);
}

bool is_stream(const Path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status))
    throw Error(ErrorKind::bad_input,
                path.string() + ": this is a directory; give the name of a file");
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

std::string sha256_hex(const std::string& bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int length = 0;
  check(EVP_Digest(bytes.data(), bytes.size(), digest, &length, EVP_sha256(), nullptr) == 1,
        "SHA-256 is available");
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) {
    constexpr char kDigits[] = "0123456789abcdef";
    hex += kDigits[digest[i] >> 4];
    hex += kDigits[digest[i] & 15];
  }
  return hex;
}

Error about(const Path& file, const Error& error) {
  const std::string name = file.string(), what = error.what();
  return {error.kind(), what.starts_with(name) ? what : name + ": " + what, error.where()};
}

}  // namespace holomorph
