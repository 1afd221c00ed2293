// Products from several threads at once, and large ones that are shared among all cores.
#include "core/solvers/dense.h"

#include <random>
#include <thread>

#include "support/catch.h"
#include "support/seeds.h"

namespace holomorph::dense_test {

namespace {

MatrixXd random_matrix(Index rows, Index columns, std::mt19937& random) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

double difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("Threads that multiply at the same time do not disturb each other") {
  std::mt19937 random(1);
  const MatrixXd a = random_matrix(50, 500, random), b = random_matrix(500, 64, random);
  const MatrixXd expected = a.lazyProduct(b);
  for (int round = 0; round < 2000; ++round) {
    MatrixXd first, second;
    {
      const std::jthread other([&] { second = matrix_product(a, b); });
      first = matrix_product(a, b);
    }
    if (difference(first, expected) < 1e-10 && difference(second, expected) < 1e-10) continue;
    FAIL("wrong product in round " << round);
  }
}

TEST_CASE("Large products are the sums of their terms") {
  for (const unsigned seed : seeds_of("large products", {1})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<Index> sizes(480, 620);
    // Enough rows that Gram matrices are shared, too, and in several blocks.
    const Index rows = sizes(random) + 200, inner = sizes(random), columns = sizes(random);
    const MatrixXd a = random_matrix(rows, inner, random),
                   b = random_matrix(inner, columns, random);
    const MatrixXd expected = a.lazyProduct(b);
    CHECK(difference(matrix_product(a, b), expected) < 1e-10);
    CHECK(difference(transposed_matrix_product(a.transpose(), b), expected) < 1e-10);
    const MatrixXc complex = a + kI * a.reverse(), other = b - kI * b.reverse();
    CHECK((matrix_product(complex, other) - complex.lazyProduct(other)).cwiseAbs().maxCoeff() <
          1e-9);
    MatrixXd sum = MatrixXd::Ones(rows + 3, columns + 2);
    add_product(a, b.transpose(), inner, 1, 2, sum);
    CHECK(difference(sum.block(1, 2, rows, columns), expected.array() + 1) < 1e-10);
    CHECK(sum.col(1) == VectorXd::Ones(rows + 3));

    MatrixXd gram = MatrixXd::Zero(rows + 5, rows + 5);
    add_gram(a, inner, 5, gram);
    const MatrixXd square = a.lazyProduct(a.transpose());
    const MatrixXd off =
        (gram.bottomRightCorner(rows, rows) - square).triangularView<Eigen::Lower>();
    CHECK(off.cwiseAbs().maxCoeff() < 1e-10);
    CHECK(gram.leftCols(5).isZero(0));

    const Eigen::MatrixXf single = a.cast<float>(), other_single = b.transpose().cast<float>();
    Eigen::MatrixXf single_gram = Eigen::MatrixXf::Zero(rows, rows),
                    single_sum = Eigen::MatrixXf::Zero(rows, columns);
    add_gram(single, inner, 0, single_gram);
    add_product(single, other_single, inner, 0, 0, single_sum);
    const MatrixXd single_off =
        (single_gram.cast<double>() - square).triangularView<Eigen::Lower>();
    CHECK(single_off.cwiseAbs().maxCoeff() < 1e-2);
    CHECK(difference(single_sum.cast<double>(), expected) < 1e-2);

    Cholesky cholesky;
    const MatrixXd definite = square + MatrixXd::Identity(rows, rows);
    REQUIRE(cholesky.factor(definite));
    const MatrixXd right = random_matrix(rows, columns, random);
    CHECK(difference(definite * cholesky.solve_all(right), right) < 1e-6);
  }
}

TEST_CASE("Triangular factors and solutions reproduce the matrix") {
  for (const unsigned seed : seeds_of("triangular factors", {1, 2})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<Index> sizes(380, 430);
    const Index n = sizes(random), rows = n + 50, columns = sizes(random);
    const MatrixXc a = random_matrix(rows, n, random) + kI * random_matrix(rows, n, random);
    const MatrixXc r = upper_factor(a);
    CHECK(r.isUpperTriangular(0));
    // R^* R = A^* A; the same R, up to signs, as with Q.
    CHECK((r.adjoint().lazyProduct(r) - a.adjoint().lazyProduct(a)).cwiseAbs().maxCoeff() < 1e-9);
    const Orthonormal both = orthonormal(a);
    CHECK((both.r.cwiseAbs() - r.cwiseAbs()).cwiseAbs().maxCoeff() < 1e-10);
    CHECK((both.q.lazyProduct(both.r) - a).cwiseAbs().maxCoeff() < 1e-10);
    const MatrixXc right =
        random_matrix(n, columns, random) + kI * random_matrix(n, columns, random);
    CHECK((r.lazyProduct(solve_upper(r, right)) - right).cwiseAbs().maxCoeff() < 1e-8);
  }
}

}  // namespace holomorph::dense_test
