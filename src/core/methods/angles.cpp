// Method `angles`: f' = exp(i H theta), where theta is the rotation of the boundary.
#include <algorithm>
#include <numeric>
#include <set>

#include "core/angles/angle_pins.h"
#include "core/angles/boundary_angles.h"
#include "core/cauchy/inside.h"
#include "core/compared/published_angles.h"
#include "core/error.h"
#include "core/geometry/orientation.h"
#include "core/maps/acting_pins.h"
#include "core/maps/distortion.h"
#include "core/methods/linear.h"
#include "core/methods/notes.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

/// A rest's boundary as this method uses it: counter-clockwise, with corners in order.
struct Boundary {
  explicit Boundary(const Rest& rest)
      : cage(oriented(rest.cage)), reversed(!(cage == rest.cage)), corners(rest.corners) {
    const Index n = cage.size();
    if (corners.empty()) {
      corners.resize(static_cast<size_t>(n));
      std::iota(corners.begin(), corners.end(), 0);
    }
    order.resize(corners.size());
    std::iota(order.begin(), order.end(), size_t{0});
    if (!reversed) return;
    for (Index& corner : corners) corner = (n - corner) % n;
    std::ranges::sort(order, {}, [&](size_t i) { return corners[i]; });
    std::ranges::sort(corners);
  }

  Cage posed(const Cage& pose) const { return reversed ? holomorph::reversed(pose) : pose; }
  /// A pose's corners in the order and orientation of this boundary.
  std::vector<PoseCorner> own(const std::vector<PoseCorner>& pose) const {
    if (pose.empty()) return std::vector<PoseCorner>(corners.size());
    std::vector<PoseCorner> own;
    for (const size_t i : order) {
      own.push_back(pose[i]);
      if (!reversed) continue;
      std::swap(own.back().before, own.back().after);
      own.back().tension = pose[(i + pose.size() - 1) % pose.size()].tension;
    }
    return own;
  }
  /// The corner's vertex index in the rest's cage.
  Index vertex(Index corner) const {
    return reversed ? (cage.size() - corner) % cage.size() : corner;
  }

  Cage cage;
  bool reversed;
  std::vector<Index> corners;
  std::vector<size_t> order;  ///< each corner's index in a pose
};

/// Evaluates the map at any point by integrating from a nearby mesh vertex.
class AnglePoints final : public PointMap {
 public:
  AnglePoints(std::shared_ptr<const Mesh> mesh, AngleMap map, PlacedAngles placed,
              VectorXc at_vertices)
      : mesh_(std::move(mesh)),
        map_(std::move(map)),
        paths_(*mesh_, cage(), Precision::full),
        inside_(cage()),
        flat_(flattened(cage())),
        placed_(std::move(placed)),
        sum_(map_.sum(placed_.theta)),
        exponents_(map_.exponents(placed_.theta)),
        at_vertices_(std::move(at_vertices)) {}

  Value at(Complex z) const override { return values_at({&z, 1})[0]; }

  std::vector<Value> values_at(std::span<const Complex> points) const override {
    // Outside the cage the coordinates are different functions, so the map is continued linearly.
    Points inside;
    for (const Complex& z : points)
      inside.push_back(inside_.contains(z) ? z : position_of(cage(), nearest_on(cage(), flat_, z)));
    std::vector<Value> values = values_inside(inside);
    for (size_t i = 0; i < points.size(); ++i)
      values[i].f += values[i].fz * (points[i] - inside[i]);
    return values;
  }

  bool has_no_zeros() const override { return true; }

 private:
  const Cage& cage() const { return map_.coordinates().cage(); }

  std::vector<Value> values_inside(const Points& points) const {
    IntegrationPaths paths = paths_.without_steps();
    std::vector<Index> nodes;
    for (const Complex& z : points) nodes.push_back(paths.add_node(z));
    VectorXc integral(paths.nodes());
    integral.head(at_vertices_.size()) = at_vertices_;
    paths.integrate(slopes_at(paths.quadrature_points()), exponents_, integral);
    Points next_to_vertices = points;
    for (Complex& z : next_to_vertices) z = point_inside_vertex(cage(), z);
    const VectorXc slopes = slopes_at(next_to_vertices);
    std::vector<Value> values;
    for (size_t i = 0; i < points.size(); ++i)
      values.push_back({placed_.scale * integral[nodes[i]] + placed_.move,
                        placed_.scale * slopes[static_cast<Index>(i)], 0});
    return values;
  }

  VectorXc slopes_at(std::span<const Complex> points) const {
    return (kI * map_.coordinates().values(points, sum_)).array().exp();
  }

  std::shared_ptr<const Mesh> mesh_;
  AngleMap map_;
  IntegrationPaths paths_;
  Inside inside_;
  FlatCage flat_;
  PlacedAngles placed_;
  HilbertCoordinates::Sum sum_;  ///< log f' / i
  VectorXd exponents_;           ///< of f' at the corners
  VectorXc at_vertices_;
};

Points joined(Points first, const Points& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

class AnglesDeformer final : public Deformer {
 public:
  /// `coordinates` belong to the same cage and corners, or are null.
  explicit AnglesDeformer(const Rest& rest,
                          std::shared_ptr<const HilbertCoordinates> coordinates = nullptr)
      : rest_(rest),
        boundary_(rest),
        coordinates_(coordinates
                         ? std::move(coordinates)
                         : std::make_shared<const HilbertCoordinates>(
                               boundary_.cage, corner_values(boundary_.cage, boundary_.corners))),
        frame_(boundary_.cage),
        map_(*rest_.mesh, coordinates_, joined(rest_.samples, frame_.samples()), rest_.precision),
        acting_(usable_pins(rest_)),
        is_on_mesh_(rest_.samples == rest_.mesh->vertices) {
    if (parameter(method_named("angles"), rest_.parameters, "published") != 0)
      published_.emplace(boundary_.cage, boundary_.corners, map_.anchor());
    if (acting_.used.empty() || published_) return;
    std::vector<RestPin> pins;
    for (const size_t i : acting_.used) {
      pins.push_back(rest_.pins[i]);
      // At a vertex, f' behaves like a power of the distance, so no frame can be prescribed.
      for (Index j = 0; j < boundary_.cage.size(); ++j)
        if (pins.back().position == boundary_.cage.vertex(j)) pins.back().has_frame = false;
    }
    pins_.emplace(*rest_.mesh, coordinates_, boundary_.corners, pins);
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    check_pose(rest_, pose);
    SampledMap out;
    out.note = acting_.note;
    const Index count = static_cast<Index>(rest_.samples.size());
    if (rests(pose)) {
      out.f = Eigen::Map<const VectorXc>(rest_.samples.data(), count);
      if (!options.derivatives) return out;
      out.fz = VectorXc::Ones(count);
      out.fzbar = VectorXc::Zero(count);
      return out;
    }
    const auto [placed, f] = place(pose, options.draft, dynamic_cast<const Found*>(from), out);
    if (published_) return answer_as_published(placed, options, std::move(out));
    out.f = (placed.scale * f).array() + placed.move;
    const Index lost = count - out.f.array().isFinite().count();
    if (lost > 0) say(out, std::to_string(lost) + " points are bent too far to compute");
    if (is_on_mesh_ && lost == 0) out.coarse_triangles = flipped_triangles(*rest_.mesh, out.f);
    if (out.coarse_triangles > 0) say(out, coarse_mesh_text(out.coarse_triangles));
    if (!options.derivatives || count == 0) return out;
    if (slopes_.rows() != count) slopes_ = slopes();
    const VectorXc theta = placed.theta.cast<Complex>();
    out.fz = placed.scale * (kI * product(slopes_, theta)).array().exp();
    out.fzbar = VectorXc::Zero(count);
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(rest_, pose);
    if (published_) return nullptr;
    AnglesDeformer whole = on_whole_mesh();
    SampledMap ignored;
    auto [placed, f] = whole.place(pose, false, nullptr, ignored);
    return std::make_unique<AnglePoints>(rest_.mesh, std::move(whole.map_), placed, std::move(f));
  }

 private:
  struct Found : Solution {
    VectorXd unknowns;  ///< of AnglePins
  };

  /// A deformer that gives the map at the mesh's vertices in full precision.
  AnglesDeformer on_whole_mesh() const {
    if (rest_.precision == Precision::full && rest_.samples == rest_.mesh->vertices) return *this;
    Rest rest = rest_;
    rest.samples = rest_.mesh->vertices;
    rest.precision = Precision::full;
    return AnglesDeformer(rest, coordinates_);
  }

  SampledMap answer_as_published(const PlacedAngles& placed, EvalOptions options,
                                 SampledMap out) const {
    const PublishedAngles::Values values = published_->map(placed.theta, rest_.samples);
    out.f = (placed.scale * values.f).array() + placed.move;
    out.ignores_pins = true;
    char text[120];
    std::snprintf(text, sizeof text,
                  "As published: boundary angles are off by up to %.2g radians per radian",
                  published_->error());
    say(out, text);
    if (!options.derivatives) return out;
    out.fz = placed.scale * values.slope;
    out.fzbar = VectorXc::Zero(out.f.size());
    return out;
  }

  bool rests(const Pose& pose) const {
    if (!cage_displacement(rest_, pose).isZero(0)) return false;
    for (const PoseCorner& corner : pose.corners)
      if (corner.before != 0 || corner.after != 0) return false;
    return std::ranges::all_of(acting_.used, [&](size_t i) {
      const PosePin& pin = pose.pins[i];
      return pin.position == rest_.pins[i].position &&
             (!rest_.pins[i].has_frame || (pin.angle == 0 && pin.scale == 1));
    });
  }

  /// The angles of a pose, and AngleMap::map at the samples.
  struct Placed {
    PlacedAngles angles;
    VectorXc f;
  };
  Placed place(const Pose& pose, bool draft, const Found* from, SampledMap& out) {
    const Cage posed = boundary_.posed(elevated_to(pose.cage, rest_.cage));
    BoundaryAngles angles =
        boundary_angles(boundary_.cage, posed, boundary_.corners, boundary_.own(pose.corners));
    const Index count = static_cast<Index>(rest_.samples.size());
    VectorXc f;
    map_.map(angles.theta, f, draft);
    PlacedAngles placed = frame_.place(angles.theta, f.tail(f.size() - count), posed);
    std::set<Index> limited(angles.limited.begin(), angles.limited.end());
    if (pins_) {
      std::vector<PosePin> targets;
      for (const size_t i : acting_.used) targets.push_back(pose.pins[i]);
      const AnglePins::Answer answer =
          pins_->pull(targets, draft, from ? &from->unknowns : nullptr, placed);
      map_.map(placed.theta, f, draft);
      const auto found = std::make_shared<Found>();
      found->unknowns = answer.unknowns;
      out.solution = found;
      limited.insert(answer.limited.begin(), answer.limited.end());
      out.iterations = answer.iterations;
      if (!answer.settled) out.status = SampledMap::Status::iterating;
      constexpr double kFar = 1e-3;  // relative to the size
      if (!draft && answer.largest_miss > kFar * box_of(rest_.mesh->vertices).diagonal())
        say(out, "Pins are missed: no map without folds was found that meets them");
    }
    for (const Index corner : limited) out.limited_corners.push_back(boundary_.vertex(corner));
    std::ranges::sort(out.limited_corners);
    std::string list;
    for (const Index corner : out.limited_corners)
      list += (list.empty() ? "" : ", ") + std::to_string(corner + 1);
    if (!list.empty())
      say(out, (limited.size() == 1 ? "Corner " : "Corners ") + list +
                   " held at 5 degrees to avoid a fold");
    return {std::move(placed), f.head(count)};
  }

  static void say(SampledMap& out, const std::string& text) {
    out.note += (out.note.empty() ? "" : ". ") + text;
  }

  /// H at the derivative samples.
  PlanarMatrix<double> slopes() const {
    Points places = rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples;
    for (Complex& z : places) z = point_inside_vertex(boundary_.cage, z);
    const MatrixXc rows = map_.rows(places);
    PlanarMatrix<double> slopes(rows.rows(), rows.cols());
    slopes.re = rows.real();
    slopes.im = rows.imag();
    return slopes;
  }

  Rest rest_;
  Boundary boundary_;
  std::shared_ptr<const HilbertCoordinates> coordinates_;
  AngleFrame frame_;
  AngleMap map_;  ///< at the samples of the rest, and then at those of the frame
  UsablePins acting_;
  bool is_on_mesh_;  ///< the samples are the mesh's vertices
  std::optional<AnglePins> pins_;
  std::optional<PublishedAngles> published_;  ///< the published map, used for comparison
  PlanarMatrix<double> slopes_;
};

std::unique_ptr<Deformer> make_angles(const Rest& rest, const Deformer*) {
  return std::make_unique<AnglesDeformer>(rest);
}

}  // namespace

Method angles_method() {
  return {
      .id = "angles",
      .label = "Angles",
      .summary = "Follows the angles at its corners. Never folds.",
      .hint =
          "Rotate, open and close corners (A). Edges follow the cage's directions, not its "
          "lengths. "
          "Never folds.",
      .parameters = {toggle(
          "published", "As published",
          "The functions of Weber and Gotsman, for comparison: the boundary is divided into "
          "equal parts, and the map is fitted to its derivative. The note shows the error of "
          "the angles. The picture may fold, and pins have no effect.",
          false)},
      .uses_pins = true,
      .uses_corners = true,
      .never_folds = true,
      .iterates = true,
      .needs_mesh = true,
      .allows_holes = false,
      .make = make_angles,
  };
}

}  // namespace holomorph
