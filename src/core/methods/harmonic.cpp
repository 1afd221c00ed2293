// Method `harmonic`: f = sum h_c b_c, where the harmonic function h_c equals the weight of control
// point c on the cage. Therefore the image of the cage is the posed cage itself.
#include <algorithm>

#include "core/angles/hilbert.h"
#include "core/cauchy/inside.h"
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
      : cage_(cage), flat_(flattened(cage)), hilbert_(cage, control_weights(cage)), inside_(cage) {}

  MatrixXd values(std::span<const Complex> points) const override {
    const Continued continued = continuation(points, 0);
    MatrixXd h = hilbert_.at(continued.places).real();
    if (continued.outside.empty()) return h;
    const MatrixXc slopes = hilbert_.at(continued.slope_places, 1);
    for (size_t k = 0; k < continued.outside.size(); ++k)
      h.row(continued.outside[k]) +=
          (continued.steps[k] * slopes.row(static_cast<Index>(k))).real();
    return h;
  }

  MatrixXc slopes(std::span<const Complex> points) const override {
    return hilbert_.at(continuation(points, 1).places, 1);
  }

 private:
  /// Where the functions are evaluated. Those of points outside are continued from the boundary.
  struct Continued {
    Points places;
    std::vector<Index> outside;
    Points slope_places, steps;  ///< for each point outside
  };

  Continued continuation(std::span<const Complex> points, int order) const {
    Continued at;
    for (const Complex& z : points) {
      if (inside_.contains(z)) {
        at.places.push_back(order == 0 ? z : point_inside_vertex(cage_, z));
        continue;
      }
      at.outside.push_back(static_cast<Index>(at.places.size()));
      const NearestPoint near = nearest_on_polygon(flat_, z);
      const BoundaryPoint foot = flat_.on_edge(near.edge, near.t);
      constexpr double kLeast =
          0.02;  // parameter distance from a segment's ends, where slopes may be infinite
      const Complex on = position_of(cage_, foot),
                    off_ends =
                        position_of(cage_, {foot.segment, std::clamp(foot.t, kLeast, 1 - kLeast)});
      at.places.push_back(order == 0 ? on : off_ends);
      at.slope_places.push_back(off_ends);
      at.steps.push_back(z - on);
    }
    return at;
  }

  Cage cage_;
  FlatCage flat_;
  HilbertCoordinates hilbert_;
  Inside inside_;
};

std::unique_ptr<Deformer> make_harmonic(const Rest& rest, const Deformer*) {
  return real_deformer(rest, harmonic_coordinates(oriented(rest.cage)));
}

}  // namespace

std::unique_ptr<RealCoordinates> harmonic_coordinates(const Cage& cage) {
  return std::make_unique<HarmonicCoordinates>(cage);
}

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
