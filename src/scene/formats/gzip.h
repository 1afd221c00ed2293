// Unpacks gzip files.
#pragma once

#include <string>

namespace holomorph {

bool is_gzip(const std::string& bytes);
/// The content of a gzip file. Throws Error{bad_input} if it is damaged or larger than `most`
/// bytes.
std::string unpacked_gzip(const std::string& bytes, const std::string& name, size_t most);

}  // namespace holomorph
