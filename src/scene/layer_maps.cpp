// Layers are identified by their ids, which do not change when layers move.
#include "scene/layer_maps.h"

#include <algorithm>
#include <atomic>

#include "core/parallel.h"

namespace holomorph {

LiveMap& LayerMaps::of(int id) {
  std::unique_ptr<LiveMap>& map = maps_[id];
  if (map) return *map;
  if (!spare_.empty()) {
    map = std::move(spare_.back());
    spare_.pop_back();
  } else {
    map = std::make_unique<LiveMap>(options_);
    if (wake_) map->on_ready(wake_);
  }
  return *map;
}

const LiveMap& LayerMaps::of(int id) const {
  const auto found = maps_.find(id);
  return found == maps_.end() ? none_ : *found->second;
}

bool LayerMaps::update_others(const Scene& scene, const Moment& moment) {
  for (auto entry = maps_.begin(); entry != maps_.end();) {
    const bool gone = layer_index(scene, entry->first) == scene.layers.size();
    if (gone) {
      entry->second->clear();
      spare_.push_back(std::move(entry->second));
      settled_.erase(entry->first);
    }
    entry = gone ? maps_.erase(entry) : std::next(entry);
  }
  settled_.erase(scene.layer().id);  // it is updated elsewhere
  std::vector<SharedLayer> unsettled;
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const SharedLayer& layer = scene.layers[i];
    if (i == scene.edited || !(layer->visible || carries_others(scene, i))) continue;
    const bool busy = of(layer->id).busy();
    const auto settled = settled_.find(layer->id);
    if (busy || settled == settled_.end() || settled->second != std::pair(layer, moment))
      unsettled.push_back(layer);
  }
  std::atomic<bool> changed = false;
  parallel_for(static_cast<int>(unsettled.size()), [&](int i) {
    const Layer& layer = *unsettled[static_cast<size_t>(i)];
    if (maps_.at(layer.id)->update(layer.deformation, {}, moment)) changed = true;
  });
  for (const SharedLayer& layer : unsettled)
    if (!of(layer->id).busy()) settled_[layer->id] = {layer, moment};
  return changed;
}

Similarity LayerMaps::motion(const Layer& parent, const Attachment& attachment) const {
  const LiveMap& map = of(parent.id);
  if (!map.has_map() || !parent.deformation.has_cage()) return {};
  const std::shared_ptr<const Mesh>& mesh = map.prepared()->mesh;
  auto known = std::ranges::find(anchors_, attachment, &std::pair<Attachment, Anchor>::first);
  if (known != anchors_.end() && !known->second.is_for(mesh, parent.deformation, attachment)) {
    anchors_.erase(known);
    known = anchors_.end();
  }
  if (known == anchors_.end()) {
    if (anchors_.size() >= kMaxLayers) anchors_.clear();
    anchors_.emplace_back(attachment, Anchor(mesh, parent.deformation, attachment));
    known = anchors_.end() - 1;
  }
  return known->second.motion(as_span(map.map().f));
}

bool LayerMaps::knows_placement(const Scene& scene, size_t layer) const {
  const std::optional<size_t> parent = parent_of(scene, *scene.layers[layer]);
  if (!parent) return true;
  const Layer& it = *scene.layers[*parent];
  const LiveMap& map = of(it.id);
  const bool known = !it.deformation.has_cage() || map.has_map() || map.error();
  return known && knows_placement(scene, *parent);
}

Similarity LayerMaps::placement(const Scene& scene, size_t layer) const {
  return placement_of(scene, layer, [&](size_t child) {
    const Layer& it = *scene.layers[child];
    return motion(*scene.layers[*parent_of(scene, it)], *it.attachment);
  });
}

void LayerMaps::clear() {
  for (auto& [id, map] : maps_) {
    map->clear();
    spare_.push_back(std::move(map));
  }
  maps_.clear();
  settled_.clear();
  anchors_.clear();
}

}  // namespace holomorph
