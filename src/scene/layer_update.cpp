// Layers are found by the most certain evidence first. Each step leaves fewer layers for the next.
#include "scene/layer_update.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "scene/layers.h"
#include "scene/limits.h"

namespace holomorph {
namespace {

std::pair<std::string, PixelPosition> key_of(const ImageReference& image) {
  return {image.entry, image.corner};
}

bool shows_layer_of(const Layer& layer, const std::string& file) {
  return layer.image && layer.image->file == file && !layer.image->entry.empty();
}

/// A layer of the file as some references know it.
struct Known {
  std::string entry;
  LayerMark mark;                   ///< without a hash if the scene has none
  bool was_lost = false;            ///< at the last update
  bool is_chosen = false;           ///< the user has said what it is, or that it is lost
  std::optional<size_t> now = {};   ///< the layer that it is in the file
  std::vector<size_t> rivals = {};  ///< what it may be, of which one must be wrong
};

/// The entry that an unclear layer had.
std::string entry_before(const std::string& entry) {
  return entry.starts_with(kUnclearEntry) ? entry.substr(kUnclearEntry.size()) : entry;
}

/// The number of the only element that satisfies a condition; none if there is no such element, or
/// if there are several.
template <class Range, class Condition>
std::optional<size_t> only(const Range& range, const Condition& condition) {
  std::optional<size_t> found;
  for (size_t i = 0; i < range.size(); ++i)
    if (condition(range[i], i)) {
      if (found) return {};
      found = i;
    }
  return found;
}

/// Finds out which layer is which.
class Finder {
 public:
  Finder(std::span<const Layer> layers, const std::string& file, PictureFiles& files)
      : file_(file), files_(files), now_(files.layers(file).layers), taken_(now_.size()) {
    for (const Layer& layer : layers) {
      if (!shows_layer_of(layer, file)) continue;
      const ImageReference& image = *layer.image;
      if (std::ranges::find(known_, image.entry, &Known::entry) == known_.end())
        known_.push_back(
            {image.entry, image.mark.value_or(LayerMark{layer.name, "", {}}), is_lost(image)});
    }
  }

  void find(const LayerChoices& choices) {
    for (const auto& [from, to] : choices) choose(from, to);
    if (!has_new_ids())
      for (Known& known : known_) find_by_id(known);
    find_by_name([](size_t) { return true; });
    find_by_pixels();
    find_by_name([&](size_t i) { return !taken_[i]; });
  }

  const std::vector<Known>& known() const { return known_; }
  const FileLayer& layer(size_t now) const { return now_[now]; }
  /// A layer that cannot be decoded has no hash.
  const LayerMark& mark(size_t now) {
    static const LayerMark kUnknown;
    try {
      return files_.mark(file_, now_[now].entry);
    } catch (const Error&) {
      return kUnknown;
    }
  }
  bool is_unchanged(const Known& known) {
    return known.now && !known.was_lost && has_pixels_of(known, *known.now);
  }
  /// What a layer may be that was not found; none if it is lost.
  std::vector<size_t> candidates(const Known& known) const {
    std::vector<size_t> left;
    if (known.now || known.was_lost || known.is_chosen) return left;
    std::ranges::copy_if(known.rivals, std::back_inserter(left),
                         [&](size_t i) { return !taken_[i]; });
    for (size_t i = 0; i < now_.size() && known.rivals.empty(); ++i)
      if (!taken_[i]) left.push_back(i);
    return left;
  }
  /// An entry that no layer has or had.
  std::string free_entry(std::string_view prefix, const std::string& before) const {
    if (before.starts_with(prefix)) return before;
    std::string entry = std::string(prefix) + entry_before(before);
    while (std::ranges::find(known_, entry, &Known::entry) != known_.end()) entry += "'";
    return entry;
  }
  /// The layers that no reference shows, nor may show.
  std::vector<FileLayer> added() const {
    std::vector<bool> shown = taken_;
    for (const Known& known : known_)
      for (const size_t i : candidates(known)) shown[i] = true;
    std::vector<FileLayer> all;
    for (size_t i = 0; i < now_.size(); ++i)
      if (!shown[i]) all.push_back(now_[i]);
    return all;
  }

 private:
  void take(Known& known, size_t now) {
    known.now = now;
    taken_[now] = true;
  }

  void choose(const std::string& from, const std::string& to) {
    const auto fail = [&](const std::string& what) {
      throw Error(ErrorKind::bad_input, Path(file_).filename().string() + ": " + what);
    };
    auto which = only(known_, [&](const Known& k, size_t) { return k.entry == from; });
    if (!which) which = only(known_, [&](const Known& k, size_t) { return k.mark.name == from; });
    if (!which)
      fail("the scene shows several layers with the name '" + from +
           "'; give the entry of one of them in the scene file");
    Known& known = known_[*which];
    if (std::exchange(known.is_chosen, true)) fail("'" + from + "' is matched twice");
    if (to.empty()) return;
    auto now = only(now_, [&](const FileLayer& l, size_t) { return l.entry == to; });
    if (!now) now = only(now_, [&](const FileLayer& l, size_t) { return l.name == to; });
    if (!now) fail("the file has no layer, or several layers, with the name '" + to + "'");
    if (taken_[*now]) fail("'" + to + "' is matched twice");
    take(known, *now);
  }

  /// The layer with the same id, and another one with the same name, if there is one.
  struct Rivals {
    std::optional<size_t> by_id, by_name;
  };
  Rivals rivals_of(const Known& known) const {
    const std::string id = entry_before(known.entry);
    if (!id.starts_with("id:")) return {};
    const auto same = only(now_, [&](const FileLayer& l, size_t) { return l.entry == id; });
    if (same && now_[*same].name == known.mark.name) return {same, {}};
    return {same,
            only(now_, [&](const FileLayer& l, size_t) { return l.name == known.mark.name; })};
  }
  bool has_pixels_of(const Known& known, size_t now) {
    return !known.mark.hash.empty() && mark(now).hash == known.mark.hash;
  }

  /// Some programs write new ids whenever they save. A layer shows this if its name and its pixels
  /// are now those of another id.
  bool has_new_ids() {
    return std::ranges::any_of(known_, [&](const Known& known) {
      const auto [by_id, by_name] = rivals_of(known);
      return by_name && has_pixels_of(known, *by_name) && !(by_id && has_pixels_of(known, *by_id));
    });
  }

  void find_by_id(Known& known) {
    const auto [by_id, by_name] = rivals_of(known);
    if (known.now || known.is_chosen || !by_id || taken_[*by_id]) return;
    if (!by_name || has_pixels_of(known, *by_id))
      take(known, *by_id);
    else
      known.rivals = {*by_id, *by_name};
  }

  static bool is_open(const Known& known) {
    return !known.now && !known.is_chosen && known.rivals.empty();
  }

  /// Only names that are unique count, both among the layers that are not found yet and, in the
  /// file, among those that satisfy a condition.
  template <class Condition>
  void find_by_name(const Condition& counts) {
    std::vector<std::pair<size_t, size_t>> pairs;
    for (size_t k = 0; k < known_.size(); ++k) {
      const std::string& name = known_[k].mark.name;
      const auto alone = only(known_, [&](const Known& other, size_t) {
        return is_open(other) && other.mark.name == name;
      });
      const auto now =
          only(now_, [&](const FileLayer& l, size_t i) { return counts(i) && l.name == name; });
      if (alone == k && now && !taken_[*now] && !name.empty()) pairs.emplace_back(k, *now);
    }
    for (const auto& [k, now] : pairs) take(known_[k], now);
  }

  void find_by_pixels() {
    for (size_t k = 0; k < known_.size(); ++k) {
      const std::string& hash = known_[k].mark.hash;
      if (hash.empty()) continue;
      const auto alone = only(known_, [&](const Known& other, size_t) {
        return is_open(other) && other.mark.hash == hash;
      });
      if (alone != k) continue;
      const auto now = only(
          now_, [&](const FileLayer&, size_t i) { return !taken_[i] && mark(i).hash == hash; });
      if (now) take(known_[k], *now);
    }
  }

  const std::string& file_;
  PictureFiles& files_;
  const std::vector<FileLayer>& now_;
  std::vector<bool> taken_;  ///< the layers of the file that were found
  std::vector<Known> known_;
};

PixelPosition difference(const PixelPosition& a, const PixelPosition& b) {
  return {a.x - b.x, a.y - b.y};
}

/// How far the scene's content lies from where it was on the canvas. A canvas is enlarged or
/// cropped at any side; what most of the unchanged layers do tells which one. Without any, it is
/// enlarged or cropped at the right and at the bottom, because offsets in files count from the
/// upper left corner.
PixelPosition shift_of_canvas(Finder& finder, const PixelPosition& size_before,
                              const PixelPosition& size_now) {
  if (size_before == size_now || size_before == PixelPosition{}) return {};
  std::vector<std::pair<PixelPosition, int>> votes;
  for (const Known& known : finder.known()) {
    if (!finder.is_unchanged(known)) continue;
    const PixelPosition by = difference(finder.mark(*known.now).offset, known.mark.offset);
    const auto same = std::ranges::find(votes, by, &std::pair<PixelPosition, int>::first);
    if (same == votes.end())
      votes.emplace_back(by, 1);
    else
      ++same->second;
  }
  if (votes.empty()) return {0, size_now.y - size_before.y};
  return std::ranges::max_element(votes, {}, &std::pair<PixelPosition, int>::second)->first;
}

std::string size_text(const PixelPosition& size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y);
}

std::string moved_text(const PixelPosition& by) {
  const auto part = [](int distance, const char* forward, const char* back) {
    return distance == 0
               ? std::string()
               : std::to_string(std::abs(distance)) + " px " + (distance > 0 ? forward : back);
  };
  const std::string across = part(by.x, "to the right", "to the left"),
                    along = part(by.y, "up", "down");
  return across + (across.empty() || along.empty() ? "" : " and ") + along;
}

}  // namespace

const std::string& name_in_file(const Layer& layer) {
  return layer.image && layer.image->mark ? layer.image->mark->name : layer.name;
}

PixelPosition LayerUpdate::carried(std::span<const Layer* const> layers, const Layer& layer) const {
  const Layer* parent = &layer;
  for (size_t k = 0; k < layers.size() && parent->attachment; ++k) {
    const auto it = std::ranges::find(layers, parent->attachment->layer,
                                      [](const Layer* each) { return each->id; });
    if (it == layers.end()) break;
    parent = *it;
    if (!shows_layer_of(*parent, file)) continue;
    const auto found = changes.find(key_of(*parent->image));
    if (found != changes.end()) return found->second.moved;
  }
  return {};
}

void LayerUpdate::apply(Layer& layer, const PixelPosition& carried) const {
  if (!shows_layer_of(layer, file)) return;
  const auto found = changes.find(key_of(*layer.image));
  if (found == changes.end()) return;
  const auto& [entry, corner, moved] = found->second;
  ImageReference& image = *layer.image;
  const std::string before = std::exchange(image.entry, entry);
  image.corner = corner;
  image.width = width;
  image.height = height;
  image.moved = {image.moved.x + moved.x, image.moved.y + moved.y};
  const auto translation = [](int x, int y) { return Similarity{1, 0, Complex(x, y)}; };
  const Similarity by = translation(moved.x - carried.x, moved.y - carried.y);
  // What its parent carries moves by the difference, in its own coordinates. What has not moved in
  // the file stays where it is in the scene if the parent is at rest.
  if (moved != carried)
    layer.placement =
        moved == PixelPosition{} ? composed(by, layer.placement) : composed(layer.placement, by);
  if (!is_lost(image) && !is_unclear(image)) {
    if (before != entry) image.sha256.clear();  // the mark is that of another layer or file
    return;
  }
  // Its content keeps its place in the scene, and so its distance from the content of the others.
  if (!image.mark) image.mark = LayerMark{layer.name, "", {}};
  image.mark->offset.x += shift.x;
  image.mark->offset.y += shift.y;
}

bool needs_layer_update(std::span<const Layer> layers, const std::string& file,
                        PictureFiles& files) {
  return std::ranges::any_of(layers, [&](const Layer& layer) {
    if (!shows_layer_of(layer, file)) return false;
    const ImageReference& image = *layer.image;
    if (is_unclear(image)) return true;
    if (!image.sha256.empty()) return image.sha256 != files.sha256(file);
    const FileLayers& now = files.layers(file);
    return image.width > 0 && (image.width != now.width || image.height != now.height);
  });
}

LayerUpdate layer_update(std::span<const Layer> layers, const std::string& file,
                         PictureFiles& files, const LayerChoices& choices) {
  Finder finder(layers, file, files);
  finder.find(choices);
  LayerUpdate update;
  update.file = file;
  update.report.file = Path(file).filename().string();
  update.added = finder.added();
  PixelPosition before;
  for (const Layer& layer : layers)
    if (before == PixelPosition{} && shows_layer_of(layer, file) && !is_lost(*layer.image))
      before = {layer.image->width, layer.image->height};
  const FileLayers& in_file = files.layers(file);
  // A file without layers, as another program may have saved it by mistake, has no canvas.
  const PixelPosition now =
      in_file.layers.empty() ? before : PixelPosition{in_file.width, in_file.height};
  const PixelPosition shift = shift_of_canvas(finder, before, now);
  update.shift = shift;
  update.width = now.x;
  update.height = now.y;
  if (before != now && before != PixelPosition{})
    update.report.add("", "its canvas has changed from " + size_text(before) + " to " +
                              size_text(now) + " pixels; what is in the scene stays where it is");
  size_t repainted = 0;
  for (const Known& known : finder.known()) {
    const std::vector<size_t> candidates = finder.candidates(known);
    const std::string entry =
        known.now ? finder.layer(*known.now).entry
                  : finder.free_entry(candidates.empty() ? kLostEntry : kUnclearEntry, known.entry);
    if (!candidates.empty()) {
      update.unclear.push_back({entry, known.mark.name, {}});
      for (const size_t i : candidates) update.unclear.back().candidates.push_back(finder.layer(i));
    } else if (!known.now) {
      if (!known.was_lost)
        update.report.add(known.mark.name, "is no longer in the file; its cage and pins are kept");
    } else {
      if (known.was_lost) update.report.add(known.mark.name, "is in the file again");
      const std::string& name = finder.layer(*known.now).name;
      if (name != known.mark.name && !known.mark.name.empty())
        update.report.add(known.mark.name, "is now called '" + name + "'");
    }
    const bool same = finder.is_unchanged(known);
    repainted += known.now && !same && !known.mark.hash.empty() && !known.was_lost;
    const PixelPosition moved =
        same ? difference(difference(finder.mark(*known.now).offset, known.mark.offset), shift)
             : PixelPosition{};
    if (moved != PixelPosition{})
      update.report.add(known.mark.name, "has moved by " + moved_text(moved) +
                                             "; its cage and pins have moved with it");
    for (const Layer& layer : layers) {
      if (!shows_layer_of(layer, file) || layer.image->entry != known.entry) continue;
      update.changes[key_of(*layer.image)] = {
          entry, difference(difference(layer.image->corner, shift), moved), moved};
    }
  }
  if (repainted > 0)
    update.report.add("", std::to_string(repainted) +
                              (repainted == 1 ? " layer was repainted" : " layers were repainted"));
  for (const FileLayer& layer : update.added)
    update.report.add(layer.name, "is new in the file, and not in the scene");
  return update;
}

Scene with_added_layers(Scene scene, const LayerUpdate& update, PictureFiles& files,
                        Pictures& pictures) {
  const std::vector<FileLayer>& now = files.layers(update.file).layers;
  std::vector<Layer> layers = layers_of(scene);
  if (layers.size() + update.added.size() > kMaxLayers)
    throw Error(ErrorKind::bad_input,
                "a scene has at most " + std::to_string(kMaxLayers) + " layers");
  const int edited = layers[scene.edited].id;
  PixelPosition corner;  // of the canvas, where no layer has moved
  for (const Layer& layer : layers)
    if (shows_layer_of(layer, update.file))
      corner = {layer.image->corner.x + layer.image->moved.x,
                layer.image->corner.y + layer.image->moved.y};
  int last = 0;
  for (const Layer& layer : layers) last = std::max(last, layer.id);
  // Above the layers that are below it in the file, or else below all layers of the file.
  std::ptrdiff_t place =
      std::ranges::find_if(layers,
                           [&](const Layer& layer) { return shows_layer_of(layer, update.file); }) -
      layers.begin();
  for (const FileLayer& each : now) {
    for (size_t i = 0; i < layers.size(); ++i)
      if (shows_layer_of(layers[i], update.file) && layers[i].image->entry == each.entry)
        place = static_cast<std::ptrdiff_t>(i) + 1;
    if (std::ranges::find(update.added, each.entry, &FileLayer::entry) == update.added.end())
      continue;
    Layer layer = layer_in_file(update.file, each, corner, files, pictures);
    layer.id = ++last;
    layers.insert(layers.begin() + place++, std::move(layer));
  }
  reserve_layer_ids(last);
  scene.edited =
      static_cast<size_t>(std::ranges::find(layers, edited, &Layer::id) - layers.begin());
  scene.layers = shared(std::move(layers));
  return scene;
}

Layer layer_in_file(const Path& file, const FileLayer& in_file, const PixelPosition& corner,
                    PictureFiles& files, Pictures& pictures) {
  ImageReference reference = reference_in(file, in_file.entry);
  reference.corner = corner;
  Picture picture = files.picture(reference);
  Layer layer;
  layer.image = described(reference, picture);
  pictures.put(*layer.image, std::move(picture));
  layer.name = in_file.name;
  layer.visible = in_file.visible;
  layer.opacity = in_file.opacity;
  layer.blending = in_file.blending;
  layer.clipped = in_file.clipped;
  return layer;
}

}  // namespace holomorph
