// The cage is a polygon with edges as long as possible in a band around the content, or a fit to
// level curves of the content's distance field.
#include "scene/auto_cage.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/geometry/curve_around.h"
#include "core/geometry/polyline.h"
#include "core/geometry/simplify.h"
#include "scene/enclosed_regions.h"
#include "scene/limits.h"
#include "scene/part_grid.h"

namespace holomorph {
namespace {

Points rectangle(const Image& image, double margin) {
  const Box page = image.page();
  const auto [left, bottom, right, top] =
      Box{page.left - margin, page.bottom - margin, page.right + margin, page.top + margin};
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

// Distances between the centers of cells. Level curves cut off corners, so that whole cells are
// enclosed only from 1 on; the rest is for rounding. Two cells are just enough for gaps of three.
constexpr double kEdge = 0.5, kEnclosing = 1.1, kLeastOuter = 1.9;

/// The point of the part's edge that is nearest to each cell, or -1 where it is farther away than
/// `reach`. The points spread to neighboring cells in sweeps over the grid.
Grid<int> nearest_points(const PartGrid& part, const Points& edge, double reach) {
  const int width = part.distance.width, height = part.distance.height;
  Grid<int> nearest(width, height, -1);
  const auto offer = [&](int point, int c, int r) {
    if (point < 0 || part.distance(c, r) > reach) return;
    const Complex z(c, -r);
    int& best = nearest(c, r);
    if (best < 0 || std::norm(edge[static_cast<size_t>(point)] - z) <
                        std::norm(edge[static_cast<size_t>(best)] - z))
      best = point;
  };
  for (size_t i = 0; i < edge.size(); ++i)
    offer(static_cast<int>(i), static_cast<int>(std::round(edge[i].real())),
          static_cast<int>(std::round(-edge[i].imag())));
  for (int sweep = 0; sweep < 4; ++sweep) {
    const bool down = sweep % 2 == 0;
    const int step = down ? 1 : -1;
    for (int row = 1; row + 1 < height; ++row) {
      const int r = down ? row : height - 1 - row;
      for (int c = 1; c + 1 < width; ++c)
        for (const int right : {-1, 0, 1}) offer(nearest(c + right, r - step), c, r);
      for (int c = 1; c < width; ++c) offer(nearest(c - 1, r), c, r);
      for (int c = width - 2; c >= 0; --c) offer(nearest(c + 1, r), c, r);
    }
  }
  return nearest;
}

/// Where two cells of the middle of a gap touch only at a corner, adds the one between them that is
/// farther from the part. A level curve would otherwise close the gap there.
void join_diagonals(const PartGrid& part, Grid<std::uint8_t>& middles) {
  for (int r = 0; r + 1 < middles.height; ++r)
    for (int c = 0; c + 1 < middles.width; ++c)
      for (const int left : {0, 1}) {  // the upper left and lower right cells, or the other two
        const int a = c + left, b = c + 1 - left;
        if (!middles(a, r) || !middles(b, r + 1) || middles(b, r) || middles(a, r + 1)) continue;
        if (part.distance(b, r) >= part.distance(a, r + 1))
          middles(b, r) = 1;
        else
          middles(a, r + 1) = 1;
      }
}

/// The distance to the middle of narrow gaps between limbs, and of the regions in front of them.
/// There, the nearest points of the part's edge are farther apart along the edge than a tenth of
/// the size for two neighboring cells. None if there are no gaps up to this distance from the part.
std::optional<Grid<float>> distance_to_gaps(const PartGrid& part, double reach) {
  const Points edge = level_curve(part.distance, kEdge);
  std::vector<double> along{0};
  for (size_t i = 0; i < edge.size(); ++i)
    along.push_back(along.back() + std::abs(edge[(i + 1) % edge.size()] - edge[i]));
  const Grid<int> nearest = nearest_points(part, edge, reach);
  const auto belongs_to_two = [&](int a, int b) {
    if (a < 0 || b < 0) return false;
    const double between = std::abs(along[static_cast<size_t>(a)] - along[static_cast<size_t>(b)]);
    return std::min(between, along.back() - between) > 0.1 * part.size;
  };
  Grid<std::uint8_t> middles(part.distance.width, part.distance.height, 0);
  bool any = false;
  for (int r = 0; r + 1 < middles.height; ++r)
    for (int c = 1; c + 1 < middles.width; ++c)
      for (const auto& [right, down] : {std::pair(1, 0), {-1, 1}, {0, 1}, {1, 1}}) {
        if (!belongs_to_two(nearest(c, r), nearest(c + right, r + down))) continue;
        const float here = part.distance(c, r), there = part.distance(c + right, r + down);
        if (here >= there) middles(c, r) = 1;
        if (there >= here) middles(c + right, r + down) = 1;
        any = true;
      }
  if (!any) return {};
  join_diagonals(part, middles);
  return distance_field(middles);
}

/// Where the cage may run: between two distances from the part and, so that limbs remain apart, not
/// across the middle of a gap.
class Band {
 public:
  /// `to_gaps` may be null.
  Band(const PartGrid& part, const Grid<float>* to_gaps, double margin)
      : part_(part),
        to_gaps_(to_gaps),
        outer_(std::max(kEdge + 2 * margin, kLeastOuter)),
        middle_(kEnclosing + 0.6 * (outer_ - kEnclosing)) {}

  /// Makes the band narrower, which leaves more vertices to a polygon in it.
  void narrow() { outer_ = middle_ + 0.25 * (outer_ - middle_); }

  /// The curve on which the cage's vertices lie.
  Points middle() const { return curve_at(middle_); }
  /// The level curve of the distance, but no farther than this part of the way to the middle of a
  /// gap.
  Points curve_at(double level, double part_of_gap = 0.7) const {
    Grid<float> field = part_.distance;
    for (size_t i = 0; i < field.cells.size(); ++i) {
      const double own = field.cells[i],
                   to_gap = std::min<double>(to_gaps_ ? to_gaps_->cells[i] : HUGE_VAL,
                                             to_middle(own, part_.to_rivals.cells[i]));
      field.cells[i] = std::max(field.cells[i],
                                static_cast<float>(level / part_of_gap * part_of_way(own, to_gap)));
    }
    return level_curve(field, level);
  }
  /// The same in an enclosed region that is at least kLeastHole deep.
  Points middle_in(const EnclosedRegion& region) const {
    const double to_rival = 0.6 * (middle_to_rival(region) - kEnclosing) + kEnclosing;
    return region.curve(std::min({middle_, 0.5 * (kEnclosing + region.deepest), to_rival}));
  }
  /// A curve that encloses the part and lies inside the band.
  Points inner() const { return level_curve(part_.distance, kEnclosing); }

  /// Whether an edge between two points of the band remains inside it. The steps are short near the
  /// middle of a gap, which is a thin barrier.
  bool contains(Complex a, Complex b) const {
    constexpr double kLongest = 0.5, kShortest = 0.1, kOuter = 0.94;
    const double length = std::abs(b - a);
    double step = kShortest;
    for (double at = step; at < length; at += step) {
      const Complex z = a + (b - a) * (at / length);
      const double d = value_at(part_.distance, z);
      if (d < kEnclosing || d > outer_) return false;
      const double to_gap = std::min(to_gaps_ ? value_at(*to_gaps_, z) : HUGE_VAL,
                                     to_middle(d, value_at(part_.to_rivals, z)));
      if (part_of_way(d, to_gap) > kOuter) return false;
      step = std::clamp(to_gap, kShortest, kLongest);
    }
    return true;
  }

 private:
  /// How far a point is on the way from the part to the middle of a gap. Gaps of one or two cells
  /// are ignored, because they have no room for two edges of the cage.
  static double part_of_way(double d, double to_gap) { return d > kTurning ? d / (d + to_gap) : 0; }
  /// The distance from this part to where another part in the region is just as near.
  double middle_to_rival(const EnclosedRegion& region) const {
    double least = HUGE_VAL;
    for (int r = 0; r < region.depth.height; ++r)
      for (int c = 0; c < region.depth.width; ++c) {
        const double own = region.depth(c, r),
                     rival = part_.to_rivals(region.column + c, region.row + r);
        if (own > 0 && rival <= own) least = std::min(least, 0.5 * (own + rival));
      }
    return least;
  }
  /// The distance to the middle between this part and another one.
  static double to_middle(double own, double to_rival) {
    return std::max(0.0, 0.5 * (to_rival - own));
  }
  static constexpr double kTurning = 1.05;

  const PartGrid& part_;
  const Grid<float>* to_gaps_;
  double outer_, middle_;
};

/// A polygon in the band with edges as long as possible and vertices on a curve in the band.
/// `thorough`: edges may be longer than others that leave the band. This matters where the curve
/// follows the steps of pixels in narrow gaps.
Points polygon_in(const Band& band, const Points& curve, bool thorough = false) {
  const size_t n = curve.size();
  const auto is_free = [&](size_t i, size_t j) {
    return band.contains(curve[i % n], curve[j % n]);
  };
  // The farthest point up to `end` that an edge from i can reach.
  const auto reach = [&](size_t i, size_t end) {
    const size_t most = std::min(end - i, n / 3 + 1);
    size_t step = 1;
    while (2 * step <= most && is_free(i, i + 2 * step)) step *= 2;
    for (size_t more = step; more > 0; more /= 2)
      if (step + more <= most && is_free(i, i + step + more)) step += more;
    for (size_t longer = step + 1; thorough && longer <= std::min(4 * step, most);
         longer += std::max<size_t>(1, step / 4))
      if (is_free(i, i + longer)) step = longer;
    return i + step;
  };
  // The end of a longest edge is a better start than an arbitrary point.
  size_t first = 0;
  for (size_t i = 0; i < n; i = reach(i, 2 * n)) first = i;
  Points polygon;
  for (size_t i = first; i < first + n; i = reach(i, first + n)) polygon.push_back(curve[i % n]);
  return polygon;
}

/// A simple polygon with at most `most` vertices around the part. Its margin grows if there would
/// be more vertices, and shrinks if edges would cross. If nothing else helps, limbs are joined.
Points tight_polygon(const PartGrid& part, const Grid<float>* to_gaps, double usual_margin,
                     int most) {
  constexpr int kTries = 10;
  const double largest_margin = std::max(0.5, (part.border - 4) / 2.0);  // the grid ends there
  double margin = usual_margin;
  for (const Grid<float>* gaps : {to_gaps, static_cast<const Grid<float>*>(nullptr)}) {
    margin = usual_margin;
    for (int tries = 0; tries < kTries; ++tries) {
      const Band band(part, gaps, margin);
      const auto fits_in = [&](const Points& polygon) {
        return static_cast<int>(polygon.size()) <= most;
      };
      Points polygon = polygon_in(band, band.middle());
      if (gaps && !fits_in(polygon)) polygon = polygon_in(band, band.middle(), true);
      const bool crosses = self_crossing(polygon).has_value(), fits = fits_in(polygon);
      if (fits && !crosses) return polygon;
      margin = std::clamp(crosses ? 0.6 * margin : 1.4 * margin, 0.5, largest_margin);
    }
  }
  return simplified_around(Band(part, nullptr, margin).middle(),
                           Band(part, nullptr, margin).inner(), most);
}

constexpr double kLeastHole = 3;  ///< depth in cells; shallower regions have no room for a polygon

/// Polygons in the enclosed regions that become holes, with at most `most` vertices in all.
std::vector<Points> hole_polygons(const PartGrid& part, double margin, double least_width,
                                  int most) {
  const double least = std::max(kLeastHole, 0.5 * least_width);
  std::vector<Points> polygons;
  size_t vertices = 0;
  for (const EnclosedRegion& region : enclosed_regions(part.distance, part.others, least)) {
    for (double narrower = std::min(margin, region.deepest / 3); narrower > 0.1; narrower *= 0.6) {
      const Band band(part, nullptr, narrower);
      Points polygon = polygon_in(band, band.middle_in(region));
      if (self_crossing(polygon)) continue;
      if (polygon.size() >= 3 && polygons.size() < kMaxHoles &&
          vertices + polygon.size() <= static_cast<size_t>(most)) {
        vertices += polygon.size();
        polygons.push_back(std::move(polygon));
      }
      break;
    }
  }
  return polygons;
}

/// A closed curve with fewer points, for fits whose cost grows with their number.
Points thinned(const Points& curve) {
  constexpr Index kMost = 4000;
  return static_cast<Index>(curve.size()) <= kMost ? curve
                                                   : at_equal_lengths(Polyline(curve, true), kMost);
}

/// The cage rounded to 1/16 px, which keeps numbers in files short. Rounding cannot move the cage
/// into the content: see kEnclosing.
Cage rounded(Cage cage) {
  for (Points& segment : cage.segments)
    for (Complex& z : segment) z = {std::round(z.real() * 16) / 16, std::round(z.imag() * 16) / 16};
  return cage;
}

/// What one part may use of the vertices and holes that a scene can have.
struct Room {
  int vertices = 0, holes = static_cast<int>(kMaxHoles);
};

/// The outline and the holes of a part. `relative` is its size in units of the largest part's.
Cage cage_around(const PartGrid& part, const AutoCageOptions& options, double relative,
                 double usual, Room& room) {
  // Curves need more room than polygons.
  const double tight = (options.curved ? 3 : 1) * usual * part.size,
               margin = std::max(0.5, options.margin ? *options.margin / part.scale : tight);
  const std::optional<Grid<float>> gaps =
      options.margin || options.curved ? std::nullopt : distance_to_gaps(part, 3 * margin + 4);
  const Grid<float>* to_gaps = gaps ? &*gaps : nullptr;
  const auto in_picture = [&](Points points) {
    for (Complex& z : points) z = part.in_picture(z);
    return points;
  };
  std::vector<Points> holes =
      hole_polygons(part, margin, 0.01 * options.hole_width * part.size, room.vertices / 2);
  if (holes.size() > static_cast<size_t>(room.holes)) holes.resize(static_cast<size_t>(room.holes));
  room.holes -= static_cast<int>(holes.size());
  int left = room.vertices;
  for (const Points& hole : holes) left -= static_cast<int>(hole.size());
  Band band(part, to_gaps, margin);
  const double usual_vertices = 30 * std::exp2(options.detail / 50 - 1),
               wanted = options.vertices ? *options.vertices : usual_vertices;
  const int vertices =
      std::clamp(static_cast<int>(std::lround(wanted * relative)), 3, room.vertices);
  Cage cage;
  if (options.curved) {
    const double kept = std::max(kEnclosing, kEdge + 0.45 * margin),
                 outer = std::max(kept + 0.5, kEdge + margin);
    cage = curves_around(thinned(in_picture(band.curve_at(outer))),
                         thinned(in_picture(band.curve_at(kept, 0.6))), vertices);
  } else if (options.vertices) {
    band.narrow();
    const Points polygon = polygon_in(band, band.middle());
    cage =
        polygon_cage(simplified_around(in_picture(self_crossing(polygon) ? band.middle() : polygon),
                                       in_picture(band.inner()), vertices));
  } else {
    cage = polygon_cage(in_picture(tight_polygon(part, to_gaps, margin, left)));
  }
  for (const Points& hole : holes)
    add_hole(cage, reversed(polygon_cage(in_picture(hole))).segments);
  return cage;
}

}  // namespace

Cage auto_cage(const Image& image, const AutoCageOptions& options) {
  constexpr int kMostVertices = 500, kMostInAll = 4500;
  if (options.vertices && (*options.vertices < 3 || *options.vertices > kMostVertices))
    throw Error(ErrorKind::bad_input,
                "a cage has 3 to 500 vertices, not " + std::to_string(*options.vertices));
  if (!(options.detail >= 0 && options.detail <= 100))
    throw Error(ErrorKind::bad_input, "the detail must be between 0 and 100");
  if (!(options.hole_width >= 0 && options.hole_width <= 100))
    throw Error(ErrorKind::bad_input, "the width of holes must be between 0 and 100 percent");
  const int longest = std::max(image.width, image.height);
  if (options.margin && !(std::abs(*options.margin) <= 4.0 * longest))
    throw Error(ErrorKind::bad_input,
                "the margin must be at most four times the longer side of the picture");
  // Half a percent of the size at medium detail, a quarter of that or four times as much at the
  // ends of the slider.
  const double usual = 0.005 * std::pow(4, 1 - options.detail / 50);
  const auto cage_of = [&](PartChoice choice) {
    const std::vector<PartGrid> parts =
        part_grids(image, choice, 4 * usual, 2 * options.margin.value_or(1));
    if (parts.empty())
      return polygon_cage(rectangle(image, std::max(0.0, options.margin.value_or(0))));
    Room room;
    room.vertices = std::min(kMostVertices, kMostInAll / static_cast<int>(parts.size()));
    Cage all;
    for (const PartGrid& part : parts) {
      const Cage cage = cage_around(part, options, part.size / parts[0].size, usual, room);
      if (all.size() == 0)
        all = cage;
      else
        add_part(all, cage);
    }
    const Cage round = rounded(all);
    return rest_fault(round) ? all : round;
  };
  const Cage cage = cage_of(options.parts);
  return options.parts == PartChoice::apart && rest_fault(cage) ? cage_of(PartChoice::joined)
                                                                : cage;
}

}  // namespace holomorph
