// The parts are drawn into a small picture, from which the cage is made.
#include "scene/joined_cage.h"

#include <algorithm>
#include <cmath>

#include "scene/auto_cage.h"
#include "scene/keyframes.h"

namespace holomorph {
namespace {

/// Makes the pixels opaque whose row meets the inside of a polygon in the plane of the picture.
/// Several lines are drawn in each row, so that nothing inside is missed but thin tips.
void fill(PolygonView polygon, Image& image) {
  constexpr int kLines = 3;
  for (int r = 0; r < image.height; ++r)
    for (int k = 0; k < kLines; ++k) {
      const double y = image.height - r - (k + 0.5) / kLines;
      std::vector<double> crossings;
      polygon.for_each_edge([&](Index, Complex a, Complex b) {
        if ((a.imag() > y) == (b.imag() > y)) return;
        const double t = (y - a.imag()) / (b.imag() - a.imag());
        crossings.push_back(a.real() + t * (b.real() - a.real()));
      });
      std::ranges::sort(crossings);
      for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const int from = std::clamp(static_cast<int>(std::floor(crossings[i])), 0, image.width),
                  to = std::clamp(static_cast<int>(std::ceil(crossings[i + 1])), 0, image.width);
        for (int c = from; c < to; ++c) image.at(c, r)[3] = 255;
      }
    }
}

}  // namespace

Cage joined_cage(const Cage& cage) {
  if (cage.parts.empty()) return cage;
  constexpr double kPixels = 600;  // on the longer side
  Polygon outline = outline_of(cage);
  const Box box = box_of(outline.points);
  const double scale = kPixels / std::max(box.width(), box.height());
  const Complex corner(box.left, box.bottom);
  for (Complex& z : outline.points) z = scale * (z - corner);
  const auto pixels = [&](double length) {
    return static_cast<int>(std::ceil(scale * length)) + 1;
  };
  Image image(pixels(box.width()), pixels(box.height()));
  fill(outline, image);
  Cage joined = auto_cage(image, {.parts = PartChoice::joined});
  for (Points& segment : joined.segments)
    for (Complex& z : segment) z = corner + z / scale;
  return joined;
}

Deformation with_joined_parts(Deformation deformation) {
  if (deformation.rest.parts.empty()) return deformation;
  const Cage before = std::move(deformation.rest);
  const FlatCage flat = flattened(before);
  const Cage joined = joined_cage(before);
  const auto follow = [&](const Cage& posed) {
    Cage cage = joined;
    for (Points& segment : cage.segments)
      for (Complex& z : segment) {
        const BoundaryPoint near = nearest_on(before, flat, z);
        z += position_of(posed, near) - position_of(before, near);
      }
    return cage;
  };
  deformation.rest = before;  // which the keyframes must fit
  for_fitting_keys(deformation, [&](Pose& pose) {
    pose.cage = follow(pose.cage);
    pose.corners.clear();
  });
  deformation.pose = follow(deformation.pose);
  deformation.rest = joined;
  deformation.corners.clear();
  deformation.loop_extras.clear();
  return deformation;
}

}  // namespace holomorph
