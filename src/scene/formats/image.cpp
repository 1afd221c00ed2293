// The table of formats: which library reads and writes which format.
#include "scene/formats/image.h"

#include <libexif/exif-data.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "scene/budget.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/psd_image.h"
#include "system/text.h"

namespace holomorph {

void PixelBudget::take(size_t width, size_t height, const std::string& name, double copies) {
  if (width == 0 || height == 0)
    throw Error(ErrorKind::bad_input, name + ": the picture has no pixels");
  if (width > kLargestSide || height > kLargestSide)
    throw Error(ErrorKind::bad_input, name + ": the picture has " + std::to_string(width) + " x " +
                                          std::to_string(height) + " pixels; at most " +
                                          std::to_string(kLargestSide) + " per side can be opened");
  const double pixels = static_cast<double>(width) * static_cast<double>(height);
  check_budget(&Budget::pixels, taken_ + copies * pixels,
               name + (copies > 1   ? ": decoding this picture takes the memory of"
                       : taken_ > 0 ? ": with this picture, all pictures together have"
                                    : ": the picture has"));
  taken_ += pixels;
}

int orientation_of_exif(const std::string& bytes) {
  const std::unique_ptr<ExifData, void (*)(ExifData*)> data(
      exif_data_new_from_data(reinterpret_cast<const unsigned char*>(bytes.data()),
                              static_cast<unsigned>(bytes.size())),
      exif_data_unref);
  if (!data) return 1;
  const ExifEntry* entry = exif_content_get_entry(data->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 1;
  const int orientation = exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
  return orientation >= 1 && orientation <= 8 ? orientation : 1;
}

Image upright(Image image, int orientation) {
  if (orientation <= 1 || orientation > 8) return image;
  const bool turned = orientation >= 5;
  Image result(turned ? image.height : image.width, turned ? image.width : image.height);
  result.fine.resize(image.fine.size());
  const int w = image.width - 1, h = image.height - 1;
  for (int r = 0; r < result.height; ++r)
    for (int c = 0; c < result.width; ++c) {
      // The position, in the stored picture, of a pixel of the upright picture.
      const auto [column, row] = orientation == 2   ? std::pair(w - c, r)
                                 : orientation == 3 ? std::pair(w - c, h - r)
                                 : orientation == 4 ? std::pair(c, h - r)
                                 : orientation == 5 ? std::pair(r, c)
                                 : orientation == 6 ? std::pair(r, h - c)
                                 : orientation == 7 ? std::pair(w - r, h - c)
                                                    : std::pair(w - r, c);
      std::memcpy(result.at(c, r), image.at(column, row), 4);
      if (!image.fine.empty())
        std::copy_n(&image.fine[image.index(column, row)], 4, &result.fine[result.index(c, r)]);
    }
  return result;
}

void round_fine(Image& image) {
  for (size_t i = 0; i < image.fine.size(); ++i)
    image.pixels[i] = image.fine[i] > 0  // also for NaN
                          ? static_cast<std::uint8_t>(std::min(image.fine[i] + 0.5f, 255.0f))
                          : 0;
}

PixelRange filled_range(const Image& image) {
  PixelRange range{image.width, image.height, 0, 0};
  for (int r = 0; r < image.height; ++r)
    for (int c = 0; c < image.width; ++c)
      if (is_filled(image, c, r))
        range = {std::min(range.left, c), std::min(range.top, r), std::max(range.right, c + 1),
                 std::max(range.bottom, r + 1)};
  return range;
}

Image nothing_on(const Box& canvas) {
  Image nothing(1, 1);
  nothing.left = static_cast<int>(canvas.left);
  nothing.bottom = static_cast<int>(canvas.bottom);
  nothing.canvas = canvas;
  return nothing;
}

Image cut_out(const Image& image, int left, int top, int width, int height) {
  Image part(width, height);
  if (!image.fine.empty()) part.fine.resize(part.pixels.size());
  const size_t row = 4 * static_cast<size_t>(width);
  for (int r = 0; r < height && width > 0; ++r) {
    const size_t from = image.index(left, top + r), to = part.index(0, r);
    std::copy_n(&image.pixels[from], row, &part.pixels[to]);
    if (!image.fine.empty()) std::copy_n(&image.fine[from], row, &part.fine[to]);
  }
  return part;
}

Image decode_image(const std::string& bytes, const std::string& name, PixelBudget& pixels,
                   PixelDepth depth) {
  if (is_png(bytes)) return decode_png(bytes, name, pixels, depth);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name, pixels);
  if (is_webp(bytes)) return decode_webp(bytes, name, pixels);
  if (is_tiff(bytes)) return decode_tiff(bytes, name, pixels);
  if (is_exr(bytes)) return decode_exr(bytes, name, pixels, depth);
  if (is_gif(bytes)) return decode_gif(bytes, name, pixels);
  if (is_ora(bytes)) return decode_ora(bytes, name, pixels);
  if (is_psd(bytes)) return decode_psd(bytes, name, pixels);
  if (is_svg(bytes)) return decode_svg(bytes, name, pixels);
  if (std::optional<Image> plain = decode_plain(bytes, name, pixels)) return std::move(*plain);
  throw Error(ErrorKind::bad_input,
              name +
                  ": not a picture in a supported format (PNG, JPEG, WebP, TIFF, OpenRaster, "
                  "OpenEXR, SVG, BMP, TGA, GIF or PSD)");
}

void report_first_of(size_t pictures, const char* what, ImportReport& report) {
  if (pictures > 1)
    report.add("", "only the first of its " + std::to_string(pictures) + " " + what + " is opened");
}

ImportReport report_of_image(const std::string& bytes, const std::string& name) {
  ImportReport report;
  if (is_png(bytes)) report_png(bytes, name, report);
  if (is_webp(bytes)) report_webp(bytes, name, report);
  if (is_tiff(bytes)) report_tiff(bytes, name, report);
  if (is_exr(bytes)) report_exr(bytes, name, report);
  if (is_gif(bytes)) report_gif(bytes, name, report);
  return report;
}

bool has_fine_pixels(const std::string& start) {
  return is_png(start) || is_exr(start);
}

namespace {

void append_to(void* bytes, void* data, int size) {
  static_cast<std::string*>(bytes)->append(static_cast<const char*>(data),
                                           static_cast<size_t>(size));
}

}  // namespace

bool is_opaque(const Image& image) {
  const Box box = image.box(), page = image.page();
  if (!box.contains({page.left, page.bottom}) || !box.contains({page.right, page.top}))
    return false;
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    if (image.pixels[i] < 255) return false;
  return true;
}

std::string encode_png(const Image& image) {
  std::string bytes;
  if (!stbi_write_png_to_func(append_to, &bytes, image.width, image.height, 4, image.pixels.data(),
                              4 * image.width))
    throw Error(ErrorKind::failed, "the picture could not be encoded as PNG");
  return bytes;
}

namespace {

std::string encode_jpeg(const Image& image) {
  constexpr int kQuality = 92;
  std::vector<std::uint8_t> opaque;
  opaque.reserve(image.pixels.size() / 4 * 3);
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    const int alpha = image.pixels[i + 3];
    for (size_t k = 0; k < 3; ++k)
      opaque.push_back(static_cast<std::uint8_t>(
          (image.pixels[i + k] * alpha + 255 * (255 - alpha) + 127) / 255));
  }
  std::string bytes;
  if (!stbi_write_jpg_to_func(append_to, &bytes, image.width, image.height, 3, opaque.data(),
                              kQuality))
    throw Error(ErrorKind::failed, "the picture could not be encoded as JPEG");
  return bytes;
}

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
  static const std::vector<PictureFormat> all{
      {"PNG picture",
       ".png",
       {8, 16},
       [](const Image& image, int depth) {
         return depth == 16 ? encode_png_16(image) : encode_png(image);
       }},
      {"JPEG picture", ".jpg", {8}, [](const Image& image, int) { return encode_jpeg(image); }},
      {"WebP picture", ".webp", {8}, [](const Image& image, int) { return encode_webp(image); }},
      {"OpenEXR picture", ".exr", {16, 32}, encode_exr}};
  return all;
}

const PictureFormat* picture_format_named(const std::string& extension) {
  const auto found = std::ranges::find(picture_formats(), extension, &PictureFormat::extension);
  return found == picture_formats().end() ? nullptr : &*found;
}

std::string depths_text(const PictureFormat& format) {
  std::string text;
  for (const int depth : format.depths)
    text += (text.empty() ? "" : " or ") + std::to_string(depth);
  return text;
}

int depth_of(const PictureFormat& format, const std::optional<int>& wanted) {
  const bool has_it = wanted && std::ranges::count(format.depths, *wanted) > 0;
  return has_it ? *wanted : format.depths[0];
}

std::string format_extension(const Path& file) {
  const std::string extension = lower_case(file.extension().string());
  return extension == ".jpeg" ? ".jpg" : extension;
}

const PictureFormat& picture_format_of(const Path& file) {
  const std::string extension = format_extension(file);
  const PictureFormat* found = picture_format_named(extension.empty() ? ".png" : extension);
  if (!found)
    throw Error(ErrorKind::bad_input,
                file.string() + ": pictures are written as .png, .jpg, .webp or .exr");
  return *found;
}

}  // namespace holomorph
