// The map of the picture's edge is known, so the cage can take the shape of that edge.
#include "edit/method_choice.h"

#include "core/geometry/polygon.h"
#include "edit/edits/method_edits.h"
#include "edit/frame.h"

namespace holomorph {
namespace {

/// Whether pins alone determine the map of a deformation with this method.
bool pins_act_alone(const Method& method, const Deformation& deformation) {
  return method.uses_pins && method.pins_replace_cage && !deformation.pins.empty();
}

/// The map of the picture's edge, as images of the vertices of the mesh's boundary.
class EdgeMap {
 public:
  EdgeMap(const Mesh& mesh, Points images) : edge_{{}, mesh.starts}, images_(std::move(images)) {
    for (const int v : mesh.boundary) edge_.points.push_back(mesh.vertices[static_cast<size_t>(v)]);
  }
  /// The image of the point of the edge that is nearest to a rest point.
  Complex operator()(Complex rest) const {
    const NearestPoint near = nearest_on_polygon(edge_, rest);
    const Loops loops{static_cast<Index>(edge_.points.size()), edge_.starts};
    const Complex from = images_[static_cast<size_t>(near.edge)],
                  to = images_[static_cast<size_t>(loops.next(near.edge))];
    return from + near.t * (to - from);
  }

 private:
  Polygon edge_;
  Points images_;
};

/// Gives the cage the shape in which it is displayed, and the same in the keyframes.
void pose_cage_as_displayed(Workspace& w, Deformation& deformation) {
  const Mesh& mesh = *w.map().prepared()->mesh;
  Points edge, images;
  for (const int v : mesh.boundary) {
    edge.push_back(mesh.vertices[static_cast<size_t>(v)]);
    images.push_back(w.map().map().f[v]);
  }
  const auto posed = [&](const Cage& pose, Points at) {
    return image_of_cage(deformation.rest, pose, EdgeMap(mesh, std::move(at)));
  };
  const std::vector<Points> in_keys = w.keyframe_images(edge);
  for (size_t i = 0; i < in_keys.size(); ++i)
    if (Pose& key = deformation.keyframes[i].pose; fits(deformation, key))
      key.cage = posed(key.cage, in_keys[i]);
  // At a time, the map of the document's own pose is not known.
  if (!w.shown.is_timed()) deformation.pose = posed(deformation.pose, std::move(images));
}

}  // namespace

void choose_method(Workspace& w, const std::string& id) {
  const Deformation before = w.shown.own();
  const Method& method = method_named(id);
  if (chosen_method(before).id == id || !w.require_keyframe_maps()) return;
  Deformation after = with_usual_frame(w, with_chosen_method(before, id));
  const LiveMap& map = w.map();
  if (pins_act_alone(chosen_method(before), before) && !pins_act_alone(method, before) &&
      map.has_map() && map.posed() && same_rest(*map.posed(), before))
    pose_cage_as_displayed(w, after);
  if (after.rest != before.rest)  // parts were joined: numbers name other points
    std::erase_if(w.selection, [](const Handle& h) { return h.kind == Handle::Kind::cage; });
  w.commit("Method: " + method.label, std::move(after), EditBase::document);
}

void prevent_folds(Workspace& w, bool on) {
  w.commit(on ? "Prevent folds" : "Allow folds", with_folds_prevented(w.shown.deformation(), on));
}

}  // namespace holomorph
