// The maps of all layers of a scene that is being edited.
#pragma once

#include <map>

#include "scene/attachments.h"
#include "scene/layers.h"
#include "scene/live_map.h"

namespace holomorph {

/// One LiveMap per layer. A layer keeps its map when layers are reordered or another layer is
/// selected.
class LayerMaps {
 public:
  explicit LayerMaps(MeshOptions options = {}) : options_(options) {}

  /// Sets a function that workers call at the end of each preparation, for example to wake an event
  /// loop. Set it before any other call.
  void on_ready(std::function<void()> wake) { wake_ = std::move(wake); }

  /// The map of the layer with this id. Creates it if it does not exist yet.
  LiveMap& of(int id);
  /// The map of the layer with this id, or an empty map if it does not exist yet.
  const LiveMap& of(int id) const;
  /// Updates the maps of all visible layers and of those that they follow, except the edited layer,
  /// to the given moment, on all processor cores. Releases the maps of deleted layers. Returns
  /// whether any map changed.
  bool update_others(const Scene& scene, const Moment& moment);
  /// Where the plane of a layer lies in the scene's plane, with the displayed maps of the layers
  /// that it follows. `scene` is the document's.
  Similarity placement(const Scene& scene, size_t layer) const;
  /// Whether the maps of all layers that a layer follows are known.
  bool knows_placement(const Scene& scene, size_t layer) const;
  /// How the map of a layer moves what is attached to it; the identity while it has no map.
  Similarity motion(const Layer& parent, const Attachment& attachment) const;
  /// Discards all maps, including those that workers are preparing.
  void clear();

 private:
  MeshOptions options_;
  std::function<void()> wake_;
  // Unused maps are kept for later layers, because destroying a map waits for its worker.
  std::map<int, std::unique_ptr<LiveMap>> maps_;
  std::vector<std::unique_ptr<LiveMap>> spare_;
  /// For each layer whose map is final, what the map belongs to. Such maps are not updated again,
  /// so that a drag in one layer costs the same with many layers.
  std::map<int, std::pair<SharedLayer, Moment>> settled_;
  LiveMap none_;
  /// The anchors of the attachments that were displayed last, because placements are needed often.
  mutable std::vector<std::pair<Attachment, Anchor>> anchors_;
};

}  // namespace holomorph
