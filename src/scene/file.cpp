// POSIX calls, because an atomic replacement needs fsync and rename.
#include "scene/file.h"

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

namespace holomorph {

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

namespace {

[[noreturn]] void fail(const Path& path, const char* what) {
  throw Error(ErrorKind::failed, path.string() + ": " + what + ": " + std::strerror(errno));
}

/// Flushes a directory's entries, so that a rename in it survives a power cut.
void sync_directory(const Path& directory) {
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

}  // namespace

namespace {

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

/// A pipe whose reader has gone is an error like others, not a signal that ends the program.
void ignore_broken_pipes() {
  static const bool ignored = std::signal(SIGPIPE, SIG_IGN) != SIG_ERR;
  (void)ignored;
}

/// Into a pipe or a device, which cannot be replaced.
void write_into(const Path& path, const std::string& bytes) {
  ignore_broken_pipes();
  const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) fail(path, "cannot be opened for writing");
  const bool good = write_all(fd, bytes);
  const int reason = errno;
  const bool closed = ::close(fd) == 0;
  if (good && closed) return;
  if (!good) errno = reason;
  fail(path, "cannot be written");
}

}  // namespace

void write_standard_output(const std::string& bytes) {
  ignore_broken_pipes();
  std::cout.flush();
  if (!write_all(STDOUT_FILENO, bytes)) fail("standard output", "cannot be written");
}

std::string read_standard_input(size_t limit) {
  std::string bytes;
  char block[1 << 16];
  while (std::cin.read(block, sizeof block) || std::cin.gcount() > 0) {
    bytes.append(block, static_cast<size_t>(std::cin.gcount()));
    if (bytes.size() > limit)
      throw Error(ErrorKind::bad_input,
                  "standard input: there are more than " + std::to_string(limit >> 20) + " MB");
  }
  return bytes;
}

bool is_read_only(const Path& path) {
  struct stat found {};
  return ::stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode) &&
         (found.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0;
}

void write_file(const Path& wanted, const std::string& bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(wanted, error);
  if (std::filesystem::is_directory(status))
    throw Error(ErrorKind::bad_input, wanted.string() + ": this is a directory; name a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return write_into(wanted, bytes);
  // A link keeps pointing where it points: its target is what gets replaced.
  Path path = wanted;
  for (int links = 0; links < 40 && std::filesystem::is_symlink(path, error); ++links)
    path = path.parent_path() / std::filesystem::read_symlink(path, error);
  const Path directory = path.has_parent_path() ? path.parent_path() : Path(".");
  std::string name = (directory / ("." + path.filename().string() + ".XXXXXX")).string();
  const int fd = ::mkstemp(name.data());
  if (fd < 0) fail(path, "cannot write here");
  bool good = write_all(fd, bytes);
  struct stat before {};
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const mode_t mode = ::stat(path.c_str(), &before) == 0 ? before.st_mode & 07777 : 0666 & ~mask;
  good = good && ::fchmod(fd, mode) == 0 && ::fsync(fd) == 0;
  good = ::close(fd) == 0 && good;
  good = good && ::rename(name.c_str(), path.c_str()) == 0;
  if (!good) {
    const int reason = errno;
    ::unlink(name.c_str());
    errno = reason;
    fail(path, "cannot be written");
  }
  sync_directory(directory);
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
