// Text for display and for searches.
#pragma once

#include <string>
#include <string_view>

namespace holomorph {

/// The text, made safe for display. A question mark replaces each character that would control a
/// terminal or change the text direction.
std::string printable(const std::string& text);

/// The text with ASCII letters in lower case, for extensions and searches.
std::string lower_case(std::string text);
/// The text without blanks and line ends around it.
std::string trimmed(std::string_view text);
/// Text in UTF-8. Halves of surrogate pairs become question marks.
std::string utf8_of(std::u16string_view text);
/// The UTF-8 of a text file that may be in UTF-16. A byte order mark tells, and is removed.
std::string utf8_of_file(std::string bytes);
/// A number in decimal notation with this many digits after the point, in any locale.
std::string decimal(double value, int digits);
/// Whether a text contains all of these words, ignoring case.
bool has_words(const std::string& text, const std::string& words);

}  // namespace holomorph
