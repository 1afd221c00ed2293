// A changed file is read once two consecutive checks find the same modification time.
#include "app/picture_watch.h"

#include <set>
#include <utility>

namespace holomorph {

void PictureWatch::forget() {
  changing_.clear();
  waiting_.reset();
  tried_.clear();
  if (reading_) reading_->cancel();
}

void PictureWatch::look() {
  if (reading_) {
    if (!reading_->ended()) return;
    take_over();
    if (!waiting_) return;
    const auto [file, choices] = *std::exchange(waiting_, std::nullopt);
    return read({}, {file}, choices);
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
    const auto tried = tried_.find(image.file);
    // The layers of a scene that was just opened may be unclear.
    const bool is_worth_it = tried == tried_.end() ? !image.entry.empty() : tried->second != now;
    if (!error && is_worth_it)
      all.emplace_back(image, now);
    else
      tried_[image.file] = now;
  }
  return all;
}

void PictureWatch::start(const Changed& changed) {
  std::vector<ImageReference> pictures;
  std::set<std::string> layered;
  for (const auto& [reference, time] : changed) {
    tried_[reference.file] = time;
    if (reference.entry.empty())
      pictures.push_back(reference);
    else
      layered.insert(reference.file);
    const Picture* known = workspace_.document.pictures().find(reference);
    if (!known) continue;
    Picture same = *known;
    same.changed = time;
    workspace_.document.put_picture(reference, std::move(same));
  }
  read(std::move(pictures), {layered.begin(), layered.end()}, {});
}

void PictureWatch::find_layers(const std::string& file, const LayerChoices& choices) {
  if (reading_)
    waiting_ = {file, choices};
  else
    read({}, {file}, choices);
}

namespace {

/// Finds the layers of a file again, and reads their pictures.
FoundLayers found_layers(const std::vector<Layer>& layers, const std::string& file,
                         PictureFiles& files, const LayerChoices& choices) {
  FoundLayers found{layer_update(layers, file, files, choices), {}, {}};
  for (Layer layer : layers) {
    found.update.apply(layer);
    const ImageReference& image = *layer.image;
    if (is_unclear(image)) continue;
    const bool is_read = std::ranges::any_of(found.pictures, [&](const auto& other) {
      return other.first.entry == image.entry && other.first.corner == image.corner;
    });
    if (!is_read) found.pictures.emplace_back(image, files.picture(image));
  }
  for (const UnclearLayer& unclear : found.update.unclear)
    for (const FileLayer& candidate : unclear.candidates)
      if (auto& picture = found.candidates[candidate.entry]; !picture)
        picture = files.picture(reference_in(file, candidate.entry)).image;
  return found;
}

}  // namespace

void PictureWatch::read(std::vector<ImageReference> pictures, std::vector<std::string> layered,
                        const LayerChoices& choices) {
  read_ = std::make_shared<Read>();
  read_->chosen = !choices.empty();
  std::vector<std::pair<std::string, std::vector<Layer>>> layers;
  for (const std::string& file : layered)
    layers.emplace_back(file, workspace_.document.layers_of_file(file));
  reading_ = std::make_unique<Job>(
      "Reading again", [pictures = std::move(pictures), layers = std::move(layers), choices,
                        read = read_](Job::Progress&) {
        PictureFiles files;
        for (const ImageReference& each : pictures)
          read->pictures.emplace_back(each, files.picture(each));
        for (const auto& [file, known] : layers)
          read->layered.push_back(found_layers(known, file, files, choices));
      });
}

void PictureWatch::take_over() {
  const std::unique_ptr<Job> ended = std::move(reading_);
  if (ended->cancelled()) return;  // it was reading for another document
  std::string said = take_over_pictures();
  for (FoundLayers& found : read_->layered) said = take_over_layers(found);
  workspace_.document.describe_films();
  if (const auto error = ended->error()) return workspace_.messages.complain(*error);
  workspace_.messages.say(said);
  for (FoundLayers& found : read_->layered)
    if (!found.update.unclear.empty()) ask_(std::move(found));
}

/// Returns what to say about it.
std::string PictureWatch::take_over_pictures() {
  bool resized = false, back = false;
  for (auto& [reference, picture] : read_->pictures) {
    if (const Picture* known = workspace_.document.pictures().find(reference)) {
      const Image &before = *known->image, &now = *picture.image;
      resized = resized || before.width != now.width || before.height != now.height;
    } else {
      back = true;
    }
    workspace_.document.put_picture(reference, std::move(picture));
  }
  if (read_->pictures.empty()) return "";
  return Path(read_->pictures.front().first.file).filename().string() +
         (back ? " was found again." : " was changed by another program and has been reloaded.") +
         (resized ? " It has a different size. Cage, pins and strokes keep their positions in "
                    "pixels."
                  : "");
}

std::string PictureWatch::take_over_layers(FoundLayers& found) {
  Document& document = workspace_.document;
  for (auto& [reference, picture] : found.pictures)
    document.put_picture(reference, std::move(picture));
  document.update_layers(found.update);
  if (read_->chosen) document.mark_unsaved();  // or the question would be asked again
  const std::string changes = found.update.report.text(LoadedScene::kFewLines);
  return found.update.report.file + " was changed by another program and has been reloaded." +
         (changes.empty() ? "" : "\n" + changes);
}

}  // namespace holomorph
