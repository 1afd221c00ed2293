// Method `harmonic`: f = sum h_c b_c with the harmonic functions h_c that run along the cage as its
// control points' weights do, so that the cage's image is the posed cage itself.
#include <algorithm>

#include "core/cauchy.h"
#include "core/hilbert.h"
#include "core/methods/real_coordinates.h"
#include "core/methods/rows.h"
#include "core/polyline.h"

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

/// h as the real parts of holomorphic functions g.
class HarmonicCoordinates final : public RealCoordinates {
 public:
  /// Of a counter-clockwise cage. Just outside of it the functions go on linearly.
  explicit HarmonicCoordinates(const Cage& cage)
      : cage_(cage),
        flat_(flattened(cage)),
        edge_(flat_.points, true),
        hilbert_(cage, control_weights(cage)) {}

  /// One row for each point: g, or g' with order 1; at vertices g is their own weights.
  MatrixXc at(std::span<const Complex> points, int order) const override {
    Points inside;
    std::vector<Index> outside;
    for (const Complex& z : points) {
      inside.push_back(is_inside(z) ? z : beside(z));
      if (inside.back() != z) outside.push_back(static_cast<Index>(inside.size()) - 1);
    }
    MatrixXc g = hilbert_.at(inside, order);
    if (order > 0) return g;
    Points moved;
    for (const Index i : outside) moved.push_back(inside[static_cast<size_t>(i)]);
    const MatrixXc slopes = hilbert_.at(moved, 1);
    for (size_t k = 0; k < outside.size(); ++k) {
      const Complex z = points[static_cast<size_t>(outside[k])];
      if (const auto vertex = vertex_at(z))
        g.row(outside[k]) =
            weights_at(cage_, std::array{BoundaryPoint{*vertex, 0}}).cast<Complex>();
      else
        g.row(outside[k]) += (z - moved[k]) * slopes.row(static_cast<Index>(k));
    }
    return g;
  }

 private:
  std::optional<Index> vertex_at(Complex z) const {
    for (Index j = 0; j < cage_.size(); ++j)
      if (cage_.vertex(j) == z) return j;
    return {};
  }
  bool is_inside(Complex z) const {
    if (vertex_at(z)) return false;
    return is_straight(cage_) ? winding_number(flat_.points, z) != 0 : contains(cage_, z);
  }

  /// The place of the boundary next to a point on it or outside, but none of its vertices.
  Complex beside(Complex z) const {
    constexpr double kLeast = 0.02;  // of a segment
    const Polyline::Nearest near = edge_.nearest(z);
    const size_t i = static_cast<size_t>(near.segment), next = (i + 1) % flat_.places.size();
    const auto& [segment, from] = flat_.places[i];
    const double to = flat_.places[next].segment == segment && next > 0 ? flat_.places[next].t : 1;
    const double t = from + near.parameter * (to - from),
                 clamped = std::clamp(t, kLeast, 1 - kLeast);
    return t == clamped && near.distance == 0 ? z : position_of(cage_, {segment, clamped});
  }

  Cage cage_;
  FlatCage flat_;
  Polyline edge_;
  HilbertCoordinates hilbert_;
};

std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer*) {
  check_rest_cage(rest.cage);
  return real_deformer(rest,
                       std::make_shared<const HarmonicCoordinates>(counter_clockwise(rest.cage)));
}

}  // namespace

Method harmonic_method() {
  return {"harmonic",
          "Harmonic",
          "The cage's edges stay straight and go exactly where you put them; angles give way.",
          {},
          false,
          true,
          true,
          prepare};
}

}  // namespace holomorph
