#include "system/text.h"

#include <array>
#include <charconv>
#include <sstream>

#include "core/error.h"

namespace holomorph {

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

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

std::string decimal(double value, int digits) {
  std::array<char, 400> text{};
  const auto [end, wrong] = std::to_chars(text.data(), text.data() + text.size(), value,
                                          std::chars_format::fixed, digits);
  check(wrong == std::errc{}, "decimal: the number fits");
  return {text.data(), end};
}

bool has_words(const std::string& text, const std::string& words) {
  const std::string all = lower_case(text);
  std::istringstream each(lower_case(words));
  for (std::string word; each >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
}
}  // namespace holomorph
