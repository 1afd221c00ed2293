// A file's time tells whether it has changed; its SHA-256 whether that matters.
#include "scene/pictures.h"

namespace holomorph {
namespace fs = std::filesystem;

Picture read_picture(const Path& file) {
  std::error_code ignored;
  const auto changed = fs::last_write_time(file, ignored);  // before: a later change is seen
  const std::string bytes = read_file(file);
  return {std::make_shared<const Image>(decode_image(bytes, file.string())), sha256_hex(bytes),
          changed};
}

ImageReference reference_to(const Path& file, const Picture& picture) {
  return {fs::absolute(file).lexically_normal().string(), picture.image->width,
          picture.image->height, picture.sha256, ""};
}

std::shared_ptr<const Image> Pictures::shared(const Scene& layer) const {
  const Picture* found = layer.image ? find(layer.image->file) : nullptr;
  return found ? found->image : nullptr;
}

const Image* Pictures::of(const Scene& layer) const {
  return shared(layer).get();
}

const Picture* Pictures::find(const std::string& file) const {
  const auto found = all_.find(file);
  return found == all_.end() ? nullptr : &found->second;
}

std::vector<std::string> Pictures::changed() const {
  std::vector<std::string> files;
  for (const auto& [file, picture] : all_) {
    std::error_code error;
    const auto now = fs::last_write_time(file, error);
    if (!error && now != picture.changed) files.push_back(file);
  }
  return files;
}

}  // namespace holomorph
