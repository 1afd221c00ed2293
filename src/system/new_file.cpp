// Uses POSIX calls, because an atomic replacement needs fsync and rename.
#include "system/new_file.h"

#include <dirent.h>
#include <fcntl.h>
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
#include <utility>

#include "system/descriptor.h"

namespace holomorph {
namespace {

[[noreturn]] void fail(const Path& path, const char* what) {
  const std::string reason = std::strerror(errno);  // before anything else changes errno
  throw Error(ErrorKind::failed, path.string() + ": " + what + ": " + reason);
}

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
/// or if something else now has the name.
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
    if (errno != EINTR) break;  // if locking fails, no process can remove anything
  struct stat found {};
  return ::fstat(descriptor, &found) == 0 && found.st_nlink > 0;
}
}  // namespace

void write_standard_output(const std::string& bytes) {
  std::cout.flush();
  if (!write_all(STDOUT_FILENO, bytes)) fail("standard output", "cannot be written");
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
}  // namespace holomorph
