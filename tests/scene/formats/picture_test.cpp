// Picture files from other programs: every format, its colors, its orientation, and truncated
// files.
#include <tiffio.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <cstdio>  // before jpeglib.h
// These headers must stay in this order.
#include <jpeglib.h>
#include <lcms2.h>
#include <png.h>

#include <cstring>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/image.h"
#include "scene/formats/image_formats.h"
#include "scene/pictures.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/folder.h"
#include "support/pictures.h"
#include "support/seeds.h"
#include "system/new_file.h"

namespace holomorph::picture_test {

namespace {

/// A smooth picture with a mark in one corner, so that each of the eight orientations looks
/// different.
Image marked(int width, int height) {
  Image image(width, height);
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      std::uint8_t* p = image.at(c, r);
      p[0] = static_cast<std::uint8_t>(255 * c / width);
      p[1] = static_cast<std::uint8_t>(255 * r / height);
      p[2] = c < width / 3 && r < height / 3 ? 255 : 20;
      p[3] = 255;
    }
  return image;
}

/// The picture as a camera stores it in one of the eight orientations. Decoding it with orientation
/// `exif_orientation` makes it upright again.
Image stored_with_orientation(const Image& image, int exif_orientation) {
  const bool turned = exif_orientation >= 5;
  Image stored(turned ? image.height : image.width, turned ? image.width : image.height);
  // Exif states which sides of the upright picture become row 0 and column 0 of the stored picture.
  for (int r = 0; r < stored.height; ++r)
    for (int c = 0; c < stored.width; ++c) {
      const int row = turned ? c : r, column = turned ? r : c;
      const bool right = exif_orientation == 2 || exif_orientation == 3 || exif_orientation == 6 ||
                         exif_orientation == 7,
                 bottom = exif_orientation == 3 || exif_orientation == 4 || exif_orientation == 7 ||
                          exif_orientation == 8;
      std::memcpy(stored.at(c, r),
                  image.at(right ? image.width - 1 - column : column,
                           bottom ? image.height - 1 - row : row),
                  4);
    }
  return stored;
}

/// Exif data with only an orientation. Odd orientations use byte order 'II', even ones 'MM'.
std::string exif_of(int exif_orientation) {
  const char w = static_cast<char>(exif_orientation);
  const char little[] = {'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 1, 3,
                         0,   1,   0,  0, 0, w, 0, 0, 0, 0, 0,    0, 0};
  const char big[] = {'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1, 1, 0x12, 0,
                      3,   0,   0, 0,  1, 0, w, 0, 0, 0, 0, 0,    0};
  return exif_orientation % 2 ? std::string(little, sizeof little) : std::string(big, sizeof big);
}

int largest_difference(const Image& a, const Image& b) {
  REQUIRE(a.width == b.width);
  REQUIRE(a.height == b.height);
  int most = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
  return most;
}

/// A linear-light profile with the primaries of Adobe RGB. The next function converts its colors to
/// sRGB directly from the two definitions, without a library.
std::string linear_adobe() {
  cmsCIExyY white{0.3127, 0.3290, 1};
  cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};
  cmsToneCurve* linear = cmsBuildGamma(nullptr, 1);
  cmsToneCurve* curves[3] = {linear, linear, linear};
  cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  cmsFreeToneCurve(linear);
  return bytes;
}

std::array<double, 3> srgb_of_linear_adobe(const std::uint8_t* p) {
  const double r = p[0] / 255.0, g = p[1] / 255.0, b = p[2] / 255.0;
  const double linear[3] = {1.3984 * r - 0.3984 * g, g, -0.0429 * g + 1.0429 * b};
  std::array<double, 3> out{};
  for (size_t k = 0; k < 3; ++k) {
    const double v = std::clamp(linear[k], 0.0, 1.0);
    out[k] = 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
  }
  return out;
}

void check_adobe(const Image& stored, const Image& read, double allowed) {
  REQUIRE(read.width == stored.width);
  for (int r = 0; r < stored.height; ++r)
    for (int c = 0; c < stored.width; ++c) {
      const auto wanted = srgb_of_linear_adobe(stored.at(c, r));
      for (size_t k = 0; k < 3; ++k)
        if (std::abs(read.at(c, r)[k] - wanted[k]) > allowed)
          FAIL_CHECK("pixel " << c << ", " << r << " channel " << k << ": " << int(read.at(c, r)[k])
                              << ", expected " << wanted[k]);
    }
}

struct BudgetGuard {
  Budget before = budget();
  explicit BudgetGuard(const Budget& now) { set_budget(now); }
  ~BudgetGuard() { set_budget(before); }
};

}  // namespace

TEST_CASE("Pictures of every format are upright in every orientation of the camera") {
  const Image image = marked(21, 13);
  for (int exif_orientation = 1; exif_orientation <= 8; ++exif_orientation) {
    CAPTURE(exif_orientation);
    const Image stored = stored_with_orientation(image, exif_orientation);
    CHECK(decode_image(png_file(stored, {.exif = exif_of(exif_orientation)}), "a.png") == image);
    CHECK(decode_image(webp_file(stored, {.exif = exif_of(exif_orientation)}), "a.webp") == image);
    CHECK(decode_image(webp_file(stored, {.exif = "Exif" + std::string(2, '\0') +
                                                  exif_of(exif_orientation)}),
                       "a.webp") == image);
    CHECK(decode_image(tiff_file(stored, {.orientation = exif_orientation}), "a.tif") == image);
    CHECK(largest_difference(
              decode_image(jpeg_file(stored, {.exif = exif_of(exif_orientation)}), "a.jpg"),
              image) < 30);
  }
  CHECK(decode_image(png_file(image, {.exif = exif_of(9)}), "a.png") == image);
  CHECK(decode_image(png_file(image, {.exif = "II*"}), "a.png") == image);
}

TEST_CASE("Colors are converted from a profile to sRGB") {
  const Image image = marked(40, 30);
  const std::string profile = linear_adobe();
  check_adobe(image, decode_image(png_file(image, {.profile = profile}), "a.png"), 1.6);
  check_adobe(image, decode_image(webp_file(image, {.profile = profile}), "a.webp"), 1.6);
  check_adobe(image, decode_image(tiff_file(image, {.profile = profile}), "a.tif"), 1.6);
  const std::string jpeg = jpeg_file(image, {}), tagged = jpeg_file(image, {.profile = profile});
  check_adobe(decode_image(jpeg, "a.jpg"), decode_image(tagged, "a.jpg"), 1.6);
  // sRGB itself and damaged profiles change nothing.
  cmsHPROFILE srgb = cmsCreate_sRGBProfile();
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(srgb, nullptr, &size);
  std::string same(size, '\0');
  cmsSaveProfileToMem(srgb, same.data(), &size);
  cmsCloseProfile(srgb);
  CHECK(decode_image(png_file(image, {.profile = same}), "a.png") == image);
  CHECK(decode_image(webp_file(image, {.profile = "no profile"}), "a.webp") == image);
}

TEST_CASE("The gamma and primaries of a PNG are applied, and those of sRGB change nothing") {
  const Image image = marked(40, 30);
  CHECK(decode_image(png_file(image, {.gamma = 1 / 2.2}), "a.png") == image);
  check_adobe(image, decode_image(png_file(image, {.gamma = 1, .adobe = true}), "a.png"), 1.6);
  check_adobe(image,
              decode_image(png_file(image, {.gamma = 1, .adobe = true, .sixteen = true}), "a.png"),
              1.6);
  check_adobe(image,
              decode_image(png_file(image, {.profile = linear_adobe(), .sixteen = true}), "a.png"),
              1.6);
  // A file that is marked as sRGB is sRGB, whatever else it states.
  CHECK(decode_image(png_file(image, {.gamma = 1, .srgb = true}), "a.png") == image);
  const Image dark = decode_image(png_file(image, {.gamma = 1.0 / 1.8}), "a.png");
  CHECK(dark.at(20, 15)[0] > image.at(20, 15)[0]);  // 1.8 is lighter than 2.2
}

TEST_CASE("PNG is read in all bit depths and variants") {
  const Image image = marked(37, 23);
  CHECK(decode_image(png_file(image, {.sixteen = true}), "a.png") == image);
  CHECK(decode_image(png_file(image, {.interlaced = true}), "a.png") == image);
  CHECK(decode_image(png_file(image, {.interlaced = true, .sixteen = true}), "a.png") == image);
  const Image gray = decode_image(png_file(image, {.gray_bits = 2}), "a.png");
  for (int c = 0; c < image.width; ++c) {
    const int step = image.at(c, 5)[0] >> 6;
    CHECK(gray.at(c, 5)[0] == step * 85);
    CHECK(gray.at(c, 5)[1] == step * 85);
    CHECK(gray.at(c, 5)[3] == 255);
  }
}

TEST_CASE("JPEG is read in gray, in both kinds of CMYK, and progressive") {
  const Image image = marked(40, 30);
  const Image colors = decode_image(jpeg_file(image, {}), "a.jpg");
  CHECK(largest_difference(decode_image(jpeg_file(image, {.progressive = true}), "a.jpg"),
                           colors) == 0);
  const Image gray = decode_image(jpeg_file(image, {.kind = JpegKind::gray}), "a.jpg");
  CHECK(gray.at(20, 20)[0] == gray.at(20, 20)[2]);
  CHECK(largest_difference(decode_image(jpeg_file(image, {.kind = JpegKind::inks}), "a.jpg"),
                           image) < 40);
  CHECK(largest_difference(decode_image(jpeg_file(image, {.kind = JpegKind::adobe_inks}), "a.jpg"),
                           image) < 40);
  CHECK_THAT(error_message_of([&] {
               decode_image(jpeg_file(image, {.progressive = true, .many_scans = true}), "a.jpg");
             }),
             Catch::Contains("more than 100 passes"));
}

TEST_CASE("Colors of faint pixels in TIFF pictures stay as they are") {
  for (const unsigned seed : seeds_of("faint pixels", {1})) {
    std::mt19937 random(seed);
    Image image(60, 50);
    for (std::uint8_t& value : image.pixels) value = static_cast<std::uint8_t>(random());
    CHECK(decode_image(tiff_file(image, {}), "a.tif").pixels == image.pixels);
  }
}

TEST_CASE("Attributes of OpenEXR pictures take no more memory than the file") {
  const Image image = marked(40, 30);
  const std::string plain = encode_exr(image, 16);
  const Image shown = decode_image(plain, "a.exr");
  // One strip of the picture starts at an offset that is stored after the header.
  constexpr size_t kVersionEnd = 8;
  const auto with_attribute = [&](const std::string& type, const std::string& value,
                                  std::uint32_t length) {
    const std::string added =
        "extra" + std::string(1, 0) + type + std::string(1, 0) + little(length, 4) + value;
    std::string bytes = plain;
    bytes.insert(kVersionEnd, added);
    const size_t table = bytes.find(std::string(1, 0), bytes.find("screenWindowWidth")) + 1 +
                         std::strlen("float") + 1 + 4 + 4 + 1;
    for (size_t strip = 0; strip < 2; ++strip) {
      std::uint64_t at = 0;
      std::memcpy(&at, bytes.data() + table + 8 * strip, 8);
      at += added.size();
      std::memcpy(bytes.data() + table + 8 * strip, &at, 8);
    }
    return bytes;
  };
  const std::string two_gigabytes = little(0x7fffffff, 4);
  // Pictures of 65535 x 65535 pixels, lists of long texts, and types that nobody knows.
  struct Attribute {
    std::string type, value;
  };
  for (const Attribute& attribute : std::vector<Attribute>{{"preview", little(0xffff0000ffff, 8)},
                                                           {"stringvector", two_gigabytes + "a"},
                                                           {"idmanifest", two_gigabytes},
                                                           {"bytes", two_gigabytes},
                                                           {"unheard of", "abc"},
                                                           {"string", "abc"}}) {
    const std::string &type = attribute.type, &value = attribute.value;
    CAPTURE(type);
    CHECK(
        decode_image(with_attribute(type, value, static_cast<std::uint32_t>(value.size())), "a.exr")
            .pixels == shown.pixels);
    for (const std::uint32_t length : {0x7fffffffu, 0xffffffffu, 100000u})
      CHECK_THAT(
          error_message_of([&] { decode_image(with_attribute(type, value, length), "a.exr"); }),
          Catch::Contains("cannot be read: the file ends too early"));
  }
}

TEST_CASE("A picture that ends too early anywhere gives an error that says so") {
  const Image image = marked(64, 48);
  struct Kind {
    const char* name;
    std::string bytes;
    size_t tail = 0;  ///< bytes at the end that are not needed
  };
  const std::vector<Kind> kinds{
      {"a.png", png_file(image, {})},      {"i.png", png_file(image, {.interlaced = true})},
      {"a.jpg", jpeg_file(image, {})},     {"p.jpg", jpeg_file(image, {.progressive = true})},
      {"a.webp", webp_file(image, {}), 1}, {"a.tif", tiff_file(image, {})},
      {"a.gif", gif_file(image), 1},       {"a.bmp", bmp_file(image)},
      {"a.tga", tga_file(image, false)},   {"r.tga", tga_file(image, true)},
      {"a.psd", psd_file(image, false)},   {"r.psd", psd_file(image, true)}};
  for (const unsigned seed : seeds_of("cut pictures", {1, 2})) {
    std::mt19937 random(seed);
    for (const Kind& kind : kinds) {
      CAPTURE(seed, kind.name);
      const Image whole = decode_image(kind.bytes, kind.name);
      CHECK(whole.width == 64);
      CHECK(whole.height == 48);
      for (int trial = 0; trial < 40; ++trial) {
        const size_t length = trial == 0 ? kind.bytes.size() - kind.tail - 1
                                         : std::uniform_int_distribution<size_t>(
                                               0, kind.bytes.size() - 2 - kind.tail)(random);
        CAPTURE(length, kind.bytes.size());
        const std::string said =
            error_message_of([&] { decode_image(kind.bytes.substr(0, length), kind.name); });
        CHECK_THAT(said, Catch::Contains("incomplete") || Catch::Contains("damaged") ||
                             Catch::Contains("cannot be read") || Catch::Contains("not a picture"));
      }
    }
  }
  // A row table without any row data.
  std::string rows = psd_file(Image(64, 48), true);
  rows.resize(26 + 12 + 2 + 2 * 4 * 48);
  std::fill(rows.begin() + 26 + 12 + 2, rows.end(), '\0');
  CHECK_THAT(error_message_of([&] { decode_image(rows, "a.psd"); }),
             Catch::Contains("wrong length"));
  // A picture of 65535 x 65535 on a canvas of 1 x 1.
  std::string gif = "GIF89a" + little(1, 2) + little(1, 2) +
                    std::string("\x80\0\0\0\0\0\0\0\0,", 10) + little(0, 4) + little(65535, 2) +
                    little(65535, 2) + std::string("\0\2\2\x44\1\0;", 7);
  CHECK_THAT(error_message_of([&] { decode_image(gif, "a.gif"); }), Catch::Contains("pixels"));
  // A file of 23 bytes that claims 16384 x 16384 pixels.
  std::string claim("\0\0\x0a\0\0\0\0\0\0\0\0\0\0\x40\0\x40\x20\x08\xff\0\0\0\0", 23);
  CHECK_THAT(error_message_of([&] { decode_image(claim, "a.tga"); }), Catch::Contains("pixels"));
  claim[13] = claim[15] = 0x10;  // 4096 x 4096
  CHECK_THAT(error_message_of([&] { decode_image(claim, "a.tga"); }),
             Catch::Contains("incomplete"));
}

TEST_CASE("A JPEG with too many Huffman codes is an error") {
  const auto segment = [](char kind, const std::string& content) {
    const size_t size = content.size() + 2;
    return std::string{'\xff', kind, static_cast<char>(size >> 8), static_cast<char>(size)} +
           content;
  };
  std::string counts(9, '\0');
  counts += "\xff\xff\xff" + std::string(4, '\0') + std::string(765, '\xff');
  const std::string bytes =
      "\xff\xd8" + segment('\xdb', std::string(1, '\0') + std::string(64, '\1')) +
      segment('\xc0', std::string("\x08\0\x10\0\x10\1\1\x11\0", 9)) +
      segment('\xc4', std::string(1, '\0') + counts) + segment('\xc4', "\x10" + counts) +
      segment('\xda', std::string("\1\1\0\0\x3f\0", 6)) + std::string(99, '\0');
  CHECK_THAT(error_message_of([&] { decode_image(bytes, "dht.jpg"); }), Catch::Contains("damaged"));
}

TEST_CASE("All pictures of a scene share one pixel budget") {
  Budget small = budget();
  small.pixels = 10000;
  const BudgetGuard raised(small);
  const Folder folder;
  write_file(folder.path / "a.png", encode_png(Image(60, 100)));
  write_file(folder.path / "b.png", encode_png(Image(50, 100)));
  PictureFiles files;
  files.picture(reference_in(folder.path / "a.png"));
  CHECK_THAT(error_message_of([&] { files.picture(reference_in(folder.path / "b.png")); }),
             Catch::Contains("b.png") && Catch::Contains("--max-pixels"));
  CHECK(PictureFiles().picture(reference_in(folder.path / "b.png")).image->width == 50);
  CHECK_THAT(error_message_of([] { decode_image(bmp_file(Image(200, 51)), "a.bmp"); }),
             Catch::Contains("--max-pixels"));
}

}  // namespace holomorph::picture_test
