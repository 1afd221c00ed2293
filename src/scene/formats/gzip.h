// Unpacks gzip files.
#pragma once

#include <string>

namespace holomorph {

bool is_gzip(const std::string& bytes);
/// The content of a gzip file, of several joined ones only that of the first. Throws
/// Error{bad_input} if it is damaged or larger than `most` bytes.
std::string unpacked_gzip(const std::string& bytes, const std::string& name, size_t most);

/// The first bytes of that content, at most `count`; fewer if the file is damaged.
std::string start_of_gzip(const std::string& bytes, size_t count);

}  // namespace holomorph
