// Finds the size of the result: whole pixels around the source's rectangle and around its image
// under the map.
#include "raster/raster.h"

#include "core/error.h"
#include "raster/drawing.h"
#include "scene/budget.h"

namespace holomorph {
namespace {

/// A rectangle of whole output pixels.
struct PixelRect {
  int left, top, width, height;  ///< top is measured downward from the page's top
};

/// Removes transparent rows and columns at the borders, but keeps all of `least`, the page.
void trim(Image& image, PixelRect& frame, const PixelRect& least) {
  const auto row_empty = [&](int r) {
    for (int c = 0; c < image.width; ++c)
      if (is_filled(image, c, r)) return false;
    return true;
  };
  const auto column_empty = [&](int c) {
    for (int r = 0; r < image.height; ++r)
      if (is_filled(image, c, r)) return false;
    return true;
  };
  int top = 0, bottom = image.height, left = 0, right = image.width;
  const auto may_trim = [&](int frame_side, int least_side) {
    return least.width == 0 || frame_side < least_side;
  };
  while (top < bottom && may_trim(frame.top + top, least.top) && row_empty(top)) ++top;
  while (bottom > top && may_trim(-(frame.top + bottom), -(least.top + least.height)) &&
         row_empty(bottom - 1))
    --bottom;
  while (left < right && may_trim(frame.left + left, least.left) && column_empty(left)) ++left;
  while (right > left && may_trim(-(frame.left + right), -(least.left + least.width)) &&
         column_empty(right - 1))
    --right;
  if (right - left == image.width && bottom - top == image.height) return;
  image = cut_out(image, left, top, right - left, bottom - top);
  frame = {frame.left + left, frame.top + top, image.width, image.height};
}

/// The bounding box of the source where the job places it.
Box placed_box(const RasterJob& job) {
  Box box;
  for (const Complex& corner : job.source_box().corners()) box.include(job.placement(corner));
  return box;
}

/// The bounding box of the image of a rectangle under the map, computed from the mesh vertices in
/// it and the points where mesh edges cross its border.
Box image_of(const Box& rectangle, const RasterJob& job, const Mesh& mesh,
             std::span<const Complex> at) {
  const auto depth = [&](Complex z) {
    return std::array{z.real() - rectangle.left, rectangle.right - z.real(),
                      z.imag() - rectangle.bottom, rectangle.top - z.imag()};
  };
  Box box;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int i = t[k], j = t[(k + 1) % 3];
      const auto a = depth(mesh.vertices[i]), b = depth(mesh.vertices[j]);
      double from = 0, to = 1;
      for (int side = 0; side < 4; ++side) {
        if (a[side] < 0 && b[side] < 0) from = 2;
        if (a[side] < 0 && b[side] >= 0) from = std::max(from, a[side] / (a[side] - b[side]));
        if (a[side] >= 0 && b[side] < 0) to = std::min(to, a[side] / (a[side] - b[side]));
      }
      if (from > to) continue;
      const Complex p = job.placement(at[i]), q = job.placement(at[j]);
      box.include((1 - from) * p + from * q);
      box.include((1 - to) * p + to * q);
    }
  return box;
}

/// The part of the stage that may show what lies beyond the page; empty if there is none.
Box on_stage(const RasterJob& job) {
  if (!job.source || !job.stage || job.region || job.crop || job.source_box() == job.page())
    return {};
  Box box = placed_box(job);
  const auto add = [&](const Mesh* mesh, std::span<const Complex> at) {
    const Box moved = mesh ? image_of(job.source_box(), job, *mesh, at) : Box{};
    if (moved.empty()) return;
    box.include({moved.left, moved.bottom});
    box.include({moved.right, moved.top});
  };
  add(job.mesh, job.positions);
  add(job.fringe, job.fringe_positions);
  const Box& stage = *job.stage;
  return {std::max(box.left, stage.left), std::max(box.bottom, stage.bottom),
          std::min(box.right, stage.right), std::min(box.top, stage.top)};
}

}  // namespace

RasterResult rasterized(const RasterJob& job) {
  check(!job.mesh || job.positions.size() == job.mesh->vertices.size(),
        "rasterized: the numbers of positions and mesh vertices differ");
  check(!job.fringe || job.fringe_positions.size() == job.fringe->vertices.size(),
        "rasterized: the numbers of positions and vertices of the fringe differ");
  const double scale = job.pixels_per_unit;
  if (!(scale > 0) || !std::isfinite(scale))
    throw Error(ErrorKind::bad_input, "the scale must be a positive number");
  const Box page = job.page();
  const double width = page.width(), height = page.height();
  const double top_edge = job.top.value_or(page.top);
  constexpr double kLargest = 16384;
  const auto check_size = [&](double width, double height) {
    if (!(width <= kLargest && height <= kLargest))
      throw Error(ErrorKind::bad_input,
                  "the picture would have more than 16384 pixels on a side; choose a smaller "
                  "scale");
  };
  if (job.source) check_size(width * scale, height * scale);
  constexpr double kRounding = 1e-3;  // tolerance for single-precision operators
  PixelRect least{0, 0, 0, 0};
  if (job.source) {
    const int left = static_cast<int>(std::floor(page.left * scale)),
              top = static_cast<int>(std::floor((top_edge - page.top) * scale));
    least = {left, top,
             page.left == 0 ? std::max(1, static_cast<int>(std::lround(width * scale)))
                            : static_cast<int>(std::ceil(page.right * scale)) - left,
             top_edge == page.top
                 ? std::max(1, static_cast<int>(std::lround(height * scale)))
                 : static_cast<int>(std::ceil((top_edge - page.bottom) * scale)) - top};
  }
  std::optional<Box> region = job.region;
  if (job.source && !region && !is_identity(job.placement)) region = placed_box(job);
  if (region) {
    const Box& box = *region;
    const double slack = job.region ? 0 : kRounding;
    const auto whole = [&](double low) {
      return static_cast<int>(std::floor(std::clamp(low + slack, -1e8, 1e8)));
    };
    least.left = whole(box.left * scale);
    least.top = whole((top_edge - box.top) * scale);
    check_size(box.width() * scale, box.height() * scale);
    const int smallest = job.region ? 0 : 1;  // a placement may be tiny
    least.width =
        std::max(smallest, static_cast<int>(std::ceil(box.right * scale - slack)) - least.left);
    least.height = std::max(
        smallest, static_cast<int>(std::ceil((top_edge - box.bottom) * scale - slack)) - least.top);
    check_size(least.width, least.height);
  }
  double left = least.left, top = least.top, right = least.left + least.width,
         bottom = least.top + least.height;
  if (job.mesh && !job.region && !(job.crop && job.source)) {
    Box box;
    if (job.source)
      box = image_of(page, job, *job.mesh, job.positions);
    else
      for (const Complex& z : job.positions) box.include(job.placement(z));
    if (job.source && job.fringe) {
      const Box around = image_of(page, job, *job.fringe, job.fringe_positions);
      if (!around.empty()) {
        box.include({around.left, around.bottom});
        box.include({around.right, around.top});
      }
    }
    if (!job.source) left = 1e300, top = 1e300, right = -1e300, bottom = -1e300;
    if (!box.empty()) {
      left = std::min(left, std::floor(box.left * scale + kRounding));
      right = std::max(right, std::ceil(box.right * scale - kRounding));
      top = std::min(top, std::floor((top_edge - box.top) * scale + kRounding));
      bottom = std::max(bottom, std::ceil((top_edge - box.bottom) * scale - kRounding));
    }
  }
  if (const Box shown = on_stage(job); !shown.empty() && right > left) {
    left = std::min(left, std::floor(shown.left * scale + kRounding));
    right = std::max(right, std::ceil(shown.right * scale - kRounding));
    top = std::min(top, std::floor((top_edge - shown.top) * scale + kRounding));
    bottom = std::max(bottom, std::ceil((top_edge - shown.bottom) * scale - kRounding));
  }
  check_size(right - left, bottom - top);
  if (right <= left || bottom <= top)
    throw Error(ErrorKind::bad_input, "there is nothing to draw: no picture and no cage");
  PixelRect frame{static_cast<int>(left), static_cast<int>(top), static_cast<int>(right - left),
                  static_cast<int>(bottom - top)};
  if (job.fine)
    check_budget(&Budget::pixels, kFineCopies * frame.width * frame.height,
                 "drawing a picture with more than 8 bits takes the memory of");
  Image image =
      drawn(job, frame.left / scale, top_edge - frame.top / scale, frame.width, frame.height);
  if (!job.crop && !job.region) trim(image, frame, least);
  return {std::move(image), {frame.left / scale, top_edge - (frame.top + frame.height) / scale}};
}

}  // namespace holomorph
