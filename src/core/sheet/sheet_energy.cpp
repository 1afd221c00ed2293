// In a triangle, let f_z = |f_z| e^(i alpha) and f_zbar = |f_zbar| e^(i beta). The stretches are
// |f_z| + |f_zbar| and |f_z| - |f_zbar|. The four eigenvectors of the membrane's Hessian are
// changes of the two stretches, of alpha (twist) and of beta (flip). Only the twist may have a
// negative eigenvalue.
#include "core/sheet/sheet_energy.h"

#include <cmath>
#include <limits>

#include "core/arithmetic.h"
#include "core/error.h"

namespace holomorph {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// With the sum s of the squares of both stretches and the determinant d, (s + s / d^2) / 2.
double membrane_of(const SheetStrain& at) {
  const double a = std::norm(at.fz), b = std::norm(at.fzbar), determinant = a - b;
  if (!(determinant > 0)) return kInfinite;
  return (a + b) * (1 + 1 / (determinant * determinant));
}

/// A complex number of size 1 in the direction of z; 1 for 0.
Complex direction_of(Complex z) {
  const double size = std::sqrt(std::norm(z));
  return size > 0 ? z / size : Complex(1);
}

/// The masses of inner vertices, with equal shares of those of their neighbors on the outline.
VectorXd inner_shares(const Mesh& mesh, const std::vector<char>& outer, const VectorXd& masses) {
  // An edge inside belongs to two triangles, so that all inner neighbors are counted twice.
  VectorXd neighbors = VectorXd::Zero(masses.size()), shares = masses;
  const auto for_each_pair = [&](const auto& use) {
    for (const Triangle& t : mesh.triangles)
      for (const int v : t)
        for (const int w : t)
          if (outer[static_cast<size_t>(v)] && !outer[static_cast<size_t>(w)]) use(v, w);
  };
  for_each_pair([&](int v, int) { neighbors[v] += 1; });
  for_each_pair([&](int v, int w) { shares[w] += masses[v] / neighbors[v]; });
  return shares;
}

}  // namespace

SheetEnergy::SheetEnergy(std::shared_ptr<const Mesh> shared, VectorXd stiffness,
                         const VectorXd& bending)
    : mesh_(std::move(shared)), weights_(std::move(stiffness)) {
  const Mesh& mesh = *mesh_;
  const Index triangles = static_cast<Index>(mesh.triangles.size()),
              vertices = static_cast<Index>(mesh.vertices.size());
  check(weights_.size() == triangles, "sheet: a stiffness for each triangle");
  check(bending.size() == vertices, "sheet: a bending length for each vertex");
  const std::vector<char> outer = boundary_marks(mesh);
  VectorXd masses = VectorXd::Zero(vertices), stiff_masses = masses;
  using Entry = Eigen::Triplet<double>;
  std::vector<Entry> entries;
  for (Index i = 0; i < triangles; ++i) {
    const Triangle& t = mesh.triangles[static_cast<size_t>(i)];
    const double own = area_of(mesh, t);
    weights_[i] *= own;
    stiff_area_ += weights_[i];
    Gradients& gradients = gradients_.emplace_back();
    for (int k = 0; k < 3; ++k) {
      gradients[static_cast<size_t>(k)] = -kI * std::conj(opposite_side(mesh, t, k)) / (4 * own);
      masses[t[k]] += own / 3;
      stiff_masses[t[k]] += weights_[i] / 3;
    }
    // The weak form: -area (d_a phi_v) (d_b phi_w), symmetric in a and b.
    for (size_t k = 0; k < 3; ++k) {
      const Complex g = 2.0 * std::conj(gradients[k]);
      if (outer[static_cast<size_t>(t[k])]) continue;
      for (size_t m = 0; m < 3; ++m) {
        const Complex h = 2.0 * std::conj(gradients[m]);
        entries.emplace_back(3 * t[k], t[m], -own * g.real() * h.real());
        entries.emplace_back(3 * t[k] + 1, t[m],
                             -0.5 * own * (g.real() * h.imag() + g.imag() * h.real()));
        entries.emplace_back(3 * t[k] + 2, t[m], -own * g.imag() * h.imag());
      }
    }
  }
  weights_ /= stiff_area_;
  second_.resize(3 * vertices, vertices);
  second_.setFromTriplets(entries.begin(), entries.end());
  // The area around outline vertices bends as their neighbors inside do.
  const VectorXd shares = inner_shares(mesh, outer, stiff_masses);
  VectorXd inverse_masses(3 * vertices);
  squares_.resize(3 * vertices);
  for (Index v = 0; v < vertices; ++v)
    for (int k = 0; k < 3; ++k) {  // f_xy counts twice in |H|^2
      inverse_masses[3 * v + k] = 1 / masses[v];
      squares_[3 * v + k] = (k == 1 ? 2 : 1) * shares[v] * bending[v] * bending[v] / stiff_area_;
    }
  second_ = inverse_masses.asDiagonal() * second_;
  bending_ = second_.transpose() * squares_.asDiagonal() * second_;
}

SheetStrain SheetEnergy::strain(size_t triangle, const VectorXc& f) const {
  SheetStrain at{0, 0};
  for (size_t k = 0; k < 3; ++k) {
    const Complex value = f[mesh_->triangles[triangle][k]], weight = gradients_[triangle][k];
    at.fz += times(weight, value);
    at.fzbar += times(std::conj(weight), value);
  }
  return at;
}

double SheetEnergy::membrane(const VectorXc& f) const {
  double sum = 0;
  for (size_t i = 0; i < gradients_.size(); ++i)
    sum += weights_[static_cast<Index>(i)] * membrane_of(strain(i, f));
  return sum;
}

double SheetEnergy::bending(const VectorXc& f) const {
  const VectorXd x = second_ * f.real(), y = second_ * f.imag();
  return 0.5 * squares_.dot((x.array().square() + y.array().square()).matrix());
}

VectorXc SheetEnergy::bending_gradient(const VectorXc& f) const {
  const VectorXd x = squares_.cwiseProduct(second_ * f.real()),
                 y = squares_.cwiseProduct(second_ * f.imag());
  VectorXc gradient(f.size());
  gradient.real() = second_.transpose() * x;
  gradient.imag() = second_.transpose() * y;
  return gradient;
}

std::array<Complex, 3> SheetEnergy::hessian_at(int vertex, const VectorXc& f) const {
  std::array<Complex, 3> second{};
  for (int k = 0; k < 3; ++k)
    for (decltype(second_)::InnerIterator at(second_, 3 * vertex + k); at; ++at)
      second[static_cast<size_t>(k)] += at.value() * f[at.col()];
  return second;
}

/// How the unknowns of a triangle change |f_z| and |f_zbar|, and the angles alpha and beta, times
/// these sizes.
struct SheetEnergy::Changes {
  SheetGradient grows, twists, shears, flips;
};

SheetEnergy::Changes SheetEnergy::changes_of(size_t triangle, const SheetStrain& at) const {
  const Complex unturned = std::conj(direction_of(at.fz)),
                unflipped = std::conj(direction_of(at.fzbar));
  Changes changes;
  for (size_t k = 0; k < 3; ++k) {
    const Complex a = times(unturned, gradients_[triangle][k]),
                  b = times(unflipped, std::conj(gradients_[triangle][k]));
    const Index x = static_cast<Index>(2 * k);
    changes.grows.segment<2>(x) << a.real(), -a.imag();
    changes.twists.segment<2>(x) << a.imag(), a.real();
    changes.shears.segment<2>(x) << b.real(), -b.imag();
    changes.flips.segment<2>(x) << b.imag(), b.real();
  }
  return changes;
}

SheetGradient SheetEnergy::gradient_of(size_t triangle, const VectorXc& f) const {
  const SheetStrain at = strain(triangle, f);
  const Changes by = changes_of(triangle, at);
  const auto slope = [](double stretch) { return stretch - 1 / (stretch * stretch * stretch); };
  const double large = slope(at.larger()), small = slope(at.smaller());
  return weights_[static_cast<Index>(triangle)] *
         ((large + small) * by.grows + (large - small) * by.shears);
}

SheetHessian SheetEnergy::hessian_of(size_t triangle, const VectorXc& f, bool projected) const {
  const SheetStrain at = strain(triangle, f);
  const Changes by = changes_of(triangle, at);
  const double large = at.larger(), small = at.smaller(), squares = large * large + small * small,
               product = large * small, cube = product * product * product;
  const auto curvature = [](double stretch) {
    const double square = stretch * stretch;
    return 1 + 3 / (square * square);
  };
  const auto times_square = [](double factor, const SheetGradient& row) {
    return SheetHessian(factor * row * row.transpose());
  };
  const double twist = 1 - (squares - product) / cube, flip = 1 + (squares + product) / cube;
  return weights_[static_cast<Index>(triangle)] *
         (times_square(curvature(large), by.grows + by.shears) +
          times_square(curvature(small), by.grows - by.shears) +
          times_square(2 * (projected ? std::max(0.0, twist) : twist), by.twists) +
          times_square(2 * flip, by.flips));
}

double SheetEnergy::first_flip(const VectorXc& f, const VectorXc& d) const {
  double first = kInfinite;
  for (size_t i = 0; i < gradients_.size(); ++i) {
    const SheetStrain at = strain(i, f), by = strain(i, d);
    // The determinant is c + 2 b t + a t^2.
    const double c = std::norm(at.fz) - std::norm(at.fzbar),
                 b = dot(at.fz, by.fz) - dot(at.fzbar, by.fzbar),
                 a = std::norm(by.fz) - std::norm(by.fzbar), inside = b * b - a * c;
    if (inside < 0) continue;
    // The smallest positive root, in a form without cancellation.
    const double root = std::sqrt(inside);
    if (b < 0)
      first = std::min(first, c / (-b + root));
    else if (a < 0)
      first = std::min(first, (b + root) / -a);
  }
  return first;
}

}  // namespace holomorph
