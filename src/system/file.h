// Files as wholes: read at once, replaced atomically.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"

namespace holomorph {

using Path = std::filesystem::path;

/// From the root on, without dots; the path itself where there is no working folder any more.
Path absolute_path(const Path& path);

/// Whether there is a file or folder of this name; false for names that cannot be asked for.
bool is_there(const Path& path);
/// Whether there is a regular file of this name.
bool is_file(const Path& path);

/// The bytes of a regular file. Throws Error{bad_input} when it is missing, a directory, unreadable
/// or larger than `limit` bytes.
std::string read_file(const Path& path, size_t limit = size_t{1} << 30);

/// The same, and of a pipe or a device up to its end: for what a user names, not for what a file
/// does, because it waits.
std::string read_stream(const Path& path, size_t limit = size_t{1} << 30);

/// All bytes of standard input, `limit` at most. Throws Error{bad_input} when there are more.
std::string read_standard_input(size_t limit = size_t{1} << 30);

/// A file that comes into being: written beside where it goes, under a short name of its own, and
/// there as a whole when it is put in place, or never. What a killed program leaves behind is
/// removed by the next NewFile or NewFolder in that folder. A pipe or a device is written into at
/// once.
class NewFile {
 public:
  /// Who may read it. The usual: as with the file that it replaces, or as the umask says; or only
  /// its owner.
  enum class Readers { usual, owner };

  /// Throws Error{failed} when nothing can be written there. A link keeps pointing where it points.
  explicit NewFile(const Path& path, Readers readers = Readers::usual);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Throw Error{failed}.
  void write(std::string_view bytes);
  void put_in_place();
  /// Open for writing, for other programs.
  int descriptor() const { return descriptor_; }

 private:
  Path path_, temporary_;
  Readers readers_;
  int descriptor_ = -1;
};

/// A temporary folder for files that belong together; whatever is not moved out of it is removed.
class NewFolder {
 public:
  /// Beside a file. Throws Error{failed}.
  explicit NewFolder(const Path& beside);
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  const Path& path() const { return path_; }

 private:
  Path path_;
  int descriptor_ = -1;
};

/// Replaces the file's content or leaves it as it was: a NewFile with all of it, flushed to disk.
/// Throws Error{failed} when that is not possible. Where SIGPIPE is not ignored, a pipe without a
/// reader ends the program.
void write_file(const Path& path, const std::string& bytes,
                NewFile::Readers readers = NewFile::Readers::usual);
/// The same with the content of a finished file in the same file system, which is gone afterwards.
void move_file(const Path& finished, const Path& path);
/// Whether a path names something that is written into and not replaced: a pipe, a device. Throws
/// Error for a folder.
bool is_stream(const Path& path);
/// Throws Error{failed} when standard output does not take all of it.
void write_standard_output(const std::string& bytes);

/// Whether there is a file that this user may not write, or whose permissions say that nobody may.
bool is_read_only(const Path& path);
/// Throws Error{failed} where there is one.
void check_not_read_only(const Path& path);

/// A mark that a running program owns something: held until destroyed, and by nobody once the
/// program has ended, however it ended.
class FileLock {
 public:
  /// Creates the file if need be and locks it. Throws Error{failed} when that is not possible.
  explicit FileLock(const Path& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  /// Whether some program, this one included, holds the lock.
  static bool is_held(const Path& path);

 private:
  Path path_;
  int descriptor_;
};

/// The error with the file's name in front, unless it starts with it.
Error about(const Path& file, const Error& error);

/// A text that may come from a file, with a question mark for each character that would control a
/// terminal or change the direction of writing.
std::string printable(const std::string& text);

/// ASCII capitals made small: for extensions and searches.
std::string lower_case(std::string text);
/// Whether a text has all of these words, in lower or upper case.
bool has_words(const std::string& text, const std::string& words);

/// The SHA-256 of bytes as 64 lower-case hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

}  // namespace holomorph
