// Paths, and files that are read in one piece. new_file.h writes files.
#pragma once

#include <filesystem>
#include <string>

#include "core/error.h"

namespace holomorph {

using Path = std::filesystem::path;

/// The absolute path without "." and ".."; the path itself if the working folder no longer exists.
Path absolute_path(const Path& path);

/// Whether a file or folder with this name exists. False if the name cannot be looked up.
bool path_exists(const Path& path);
/// Whether a regular file with this name exists.
bool is_file(const Path& path);

/// The bytes of a regular file. Throws Error{bad_input} if it is missing, a directory, unreadable
/// or larger than `limit` bytes.
std::string read_file(const Path& path, size_t limit = size_t{1} << 30);

/// The first bytes of a regular file, at most `count`. Throws Error{bad_input} like read_file().
std::string read_start(const Path& path, size_t count);

/// Like read_file(), but also reads a pipe or a device up to its end. The call may block. Use it
/// only for files that the user names, not for files that another file names.
std::string read_stream(const Path& path, size_t limit = size_t{1} << 30);

/// All bytes of standard input. Throws Error{bad_input} if there are more than `limit`.
std::string read_standard_input(size_t limit = size_t{1} << 30);

/// Whether a path names a pipe or a device, which is written directly instead of being replaced.
/// Throws Error for a folder.
bool is_stream(const Path& path);

/// The error with the file's name in front of the message, unless the message already starts with
/// the name.
Error about(const Path& file, const Error& error);

/// The SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

}  // namespace holomorph
