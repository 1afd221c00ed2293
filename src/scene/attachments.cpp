// A layer that follows another one is moved as a whole, by a similarity. Its own pose and keyframes
// stay as they are.
#include "scene/attachments.h"

#include <algorithm>

#include "core/error.h"
#include "core/maps/held_disk.h"
#include "scene/layers.h"

namespace holomorph {
namespace {

const Pin* pin_of(const Deformation& deformation, int id) {
  const auto found = std::ranges::find(deformation.pins, id, &Pin::id);
  return found == deformation.pins.end() ? nullptr : &*found;
}
const Stroke* stroke_of(const Deformation& deformation, int id) {
  const auto found = std::ranges::find(deformation.strokes, id, &Stroke::id);
  return found == deformation.strokes.end() ? nullptr : &*found;
}

/// The points of the parent, at rest, from which the anchor is made; empty if there are none.
Points source_of(const Deformation& parent, const Attachment& to) {
  if (to.to == Attachment::To::place) return {to.place};
  if (to.to == Attachment::To::pin) {
    const Pin* pin = pin_of(parent, to.handle);
    return pin ? Points{pin->rest} : Points{};
  }
  const Stroke* stroke = stroke_of(parent, to.handle);
  return stroke ? stroke->rest : Points{};
}

std::optional<double> radius_of(const Deformation& parent, const Attachment& to) {
  const Pin* pin = to.to == Attachment::To::pin ? pin_of(parent, to.handle) : nullptr;
  return pin ? pin->radius : std::nullopt;
}

/// The nearest location to z in the mesh; exact where z is inside.
Location location_near(const Mesh& mesh, Complex z) {
  Location at = locate_near(mesh, z);
  double sum = 0;
  for (double& weight : at.weights) sum += weight = std::max(weight, 0.0);
  for (double& weight : at.weights) weight /= sum;
  return at;
}

/// The id of a handle; a new one if it has none yet.
template <class Handle>
int id_of(std::vector<Handle>& handles, size_t index) {
  check(index < handles.size(), "attachment_to: the handle exists");
  int& id = handles[index].id;
  if (id > 0) return id;
  int free = 1;
  while (std::ranges::find(handles, free, &Handle::id) != handles.end()) ++free;
  return id = free;
}

}  // namespace

std::optional<size_t> parent_of(const Scene& scene, const Layer& layer) {
  if (!layer.attachment) return {};
  const size_t parent = layer_index(scene, layer.attachment->layer);
  if (parent == scene.layers.size() ||
      source_of(scene.layers[parent]->deformation, *layer.attachment).empty())
    return {};
  return parent;
}

bool follows(const Scene& scene, size_t layer, size_t other) {
  std::optional<size_t> at = layer;
  for (size_t steps = 0; at && steps <= scene.layers.size(); ++steps) {
    if (*at == other) return true;
    at = parent_of(scene, *scene.layers[*at]);
  }
  return false;
}

bool may_follow_any(const Scene& scene, size_t layer) {
  for (size_t i = 0; i < scene.layers.size(); ++i)
    if (!follows(scene, i, layer)) return true;
  return false;
}

bool carries_others(const Scene& scene, size_t layer) {
  for (size_t i = 0; i < scene.layers.size(); ++i)
    if (i != layer && follows(scene, i, layer)) return true;
  return false;
}

void check_attachments(const Scene& scene) {
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    if (!layer.attachment) continue;
    const auto fail = [&](const std::string& what) {
      throw Error(ErrorKind::bad_input, "layer " + std::to_string(i + 1) + " " + what);
    };
    const std::optional<size_t> parent = parent_of(scene, layer);
    if (!parent) fail("is attached to a layer, pin or stroke that does not exist");
    if (follows(scene, *parent, i)) fail("is attached to itself, or to a layer that follows it");
  }
}

Anchor::Anchor(std::shared_ptr<const Mesh> mesh, const Deformation& parent, const Attachment& to)
    : mesh_(std::move(mesh)), source_(source_of(parent, to)), radius_(radius_of(parent, to)) {
  check(!source_.empty(), "Anchor: the parent has what the attachment names");
  Points points = source_;
  if (to.to != Attachment::To::stroke) {
    const Complex center = location_near(*mesh_, source_[0]).in(*mesh_, mesh_->vertices);
    points = held_disk(parent.rest, {center, true, radius_});
  }
  for (const Complex& z : points) {
    points_.push_back(location_near(*mesh_, z));
    rest_.push_back(points_.back().in(*mesh_, mesh_->vertices));
  }
}

bool Anchor::is_for(const std::shared_ptr<const Mesh>& mesh, const Deformation& parent,
                    const Attachment& to) const {
  return mesh == mesh_ && source_of(parent, to) == source_ && radius_of(parent, to) == radius_;
}

Similarity Anchor::motion(std::span<const Complex> positions) const {
  constexpr double kLeast = 1e-3, kMost = 1e3;
  Points images;
  for (const Location& at : points_) images.push_back(at.in(*mesh_, positions));
  Similarity motion = similarity_between(rest_, images);
  const double scale = std::abs(motion.factor);
  if (!(scale >= kLeast && scale <= kMost)) motion.factor = 1;
  return motion;
}

std::string attachment_text(const Scene& scene, size_t layer) {
  const std::optional<size_t> parent = parent_of(scene, *scene.layers[layer]);
  if (!parent) return "";
  const std::string title = title_of_layer(scene, *parent);
  const Attachment& to = *scene.layers[layer]->attachment;
  const Deformation& deformation = scene.layers[*parent]->deformation;
  if (to.to == Attachment::To::pin)
    return "pin " + std::to_string(pin_of(deformation, to.handle) - deformation.pins.data() + 1) +
           " of " + title;
  if (to.to == Attachment::To::stroke)
    return "stroke " +
           std::to_string(stroke_of(deformation, to.handle) - deformation.strokes.data() + 1) +
           " of " + title;
  return title;
}

Similarity placement_of(const Scene& scene, size_t layer, const ParentMotion& motion) {
  const Layer& it = *scene.layers[layer];
  const std::optional<size_t> parent = parent_of(scene, it);
  if (!parent) return it.placement;
  const Similarity moved = composed(motion(layer), it.placement),
                   below = placement_of(scene, *parent, motion);
  return is_identity(below) ? moved : composed(below, moved);
}

std::pair<Attachment, Scene> attachment_to(Scene scene, const AttachmentTarget& target) {
  Layer parent = *scene.layers[target.layer];
  Attachment attachment{parent.id, target.to, 0, target.place, {}};
  if (target.to == Attachment::To::pin)
    attachment.handle = id_of(parent.deformation.pins, target.handle);
  if (target.to == Attachment::To::stroke)
    attachment.handle = id_of(parent.deformation.strokes, target.handle);
  return {attachment, with_layer_at(std::move(scene), target.layer, std::move(parent))};
}

Scene with_attachment(Scene scene, size_t layer, const Attachment& attachment,
                      const Similarity& placement) {
  Layer changed = *scene.layers[layer];
  changed.attachment = attachment;
  changed.placement = placement;
  return with_layer_at(std::move(scene), layer, std::move(changed));
}

Scene detached(Scene scene, size_t layer, const Similarity& placed) {
  Layer changed = *scene.layers[layer];
  changed.attachment.reset();
  changed.placement = placed;
  return with_layer_at(std::move(scene), layer, std::move(changed));
}

Scene without_lost_parents(Scene scene, const std::function<Similarity(int id)>& placed) {
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const Layer& layer = *scene.layers[i];
    if (layer.attachment && !parent_of(scene, layer)) {
      const Similarity here = placed(layer.id);
      scene = detached(std::move(scene), i, here);
    }
  }
  return scene;
}

}  // namespace holomorph
