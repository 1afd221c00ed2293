// Products with the operator, and functions that the linear methods share.
#include "core/methods/linear.h"

#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/geometry/polyline.h"

namespace holomorph {
template <class T>
LinearDeformer<T>::LinearDeformer(const Rest& rest) : rest_(rest) {}

template <class T>
SampledMap LinearDeformer<T>::deform(const Pose& pose, EvalOptions options, const Solution*) {
  check_pose(rest_, pose);
  const VectorXc by = controls(pose);
  const Eigen::Map<const VectorXc> z(rest_.samples.data(),
                                     static_cast<Index>(rest_.samples.size()));
  SampledMap out;
  out.f = z + product(value_, by);
  out.note = note_;
  if (!options.derivatives || z.size() == 0) return out;
  if (derivative_.rows() != z.size()) derivative_ = derivative_matrix();
  out.fz = product(derivative_, by).array() + Complex(1.0);
  out.fzbar = VectorXc::Zero(z.size());
  return out;
}

template <class T>
const PlanarMatrix<float>* LinearDeformer<T>::operator_matrix() const {
  if constexpr (std::is_same_v<T, float>)
    return &value_;
  else
    return nullptr;
}

PointMap::Value SumMap::at(Complex z) const {
  Value value{z + constant + slope * (z - center), 1.0 + slope, 0};
  for (const CauchySum& term : terms) {
    const CauchySum::ValueAndSlope part = term.at(z);
    value.f += part.f;
    value.fz += part.df;
  }
  for (const CauchySum& term : conjugates) {
    const CauchySum::ValueAndSlope part = term.at(z);
    value.f += std::conj(part.f);
    value.fzbar += std::conj(part.df);
  }
  return value;
}

void check_pose(const Rest& rest, const Pose& pose) {
  check_same_loops(rest.cage, pose.cage);
  for (Index i = 0; i < pose.cage.size(); ++i)
    if (pose.cage.degree(i) < 1 || pose.cage.degree(i) > rest.cage.degree(i))
      throw Error(ErrorKind::bad_input, "posed segment " + std::to_string(i + 1) + " has " +
                                            std::to_string(pose.cage.degree(i)) +
                                            " control points; the rest shape allows 1 to " +
                                            std::to_string(rest.cage.degree(i)));
  if (pose.pins.size() != rest.pins.size())
    throw Error(ErrorKind::bad_input, "the pose must have as many pins as the rest shape");
  if (pose.strokes.size() != rest.strokes.size())
    throw Error(ErrorKind::bad_input, "the pose must have as many strokes as the rest shape");
  if (pose.corners.size() != rest.corners.size())
    throw Error(ErrorKind::bad_input, "the pose must have as many corners as the rest shape");
  for (const Points& stroke : pose.strokes) check_stroke(stroke);
  for (const PoseCorner& corner : pose.corners)
    if (!std::isfinite(corner.before) || !std::isfinite(corner.after) || !(corner.tension >= 0) ||
        !(corner.tension <= 1))
      throw Error(ErrorKind::bad_input,
                  "a corner's angle is not finite, or its tension is not between 0 and 1");
  for (const Points& segment : pose.cage.segments)
    for (const Complex& z : segment)
      if (!is_finite(z)) throw Error(ErrorKind::bad_input, "a posed cage point is not finite");
  for (const PosePin& pin : pose.pins)
    if (!is_finite(pin.position) || !std::isfinite(pin.angle) ||
        !std::isfinite(pin.turn.value_or(0)) || !(pin.scale >= kMinPinScale) ||
        !(pin.scale <= kMaxPinScale))
      throw Error(ErrorKind::bad_input,
                  "a posed pin is not finite, or its scale is below 0.01 or above 100");
}

VectorXc cage_displacement(const Rest& rest, const Pose& pose) {
  return controls_of(elevated_to(pose.cage, rest.cage)) - controls_of(rest.cage);
}

template <class T>
PlanarMatrix<T> side_by_side(const PlanarMatrix<T>& left, const PlanarMatrix<T>& right) {
  PlanarMatrix<T> both(left.rows(), left.cols() + right.cols());
  both.re << left.re, right.re;
  both.im << left.im, right.im;
  return both;
}

template class LinearDeformer<float>;
template class LinearDeformer<double>;
template PlanarMatrix<float> side_by_side(const PlanarMatrix<float>&, const PlanarMatrix<float>&);
template PlanarMatrix<double> side_by_side(const PlanarMatrix<double>&,
                                           const PlanarMatrix<double>&);

}  // namespace holomorph
