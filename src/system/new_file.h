// Files that are replaced atomically, temporary folders, and locks.
#pragma once

#include <string_view>

#include "system/file.h"

namespace holomorph {

/// A file that is being written. The data is written to a temporary file with a short name next to
/// the destination. put_in_place() replaces the destination atomically. Temporary files of killed
/// programs are removed by a later NewFile or NewFolder in the same folder. A pipe or a device is
/// written directly.
class NewFile {
 public:
  /// The permissions of the file. Usual: the permissions of the file that it replaces or, for a
  /// new file, those that the umask allows. Owner: only the owner may read the file.
  enum class Readers { usual, owner };

  /// Throws Error{failed} if the destination cannot be written. If `path` is a link, its target is
  /// replaced.
  explicit NewFile(const Path& path, Readers readers = Readers::usual);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Both functions throw Error{failed}.
  void write(std::string_view bytes);
  void put_in_place();
  /// The open file, for other programs to write to.
  int descriptor() const { return descriptor_; }

 private:
  Path path_, temporary_;
  Readers readers_;
  int descriptor_ = -1;
};

/// A temporary folder for files that belong together. The destructor removes the folder with all
/// files that remain in it.
class NewFolder {
 public:
  /// Creates the folder next to a file. Throws Error{failed}.
  explicit NewFolder(const Path& neighbor);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  const Path& path() const { return path_; }

 private:
  Path path_;
  int descriptor_ = -1;
};

/// Replaces the file's content and flushes it to disk. On failure, throws Error{failed} and leaves
/// the file unchanged. Unless SIGPIPE is ignored, writing to a pipe without a reader ends the
/// program.
void write_file(const Path& path, const std::string& bytes,
                NewFile::Readers readers = NewFile::Readers::usual);
/// Like write_file(), but moves a finished file into place. This is fastest within one file system.
void move_file(const Path& finished, const Path& path);
/// Writes to standard output. Throws Error{failed} if not all bytes can be written.
void write_standard_output(const std::string& bytes);

/// Whether a file exists that this user cannot write to or whose permissions let nobody write to
/// it.
bool is_read_only(const Path& path);
/// Throws Error{failed} if the file is read-only.
void check_not_read_only(const Path& path);

/// A lock that shows that a running program owns something. It is released when the object is
/// destroyed or the program ends, even if the program is killed.
class FileLock {
 public:
  /// Creates the file if necessary and locks it. Throws Error{failed} if that is not possible.
  explicit FileLock(const Path& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  /// Whether any program, including this one, holds the lock.
  static bool is_held(const Path& path);

 private:
  Path path_;
  int descriptor_;
};

}  // namespace holomorph
