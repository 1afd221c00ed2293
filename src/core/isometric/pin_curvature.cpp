#include "core/isometric/pin_curvature.h"

#include "core/solvers/factors.h"

namespace holomorph {

PinCurvature::PinCurvature(const IsometricSystem& system, const VectorXc& phi, const VectorXc& psi,
                           double penalty, const VectorXc& offsets)
    : system_(system) {
  const auto& pieces = system_.paths.pieces();
  const std::vector<Index>& ends = system_.paths.ends();
  // The pull on each piece: the sum of s conj(c) over the stations behind it. The mean of the
  // offsets is zero, so the centering does not matter.
  std::vector<Complex> pull(pieces.size(), 0);
  for (size_t j = 0; j < ends.size(); ++j)
    if (ends[j] >= 0)
      pull[static_cast<size_t>(ends[j])] += 2 * penalty *
                                            system_.station_weights[static_cast<Index>(j)] *
                                            std::conj(offsets[static_cast<Index>(j)]);
  for (size_t e = pieces.size(); e-- > 0;)
    if (pieces[e].parent >= 0) pull[static_cast<size_t>(pieces[e].parent)] += pull[e];
  for (Index k = 0; k < phi.size(); ++k) {
    const Complex g = pull[static_cast<size_t>(k / PathTree::kNodes)];
    bends_.push_back({g * phi[k] + std::conj(g) * psi[k], std::conj(g) * phi[k]});
  }
}

MatrixXd PinCurvature::second_derivatives() const {
  const Index n = system_.size();
  const Index count = static_cast<Index>(bends_.size());
  const Eigen::MatrixXf re = system_.nodes_by_column.re.cast<float>(),
                        im = system_.nodes_by_column.im.cast<float>();
  // The real and imaginary parts of the sum of factor b b^T over the nodes.
  Eigen::MatrixXf scaled_re(n, count), scaled_im(n, count);
  const auto sum = [&](auto factor, Eigen::MatrixXf& sum_re, Eigen::MatrixXf& sum_im) {
    for (Index k = 0; k < count; ++k) {
      const std::complex<float> c(factor(bends_[static_cast<size_t>(k)]));
      scaled_re.col(k) = c.real() * re.col(k) - c.imag() * im.col(k);
      scaled_im.col(k) = c.real() * im.col(k) + c.imag() * re.col(k);
    }
    sum_re.setZero(n, n);
    sum_im.setZero(n, n);
    add_product(im, scaled_im, count, 0, 0, sum_re);
    sum_re = -sum_re;
    add_product(re, scaled_re, count, 0, 0, sum_re);
    add_product(re, scaled_im, count, 0, 0, sum_im);
    add_product(im, scaled_re, count, 0, 0, sum_im);
  };
  MatrixXd result = MatrixXd::Zero(4 * n, 4 * n);
  Eigen::MatrixXf sum_re, sum_im;
  sum([](const Bend& bend) { return bend.alpha; }, sum_re, sum_im);
  result.block(0, 0, n, n) = sum_re.cast<double>();
  result.block(n, 0, n, n) = -sum_im.cast<double>();
  result.block(n, n, n, n) = -sum_re.cast<double>();
  sum([](const Bend& bend) { return bend.beta; }, sum_re, sum_im);
  result.block(2 * n, 0, n, n) = sum_re.cast<double>();
  result.block(2 * n, n, n, n) = -sum_im.cast<double>();
  result.block(3 * n, 0, n, n) = -sum_im.cast<double>();
  result.block(3 * n, n, n, n) = -sum_re.cast<double>();
  return result;
}

MatrixXd PinCurvature::convex_part() const {
  const Index n = system_.size();
  Eigen::MatrixXf columns(4 * n, 2 * static_cast<Index>(bends_.size()));
  Index used = 0;
  for (size_t k = 0; k < bends_.size(); ++k) {
    // A form in (Re dl, Im dl, Re dnu, Im dnu). Its eigenvalues come in pairs of opposite sign.
    Eigen::Matrix4d form;
    const double ar = bends_[k].alpha.real(), ai = bends_[k].alpha.imag(),
                 br = bends_[k].beta.real(), bi = bends_[k].beta.imag();
    form << ar, -ai, br, -bi, -ai, -ar, -bi, -br, br, -bi, 0, 0, -bi, -br, 0, 0;
    const Eigen4 eigen = eigen_decomposition(form);
    const auto re = system_.nodes_by_column.re.col(static_cast<Index>(k)),
               im = system_.nodes_by_column.im.col(static_cast<Index>(k));
    for (int i = 2; i < 4; ++i) {
      const double value = eigen.values[i];
      if (!(value > 0)) continue;
      const Eigen::Vector4d v = std::sqrt(value) * eigen.vectors.col(i);
      auto column = columns.col(used++);
      column.segment(0, n) = (v[0] * re + v[1] * im).cast<float>();
      column.segment(n, n) = (-v[0] * im + v[1] * re).cast<float>();
      column.segment(2 * n, n) = (v[2] * re + v[3] * im).cast<float>();
      column.segment(3 * n, n) = (-v[2] * im + v[3] * re).cast<float>();
    }
  }
  Eigen::MatrixXf sum = Eigen::MatrixXf::Zero(4 * n, 4 * n);
  add_gram(columns, used, 0, sum);
  return sum.cast<double>();
}

}  // namespace holomorph
