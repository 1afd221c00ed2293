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

std::string utf8_of(std::u16string_view text) {
  std::string utf8;
  const auto put = [&](unsigned byte) { utf8 += static_cast<char>(byte); };
  const auto is_half = [](char16_t unit, unsigned first) { return (unit & 0xfc00u) == first; };
  for (size_t i = 0; i < text.size(); ++i) {
    unsigned code = text[i];
    if (is_half(text[i], 0xd800) && i + 1 < text.size() && is_half(text[i + 1], 0xdc00))
      code = 0x10000 + ((code - 0xd800) << 10) + (text[++i] - 0xdc00u);
    else if (is_half(text[i], 0xd800) || is_half(text[i], 0xdc00))
      code = '?';
    if (code < 0x80) {
      put(code);
      continue;
    }
    if (code < 0x800) {
      put(0xc0 | code >> 6);
    } else if (code < 0x10000) {
      put(0xe0 | code >> 12);
      put(0x80 | (code >> 6 & 63));
    } else {
      put(0xf0 | code >> 18);
      put(0x80 | (code >> 12 & 63));
      put(0x80 | (code >> 6 & 63));
    }
    put(0x80 | (code & 63));
  }
  return utf8;
}

std::string utf8_of_file(std::string bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) return bytes.substr(3);
  const bool low_first = bytes.starts_with("\xff\xfe");
  if (!low_first && !bytes.starts_with("\xfe\xff")) return bytes;
  std::u16string units;
  for (size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const auto byte = [&](size_t k) { return static_cast<unsigned char>(bytes[i + k]); };
    units += static_cast<char16_t>(low_first ? byte(1) << 8 | byte(0) : byte(0) << 8 | byte(1));
  }
  return utf8_of(units);
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
