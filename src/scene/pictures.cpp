// Changes to a file are detected by its modification time.
#include "scene/pictures.h"

#include "scene/formats/layered.h"

namespace holomorph {
namespace fs = std::filesystem;

const PictureFiles::File& PictureFiles::read(const std::string& name) {
  const auto found = files_.find(name);
  if (found != files_.end()) return found->second;
  File file;
  std::error_code ignored;
  file.changed = fs::last_write_time(name, ignored);  // before reading, to detect later changes
  file.bytes = read_file(name);
  file.sha256 = sha256_hex(file.bytes);
  return files_.emplace(name, std::move(file)).first->second;
}

Picture PictureFiles::picture(const ImageReference& reference) {
  const std::string& name = reference.file;
  const File& file = read(name);
  Image image = reference.entry.empty() ? decode_image(file.bytes, name, pixels_)
                                        : decode_layer(file.bytes, reference.entry, name, pixels_);
  return {std::make_shared<const Image>(std::move(image)), file.sha256, file.changed};
}

ImageReference reference_in(const Path& file, const std::string& entry) {
  ImageReference reference;
  reference.file = absolute_path(file).string();
  reference.entry = entry;
  return reference;
}

ImageReference described(ImageReference reference, const Picture& picture) {
  reference.width = picture.image->width;
  reference.height = picture.image->height;
  reference.sha256 = picture.sha256;
  return reference;
}

std::shared_ptr<const Image> Pictures::shared(const Layer& layer) const {
  const Picture* found = layer.image ? find(*layer.image) : nullptr;
  return found ? found->image : nullptr;
}

const Image* Pictures::of(const Layer& layer) const {
  return shared(layer).get();
}

const Picture* Pictures::find(const ImageReference& reference) const {
  const auto found = all_.find({reference.file, reference.entry});
  return found == all_.end() ? nullptr : &found->second;
}

void Pictures::put(const ImageReference& reference, Picture picture) {
  all_[{reference.file, reference.entry}] = std::move(picture);
}

void Pictures::add(const Pictures& others) {
  all_.insert(others.all_.begin(), others.all_.end());
  withheld_.insert(others.withheld_.begin(), others.withheld_.end());
}

double Pictures::pixels() const {
  double count = 0;
  for (const auto& [name, picture] : all_)
    count += static_cast<double>(picture.image->width) * picture.image->height;
  return count;
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
