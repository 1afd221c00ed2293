// Rotations and stretches are averaged separately.
#include "scene/formats/drawing_frames.h"

#include <cmath>

#include "scene/formats/svg_paint.h"
#include "scene/formats/svg_styles.h"

namespace holomorph {
namespace {

/// The average of derivatives that preserves orientation. Rotations are averaged alone, so that a
/// stroke that is bent into a circle keeps its width.
Affine average(const std::vector<PointMap::Value>& values, const Points& points) {
  Complex rotation = 0, at = 0, image = 0, anti = 0;
  double linear = 0;
  size_t count = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const auto& [f, fz, fzbar] = values[i];
    if (!is_finite(f) || !is_finite(fz) || !is_finite(fzbar) || !(std::abs(fz) > 0)) continue;
    const Complex direction = fz / std::abs(fz);
    rotation += direction;
    linear += std::abs(fz);
    anti += std::conj(direction) * fzbar;
    at += points[i];
    image += f;
    ++count;
  }
  if (count == 0) return {};
  const double n = static_cast<double>(count);
  Affine map{linear / n, anti / n, 0};
  if (!(std::abs(map.anti) < 0.99 * linear / n)) map.anti = 0;  // the map folds
  const Complex direction = std::abs(rotation) > 0 ? rotation / std::abs(rotation) : 1;
  map.linear *= direction;
  map.anti *= direction;
  map.shift = image / n - map.direction(at / n);
  return map;
}

/// Whether an affine map misses the values of another map by a tenth of their extent, on average.
bool misses(const Affine& map, const Points& points, std::span<const PointMap::Value> values) {
  constexpr double kVisible = 0.1;
  Complex center = 0;
  for (const PointMap::Value& value : values) center += value.f / double(values.size());
  double off = 0, extent = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    off += std::norm(map(points[i]) - values[i].f);
    extent += std::norm(values[i].f - center);
  }
  return off > kVisible * kVisible * extent;
}

bool paints_gradient(const pugi::xml_node& node) {
  return inherited_property(node, "fill").starts_with("url(") ||
         inherited_property(node, "stroke").starts_with("url(");
}

}  // namespace

size_t DrawingFrames::add(pugi::xml_node node, const Affine& to_picture, size_t parent) {
  frames_.push_back({parent, node, to_picture});
  return frames_.size() - 1;
}

void DrawingFrames::sample(size_t frame, Complex at) {
  constexpr size_t kMostSamples = 1024;
  for (; frame != kResult; frame = frames_[frame].parent) {
    Frame& it = frames_[frame];
    if (it.offered++ % it.step != 0) continue;
    it.samples.push_back(at);
    if (it.samples.size() < kMostSamples) continue;
    for (size_t i = 0; 2 * i < it.samples.size(); ++i) it.samples[i] = it.samples[2 * i];
    it.samples.resize(kMostSamples / 2);
    it.step *= 2;
  }
}

void DrawingFrames::place(const PointValues& map) {
  Points all;
  for (const Frame& frame : frames_)
    all.insert(all.end(), frame.samples.begin(), frame.samples.end());
  const std::vector<PointMap::Value> values =
      all.empty() ? std::vector<PointMap::Value>() : map(all);
  auto at = values.begin();
  for (size_t i = 1; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    const auto end = at + static_cast<long>(frame.samples.size());
    const Affine map_here = average({at, end}, frame.samples);
    frame.placement = composed(map_here, frame.to_picture);
    if (paints_gradient(frame.node) && misses(map_here, frame.samples, {at, end}))
      should_bend_gradients_ = true;
    at = end;
    const double size = std::abs(frame.placement.linear) + std::abs(frame.placement.anti);
    if (!(std::abs(frame.placement.determinant()) > 1e-9 * size * size))
      frame.placement = frames_[frame.parent].placement;
  }
}

void DrawingFrames::write_transforms() {
  for (size_t i = 1; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    const Affine relative = composed(inverse(frames_[frame.parent].placement), frame.placement);
    if (relative != Affine{})
      frame.node.append_attribute("transform").set_value(matrix_text(relative).c_str());
  }
}

}  // namespace holomorph
