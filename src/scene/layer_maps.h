// The maps of all layers of a scene that is being edited.
#pragma once

#include <map>

#include "scene/layers.h"
#include "scene/live_map.h"

namespace holomorph {

/// A LiveMap for each layer, which it keeps while layers are reordered and chosen.
class LayerMaps {
 public:
  explicit LayerMaps(MeshOptions options = {}) : options_(options) {}

  /// Called by workers when a preparation has ended, to wake an event loop. Set before use.
  void on_ready(std::function<void()> wake) { wake_ = std::move(wake); }

  /// The map of the layer of this id; a new one if it has none yet.
  LiveMap& of(int id) const;
  /// Brings the maps of all visible layers but the edited one up to date, at a time when there is
  /// one, and lets those of layers go that are not there any more. Returns whether any changed.
  bool update_others(const Scene& scene, const Moment& moment);
  /// Forgets all of them and whatever workers are busy with.
  void clear();

 private:
  MeshOptions options_;
  std::function<void()> wake_;
  // Asking for a map makes it. Maps that are not needed any more are kept for the next layer, so
  // that nobody waits for a worker to end.
  mutable std::map<int, std::unique_ptr<LiveMap>> maps_;
  mutable std::vector<std::unique_ptr<LiveMap>> spare_;
};

}  // namespace holomorph
