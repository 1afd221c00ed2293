// Divides a picture with several parts: those with handles are sheets, and the others follow.
#pragma once

#include <memory>
#include <optional>

#include "core/maps/deformer.h"

namespace holomorph {

/// Gives each part of the cage its share of a rest and of its poses. Parts in which no pin and no
/// stroke acts are loose, unless there are no such handles anywhere. A loose part moves like the
/// point of a part with handles that is nearest to it, its anchor, or like another loose part that
/// is nearer. Immutable.
class SheetDivision {
 public:
  struct Part {
    Rest rest;                   ///< with the samples and the pins of this part
    std::vector<Index> samples;  ///< their indices in the whole rest
    std::vector<size_t> pins;    ///< likewise
    Points anchors;              ///< those of the loose parts that follow this one
    struct Leader {
      size_t part, anchor;  ///< its index among the anchors of that part
      Complex at;
    };
    std::optional<Leader> leader;  ///< of a loose part
  };

  /// The meshes of the parts are shared with `previous`, if they are the same; it may be null. The
  /// rest must have a mesh.
  SheetDivision(const Rest& rest, const SheetDivision* previous);

  const std::vector<Part>& parts() const { return parts_; }
  /// Which pins and strokes have no effect; empty if there is one part, which has its own note.
  const std::string& note() const { return note_; }
  Pose pose_of(size_t part, const Pose& pose) const;
  size_t part_at(Complex z) const { return static_cast<size_t>(finder_.at(z)); }

 private:
  void share_handles(const Rest& rest);
  void share_samples(const Rest& rest);
  void find_leaders();

  std::shared_ptr<const Mesh> mesh_;
  PartFinder finder_;
  std::vector<Part> parts_;
  std::string note_;
};

}  // namespace holomorph
