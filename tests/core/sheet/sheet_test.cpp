// The elastic sheet: derivatives of its energy, motions that cost nothing, bending of quadratics,
// and answers that do not depend on the mesh.
#include <numbers>

#include "core/maps/distortion.h"
#include "core/mesh/mesher.h"
#include "core/sheet/sheet_program.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::sheet_test {

namespace {

std::shared_ptr<const SheetEnergy> sheet_of(const Cage& cage, int vertices, double bending) {
  const auto mesh = std::make_shared<const Mesh>(domain_mesh(cage, {vertices}));
  return std::make_shared<const SheetEnergy>(
      mesh, VectorXd::Ones(static_cast<Index>(mesh->triangles.size())),
      VectorXd::Constant(static_cast<Index>(mesh->vertices.size()), bending));
}

VectorXc at_rest(const Mesh& mesh) {
  return Eigen::Map<const VectorXc>(mesh.vertices.data(), static_cast<Index>(mesh.vertices.size()));
}

SheetRow row_at(const Mesh& mesh, Complex z) {
  const Location at = locate_near(mesh, z);
  SheetRow row;
  for (size_t k = 0; k < 3; ++k)
    row.terms.emplace_back(mesh.triangles[static_cast<size_t>(at.triangle)][k], at.weights[k]);
  return row;
}

/// A mesh of unit squares, each cut in two.
Mesh grid(int columns, int rows) {
  Mesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c) mesh.vertices.emplace_back(c, r);
  const int next = columns + 1;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int v = r * next + c;
      mesh.triangles.push_back({v, v + 1, v + next + 1});
      mesh.triangles.push_back({v, v + next + 1, v + next});
    }
  for (int c = 0; c < columns; ++c) mesh.boundary.push_back(c);
  for (int r = 0; r < rows; ++r) mesh.boundary.push_back(r * next + columns);
  for (int c = columns; c > 0; --c) mesh.boundary.push_back(rows * next + c);
  for (int r = rows; r > 0; --r) mesh.boundary.push_back(r * next);
  return mesh;
}

/// A map near rest without flipped triangles.
VectorXc random_map(const Mesh& mesh, std::mt19937& random) {
  VectorXc f = at_rest(mesh);
  const double size = box_of(mesh.vertices).diagonal();
  const Complex wave = 6.0 / size * random_complex(random),
                by = 0.04 * size * random_complex(random),
                turn = std::polar(1.0, 3 * random_complex(random).real());
  for (Complex& z : f) z = turn * (z + by * std::sin(dot(wave, z)));
  return f;
}

}  // namespace

TEST_CASE("Sheet: rigid motions have no strain and no bending") {
  for (const unsigned seed : seeds_of("rigid motions of a sheet", {1})) {
    std::mt19937 random(seed);
    const auto sheet = sheet_of(polygon_cage(shapes::l_shape()), 600, 20);
    const Complex turn = std::polar(1.0, 9 * random_complex(random).real()),
                  by = 1e3 * random_complex(random);
    const VectorXc f = (turn * at_rest(sheet->mesh())).array() + by;
    CHECK(std::abs(sheet->membrane(f) - 2) < 1e-12);
    CHECK(sheet->bending(f) < 1e-10);
    const SheetProgram program(sheet, {});
    CHECK(program.gradient(f, {}).cwiseAbs().maxCoeff() < 1e-11);
  }
}

TEST_CASE("Sheet: the bending of quadratics on a grid is exact") {
  const auto mesh = std::make_shared<const Mesh>(grid(8, 6));
  const SheetEnergy sheet(mesh, VectorXd::Ones(96), VectorXd::Ones(63));
  const Complex xx(0.3, -1.2), xy(0.7, 0.1), yy(-0.4, 2.5);
  VectorXc f = at_rest(*mesh);
  for (Complex& z : f) {
    const double x = z.real(), y = z.imag();
    z = 0.5 * xx * x * x + xy * x * y + 0.5 * yy * y * y + 2.0 * x - kI * y;
  }
  const std::vector<char> outer = boundary_marks(*mesh);
  for (int v = 0; v < 63; ++v) {
    if (outer[static_cast<size_t>(v)]) continue;
    const auto [a, b, c] = sheet.hessian_at(v, f);
    CHECK(std::abs(a - xx) < 1e-12);
    CHECK(std::abs(b - xy) < 1e-12);
    CHECK(std::abs(c - yy) < 1e-12);
  }
  // Two corners of the grid belong to one triangle each, and have no neighbors inside.
  const double exact =
      0.5 * (std::norm(xx) + 2 * std::norm(xy) + std::norm(yy)) * (48 - 2 * 0.5 / 3) / 48;
  CHECK(sheet.bending(f) == Approx(exact).epsilon(1e-12));
}

TEST_CASE("Sheet: derivatives of its energy agree with differences") {
  for (const unsigned seed : seeds_of("derivatives of a sheet", {1, 2})) {
    std::mt19937 random(seed);
    const auto sheet = sheet_of(polygon_cage(shapes::star(5, 0.4, seed)), 120, 25);
    const Mesh& mesh = sheet->mesh();
    const VectorXc f = random_map(mesh, random);
    REQUIRE(flipped_triangles(mesh, f) == 0);
    CHECK(sheet->membrane(f) == Approx(isometric_energy_of(mesh, f)).epsilon(1e-12));
    SheetHolds holds;
    SheetPull pull;
    for (int p = 0; p < 3; ++p) {
      holds.rows.push_back(row_at(mesh, mesh.vertices[static_cast<size_t>(20 * p + 9)]));
      pull.rows.push_back({300.0 * random_complex(random), {0.02, p == 0 ? 0 : 0.2, 0.001}});
    }
    for (const int v : {3, 40, 41})
      pull.vertices.push_back(
          {v, 300.0 * random_complex(random), {0.03, v == 40 ? 0 : 0.1, 0.002}});
    const SheetProgram program(sheet, holds);
    const VectorXd gradient = program.gradient(f, pull);
    for (int i = 0; i < 20; ++i) {
      VectorXc d(f.size());
      VectorXd flat(2 * f.size());
      for (Index v = 0; v < d.size(); ++v) {
        d[v] = random_complex(random);
        flat[2 * v] = d[v].real(), flat[2 * v + 1] = d[v].imag();
      }
      const double h = 1e-5,
                   slope =
                       (program.value(f + h * d, pull) - program.value(f - h * d, pull)) / (2 * h);
      CHECK(std::abs(slope - gradient.dot(flat)) <= 1e-6 * gradient.norm());
    }
    // Hessians, in random directions.
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      VectorXc d = VectorXc::Zero(f.size());
      SheetGradient by;
      for (int k = 0; k < 3; ++k) {
        const Complex to = d[mesh.triangles[t][static_cast<size_t>(k)]] = random_complex(random);
        by.segment<2>(2 * k) << to.real(), to.imag();
      }
      const double h = 1e-5, exact = by.dot(sheet->hessian_of(t, f, false) * by),
                   projected = by.dot(sheet->hessian_of(t, f, true) * by),
                   differences =
                       by.dot(sheet->gradient_of(t, f + h * d) - sheet->gradient_of(t, f - h * d)) /
                       (2 * h);
      CHECK(exact == Approx(differences).epsilon(1e-5).margin(1e-10));
      CHECK(projected >= std::max(0.0, exact) * (1 - 1e-12));
    }
  }
}

TEST_CASE("Sheet: the first flip is where the first triangle is flat") {
  for (const unsigned seed : seeds_of("first flips", {1, 2, 3})) {
    std::mt19937 random(seed);
    const auto sheet = sheet_of(polygon_cage(shapes::star(5, 0.4, seed)), 100, 25);
    const VectorXc f = at_rest(sheet->mesh());
    VectorXc d(f.size());
    for (Complex& z : d) z = 30.0 * random_complex(random);
    const double first = sheet->first_flip(f, d);
    REQUIRE(std::isfinite(first));
    CHECK(flipped_triangles(sheet->mesh(), f + (1 - 1e-9) * first * d) == 0);
    CHECK(flipped_triangles(sheet->mesh(), f + (1 + 1e-9) * first * d) > 0);
    CHECK(std::isfinite(sheet->value(f + 0.99 * first * d)));
    CHECK(std::isinf(sheet->value(f + 1.01 * first * d)));
    CHECK(std::isinf(sheet->first_flip(f, f)));  // it grows
  }
}

TEST_CASE("Sheet: Newton steps end at a minimum, without flips on the way") {
  for (const unsigned seed : seeds_of("minima of sheets", {1, 2, 3})) {
    std::mt19937 random(seed);
    const auto sheet = sheet_of(polygon_cage(shapes::star(6, 0.4, seed)), 400, 25);
    const Mesh& mesh = sheet->mesh();
    const double size = box_of(mesh.vertices).diagonal();
    SheetHolds holds;
    SheetPull pull;
    for (int p = 0; p < 4; ++p) {
      const Complex z = Complex(200, 200) + std::polar(60.0, 2 * kPi * p / 4);
      holds.rows.push_back(row_at(mesh, z));
      pull.rows.push_back({z + 60.0 * random_complex(random), {1e4 / (size * size)}});
    }
    SheetProgram program(sheet, holds);
    VectorXc f = at_rest(mesh);
    double last = program.value(f, pull);
    int steps = 0;
    for (bool ended = false; steps < 40 && !ended; ++steps) {
      const SheetProgram::Step step = program.minimize(pull, f, 1, {}, 0);
      CHECK(step.value <= last);
      REQUIRE(flipped_triangles(mesh, f) == 0);
      last = step.value;
      ended = step.length == 0;
    }
    VectorXc at_once = at_rest(mesh);
    program.minimize(pull, at_once, 300);
    INFO("seed " << seed << ", " << steps << " steps, value " << last);
    CHECK(program.gradient(at_once, pull).cwiseAbs().maxCoeff() < 1e-6);
    // True Hessians get there in fewer steps than projected ones alone.
    CHECK(program.value(at_once, pull) <= last * (1 + 1e-9));
  }
}

TEST_CASE("Sheet: a Newton step near the minimum gets there where handles give way") {
  for (const unsigned seed : seeds_of("handles that give way", {1})) {
    std::mt19937 random(seed);
    std::vector<double> left;  // of the distance from the minimum
    for (int shape = 0; shape < 9; ++shape) {
      const auto sheet = sheet_of(polygon_cage(shapes::star(6, 0.4, random())), 200, 25);
      const Mesh& mesh = sheet->mesh();
      const double size = box_of(mesh.vertices).diagonal();
      SheetHolds holds;
      SheetPull pull;
      for (int p = 0; p < 4; ++p) {
        const Complex z = Complex(200, 200) + std::polar(60.0, 2 * kPi * p / 4);
        holds.rows.push_back(row_at(mesh, z));
        // Two pins are far away, and pull with about the same force wherever they are.
        const Spring spring{1e4 / (size * size), p < 2 ? 0 : size / 2, 0.1 / (size * size)};
        pull.rows.push_back({z + (p < 2 ? 10.0 : 500.0) * random_complex(random), spring});
      }
      pull.vertices.push_back({7, mesh.vertices[7] + 300.0, {1e4 / (size * size), size, 0}});
      const SheetProgram program(sheet, holds);
      VectorXc f = at_rest(mesh);
      program.minimize(pull, f, 300, {}, 0);
      // A smooth change, to which the springs matter as much as the sheet.
      const VectorXc best = f;
      for (Index v = 0; v < f.size(); ++v) f[v] += 1e-4 * best[v] * best[v] / size;
      const double before = (f - best).norm();
      program.step(pull, f, false);
      left.push_back((f - best).norm() / before);
    }
    std::ranges::sort(left);
    CAPTURE(seed, left);
    CHECK(left[4] < 0.01);  // projected Hessians leave 0.08
  }
}

TEST_CASE("Sheet: fixed coordinates stay") {
  const auto sheet = sheet_of(polygon_cage(shapes::rectangle(300, 200)), 300, 20);
  const Mesh& mesh = sheet->mesh();
  SheetHolds holds;
  // A picture's frame: vertices on a side slide along it, and corners stay.
  for (const Complex& z : mesh.vertices)
    holds.fixed.push_back({z.real() == 0 || z.real() == 300, z.imag() == 0 || z.imag() == 200});
  holds.rows.push_back(row_at(mesh, {150, 100}));
  SheetProgram program(sheet, holds);
  VectorXc f = at_rest(mesh);
  const SheetPull pull{{{{220, 150}, {1}}}};
  program.minimize(pull, f, 40);
  CHECK(program.value(f, pull) < program.value(at_rest(mesh), pull) / 10);
  CHECK(flipped_triangles(mesh, f) == 0);
  double slid = 0;
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Complex z = mesh.vertices[v], w = f[static_cast<Index>(v)];
    if (holds.fixed[v][0]) CHECK(w.real() == z.real());
    if (holds.fixed[v][1]) CHECK(w.imag() == z.imag());
    if (holds.fixed[v][0] || holds.fixed[v][1]) slid = std::max(slid, std::abs(w - z));
  }
  CHECK(slid > 1);
}

TEST_CASE(
    "Sheet: unrelated meshes of one pose give one answer, which the membrane alone does not") {
  const Cage cage = polygon_cage(shapes::rectangle(600, 200));
  const std::vector<std::pair<Complex, Complex>> pins{
      {{60, 100}, {60, 100}}, {{300, 100}, {300, 130}}, {{540, 100}, {470, 260}}};
  const double size = std::hypot(600, 200);
  std::vector<double> energies, spread;
  for (const double bending : {30.0, 0.0}) {
    std::vector<double> found;
    for (const int vertices : {500, 1100, 2300}) {
      const auto sheet = sheet_of(cage, vertices, bending);
      SheetHolds holds;
      SheetPull pull;
      for (const auto& [from, to] : pins) {
        holds.rows.push_back(row_at(sheet->mesh(), from));
        pull.rows.push_back({to, {1e4 / (size * size)}});
      }
      SheetProgram program(sheet, holds);
      VectorXc f = at_rest(sheet->mesh());
      program.minimize(pull, f, 60);
      found.push_back(sheet->value(f) - 2);
    }
    const auto [least, most] = std::ranges::minmax(found);
    INFO("bending " << bending << ": " << found[0] << ", " << found[1] << ", " << found[2]);
    if (bending > 0)
      CHECK(most <= 1.05 * least);
    else
      CHECK(most >= 1.1 * least);
  }
}

}  // namespace holomorph::sheet_test
