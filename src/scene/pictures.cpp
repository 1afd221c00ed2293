// A file's time tells whether it has changed.
#include "scene/pictures.h"

#include "scene/ora_image.h"

namespace holomorph {
namespace fs = std::filesystem;

Picture read_picture(const ImageReference& reference) {
  const Path file = reference.file;
  std::error_code ignored;
  const auto changed = fs::last_write_time(file, ignored);  // before: a later change is seen
  const std::string bytes = read_file(file);
  Image image = reference.entry.empty() ? decode_image(bytes, file.string())
                                        : decode_ora_layer(bytes, reference.entry, file.string());
  return {std::make_shared<const Image>(std::move(image)), sha256_hex(bytes), changed};
}

ImageReference reference_in(const Path& file, const std::string& entry) {
  ImageReference reference;
  reference.file = fs::absolute(file).lexically_normal().string();
  reference.entry = entry;
  return reference;
}

ImageReference described(ImageReference reference, const Picture& picture) {
  reference.width = picture.image->width;
  reference.height = picture.image->height;
  reference.sha256 = picture.sha256;
  return reference;
}

std::shared_ptr<const Image> Pictures::shared(const Scene& layer) const {
  const Picture* found = layer.image ? find(*layer.image) : nullptr;
  return found ? found->image : nullptr;
}

const Image* Pictures::of(const Scene& layer) const {
  return shared(layer).get();
}

const Picture* Pictures::find(const ImageReference& reference) const {
  const auto found = all_.find({reference.file, reference.entry});
  return found == all_.end() ? nullptr : &found->second;
}

void Pictures::put(const ImageReference& reference, Picture picture) {
  all_[{reference.file, reference.entry}] = std::move(picture);
}

std::vector<ImageReference> Pictures::changed() const {
  std::vector<ImageReference> all;
  for (const auto& [name, picture] : all_) {
    std::error_code error;
    const auto now = fs::last_write_time(name.first, error);
    if (error || now == picture.changed) continue;
    all.push_back(reference_in(name.first, name.second));
  }
  return all;
}

}  // namespace holomorph
