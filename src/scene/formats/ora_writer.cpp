// Writes OpenRaster files; ora_image.cpp reads them.
#include <zip.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <sstream>

#include <pugixml.hpp>

#include "core/error.h"
#include "scene/formats/ora_image.h"

namespace holomorph {
namespace {

/// A ZIP archive in memory.
class NewArchive {
 public:
  NewArchive() {
    zip_error_t error;
    zip_error_init(&error);
    source_ = zip_source_buffer_create(nullptr, 0, 0, &error);
    if (source_) zip_ = zip_open_from_source(source_, ZIP_TRUNCATE, &error);
    if (source_ && !zip_) zip_source_free(source_);
    zip_error_fini(&error);
    if (!zip_) throw failed();
    zip_source_keep(source_);
  }
  ~NewArchive() {
    if (zip_) zip_discard(zip_);
    if (source_) zip_source_free(source_);
  }
  NewArchive(const NewArchive&) = delete;
  NewArchive& operator=(const NewArchive&) = delete;

  /// PNG files are compressed already, and the MIME type must not be.
  void add(const std::string& name, const std::string& content) {
    zip_source_t* data = zip_source_buffer(zip_, content.data(), content.size(), 0);
    const zip_int64_t index = data ? zip_file_add(zip_, name.c_str(), data, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
      if (data) zip_source_free(data);
      throw failed();
    }
    const auto number = static_cast<zip_uint64_t>(index);
    constexpr zip_uint16_t kDate = 0x21,
                           kTime = 0;  // 1980, so that equal pictures give equal files
    if (zip_set_file_compression(zip_, number, ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(zip_, number, kTime, kDate, 0) != 0)
      throw failed();
  }

  /// The bytes of the archive. Everything that was added must still exist.
  std::string bytes() {
    if (zip_close(zip_) != 0) throw failed();
    zip_ = nullptr;
    zip_stat_t stat;
    if (zip_source_stat(source_, &stat) != 0 || zip_source_open(source_) != 0) throw failed();
    std::string all(stat.size, '\0');
    const bool complete =
        zip_source_read(source_, all.data(), stat.size) == static_cast<zip_int64_t>(stat.size);
    zip_source_close(source_);
    if (!complete) throw failed();
    return all;
  }

 private:
  static Error failed() {
    return {ErrorKind::failed, "the OpenRaster file could not be put together"};
  }

  zip_source_t* source_ = nullptr;
  zip_t* zip_ = nullptr;
};

/// The picture in at most 256 x 256 pixels; each is the mean of the pixels that it covers.
Image thumbnail_of(const Image& image) {
  constexpr int kSide = 256;
  const int larger = std::max(image.width, image.height);
  if (larger <= kSide) return image;
  Image small(std::max(1, image.width * kSide / larger),
              std::max(1, image.height * kSide / larger));
  for (int r = 0; r < small.height; ++r)
    for (int c = 0; c < small.width; ++c) {
      long sum[4] = {};
      long count = 0;
      for (int y = r * image.height / small.height; y < (r + 1) * image.height / small.height; ++y)
        for (int x = c * image.width / small.width; x < (c + 1) * image.width / small.width; ++x) {
          const std::uint8_t* pixel = image.at(x, y);
          for (int k = 0; k < 3; ++k) sum[k] += pixel[k] * pixel[3];
          sum[3] += pixel[3];
          ++count;
        }
      if (sum[3] == 0) continue;
      for (int k = 0; k < 3; ++k)
        small.at(c, r)[k] = static_cast<std::uint8_t>((sum[k] + sum[3] / 2) / sum[3]);
      small.at(c, r)[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
    }
  return small;
}

const char* mode_of(Blending blending) {
  switch (blending) {
    case Blending::multiply:
      return "svg:multiply";
    case Blending::screen:
      return "svg:screen";
    case Blending::overlay:
      return "svg:overlay";
    case Blending::add:
      return "svg:plus";
    case Blending::normal:
      break;
  }
  return "svg:src-over";
}

/// The layer, cut to the shape of the layer that it is clipped to.
DrawnLayer cut_to(const DrawnLayer& base, DrawnLayer layer) {
  for (int r = 0; r < layer.image.height; ++r)
    for (int c = 0; c < layer.image.width; ++c) {
      const int column = c + layer.left - base.left, row = r + layer.top - base.top;
      const bool inside =
          column >= 0 && column < base.image.width && row >= 0 && row < base.image.height;
      std::uint8_t& alpha = layer.image.at(c, r)[3];
      alpha = static_cast<std::uint8_t>(inside ? (alpha * base.image.at(column, row)[3] + 127) / 255
                                               : 0);
    }
  layer.opacity *= base.opacity;
  layer.visible = layer.visible && base.visible;
  return layer;
}

}  // namespace

std::string encode_ora(const LayeredPicture& picture) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("image");
  root.append_attribute("version") = "0.0.3";
  root.append_attribute("w") = picture.merged.width;
  root.append_attribute("h") = picture.merged.height;
  pugi::xml_node stack = root.append_child("stack");
  std::vector<std::pair<std::string, std::string>> files;
  const DrawnLayer* base = nullptr;
  const auto add = [&](pugi::xml_node& group, const DrawnLayer& layer) {
    const std::string file = "data/layer" + std::to_string(files.size()) + ".png";
    pugi::xml_node node = group.prepend_child("layer");  // the file lists layers from the top
    node.append_attribute("name") = name_for_xml(layer.name).c_str();
    node.append_attribute("src") = file.c_str();
    node.append_attribute("x") = layer.left;
    node.append_attribute("y") = layer.top;
    node.append_attribute("opacity") = layer.opacity;
    node.append_attribute("visibility") = layer.visible ? "visible" : "hidden";
    node.append_attribute("composite-op") = mode_of(layer.blending);
    files.emplace_back(file, encode_png(layer.image));
  };
  if (picture.background) add(stack, background_layer(picture));
  for (const DrawnLayer& original : picture.originals) add(stack, original);
  if (needs_group(picture)) {
    stack = stack.prepend_child("stack");
    stack.append_attribute("name") = "Layers";
    stack.append_attribute("isolation") = "isolate";
  }
  for (const DrawnLayer& layer : picture.layers) {
    const bool is_cut = layer.clipped && base;
    if (!is_cut) base = &layer;
    add(stack, is_cut ? cut_to(*base, layer) : layer);
  }
  std::ostringstream text;
  document.save(text);
  files.emplace_back("stack.xml", text.str());
  files.emplace_back("mergedimage.png", encode_png(picture.merged));
  files.emplace_back("Thumbnails/thumbnail.png", encode_png(thumbnail_of(picture.merged)));
  const std::string type = "image/openraster";
  NewArchive archive;
  archive.add("mimetype", type);  // must be the first file
  for (const auto& [name, content] : files) archive.add(name, content);
  return archive.bytes();
}

}  // namespace holomorph
