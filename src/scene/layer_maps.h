// The maps of all layers of a scene that is being edited.
#pragma once

#include <map>

#include "scene/layers.h"
#include "scene/live_map.h"

namespace holomorph {

/// One LiveMap per layer. A layer keeps its map when layers are reordered or another one is
/// selected.
class LayerMaps {
 public:
  explicit LayerMaps(MeshOptions options = {}) : options_(options) {}

  /// Sets a function that workers call when a preparation has ended, to wake an event loop. Call it
  /// before use.
  void on_ready(std::function<void()> wake) { wake_ = std::move(wake); }

  /// The map of the layer with this id, created if it has none yet.
  LiveMap& of(int id);
  /// The same to look at; an empty map if it has none yet.
  const LiveMap& of(int id) const;
  /// Updates the maps of all visible layers except the edited one for the given moment, and
  /// releases the maps of deleted layers. Returns whether any map changed.
  bool update_others(const Scene& scene, const Moment& moment);
  /// Discards all maps, including those that workers are preparing.
  void clear();

 private:
  MeshOptions options_;
  std::function<void()> wake_;
  // Unused maps are kept for later layers, so that no caller has to wait for a worker to end.
  std::map<int, std::unique_ptr<LiveMap>> maps_;
  std::vector<std::unique_ptr<LiveMap>> spare_;
  LiveMap none_;
};

}  // namespace holomorph
