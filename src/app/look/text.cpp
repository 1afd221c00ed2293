// Hints are plain sentences. Names of keys are found in them and drawn as keys.
#include "app/look/text.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace holomorph {
namespace {

constexpr std::string_view kKeys[] = {"Shift", "Ctrl",      "Alt", "Esc", "Enter", "Del", "Tab",
                                      "Space", "Backspace", "F1",  "F2",  "F6",    "F10", "Home"};

bool is_letter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
         (static_cast<unsigned char>(c) & 0x80) != 0;
}

/// The end of the key's name that starts at `begin`, or `begin` if there is none.
size_t end_of_key(const std::string& text, size_t begin) {
  if (begin > 0 && is_letter(text[begin - 1])) return begin;
  for (const std::string_view key : kKeys)
    if (text.compare(begin, key.size(), key) == 0 &&
        (begin + key.size() == text.size() || !is_letter(text[begin + key.size()])))
      return begin + key.size();
  return begin;
}

/// Removes the last character of a text in UTF-8.
void drop_character(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

void wrapped_text(const std::string& text) {
  const float width = ImGui::GetContentRegionAvail().x;
  const auto fits = [&](const std::string& line) {
    return ImGui::CalcTextSize(line.c_str()).x <= width;
  };
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && !fits(line + " " + word)) {
      lines += line + "\n";
      line.clear();
    }
    line += line.empty() ? word : " " + word;
  }
  ImGui::TextUnformatted((lines + line).c_str());
}

void caption(const std::string& text) {
  const ScopedFont small(Type::caption);
  ImGui::PushStyleColor(ImGuiCol_Text, color_of(theme_colors().muted));
  wrapped_text(text);
  ImGui::PopStyleColor();
}

void colored_text(ImU32 color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color_of(color));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void muted_text(const std::string& text) {
  colored_text(theme_colors().muted, text);
}

std::string shortened_text(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string kept = text;
  do drop_character(kept);
  while (!kept.empty() && ImGui::CalcTextSize((kept + "...").c_str()).x > width);
  return kept.empty() ? "" : kept + "...";
}

std::string fitted_text(const std::string& text, float width) {
  std::string fitted = text;
  const auto is_wide = [&] { return ImGui::CalcTextSize(fitted.c_str()).x > width; };
  while (!fitted.empty() && is_wide()) {
    const size_t end = fitted.find_last_of(",;");
    fitted.resize(end == std::string::npos ? 0 : end);
  }
  if (!fitted.empty() || text.empty()) return fitted;
  return shortened_text(text.substr(0, text.find_first_of(",;")) + " ", width);
}

ImVec2 text_size(Type type, const std::string& text) {
  const ImFont& face = *font(type);
  return face.CalcTextSizeA(face.FontSize, 1e9f, 0, text.c_str());
}

void draw_text(ImDrawList& list, Type type, ImVec2 at, ImU32 color, const std::string& text) {
  const ImFont* face = font(type);
  list.AddText(face, face->FontSize, {std::round(at.x), std::round(at.y)}, faded(color),
               text.c_str());
}

void draw_wrapped_text(ImDrawList& list, Type type, ImVec2 at, ImU32 color, const std::string& text,
                       float width) {
  const ImFont* face = font(type);
  list.AddText(face, face->FontSize, {std::round(at.x), std::round(at.y)}, faded(color),
               text.c_str(), nullptr, width);
}

void draw_centered_text(ImDrawList& list, Type type, ImVec2 from, ImVec2 to, ImU32 color,
                        const std::string& text) {
  const ImVec2 size = text_size(type, text);
  draw_text(list, type, {(from.x + to.x - size.x) / 2, (from.y + to.y - size.y) / 2}, color, text);
}

void draw_icon(ImDrawList& list, const char* icon, ImVec2 center, ImU32 color, Type size) {
  const ImVec2 box = text_size(size, icon);
  draw_text(list, size, {center.x - box.x / 2, center.y - box.y / 2}, color, icon);
}

float draw_key_cap(ImDrawList& list, ImVec2 top, float height, const std::string& key) {
  const ThemeColors& c = theme_colors();
  const ImVec2 size = text_size(Type::caption, key);
  const float width = std::max(size.x + px(10), px(20)), tall = px(18),
              y = std::round(top.y + (height - tall) / 2);
  const ImVec2 from(std::round(top.x), y), to(std::round(top.x) + std::round(width), y + tall);
  list.AddRectFilled(from, to, faded(c.raised), px(4));
  list.AddRect(from, to, faded(c.edge), px(4));
  draw_centered_text(list, Type::caption, from, to, c.text, key);
  return to.x - from.x;
}

void draw_hint(ImDrawList& list, ImVec2 top, float height, ImU32 color, const std::string& text) {
  const float y = top.y + (height - font(Type::caption)->FontSize) / 2;
  float x = top.x;
  size_t plain = 0;
  const auto draw_plain = [&](size_t end) {
    const std::string part = text.substr(plain, end - plain);
    draw_text(list, Type::caption, {x, y}, color, part);
    x += text_size(Type::caption, part).x;
  };
  for (size_t i = 0; i < text.size(); ++i) {
    const size_t end = end_of_key(text, i);
    if (end == i) continue;
    draw_plain(i);
    x += draw_key_cap(list, {x, top.y}, height, text.substr(i, end - i)) + px(1);
    plain = end;
    i = end - 1;
  }
  draw_plain(text.size());
}

}  // namespace holomorph
