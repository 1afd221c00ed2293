// Operations on whole files, which are read in one piece and replaced atomically.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"

namespace holomorph {

using Path = std::filesystem::path;

/// The absolute path without dots; the path itself if the working folder no longer exists.
Path absolute_path(const Path& path);

/// Whether there is a file or folder with this name; false for names that cannot be looked up.
bool path_exists(const Path& path);
/// Whether there is a regular file with this name.
bool is_file(const Path& path);

/// The bytes of a regular file. Throws Error{bad_input} if it is missing, a directory, unreadable
/// or larger than `limit` bytes.
std::string read_file(const Path& path, size_t limit = size_t{1} << 30);

/// The same, and also reads a pipe or a device up to its end. It may wait, so use it for files that
/// the user names, not for those that a file names.
std::string read_stream(const Path& path, size_t limit = size_t{1} << 30);

/// All bytes of standard input, at most `limit`. Throws Error{bad_input} if there are more.
std::string read_standard_input(size_t limit = size_t{1} << 30);

/// A file that is being written. It is written under a short temporary name next to its
/// destination, and appears there as a whole when it is put in place, or never. What a killed
/// program leaves behind is removed by the next NewFile or NewFolder in that folder. A pipe or a
/// device is written directly.
class NewFile {
 public:
  /// Who may read the file. Usual: the same users as the file that it replaces, or those that the
  /// umask allows. Owner: only its owner.
  enum class Readers { usual, owner };

  /// Throws Error{failed} if nothing can be written there. A link keeps its target.
  explicit NewFile(const Path& path, Readers readers = Readers::usual);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Both throw Error{failed}.
  void write(std::string_view bytes);
  void put_in_place();
  /// The open file, for other programs to write to.
  int descriptor() const { return descriptor_; }

 private:
  Path path_, temporary_;
  Readers readers_;
  int descriptor_ = -1;
};

/// A temporary folder for files that belong together. Whatever is not moved out of it is removed.
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

/// Replaces the file's content, flushed to disk, or throws Error{failed} and leaves the file as it
/// was. Unless SIGPIPE is ignored, writing to a pipe without a reader ends the program.
void write_file(const Path& path, const std::string& bytes,
                NewFile::Readers readers = NewFile::Readers::usual);
/// Replaces a file's content in the same way by a finished file, ideally in the same file system.
/// The finished file is gone afterwards.
void move_file(const Path& finished, const Path& path);
/// Whether a path names something that is written into instead of being replaced: a pipe or a
/// device. Throws Error for a folder.
bool is_stream(const Path& path);
/// Throws Error{failed} if not all of it can be written to standard output.
void write_standard_output(const std::string& bytes);

/// Whether there is such a file and this user may not write it, or its permissions let nobody write
/// it.
bool is_read_only(const Path& path);
/// Throws Error{failed} if the file is read-only.
void check_not_read_only(const Path& path);

/// A mark that a running program owns something. It is held until the object is destroyed or the
/// program ends, however it ends.
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

/// The error with the file's name in front, unless its message already starts with it.
Error about(const Path& file, const Error& error);

/// A text that may come from a file, with a question mark for each character that would control a
/// terminal or change the text direction.
std::string printable(const std::string& text);

/// The text with ASCII letters in lower case, for extensions and searches.
std::string lower_case(std::string text);
/// Whether a text contains all of these words, in lower or upper case.
bool has_words(const std::string& text, const std::string& words);

/// The SHA-256 of bytes as 64 lower-case hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

}  // namespace holomorph
