// Layers are identified by their ids, which do not change when layers move.
#include "scene/layer_maps.h"

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
    }
    entry = gone ? maps_.erase(entry) : std::next(entry);
  }
  bool changed = false;
  for (const SharedLayer& layer : scene.layers)
    if (layer->id != scene.layer().id && layer->visible)
      changed = of(layer->id).update(layer->deformation, {}, moment) || changed;
  return changed;
}

void LayerMaps::clear() {
  for (auto& [id, map] : maps_) {
    map->clear();
    spare_.push_back(std::move(map));
  }
  maps_.clear();
}

}  // namespace holomorph
