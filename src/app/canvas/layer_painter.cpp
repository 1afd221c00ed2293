// To upload only changed data, compares the map's counters and the picture's address with their
// values at the last upload.
#include "app/canvas/layer_painter.h"

#include <utility>

#include "core/clock.h"
#include "system/memory.h"

namespace holomorph {

namespace {

/// Amounts of data that can be uploaded in one frame without a noticeable delay.
constexpr size_t kSmallPixels = 1'500'000;
constexpr size_t kBytesPerFrame = 8 << 20;

}  // namespace

int LayerPainter::update_picture(std::shared_ptr<const Image> picture, bool moves) {
  if (picture == picture_) {
    if (uploading_ && !renderer_.upload_more(kBytesPerFrame)) {
      uploading_ = false;
      return_freed_memory();  // the texture's levels were as large as the picture
    }
    return std::exchange(factor_, 0);
  }
  const bool moved = std::exchange(moves_, moves);
  picture_ = std::move(picture);
  opaque_.reset();
  preparing_.reset();
  uploading_ = false;
  if (!picture_) return renderer_.set_picture(0, 0, nullptr);
  const size_t pixels =
      static_cast<size_t>(picture_->width) * static_cast<size_t>(picture_->height);
  if (moves || pixels <= kSmallPixels) {
    const int factor =
        renderer_.set_picture(picture_->width, picture_->height, picture_->pixels.data());
    renderer_.place_picture(picture_->box(), picture_->page());
    return moves && moved ? 0 : factor;
  }
  ready_ = std::make_shared<TextureLevels>();
  preparing_ = std::make_unique<Job>(
      "Texture",
      [picture = picture_, ready = ready_,
       largest = Renderer::largest_side()](Job::Progress& progress) {
        *ready = texture_levels(picture->width, picture->height, picture->pixels.data(), largest,
                                [&] { return !progress.cancelled(); });
      },
      wake_);
  return 0;
}

bool LayerPainter::is_opaque() {
  if (!opaque_) opaque_ = !picture_ || holomorph::is_opaque(*picture_);
  return *opaque_;
}

bool LayerPainter::allocate_texture() {
  if (!preparing_ || !preparing_->ended()) return false;
  preparing_.reset();
  factor_ = ready_->factor;
  renderer_.begin_picture(std::exchange(ready_, nullptr));
  renderer_.place_picture(picture_->box(), picture_->page());
  return uploading_ = true;
}

void LayerPainter::update_fringe(const LiveMap& map, bool moved) {
  if (fringe_answer_) {
    const std::lock_guard lock(fringe_answer_->mutex);
    if (fringe_answer_->fringe) {
      fringe_ = *std::exchange(fringe_answer_->fringe, std::nullopt);
      renderer_.set_fringe(fringe_ ? &fringe_->mesh : nullptr);
      moved = true;
    }
  }
  const std::pair sought{map.prepared()->mesh, picture_};
  if (fringed_ != sought) {
    // The fringe of a film's last frame stays until the next one is known.
    if (!moves_ || fringed_.first != sought.first) {
      fringe_.reset();
      renderer_.set_fringe(nullptr);
    }
    fringed_ = sought;
    fringe_answer_.reset();
    if (seeks_fringe_) seeks_fringe_->cancel();
    needs_fringe_ = picture_ != nullptr;
  }
  if (seeks_fringe_ && seeks_fringe_->ended()) seeks_fringe_.reset();
  if (needs_fringe_ && !seeks_fringe_) {  // a canceled search ends soon, and then wakes the window
    needs_fringe_ = false;
    fringe_answer_ = std::make_shared<FringeAnswer>();
    seeks_fringe_ = std::make_unique<Job>(
        "Fringe",
        [sought, answer = fringe_answer_](Job::Progress& progress) {
          auto fringe =
              fringe_of(*sought.first, *sought.second, [&] { return !progress.cancelled(); });
          const std::lock_guard lock(answer->mutex);
          answer->fringe = std::move(fringe);
        },
        wake_);
  }
  if (fringe_ && moved)
    renderer_.set_fringe_positions(fringe_->positions(as_span(settling_.positions(map, now_ms()))));
}

void LayerPainter::update_heat(const LiveMap& map, View view, bool automatic_range) {
  if (!is_heat(view) || !map.has_map() || map.map().fz.size() == 0) {
    heat_values_.resize(0);
    return;
  }
  heat_values_ = holomorph::heat_values(view, distortion_of(map.map()));
  heat_scale_ = holomorph::heat_scale(view, heat_values_, automatic_range);
}

void LayerPainter::update_map(const LiveMap& map, View view, bool automatic_range) {
  const Uploaded wanted{&map, map.revision(), view, automatic_range};
  const bool settles = settling_.moves(), changed = uploaded_ != wanted;
  if (uploaded_.map != &map) {  // maps count their preparations independently
    preparation_ = 0;
    settling_ = {};
  }
  if (changed)
    upload(map, view, automatic_range);
  else if (settles)
    renderer_.set_positions(as_span(settling_.positions(map, now_ms())));
  uploaded_ = wanted;
  if (map.has_map()) update_fringe(map, changed || settles);
}

void LayerPainter::upload(const LiveMap& map, View view, bool automatic_range) {
  update_heat(map, view, automatic_range);
  if (!map.has_map()) {
    settling_ = {};
    renderer_.set_mesh(nullptr);
    preparation_ = 0;
    fringed_ = {};
    return;
  }
  const bool timed = map.timed().has_value();
  if (preparation_ != map.preparation() || timed_ != timed) {
    if (preparation_ != map.preparation()) {
      renderer_.set_mesh((mesh_ = map.drawn()).get());
      if (fringe_) renderer_.set_fringe(&fringe_->mesh);
    }
    // The shader computes positions as a sum over controls. Software OpenGL is too slow for this,
    // and maps interpolated between keyframes are not such sums.
    by_operator_ = renderer_.set_operator(
        is_software_driver() || timed ? nullptr : map.prepared()->deformer->operator_matrix());
    preparation_ = map.preparation();
    timed_ = timed;
  }
  if (mesh_ != map.drawn()) {  // depths have changed the order of the triangles
    renderer_.set_triangles((mesh_ = map.drawn())->triangles);
  }
  if (by_operator_ && map.posed())
    renderer_.set_controls(map.prepared()->deformer->controls(pose_of(*map.posed())));
  renderer_.set_positions(as_span(settling_.positions(map, now_ms())));
  if (heat_values_.size() != map.map().f.size()) return;
  Eigen::VectorXf shades(heat_values_.size());
  for (Index i = 0; i < shades.size(); ++i)
    shades[i] = static_cast<float>(heat_position(heat_scale_, heat_values_[i]));
  renderer_.set_heat(shades);
}

void LayerPainter::draw(const LiveMap& map, View view, RenderFrame frame) {
  const bool shows_picture = !map.has_map() || (is_heat(view) && heat_values_.size() == 0);
  frame.view = shows_picture ? View::image : view;
  frame.diverging = heat_scale_.diverging;
  if (frame.placement != Placement::at_rest)
    frame.placement = by_operator_ ? Placement::by_operator : Placement::positions;
  renderer_.draw(frame);
}

}  // namespace holomorph
