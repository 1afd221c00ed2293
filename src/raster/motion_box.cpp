// Halves each piece of the motion until the path of each point hardly bends. The path is then
// bounded by its ends and its middle, up to a margin.
#include "raster/motion_box.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

constexpr int kMaxHalvings = 10;

class MovingPoints {
 public:
  MovingPoints(Box& box, const std::function<VectorXc(double)>& points_at,
               const std::function<bool()>& keep_going)
      : box_(box), points_at_(points_at), keep_going_(keep_going) {}

  void include(const VectorXc& points) {
    for (const Complex& z : points) box_.include(z);
  }

  bool include_between(double from, double to, const VectorXc& at_from, const VectorXc& at_to,
                       int halves) {
    if (at_from.size() == 0) return true;
    const double kBend = std::max(1.0, 1e-3 * box_.diagonal());  // plane units
    if (!keep_going_()) return false;
    const double middle = 0.5 * (from + to);
    const VectorXc at_middle = points_at_(middle);
    // A parabola deviates from the chords of its halves by an eighth of `bend`. The margin below is
    // twice that.
    const double bend = (at_from - 2 * at_middle + at_to).cwiseAbs().maxCoeff();
    if (bend > kBend && halves > 0)
      return include_between(from, middle, at_from, at_middle, halves - 1) &&
             include_between(middle, to, at_middle, at_to, halves - 1);
    Box here;
    for (const VectorXc* f : {&at_from, &at_middle, &at_to})
      for (const Complex& z : *f) here.include(z);
    const Complex margin(bend / 4, bend / 4);
    box_.include(Complex(here.left, here.bottom) - (bend > 1e-3 ? margin : 0));
    box_.include(Complex(here.right, here.top) + (bend > 1e-3 ? margin : 0));
    return true;
  }

 private:
  Box& box_;
  const std::function<VectorXc(double)>& points_at_;
  const std::function<bool()>& keep_going_;
};

}  // namespace

bool include_motion(Box& box, const std::function<VectorXc(double)>& points_at,
                    const std::vector<MotionPart>& parts, const std::function<bool()>& keep_going) {
  MovingPoints points(box, points_at, keep_going);
  VectorXc before = points_at(0);
  points.include(before);
  for (const auto& [from, to, pieces] : parts) {
    for (int i = 0; i < pieces; ++i) {
      const double start = from + (to - from) * i / pieces,
                   end = from + (to - from) * (i + 1) / pieces;
      VectorXc after = points_at(end);
      if (!points.include_between(start, end, before, after, kMaxHalvings)) return false;
      before = std::move(after);
    }
    if (pieces > 0) continue;
    before = points_at(to);
    points.include(before);
  }
  return true;
}

}  // namespace holomorph
