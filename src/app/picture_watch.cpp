// A file counts as left alone when two looks find it equally changed.
#include "app/picture_watch.h"

#include <utility>

namespace holomorph {

void PictureWatch::forget() {
  changing_.clear();
  absent_.clear();
  if (reading_) reading_->cancel();
}

void PictureWatch::look() {
  if (reading_) {
    if (reading_->ended()) take();
    return;
  }
  const Document& document = workspace_.document;
  std::vector<ImageReference> changed = document.pictures().changed();
  for (const size_t i : document.without_picture())  // it may be there again
    if (const ImageReference& missing = *layer_at(document.scene(), i).image;
        !std::filesystem::is_regular_file(missing.file))
      absent_.insert(missing.file);
    else if (absent_.contains(missing.file))
      changed.push_back(reference_in(missing.file, missing.entry));
  if (!changed.empty() && changed == changing_)
    start(changed);
  else
    changing_ = std::move(changed);
}

void PictureWatch::start(const std::vector<ImageReference>& changed) {
  for (const ImageReference& reference : changed) {
    absent_.erase(reference.file);
    const Picture* known = workspace_.document.pictures().find(reference);
    if (!known) continue;
    std::error_code ignored;
    Picture same = *known;
    same.changed = std::filesystem::last_write_time(reference.file, ignored);
    workspace_.document.put_picture(reference, std::move(same));
  }
  read_ = std::make_shared<std::vector<std::pair<ImageReference, Picture>>>();
  reading_ = std::make_unique<Job>("Reading again", [changed, read = read_](Job::Progress&) {
    PictureFiles files;
    for (const ImageReference& reference : changed)
      read->push_back({reference, files.picture(reference)});
  });
}

void PictureWatch::take() {
  const std::unique_ptr<Job> ended = std::move(reading_);
  if (ended->cancelled()) return;  // it was another document's
  bool resized = false;
  for (auto& [reference, picture] : *read_) {
    if (const Picture* known = workspace_.document.pictures().find(reference)) {
      const Image &before = *known->image, &now = *picture.image;
      resized = resized || before.width != now.width || before.height != now.height;
    }
    workspace_.document.put_picture(reference, std::move(picture));
  }
  if (const auto error = ended->error()) return workspace_.complain(*error);
  workspace_.say(Path(read_->front().first.file).filename().string() +
                 " was changed by another program and is read again." +
                 (resized ? " It has another size now; cage, pins and strokes stay where they "
                            "are, in pixels."
                          : ""));
}

}  // namespace holomorph
