// POSIX calls, because an atomic replacement needs fsync and rename.
#include "scene/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <vector>

namespace holomorph {

namespace {

[[noreturn]] void fail(const Path& path, const char* what) {
  throw Error(ErrorKind::failed, path.string() + ": " + what + ": " + std::strerror(errno));
}

/// Closed when it goes out of scope.
struct Descriptor {
  int fd;
  ~Descriptor() { ::close(fd); }
};

/// Flushes a directory's entries, so that a rename in it survives a power cut.
void sync_directory(const Path& directory) {
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

/// False with errno when not all bytes could be written.
bool write_all(int descriptor, const std::string& bytes) {
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    done += static_cast<size_t>(wrote);
  }
  return true;
}

/// Into a pipe or a device, which cannot be replaced.
void write_into(const Path& path, const std::string& bytes) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) fail(path, "cannot be opened for writing");
  const bool good = write_all(fd, bytes);
  const int reason = errno;
  const bool closed = ::close(fd) == 0;
  if (good && closed) return;
  if (!good) errno = reason;
  fail(path, "cannot be written");
}

/// What a path leads to through links. Throws Error where links lead in a circle.
Path target_of(Path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(path, error); ++links) {
    if (links == kMostLinks) {
      errno = ELOOP;
      fail(path, "cannot be written");
    }
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  }
  return path;
}

Path folder_of(const Path& path) {
  return path.has_parent_path() ? path.parent_path() : Path(".");
}

/// Whether a path names something that is written into. Throws Error for a folder.
bool is_stream(const Path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status))
    throw Error(ErrorKind::bad_input, path.string() + ": this is a directory; name a file");
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

/// The permissions of what is replaced, or those of new files.
mode_t mode_for(const Path& path) {
  struct stat before {};
  if (::stat(path.c_str(), &before) == 0) return before.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// Up to the end; `name` is for messages.
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
      throw Error(ErrorKind::bad_input,
                  name.string() + ": there are more than " + std::to_string(limit >> 20) + " MB");
  }
}

}  // namespace

std::string read_file(const Path& path, size_t limit) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw Error(ErrorKind::bad_input, path.string() + ": there is no such file");
  if (std::filesystem::is_directory(status))
    throw Error(ErrorKind::bad_input, path.string() + ": this is a directory, not a file");
  if (!std::filesystem::is_regular_file(status))
    throw Error(ErrorKind::bad_input, path.string() + ": this is not a regular file");
  if (std::filesystem::file_size(path, error) > limit)
    throw Error(ErrorKind::bad_input,
                path.string() + ": the file is larger than " + std::to_string(limit >> 20) + " MB");
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw Error(ErrorKind::bad_input, path.string() + ": the file cannot be read");
  return bytes;
}

std::string read_stream(const Path& path, size_t limit) {
  std::error_code error;
  if (!std::filesystem::exists(path, error) || std::filesystem::is_directory(path, error) ||
      std::filesystem::is_regular_file(path, error))
    return read_file(path, limit);
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0)
    throw Error(ErrorKind::bad_input, path.string() + ": cannot be read: " + std::strerror(errno));
  const Descriptor closed{fd};
  return read_descriptor(fd, path, limit);
}

void write_standard_output(const std::string& bytes) {
  std::cout.flush();
  if (!write_all(STDOUT_FILENO, bytes)) fail("standard output", "cannot be written");
}

std::string read_standard_input(size_t limit) {
  return read_descriptor(STDIN_FILENO, "standard input", limit);
}

bool is_read_only(const Path& path) {
  constexpr mode_t kWrite = S_IWUSR | S_IWGRP | S_IWOTH;
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return false;
  return (found.st_mode & kWrite) == 0 ||
         ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0;
}

void check_not_read_only(const Path& path) {
  if (is_read_only(path))
    throw Error(ErrorKind::failed, path.string() +
                                       ": the file is read-only; choose another name, "
                                       "or make it writable");
}

void write_file(const Path& wanted, const std::string& bytes) {
  if (is_stream(wanted)) return write_into(wanted, bytes);
  const Path path = target_of(wanted), folder = folder_of(path);
  std::string name = (folder / ("." + path.filename().string() + ".XXXXXX")).string();
  const int fd = ::mkstemp(name.data());
  if (fd < 0) fail(path, "cannot write here");
  const bool good = write_all(fd, bytes) && ::fchmod(fd, mode_for(path)) == 0 && ::fsync(fd) == 0;
  int reason = errno;  // of the first that failed
  const bool closed = ::close(fd) == 0;
  if (good) reason = errno;
  if (good && closed) {
    if (::rename(name.c_str(), path.c_str()) == 0) return sync_directory(folder);
    reason = errno;
  }
  ::unlink(name.c_str());
  errno = reason;
  fail(path, "cannot be written");
}

void move_file(const Path& finished, const Path& wanted) {
  std::error_code error;
  if (is_stream(wanted) || std::filesystem::is_symlink(wanted, error)) {
    write_file(wanted, read_file(finished, std::numeric_limits<size_t>::max()));
    ::unlink(finished.c_str());
    return;
  }
  ::chmod(finished.c_str(), mode_for(wanted));
  if (::rename(finished.c_str(), wanted.c_str()) != 0) fail(wanted, "cannot be written");
  sync_directory(folder_of(wanted));
}

FileLock::FileLock(const Path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
  if (descriptor_ < 0) fail(path, "cannot be created");
  for (int attempt = 0; attempt < 50; ++attempt) {  // somebody may be looking
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    if (errno != EWOULDBLOCK && errno != EINTR) break;
    ::usleep(1000);
  }
  ::close(descriptor_);
  fail(path, "is in use");
}

FileLock::~FileLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

bool FileLock::is_held(const Path& path) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;  // other probes are no owners
  ::close(descriptor);
  return held;
}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool has_words(const std::string& text, const std::string& words) {
  const std::string all = lower_case(text);
  std::istringstream each(lower_case(words));
  for (std::string word; each >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
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
