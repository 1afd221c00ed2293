// The normal matrices are sparse for triangles and dense for harmonic maps.
#include "core/compared/derivative_operator.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include "core/error.h"
#include "core/solvers/real_form.h"

namespace holomorph {
namespace {

constexpr double kNullSpaceWeight = 1e-9;  ///< added to the diagonal because T has a null space

class MeshOperator final : public DerivativeOperator {
 public:
  explicit MeshOperator(const Mesh& mesh) : mesh_(mesh) {
    std::vector<Eigen::Triplet<double>> entries;
    weights_.resize(static_cast<Index>(mesh.triangles.size()));
    for (size_t t = 0; t < mesh.triangles.size(); ++t) add_triangle(static_cast<Index>(t), entries);
    weights_ /= weights_.sum();
    t_.resize(4 * elements(), unknowns());
    t_.setFromTriplets(entries.begin(), entries.end());
    transposed_ = t_.transpose();
  }

  Index unknowns() const override { return 2 * static_cast<Index>(mesh_.vertices.size()); }
  VectorXd apply(const VectorXd& x) const override { return t_ * x; }
  VectorXd adjoint(const VectorXd& y) const override { return transposed_ * y; }

  void factor(const std::vector<Eigen::Matrix4d>& h) override {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index i = 0; i < elements(); ++i)
      for (Index r = 0; r < 4; ++r)
        for (Index c = 0; c < 4; ++c)
          entries.emplace_back(4 * i + r, 4 * i + c, h[static_cast<size_t>(i)](r, c));
    Eigen::SparseMatrix<double> blocks(4 * elements(), 4 * elements());
    blocks.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseMatrix<double> normal = transposed_ * blocks * t_;
    const double most = normal.diagonal().maxCoeff();
    normal.diagonal().array() += kNullSpaceWeight * most;
    if (!analyzed_) cholesky_.analyzePattern(normal);
    analyzed_ = true;
    cholesky_.factorize(normal);
    check(cholesky_.info() == Eigen::Success, "mesh operator: the normal matrix is definite");
  }
  VectorXd solve(const VectorXd& right) const override { return cholesky_.solve(right); }

  VectorXc map(const VectorXd& x) const override { return complex_of(x); }
  VectorXd similarity(double factor) const override {
    const VectorXc positions = Eigen::Map<const VectorXc>(mesh_.vertices.data(), unknowns() / 2);
    return stacked(factor * positions);
  }

 private:
  /// f_z and f_zbar of the linear map on a triangle: linear combinations of its corners.
  void add_triangle(Index t, std::vector<Eigen::Triplet<double>>& entries) {
    const Triangle& corners = mesh_.triangles[static_cast<size_t>(t)];
    const auto at = [&](int k) { return mesh_.vertices[static_cast<size_t>(corners[k % 3])]; };
    const double area = 0.5 * cross(at(1) - at(0), at(2) - at(0));
    weights_[t] = area;
    const auto add = [&](Index row, int vertex, Complex c) {
      const Index n = static_cast<Index>(mesh_.vertices.size());
      entries.emplace_back(row, vertex, c.real());
      entries.emplace_back(row, n + vertex, -c.imag());
      entries.emplace_back(row + 1, vertex, c.imag());
      entries.emplace_back(row + 1, n + vertex, c.real());
    };
    for (int k = 0; k < 3; ++k) {
      const Complex opposite = at(k + 2) - at(k + 1);
      add(4 * t, corners[k], -kI * std::conj(opposite) / (4 * area));
      add(4 * t + 2, corners[k], kI * opposite / (4 * area));
    }
  }

  const Mesh& mesh_;
  Eigen::SparseMatrix<double> t_, transposed_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky_;
  bool analyzed_ = false;
};

class HarmonicOperator final : public DerivativeOperator {
 public:
  HarmonicOperator(const BoundaryBasis& basis, const MapOnMesh& mesh,
                   std::span<const Complex> points)
      : basis_(basis), mesh_(mesh) {
    const MatrixXc c = basis.whitened(basis.values(points));
    const Index m = c.rows(), n = c.cols();
    weights_ = VectorXd::Constant(m, 1 / static_cast<double>(m));
    MatrixXd re, im;
    real_columns(c, re, im);
    t_ = MatrixXd::Zero(4 * m, 4 * n);
    for (Index i = 0; i < m; ++i) {
      t_.row(4 * i).head(2 * n) = re.col(i).transpose();
      t_.row(4 * i + 1).head(2 * n) = im.col(i).transpose();
      t_.row(4 * i + 2).tail(2 * n) = re.col(i).transpose();
      t_.row(4 * i + 3).tail(2 * n) = -im.col(i).transpose();
    }
  }

  Index unknowns() const override { return t_.cols(); }
  VectorXd apply(const VectorXd& x) const override { return product(t_, x); }
  VectorXd adjoint(const VectorXd& y) const override { return transposed_product(t_, y); }

  void factor(const std::vector<Eigen::Matrix4d>& h) override {
    MatrixXd columns(t_.cols(), t_.rows());  // H = L L^T
    for (Index i = 0; i < elements(); ++i)
      columns.middleCols(4 * i, 4) = t_.middleRows(4 * i, 4).transpose() *
                                     h[static_cast<size_t>(i)].llt().matrixL().toDenseMatrix();
    MatrixXd normal = MatrixXd::Zero(t_.cols(), t_.cols());
    add_gram(columns, columns.cols(), 0, normal);
    const double most = normal.diagonal().maxCoeff();
    normal.diagonal().array() += kNullSpaceWeight * most;
    check(cholesky_.factor(normal), "harmonic operator: the normal matrix is definite");
  }
  VectorXd solve(const VectorXd& right) const override { return cholesky_.solve(right); }

  VectorXc map(const VectorXd& x) const override {
    const Index n = t_.cols() / 2;
    return mesh_.antiderivative(basis_.coefficients(complex_of(x.head(n)))) +
           mesh_.antiderivative(basis_.coefficients(complex_of(x.tail(n)))).conjugate();
  }
  VectorXd similarity(double factor) const override {
    VectorXd x = VectorXd::Zero(t_.cols());
    x.head(t_.cols() / 2) = stacked(factor * basis_.one());
    return x;
  }

 private:
  const BoundaryBasis& basis_;
  const MapOnMesh& mesh_;
  MatrixXd t_;
  Cholesky cholesky_;
};

}  // namespace

std::unique_ptr<DerivativeOperator> mesh_operator(const Mesh& mesh) {
  return std::make_unique<MeshOperator>(mesh);
}

std::unique_ptr<DerivativeOperator> harmonic_operator(const BoundaryBasis& basis,
                                                      const MapOnMesh& mesh,
                                                      std::span<const Complex> points) {
  return std::make_unique<HarmonicOperator>(basis, mesh, points);
}

}  // namespace holomorph
