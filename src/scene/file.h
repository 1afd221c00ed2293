// Files as wholes: read at once, replaced atomically.
#pragma once

#include <filesystem>
#include <string>

namespace holomorph {

using Path = std::filesystem::path;

/// The bytes of a regular file. Throws Error{bad_input} when it is missing, a directory, unreadable
/// or larger than `limit` bytes.
std::string read_file(const Path& path, size_t limit = size_t{1} << 30);

/// Replaces the file's content or leaves it as it was: writes beside it, flushes to disk, renames.
/// Throws Error{failed} when that is not possible.
void write_file(const Path& path, const std::string& bytes);

/// The SHA-256 of bytes as 64 lower-case hexadecimal digits.
std::string sha256_hex(const std::string& bytes);

}  // namespace holomorph
