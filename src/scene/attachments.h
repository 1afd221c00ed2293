// Layers that follow a pin, a stroke or a place of another layer, as a hat follows a head.
#pragma once

#include <functional>

#include "core/mesh/mesh.h"
#include "scene/scene.h"

namespace holomorph {

/// The index of the layer to which a layer is attached. None if it is not attached, or if the
/// parent or its handle does not exist.
std::optional<size_t> parent_of(const Scene& scene, const Layer& layer);
/// Whether a layer follows another one, directly or through other layers. Layers also follow
/// themselves.
bool follows(const Scene& scene, size_t layer, size_t other);
/// Whether there is a layer that another one may follow.
bool may_follow_any(const Scene& scene, size_t layer);
/// Whether any other layer follows the layer with this index.
bool carries_others(const Scene& scene, size_t layer);
/// Throws Error if a layer is attached to something that does not exist, or to itself through
/// other layers.
void check_attachments(const Scene& scene);

/// The spot of a parent that an attached layer follows: points of the picture at rest. For a pin or
/// a place, they are the disk that a pin there would hold; for a stroke, its points.
class Anchor {
 public:
  /// `mesh` is that of the parent's map. The parent must have what the attachment names.
  Anchor(std::shared_ptr<const Mesh> mesh, const Deformation& parent, const Attachment& to);
  /// Whether this is the anchor for the same arguments.
  bool is_for(const std::shared_ptr<const Mesh>& mesh, const Deformation& parent,
              const Attachment& to) const;
  /// The similarity that best follows the points when the mesh's vertices are at `positions`. If
  /// the points collapse, only their center is followed.
  Similarity motion(std::span<const Complex> positions) const;

 private:
  std::shared_ptr<const Mesh> mesh_;
  Points source_;  ///< determines the points, together with mesh and radius
  std::optional<double> radius_;
  std::vector<Location> points_;
  Points rest_;
};

/// What a layer is attached to, such as "pin 3 of gecko"; empty if it is not attached.
std::string attachment_text(const Scene& scene, size_t layer);

/// How the parent of the layer with an index moves the layer's anchor.
using ParentMotion = std::function<Similarity(size_t layer)>;
/// Where a layer's plane lies in the scene's plane: its placement, moved by all layers that carry
/// it.
Similarity placement_of(const Scene& scene, size_t layer, const ParentMotion& motion);

/// What a layer can be attached to.
struct AttachmentTarget {
  size_t layer = 0;
  Attachment::To to = Attachment::To::place;
  size_t handle = 0;  ///< the index of a pin or stroke
  Complex place = {};
  bool operator==(const AttachmentTarget&) const = default;
};
/// The attachment to a target, and the scene with an id for its handle.
std::pair<Attachment, Scene> attachment_to(Scene scene, const AttachmentTarget& target);
/// The scene with a layer attached to a parent that does not follow it. `placement` is where the
/// layer would lie if the parent were at rest; see Layer::placement.
Scene with_attachment(Scene scene, size_t layer, const Attachment& attachment,
                      const Similarity& placement = {});
/// The scene with a layer that follows nothing and stays where it lies now.
Scene detached(Scene scene, size_t layer, const Similarity& placed);
/// Detaches all layers whose parent, or the parent's pin or stroke, no longer exists. They stay
/// where they lay; `placed` gives the placement of a layer by its id.
Scene without_lost_parents(Scene scene, const std::function<Similarity(int id)>& placed);

}  // namespace holomorph
