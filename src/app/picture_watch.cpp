// A changed file is read once two consecutive checks find the same modification time.
#include "app/picture_watch.h"

#include <utility>

namespace holomorph {

void PictureWatch::forget() {
  changing_.clear();
  tried_.clear();
  if (reading_) reading_->cancel();
}

void PictureWatch::look() {
  if (reading_) {
    if (reading_->ended()) take_over();
    return;
  }
  Changed now = changed();
  if (!now.empty() && now == changing_)
    start(now);
  else
    changing_ = std::move(now);
}

PictureWatch::Changed PictureWatch::changed() {
  const Document& document = workspace_.document;
  Changed all;
  std::error_code error;
  for (const ImageReference& reference : document.pictures().changed())
    all.emplace_back(reference, std::filesystem::last_write_time(reference.file, error));
  for (const size_t i : document.layers_without_picture()) {
    const ImageReference& image = *document.scene().layers[i]->image;
    if (document.pictures().withheld().contains(image.file)) continue;
    const Time time = std::filesystem::last_write_time(image.file, error);
    const Time now = error ? Time::min() : time;
    const auto [tried, first] = tried_.try_emplace(image.file, now);
    if (!error && tried->second != now)
      all.emplace_back(image, now);
    else
      tried->second = now;
  }
  return all;
}

void PictureWatch::start(const Changed& changed) {
  for (const auto& [reference, time] : changed) {
    tried_[reference.file] = time;
    const Picture* known = workspace_.document.pictures().find(reference);
    if (!known) continue;
    Picture same = *known;
    same.changed = time;
    workspace_.document.put_picture(reference, std::move(same));
  }
  read_ = std::make_shared<std::vector<std::pair<ImageReference, Picture>>>();
  reading_ = std::make_unique<Job>("Reading again", [changed, read = read_](Job::Progress&) {
    PictureFiles files;
    for (const auto& each : changed) read->push_back({each.first, files.picture(each.first)});
  });
}

void PictureWatch::take_over() {
  const std::unique_ptr<Job> ended = std::move(reading_);
  if (ended->cancelled()) return;  // it was reading for another document
  bool resized = false, back = false;
  for (auto& [reference, picture] : *read_) {
    if (const Picture* known = workspace_.document.pictures().find(reference)) {
      const Image &before = *known->image, &now = *picture.image;
      resized = resized || before.width != now.width || before.height != now.height;
    } else {
      back = true;
    }
    workspace_.document.put_picture(reference, std::move(picture));
  }
  workspace_.document.describe_films();
  if (const auto error = ended->error()) return workspace_.messages.complain(*error);
  workspace_.messages.say(
      Path(read_->front().first.file).filename().string() +
      (back ? " was found again." : " was changed by another program and has been reloaded.") +
      (resized ? " It has a different size. Cage, pins and strokes keep their positions in "
                 "pixels."
               : ""));
}

}  // namespace holomorph
