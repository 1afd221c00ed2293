// Icons are characters of the fonts, so that they line up with text and take its color.
#include "app/look/fonts.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "app/look/theme.h"
#include "edit/actions/icons.h"
#include "icon_sheets.h"
#include "scene/formats/image.h"
#include "system/program.h"

namespace holomorph {
namespace {

constexpr int kShadow = 64;  ///< width of the blurred square
int shadow_rectangle = 0;

constexpr bool icons_agree() {
  if (std::size(kIconNames) != std::size(kDrawnIcons)) return false;
  for (size_t i = 0; i < std::size(kIconNames); ++i)
    if (std::string_view(kIconNames[i]) != kDrawnIcons[i]) return false;
  return true;
}
static_assert(icons_agree(), "kIconNames lists the files in assets/icons");

struct Face {
  const char* file;
  int height;  ///< ascent to descent
  int icon;    ///< width of the icons
};
/// In the order of Type.
constexpr Face kFaces[] = {{HOLOMORPH_FONT_FILE, 16, 20},
                           {HOLOMORPH_STRONG_FONT_FILE, 16, 20},
                           {HOLOMORPH_STRONG_FONT_FILE, 20, 20},
                           {HOLOMORPH_STRONG_FONT_FILE, 32, 20},
                           {HOLOMORPH_FONT_FILE, 14, 16}};

ImFont* add_face(const Face& face, float height) {
  static const ImWchar kRanges[] = {0x20,   0x24f,  0x370,  0x3ff,  0x2010, 0x2044,
                                    0x20ac, 0x20ac, 0x2190, 0x2193, 0};
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.OversampleH = face.height > 16 ? 1 : 2;  // more makes the atlas large and hardly sharper
  const Path built = face.file, file = data_file("fonts/" + built.filename().string(), built);
  if (is_file(file)) return fonts.AddFontFromFileTTF(file.c_str(), height, &config, kRanges);
  config.SizePixels = height;
  return fonts.AddFontDefault(&config);
}

/// The sheet with the smallest icons that are at least `width` wide, or the largest ones.
const IconSheet& sheet_for(float width) {
  for (const IconSheet& sheet : kIconSheets)
    if (static_cast<float>(sheet.size) >= width) return sheet;
  return kIconSheets[std::size(kIconSheets) - 1];
}

/// The atlas's pixels while it is being built.
struct Pixels {
  unsigned char* rgba = nullptr;
  int width = 0, height = 0;
  void put(int x, int y, unsigned char alpha) {
    unsigned char* pixel =
        rgba + 4 * (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x));
    std::fill_n(pixel, 3, static_cast<unsigned char>(255));
    pixel[3] = alpha;
  }
};

void put_icons(Pixels& pixels, const IconSheet& sheet, const std::vector<int>& rectangles) {
  const Image image = decode_image(std::string(sheet.png), "icons");
  for (size_t icon = 0; icon < rectangles.size(); ++icon) {
    const ImFontAtlasCustomRect& at = *ImGui::GetIO().Fonts->GetCustomRectByIndex(rectangles[icon]);
    for (int y = 0; y < sheet.size; ++y)
      for (int x = 0; x < sheet.size; ++x) {
        pixels.put(at.X + x, at.Y + y, image.at(static_cast<int>(icon) * sheet.size + x, y)[3]);
      }
  }
}

/// A square of half the width, blurred by a Gaussian.
void put_shadow(Pixels& pixels) {
  const ImFontAtlasCustomRect& at = *ImGui::GetIO().Fonts->GetCustomRectByIndex(shadow_rectangle);
  const auto edge = [](double from_center) {
    return 0.5 * std::erfc((std::abs(from_center) - kShadow / 4.0) / (kShadow / 9.0));
  };
  for (int y = 0; y < kShadow; ++y)
    for (int x = 0; x < kShadow; ++x)
      pixels.put(at.X + x, at.Y + y,
                 static_cast<unsigned char>(std::lround(255 * edge(x + 0.5 - kShadow / 2.0) *
                                                        edge(y + 0.5 - kShadow / 2.0))));
}

}  // namespace

void load_fonts() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  struct Icons {
    const IconSheet* sheet;
    std::vector<int> rectangles;
  };
  std::vector<Icons> all;
  for (const Face& face : kFaces) {
    const float height = px(face.height), width = px(face.icon);
    ImFont* added = add_face(face, height);
    Icons icons{&sheet_for(width), {}};
    for (size_t i = 0; i < std::size(kIconNames); ++i)
      icons.rectangles.push_back(fonts.AddCustomRectFontGlyph(
          added, static_cast<ImWchar>(kFirstIcon + i), icons.sheet->size, icons.sheet->size, width,
          {0, std::round((height - width) / 2)}));
    all.push_back(std::move(icons));
  }
  shadow_rectangle = fonts.AddCustomRectRegular(kShadow, kShadow);
  Pixels pixels;
  fonts.GetTexDataAsRGBA32(&pixels.rgba, &pixels.width, &pixels.height);
  for (const Icons& icons : all) put_icons(pixels, *icons.sheet, icons.rectangles);
  put_shadow(pixels);
  // A sheet's icons may be larger than needed. The glyphs are drawn at the size that is needed.
  for (int i = 0; i < fonts.Fonts.Size; ++i)
    for (ImFontGlyph& glyph : fonts.Fonts[i]->Glyphs)
      if (glyph.Codepoint >= kFirstIcon && glyph.Codepoint < kFirstIcon + std::size(kIconNames)) {
        const float width = px(kFaces[i].icon);
        glyph.X1 = glyph.X0 + width;
        glyph.Y1 = glyph.Y0 + width;
      }
}

std::pair<ImVec2, ImVec2> shadow_texture() {
  const ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  ImVec2 from, to;
  fonts.CalcCustomRectUV(ImGui::GetIO().Fonts->GetCustomRectByIndex(shadow_rectangle), &from, &to);
  return {from, to};
}

}  // namespace holomorph
