// Method `harmonic`: f = sum h_c b_c, where the harmonic function h_c equals the weight of control
// point c on the cage. Therefore the image of the cage is the posed cage itself.
#include <algorithm>

#include "core/angles/hilbert.h"
#include "core/cauchy/cauchy.h"
#include "core/geometry/orientation.h"
#include "core/methods/real_coordinates.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

RealParts control_weights(const Cage& cage) {
  RealParts parts;
  parts.values = [cage](std::span<const BoundaryPoint> places) { return weights_at(cage, places); };
  parts.jumps = MatrixXd::Zero(cage.size(), cage.control_count());
  const VectorXc controls = controls_of(cage);
  parts.linear.resize(controls.size(), 3);
  parts.linear << VectorXd::Ones(controls.size()), controls.real(), controls.imag();
  return parts;
}

/// Harmonic coordinates h, computed as the real parts of holomorphic functions g.
class HarmonicCoordinates final : public RealCoordinates {
 public:
  /// `cage` must be oriented. Outside the cage, the functions are continued linearly.
  explicit HarmonicCoordinates(const Cage& cage)
      : cage_(cage), flat_(flattened(cage)), hilbert_(cage, control_weights(cage)) {
    for (Index e = 0; e < cage.size(); ++e) segments_.emplace_back(cage.controls(e));
  }

  MatrixXd values(std::span<const Complex> points) const override { return at(points, 0).real(); }
  MatrixXc slopes(std::span<const Complex> points) const override { return at(points, 1); }

 private:
  /// One row per point: g (order 0) or g' (order 1).
  MatrixXc at(std::span<const Complex> points, int order) const {
    Points places, slope_places, steps;
    std::vector<Index> outside;
    for (const Complex& z : points) {
      if (is_inside(z)) {
        places.push_back(order == 0 ? z : point_inside_vertex(cage_, z));
        continue;
      }
      outside.push_back(static_cast<Index>(places.size()));
      const NearestPoint near = nearest_on_polygon(flat_, z);
      const BoundaryPoint foot = flat_.on_edge(near.edge, near.t);
      constexpr double kLeast =
          0.02;  // parameter distance from a segment's ends, where slopes may be infinite
      const Complex on = position_of(cage_, foot),
                    off_ends =
                        position_of(cage_, {foot.segment, std::clamp(foot.t, kLeast, 1 - kLeast)});
      places.push_back(order == 0 ? on : off_ends);
      slope_places.push_back(off_ends);
      steps.push_back(z - on);
    }
    MatrixXc g = hilbert_.at(places, order);
    if (order > 0 || outside.empty()) return g;
    const MatrixXc slopes = hilbert_.at(slope_places, 1);
    for (size_t k = 0; k < outside.size(); ++k)
      g.row(outside[k]) += steps[k] * slopes.row(static_cast<Index>(k));
    return g;
  }

  /// Returns whether z is inside the cage or on its boundary.
  bool is_inside(Complex z) const {
    if (contact_of(segments_, z)) return true;
    return is_straight(cage_) ? encloses(flat_, z) : contains(cage_, z);
  }

  Cage cage_;
  FlatCage flat_;
  HilbertCoordinates hilbert_;
  std::vector<SegmentPolynomial> segments_;
};

std::unique_ptr<Deformer> make_harmonic(const Rest& rest, const Deformer*) {
  return real_deformer(rest, std::make_shared<const HarmonicCoordinates>(oriented(rest.cage)));
}

}  // namespace

Method harmonic_method() {
  return {
      .id = "harmonic",
      .label = "Harmonic",
      .summary = "Keeps the cage's edges straight. Angles change.",
      .hint = "The cage's edges stay straight and go exactly where you put them. Angles change.",
      .make = make_harmonic,
  };
}

}  // namespace holomorph
