// A file counts as left alone when two looks find it equally changed.
#include "app/picture_watch.h"

#include <utility>

namespace holomorph {

void PictureWatch::forget() {
  changing_.clear();
  if (reading_) reading_->cancel();
}

void PictureWatch::look() {
  if (reading_) {
    if (reading_->ended()) take();
    return;
  }
  std::vector<ImageReference> changed = workspace_.document.pictures().changed();
  if (!changed.empty() && changed == changing_)
    start(changed);
  else
    changing_ = std::move(changed);
}

void PictureWatch::start(const std::vector<ImageReference>& changed) {
  for (const ImageReference& reference : changed) {
    std::error_code ignored;
    Picture same = *workspace_.document.pictures().find(reference);
    same.changed = std::filesystem::last_write_time(reference.file, ignored);
    workspace_.document.put_picture(reference, std::move(same));
  }
  read_ = std::make_shared<std::vector<std::pair<ImageReference, Picture>>>();
  reading_ = std::make_unique<Job>("Reading again", [changed, read = read_](Job::Progress&) {
    for (const ImageReference& reference : changed)
      read->push_back({reference, read_picture(reference)});
  });
}

void PictureWatch::take() {
  const std::unique_ptr<Job> ended = std::move(reading_);
  if (ended->cancelled()) return;  // it was another document's
  bool resized = false;
  for (auto& [reference, picture] : *read_) {
    const Image& before = *workspace_.document.pictures().find(reference)->image;
    resized =
        resized || before.width != picture.image->width || before.height != picture.image->height;
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
