// Values are compared with what the renderer has: a preparation's number, a flag for the picture.
#include "app/canvas.h"

#include <utility>

namespace holomorph {
namespace {

/// Texture px per plane unit: a power of two, so that a box a pixel larger has the same.
double texture_zoom(const Box& box) {
  const double most = is_software_driver() ? 1024 : 2048;
  return std::exp2(std::floor(std::log2(most / std::max({box.width(), box.height(), 1e-6}))));
}

}  // namespace

Color onion_color(bool later) {
  return later ? Color{0.35f, 0.67f, 1} : Color{1, 0.55f, 0.31f};
}

void Canvas::draw(Workspace& workspace, const CanvasFrame& at) {
  update_heat(workspace);
  upload_picture(workspace);
  upload_map(workspace.map);
  const Viewport& view = workspace.viewport;
  Frame frame = frame_of(workspace);
  frame.window_width = at.window_width;
  frame.window_height = at.window_height;
  frame.canvas_left = view.left * at.ratio;
  frame.canvas_top = view.top * at.ratio;
  frame.canvas_width = view.width * at.ratio;
  frame.canvas_height = view.height * at.ratio;
  frame.center = view.center;
  frame.zoom = view.zoom * at.ratio;
  frame.wireframe = workspace.show_mesh;
  if (workspace.at_rest()) frame.placement = Placement::at_rest;
  frame.background = at.background;
  frame.backdrop = at.backdrop;
  const std::vector<OnionSkin> skins = workspace.onion_skins();
  for (const OnionSkin& skin : skins)
    frame.ghosts.push_back(
        {{skin.f.data(), static_cast<size_t>(skin.f.size())}, onion_color(skin.later)});
  renderer_.draw(frame);
}

Frame Canvas::frame_of(const Workspace& workspace) const {
  Frame frame;
  const bool shows_picture =
      !workspace.map.has_map() || (is_heat(workspace.view) && heat_values_.size() == 0);
  frame.view = shows_picture ? View::image : workspace.view;
  frame.diverging = heat_scale_.diverging;
  frame.placement = by_operator_ ? Placement::by_operator : Placement::positions;
  return frame;
}

Box Canvas::whole_pixels(const Box& box) {
  const double zoom = texture_zoom(box), width = std::ceil(zoom * box.width() + 1) / zoom,
               height = std::ceil(zoom * box.height() + 1) / zoom;
  Box whole;
  whole.include(box.center() - 0.5 * Complex(width, height));
  whole.include(box.center() + 0.5 * Complex(width, height));
  return whole;
}

void Canvas::draw_map(const Workspace& workspace, const Box& box, Framebuffer& into, Color clay) {
  Frame frame = frame_of(workspace);
  frame.zoom = texture_zoom(box);
  frame.window_width = static_cast<int>(std::lround(frame.zoom * box.width()));
  frame.window_height = static_cast<int>(std::lround(frame.zoom * box.height()));
  frame.canvas_width = frame.window_width;
  frame.canvas_height = frame.window_height;
  frame.center = box.center();
  frame.map_alone = true;
  frame.background = {0, 0, 0};
  frame.backdrop = clay;
  into.bind(frame.window_width, frame.window_height);
  renderer_.draw(frame);
  into.release();
}

void Canvas::update_heat(const Workspace& workspace) {
  const LiveMap& map = workspace.map;
  if (!is_heat(workspace.view) || !map.has_map() || map.map().fz.size() == 0) {
    heat_values_.resize(0);
    return;
  }
  heat_values_ = holomorph::heat_values(workspace.view, distortion_of(map.map()));
  heat_scale_ = holomorph::heat_scale(workspace.view, heat_values_, workspace.automatic_range);
}

void Canvas::upload_picture(Workspace& workspace) {
  if (!std::exchange(picture_changed_, false)) return;
  const Image* image = workspace.document.image();
  const int factor = image
                         ? renderer_.set_picture(image->width, image->height, image->pixels.data())
                         : renderer_.set_picture(0, 0, nullptr);
  if (factor > 1)
    workspace.say(
        "The picture is larger than this driver's textures: the canvas shows it reduced " +
        std::to_string(factor) + " times. Export uses all pixels.");
}

void Canvas::upload_map(const LiveMap& map) {
  if (!map.has_map()) {
    renderer_.set_mesh(nullptr);
    uploaded_ = 0;
    return;
  }
  const bool timed = map.timed().has_value();
  if (uploaded_ != map.preparation() || timed_ != timed) {
    if (uploaded_ != map.preparation()) renderer_.set_mesh(map.prepared()->mesh.get());
    // On a processor-driven OpenGL the shader's sum is the slower one; in-betweens are no sum.
    by_operator_ = renderer_.set_operator(
        is_software_driver() || timed ? nullptr : map.prepared()->deformer->operator_matrix());
    uploaded_ = map.preparation();
    timed_ = timed;
  }
  if (by_operator_ && map.posed())
    renderer_.set_controls(map.prepared()->deformer->controls(pose_of(*map.posed())));
  renderer_.set_positions({map.map().f.data(), static_cast<size_t>(map.map().f.size())});
  if (heat_values_.size() != map.map().f.size()) return;
  Eigen::VectorXf shades(heat_values_.size());
  for (Index i = 0; i < shades.size(); ++i)
    shades[i] = static_cast<float>(heat_position(heat_scale_, heat_values_[i]));
  renderer_.set_heat(shades);
}

}  // namespace holomorph
