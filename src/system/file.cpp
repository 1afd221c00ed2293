// Uses POSIX calls, because an atomic replacement needs fsync and rename.
#include "system/file.h"

#include <dirent.h>
#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <mutex>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

namespace holomorph {

namespace {

[[noreturn]] void fail(const Path& path, const char* what) {
  const std::string reason = std::strerror(errno);  // before anything else changes errno
  throw Error(ErrorKind::failed, path.string() + ": " + what + ": " + reason);
}

/// A file descriptor that is closed when it goes out of scope.
struct Descriptor {
  int fd;
  ~Descriptor() { ::close(fd); }
};

/// Flushes a directory's entries to disk. A rename in the directory then survives a power failure.
void sync_directory(const Path& directory) {
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

/// Writes all bytes. Returns false and sets errno if not all of them could be written.
bool write_all(int descriptor, std::string_view bytes) {
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t wrote = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    done += static_cast<size_t>(wrote);
  }
  return true;
}

/// The path that results from following links. Throws Error if the links form a cycle.
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

/// The permissions of new files. Does not call umask(), which can be queried only by setting it.
/// That would affect files that other threads are creating.
mode_t default_file_mode() {
  static const mode_t mask = [] {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (unsigned value = 0; word == "Umask:" && status >> std::oct >> value) return value;
    return 022u;
  }();
  return 0666 & ~mask;
}

/// The permissions of the existing file at `path`, or the permissions of new files.
mode_t mode_for(const Path& path) {
  struct stat before {};
  return ::stat(path.c_str(), &before) == 0 ? before.st_mode & 07777 : default_file_mode();
}

constexpr std::string_view kTemporary = ".holomorph-";
constexpr size_t kRandom = 8;  ///< hexadecimal digits after the prefix

bool is_temporary(const std::string& name) {
  return name.starts_with(kTemporary) && name.size() == kTemporary.size() + kRandom &&
         name.find_first_not_of("0123456789abcdef", kTemporary.size()) == std::string::npos;
}

Path temporary_path(const Path& folder) {
  thread_local std::random_device random;
  char name[32];
  std::snprintf(name, sizeof name, "%s%08x", kTemporary.data(), random());
  return folder / name;
}

/// Removes a file or folder left behind by a NewFile or a NewFolder. Does nothing if it is in use
/// or something else has the name.
void remove_leftover(int folder, const char* name) {
  const int fd = ::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return;
  const Descriptor closed{fd};
  struct stat opened {};
  struct stat named {};
  if (::fstat(fd, &opened) != 0 || opened.st_uid != ::geteuid() ||
      ::flock(fd, LOCK_EX | LOCK_NB) != 0)
    return;
  // Something else may have taken the name since the file was opened.
  if (::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) != 0 || named.st_ino != opened.st_ino ||
      named.st_dev != opened.st_dev)
    return;
  if (S_ISREG(opened.st_mode)) ::unlinkat(folder, name, 0);
  if (!S_ISDIR(opened.st_mode) || (opened.st_mode & 07777) != 0700) return;
  DIR* entries = ::fdopendir(::dup(fd));
  if (!entries) return;
  while (const dirent* entry = ::readdir(entries)) {
    const std::string_view file = entry->d_name;
    const bool ours = file.starts_with("film") || is_temporary(entry->d_name) ||
                      file.find_first_not_of("0123456789") == std::string_view::npos;
    if (ours) ::unlinkat(fd, entry->d_name, 0);
  }
  ::closedir(entries);
  ::unlinkat(folder, name, AT_REMOVEDIR);  // succeeds only if the folder is empty
}

/// Removes temporary files that killed programs have left in a folder. Locked files are in use.
void clean(const Path& folder) {
  using Clock = std::chrono::steady_clock;
  static std::mutex mutex;
  static std::map<Path, Clock::time_point>
      cleaned;  // avoids repeating this for each frame of a film
  {
    const std::lock_guard lock(mutex);
    const auto [last, first] = cleaned.try_emplace(folder, Clock::now());
    if (!first && Clock::now() - last->second < std::chrono::minutes(1)) return;
    last->second = Clock::now();
    if (cleaned.size() > 1000) cleaned.clear();
  }
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  const Descriptor closed{fd};
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (is_temporary(name)) remove_leftover(fd, name.c_str());
  }
}

/// Locks a file or folder that was just created. Returns false if another process has already
/// removed it.
bool lock_created(int descriptor) {
  while (::flock(descriptor, LOCK_EX) != 0)
    if (errno != EINTR) break;  // if locks fail, no process removes anything
  struct stat found {};
  return ::fstat(descriptor, &found) == 0 && found.st_nlink > 0;
}

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

namespace {

/// The reason why a file cannot be opened.
std::string unreadable(const Path& path, int reason) {
  std::error_code error;
  if (reason == ENOENT && std::filesystem::is_symlink(path, error))
    return "this is a link to " + std::filesystem::read_symlink(path, error).string() +
           ", which does not exist";
  if (reason == ENOENT || reason == ENOTDIR) return "no such file";
  if (reason == ELOOP) return "this is a link that leads to itself";
  if (reason == ENAMETOOLONG) return "the name is too long";
  return std::string("cannot be read: ") + std::strerror(reason);
}

std::string shortened(const Path& path) {
  constexpr size_t kMost = 300;
  const std::string name = path.string();
  return name.size() <= kMost ? name : name.substr(0, kMost) + "...";
}

std::string read_path(const Path& path, size_t limit, bool streams) {
  const auto refuse = [&](const std::string& why) {
    return Error(ErrorKind::bad_input, shortened(path) + ": " + why);
  };
  if (path.native().find('\0') != std::string::npos) throw refuse("this is not a valid file name");
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) throw refuse(unreadable(path, errno));
  if (S_ISDIR(found.st_mode)) throw refuse("this is a directory, not a file");
  // Devices are not even opened, because opening some of them has effects.
  if (!S_ISREG(found.st_mode) && !streams) throw refuse("this is not a regular file");
  const bool waits = !S_ISREG(found.st_mode);  // until another program writes into the pipe
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | (waits ? 0 : O_NONBLOCK));
  if (fd < 0) throw refuse(unreadable(path, errno));
  const Descriptor closed{fd};
  if (waits) return read_descriptor(fd, path, limit);
  // The name may refer to another file than the one that was checked.
  if (::fstat(fd, &found) != 0 || !S_ISREG(found.st_mode))
    throw refuse("this is not a regular file");
  if (static_cast<size_t>(found.st_size) > limit)
    throw refuse("the file is larger than " + std::to_string(limit >> 20) + " MB");
  // Read no more than the size of the file, because some system files have no end.
  std::string bytes(static_cast<size_t>(found.st_size), '\0');
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

std::string read_file(const Path& path, size_t limit) {
  return read_path(path, limit, false);
}

std::string read_stream(const Path& path, size_t limit) {
  return read_path(path, limit, true);
}

void write_standard_output(const std::string& bytes) {
  std::cout.flush();
  if (!write_all(STDOUT_FILENO, bytes)) fail("standard output", "cannot be written");
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

NewFile::NewFile(const Path& wanted, Readers readers)
    : path_(target_of(wanted)), readers_(readers) {
  if (is_stream(path_)) {  // a stream cannot be replaced
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(path_, "cannot be opened for writing");
    return;
  }
  const Path folder = folder_of(path_);
  clean(folder);
  constexpr int kAttempts = 100;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    temporary_ = temporary_path(folder);
    descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor_ >= 0 && lock_created(descriptor_)) return;
    if (descriptor_ < 0 && errno != EEXIST) fail(path_, "cannot write here");
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  fail(path_, "cannot write here");
}

NewFile::~NewFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

void NewFile::write(std::string_view bytes) {
  if (!write_all(descriptor_, bytes)) fail(path_, "cannot be written");
}

void NewFile::put_in_place() {
  if (temporary_.empty()) {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, "cannot be written");
    return;
  }
  const mode_t mode = readers_ == Readers::owner ? 0600 : mode_for(path_);
  if (::fchmod(descriptor_, mode) != 0 || ::fsync(descriptor_) != 0 ||
      ::rename(temporary_.c_str(), path_.c_str()) != 0)
    fail(path_, "cannot be written");
  temporary_.clear();
  sync_directory(folder_of(path_));
}

NewFolder::NewFolder(const Path& neighbor) {
  const Path folder = folder_of(neighbor);
  clean(folder);
  constexpr int kAttempts = 100;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    path_ = temporary_path(folder);
    const bool made = ::mkdir(path_.c_str(), 0700) == 0;
    if (!made && errno != EEXIST) fail(neighbor, "cannot write here");
    if (!made) continue;
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor_ >= 0 && lock_created(descriptor_)) return;
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  fail(neighbor, "cannot write here");
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  ::close(descriptor_);
}

void write_file(const Path& path, const std::string& bytes, NewFile::Readers readers) {
  NewFile file(path, readers);
  file.write(bytes);
  file.put_in_place();
}

void move_file(const Path& finished, const Path& wanted) {
  if (is_stream(wanted)) {
    write_file(wanted, read_file(finished, std::numeric_limits<size_t>::max()));
    ::unlink(finished.c_str());
    return;
  }
  const Path path = target_of(wanted);
  ::chmod(finished.c_str(), mode_for(path));
  if (::rename(finished.c_str(), path.c_str()) == 0) return sync_directory(folder_of(path));
  if (errno != EXDEV) fail(path, "cannot be written");
  write_file(path, read_file(finished, std::numeric_limits<size_t>::max()));
  ::unlink(finished.c_str());
}

FileLock::FileLock(const Path& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
  if (descriptor_ < 0) fail(path, "cannot be created");
  for (int attempt = 0; attempt < 50; ++attempt) {  // another process may be probing the lock
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
  const bool held =
      ::flock(descriptor, LOCK_SH | LOCK_NB) != 0;  // several probes can share the lock
  ::close(descriptor);
  return held;
}

std::string printable(const std::string& text) {
  std::string shown;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto at = [&](size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    // U+202A to U+202E and U+2066 to U+2069 change the text direction.
    const bool turns = at(0) == 0xe2 && ((at(1) == 0x80 && at(2) >= 0xaa && at(2) <= 0xae) ||
                                         (at(1) == 0x81 && at(2) >= 0xa6 && at(2) <= 0xa9));
    const bool steers = (at(0) < ' ' && at(0) != '\n') || at(0) == 0x7f ||
                        (at(0) == 0xc2 && at(1) >= 0x80 && at(1) < 0xa0);
    if (turns || steers) shown += '?';
    if (turns) i += 2;
    if (steers && at(0) == 0xc2) ++i;
    if (!turns && !steers) shown += text[i];
  }
  return shown;
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
