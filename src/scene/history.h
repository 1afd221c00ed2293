// Undo by snapshots. Each drag adds one snapshot, taken when the mouse button is released.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/layers.h"
#include "scene/scene.h"

namespace holomorph {

/// A sequence of scenes with a current position. It always has at least one scene.
class History {
 public:
  struct Entry {
    std::string label;
    Scene scene;
    std::optional<double> at = {};  ///< the time displayed when the entry was made
  };

  explicit History(Scene scene, std::string label = "Open") {
    entries_.push_back({std::move(label), std::move(scene)});
  }

  /// Adds a scene after the current one and discards the scenes that were undone. Returns false,
  /// and adds nothing, if the scene equals the current one.
  bool commit(std::string label, Scene scene, std::optional<double> at = {}) {
    if (scene == current()) return false;
    entries_.resize(index_ + 1);
    entries_.push_back({std::move(label), std::move(scene), at});
    if (entries_.size() > kMost) entries_.erase(entries_.begin());
    index_ = entries_.size() - 1;
    return true;
  }
  /// Replaces the current scene, which continues the last step. Discards the scenes that were
  /// undone.
  void amend(Scene scene) {
    entries_.resize(index_ + 1);
    entries_[index_].scene = std::move(scene);
  }
  /// Replaces the current scene with an equivalent one. Scenes that were undone can still be
  /// redone.
  void replace(Scene scene) { entries_[index_].scene = std::move(scene); }
  /// Replaces a layer's deformation by an equivalent one in all scenes that have it.
  void revise(int layer, const Deformation& from, const Deformation& to) {
    for (Entry& entry : entries_)
      if (const size_t i = layer_index(entry.scene, layer);
          i < entry.scene.layers.size() && entry.scene.layers[i]->deformation == from) {
        Layer revised = *entry.scene.layers[i];
        revised.deformation = to;
        entry.scene.layers[i] = SharedLayer(std::move(revised));
      }
  }
  /// Replaces all scenes by equivalent ones.
  void revise_all(const std::function<Scene(const Scene&)>& revised) {
    for (Entry& entry : entries_) entry.scene = revised(entry.scene);
  }
  bool undo() { return index_ > 0 && (--index_, true); }
  bool redo() { return index_ + 1 < entries_.size() && (++index_, true); }
  void go_to(size_t index) { index_ = std::min(index, entries_.size() - 1); }

  bool can_undo() const { return index_ > 0; }
  bool can_redo() const { return index_ + 1 < entries_.size(); }
  const Scene& current() const { return entries_[index_].scene; }
  const std::vector<Entry>& entries() const { return entries_; }
  size_t index() const { return index_; }

 private:
  static constexpr size_t kMost = 1000;
  std::vector<Entry> entries_;
  size_t index_ = 0;
};

}  // namespace holomorph
