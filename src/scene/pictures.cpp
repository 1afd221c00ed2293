// Changes to a file are detected by its modification time.
#include "scene/pictures.h"

#include <algorithm>

#include "scene/clips.h"
#include "scene/formats/file_kinds.h"
#include "scene/formats/image_formats.h"
#include "scene/formats/layered.h"
#include "scene/formats/numbered_frames.h"

namespace holomorph {
namespace fs = std::filesystem;

namespace {

constexpr size_t kHashedBytes = size_t{16} << 20;  // of a film
constexpr size_t kSignature = 8;                   // bytes by which formats are recognized

bool is_film(const std::string& file) {
  return is_named_as(file, FileContent::film);
}

/// Moves a layer and its canvas in the plane.
void move(Image& image, const PixelPosition& by) {
  image.left += by.x;
  image.bottom += by.y;
  Box& canvas = *image.canvas;
  canvas = {canvas.left + by.x, canvas.bottom + by.y, canvas.right + by.x, canvas.top + by.y};
}

}  // namespace

PictureFiles::File& PictureFiles::read(const std::string& name) {
  const auto found = files_.find(name);
  if (found != files_.end()) return found->second;
  File file;
  std::error_code ignored;
  file.changed = fs::last_write_time(name, ignored);  // before reading, to detect later changes
  file.bytes = is_film(name) ? read_start(name, kHashedBytes) : read_file(name);
  file.sha256 = sha256_hex(file.bytes);
  if (is_film(name)) file.bytes.clear();
  return files_.emplace(name, std::move(file)).first->second;
}

Picture PictureFiles::picture(const ImageReference& reference) {
  const std::string& name = reference.file;
  File& file = read(name);
  if (is_film(name) || reference.clip) {
    if (!file.footage) {
      auto reader = is_film(name) ? open_film(name) : open_numbered_pictures(name);
      file.footage = std::make_shared<Footage>(std::move(reader));
      const auto first = file.footage->frame(0);
      pixels_.take(static_cast<size_t>(first->width), static_cast<size_t>(first->height), name);
    }
    return {file.footage->frame(0), file.sha256, file.changed, file.footage};
  }
  if (!reference.entry.empty()) return layer_picture(reference);
  Image image = decode_image(file.bytes, name, pixels_);
  Picture picture{std::make_shared<const Image>(std::move(image)), file.sha256, file.changed};
  if (is_svg(file.bytes)) picture.drawing = std::make_shared<const std::string>(file.bytes);
  return picture;
}

const FileLayers& PictureFiles::layers(const std::string& name) {
  File& file = read(name);
  if (!file.layers) file.layers = layers_of_file(file.bytes, name);
  return *file.layers;
}

Picture PictureFiles::layer_picture(const ImageReference& reference) {
  const File& file = read(reference.file);
  Picture picture{nullptr, file.sha256, file.changed};
  picture.mark = reference.mark;
  if (is_lost(reference)) {
    picture.image = std::make_shared<const Image>(nothing_on(reference.page()));
    return picture;
  }
  Image image = decode_layer(file.bytes, reference.entry, reference.file, pixels_);
  // Only a file that has changed costs the time for new hashes.
  if (!picture.mark || reference.sha256 != file.sha256)
    picture.mark = keep_mark(reference.file, reference.entry, image);
  move(image, reference.corner);
  picture.image = std::make_shared<const Image>(std::move(image));
  return picture;
}

const LayerMark& PictureFiles::keep_mark(const std::string& file, const std::string& entry,
                                         const Image& image) {
  const auto& all = layers(file).layers;
  const auto found = std::ranges::find(all, entry, &FileLayer::entry);
  LayerMark mark = mark_of(image, found == all.end() ? "" : found->name);
  return read(file).marks.insert_or_assign(entry, std::move(mark)).first->second;
}

const LayerMark& PictureFiles::mark(const std::string& name, const std::string& entry) {
  const File& file = read(name);
  if (const auto known = file.marks.find(entry); known != file.marks.end()) return known->second;
  PixelBudget alone;  // the pixels are not kept
  return keep_mark(name, entry, decode_layer(file.bytes, entry, name, alone));
}

ImageReference reference_in(const Path& file, const std::string& entry) {
  ImageReference reference;
  reference.file = absolute_path(file).string();
  reference.entry = entry;
  return reference;
}

ImageReference described(ImageReference reference, const Picture& picture) {
  const Box page = picture.image->page();
  reference.width = static_cast<int>(page.width());
  reference.height = static_cast<int>(page.height());
  reference.sha256 = picture.sha256;
  reference.mark = picture.mark;
  if (!picture.footage) return reference;
  const FilmInfo& film = picture.footage->info();
  if (!reference.clip) reference.clip = Clip{film.frames_per_second};
  reference.clip->frames = film.frames;
  return reference;
}

std::shared_ptr<const Image> Pictures::still(const Layer& layer) const {
  const Picture* found = layer.image ? find(*layer.image) : nullptr;
  return found ? found->image : nullptr;
}

std::shared_ptr<Footage> Pictures::footage(const Layer& layer) const {
  const Picture* found = clip_of(layer) ? find(*layer.image) : nullptr;
  return found ? found->footage : nullptr;
}

std::shared_ptr<const std::string> Pictures::drawing(const Layer& layer) const {
  const Picture* found = layer.image ? find(*layer.image) : nullptr;
  return found ? found->drawing : nullptr;
}

std::shared_ptr<const Image> Pictures::shared(const Layer& layer) const {
  const auto frame = frames_.find(layer.id);
  if (frame == frames_.end()) return still(layer);
  const std::shared_ptr<Footage> footage = this->footage(layer);
  return footage && footage == frame->second.footage.lock() ? frame->second.image : still(layer);
}

void Pictures::show_frame(const Layer& layer, int number, std::shared_ptr<const Image> frame) {
  frames_[layer.id] = {footage(layer), number, std::move(frame)};
}

void Pictures::show_time(const Scene& scene, double time) {
  for (const SharedLayer& layer : scene.layers)
    if (const auto footage = this->footage(*layer)) {
      const int number = clip_frame_at(*clip_of(*layer), time);
      show_frame(*layer, number, footage->frame(number));
    }
}

const Image* Pictures::of(const Layer& layer) const {
  return shared(layer).get();
}

Pictures::Source Pictures::source_of(const ImageReference& reference) {
  return {reference.file, reference.entry, reference.clip || is_film(reference.file),
          reference.corner};
}

const Picture* Pictures::find(const ImageReference& reference) const {
  const auto found = all_.find(source_of(reference));
  return found == all_.end() ? nullptr : &found->second;
}

void Pictures::put(const ImageReference& reference, Picture picture) {
  all_[source_of(reference)] = std::move(picture);
}

/// A picture with fine pixels if its file has some. Throws Error if they cannot be read.
Picture Pictures::fine_picture(const Source& source, Picture picture, PixelBudget& pixels) {
  const bool is_deep = has_fine_pixels(read_start(source.file, kSignature));
  if (!is_deep || !source.entry.empty()) return picture;
  const std::string bytes = read_file(source.file);
  if (sha256_hex(bytes) != picture.sha256)
    throw Error(ErrorKind::bad_input, source.file + ": the file has changed");
  if (source.moves) {
    picture.footage =
        std::make_shared<Footage>(open_numbered_pictures(source.file, PixelDepth::full));
    picture.image = picture.footage->frame(0);
  } else {
    picture.image =
        std::make_shared<const Image>(decode_image(bytes, source.file, pixels, PixelDepth::full));
  }
  return picture;
}

Pictures Pictures::fine(std::vector<std::string>& losses,
                        const std::function<void()>& keep_going) const {
  Pictures result = *this;
  PixelBudget pixels;
  for (auto& [source, picture] : result.all_) {
    keep_going();
    if (is_film(source.file)) continue;
    const std::shared_ptr<Footage> before = picture.footage;
    try {
      picture = fine_picture(source, picture, pixels);
      for (auto& [layer, shown] : result.frames_)
        if (before && shown.footage.lock() == before)
          shown = {picture.footage, shown.number, picture.footage->frame(shown.number)};
    } catch (const Error& error) {
      losses.push_back(std::string(error.what()) + "; it has 8 bits");
    }
  }
  return result;
}

void Pictures::add(const Pictures& others) {
  all_.insert(others.all_.begin(), others.all_.end());
  withheld_.insert(others.withheld_.begin(), others.withheld_.end());
}

double Pictures::pixels() const {
  double count = 0;
  for (const auto& [source, picture] : all_)
    count += static_cast<double>(picture.image->width) * picture.image->height;
  return count;
}

std::vector<ImageReference> Pictures::changed() const {
  std::vector<ImageReference> all;
  for (const auto& [source, picture] : all_) {
    std::error_code error;
    const auto now = fs::last_write_time(source.file, error);
    if (error || now == picture.changed) continue;
    all.push_back(reference_in(source.file, source.entry));
    all.back().corner = source.corner;
    if (source.moves) all.back().clip.emplace();
  }
  return all;
}

}  // namespace holomorph
