// Cycles on coarser meshes find the minima of the published iterations, and need few steps on any
// mesh.
#include "core/methods/rigid_energy.h"

#include "core/maps/distortion.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::rigid_energy_test {

namespace {

/// A bar that is held at both ends. One end is turned around the bar's middle by an angle.
struct HeldBar {
  std::shared_ptr<const Mesh> mesh;
  std::vector<Location> handles;
  Points targets;
  std::vector<BrushDab> stiffness;

  HeldBar(int vertices, double angle) {
    mesh = std::make_shared<const Mesh>(domain_mesh(shapes::rectangle(600, 100), {vertices}));
    const Complex middle(300, 50);
    for (const Complex z : {Complex(20, 20), Complex(20, 80), Complex(580, 20), Complex(580, 80)}) {
      handles.push_back(locate_near(*mesh, z));
      targets.push_back(z.real() < 300 ? z : middle + std::polar(1.0, angle) * (z - middle));
    }
  }

  RigidEnergy energy() const { return {mesh, stiffness, handles}; }

  VectorXc at_rest() const {
    return Eigen::Map<const VectorXc>(mesh->vertices.data(),
                                      static_cast<Index>(mesh->vertices.size()));
  }

  double value(const RigidEnergy& energy, const VectorXc& f) const {
    double sum = value(f);
    for (size_t h = 0; h < handles.size(); ++h)
      sum += energy.handle_weight() * std::norm(handles[h].in(*mesh, as_span(f)) - targets[h]);
    return sum;
  }

  double value(const VectorXc& f) const {
    double sum = 0;
    for (const Triangle& t : mesh->triangles) {
      const auto [fz, fzbar] = derivatives_in(*mesh, t, f);
      const auto corner = [&](int k) { return mesh->vertices[static_cast<size_t>(t[k])]; };
      const double area = 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0)),
                   level = stiffness_level(stiffness, (corner(0) + corner(1) + corner(2)) / 3.0);
      sum += std::pow(10, level) * area * (std::pow(std::abs(fz) - 1, 2) + std::norm(fzbar));
    }
    return sum;
  }
};

/// The largest movement of a vertex in one published iteration.
double movement(const RigidEnergy& energy, const Points& targets, const VectorXc& f) {
  VectorXc next = f;
  energy.iterate(targets, next);
  return (next - f).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("Rigid energy: where cycles end, published iterations do not move either") {
  for (const unsigned seed : seeds_of("rigid cycles", {1, 2, 3, 1835551510u})) {
    std::mt19937 random(seed);
    HeldBar bar(1000 + static_cast<int>(random() % 5000), 1.2 * random_complex(random).real());
    for (Complex& target : bar.targets) target += 3.0 * random_complex(random);
    if (random() % 2)
      bar.stiffness.push_back({{300, 50}, 150, 1.5 * random_complex(random).real()});
    const RigidEnergy energy = bar.energy();
    VectorXc f = bar.at_rest();
    // A bar that buckles stays for long where it hardly moves, far from the minimum. With the last
    // seed, cycles alone lead back and forth between two states forever.
    int cycles = 0;
    for (double moved = 1; moved > 1e-7; ++cycles) {
      REQUIRE(cycles < 1000);
      const VectorXc before = f;
      if (cycles < 40)
        energy.cycle(bar.targets, f);
      else
        energy.descend(bar.targets, f);
      if (cycles >= 40 && cycles % 10 == 0)
        REQUIRE(bar.value(energy, f) <= bar.value(energy, before) * (1 + 1e-9) + 1e-9);
      moved = (f - before).cwiseAbs().maxCoeff();
    }
    CAPTURE(seed, bar.mesh->vertices.size(), cycles);
    CHECK(movement(energy, bar.targets, f) < 1e-5);
    const double least = bar.value(f);
    for (int i = 0; i < 20; ++i) energy.iterate(bar.targets, f);
    CHECK(bar.value(f) == Approx(least).epsilon(1e-6));
  }
}

TEST_CASE("Rigid energy: a cycle is near the minimum on fine meshes, too") {
  for (const unsigned seed : seeds_of("rigid meshes", {1, 2})) {
    std::mt19937 random(seed);
    const double angle = 0.5 + 0.4 * random_complex(random).real();
    for (const int vertices : {1500, 6000, 24000}) {
      HeldBar bar(vertices, angle);
      const RigidEnergy energy = bar.energy();
      VectorXc f = bar.at_rest();
      for (int i = 0; i < 40; ++i) energy.cycle(bar.targets, f);
      // The end moves on, as in a frame of a drag.
      const Complex by = 6.0 * random_complex(random);
      bar.targets[2] += by;
      bar.targets[3] += by;
      VectorXc cycled = f, iterated = f;
      for (int i = 0; i < 2; ++i) energy.cycle(bar.targets, cycled);
      for (int i = 0; i < 6; ++i) energy.iterate(bar.targets, iterated);
      for (int i = 0; i < 40; ++i) energy.cycle(bar.targets, f);
      const double least = bar.value(f);
      CAPTURE(seed, vertices, angle, by, least, bar.value(cycled), bar.value(iterated));
      CHECK(bar.value(cycled) < 1.01 * least);
      CHECK(bar.value(cycled) - least < 0.5 * (bar.value(iterated) - least) + 1e-3 * least);
    }
  }
}

TEST_CASE("Rigid energy: narrow gaps do not tie limbs together") {
  for (const unsigned seed : seeds_of("rigid combs", {1, 2})) {
    std::mt19937 random(seed);
    HeldBar comb(2000, 0);
    comb.mesh = std::make_shared<const Mesh>(
        domain_mesh(shapes::comb(4), {1500 + static_cast<int>(random() % 4000)}));
    comb.handles.clear();
    comb.targets.clear();
    // Pins in all teeth; one tooth bends.
    for (int tooth = 0; tooth < 4; ++tooth)
      for (const Complex z : {Complex(20.0 * tooth + 9, 8), Complex(20.0 * tooth + 9, 95)}) {
        comb.handles.push_back(locate_near(*comb.mesh, z));
        comb.targets.push_back(z);
      }
    comb.targets[2] += Complex(6, 3) * random_complex(random);
    const RigidEnergy energy = comb.energy();
    VectorXc f = comb.at_rest(), iterated = f;
    for (int i = 0; i < 3; ++i) energy.cycle(comb.targets, f);
    for (int i = 0; i < 6; ++i) energy.iterate(comb.targets, iterated);
    CAPTURE(seed, comb.mesh->vertices.size(), comb.targets[2]);
    CHECK(comb.value(f) < comb.value(iterated) + 1e-9);
    for (int i = 0; i < 60; ++i) energy.cycle(comb.targets, f);
    CHECK(movement(energy, comb.targets, f) < 1e-5);
  }
}

TEST_CASE("Rigid energy: maps at rest stay, and rigid motions are found") {
  for (const double angle : {0.0, 2.0}) {
    HeldBar bar(3000, 0);
    const Complex factor = std::polar(1.0, angle);
    for (size_t h = 0; h < bar.targets.size(); ++h) bar.targets[h] = factor * bar.targets[h] + 30.0;
    const RigidEnergy energy = bar.energy();
    const VectorXc moved = factor * bar.at_rest().array() + 30.0;
    VectorXc f = moved;
    energy.cycle(bar.targets, f);
    CHECK((f - moved).cwiseAbs().maxCoeff() < 1e-8);
    f = bar.at_rest();
    for (int i = 0; i < 60; ++i) energy.cycle(bar.targets, f);
    CHECK((f - moved).cwiseAbs().maxCoeff() < 1e-4);
  }
}

}  // namespace holomorph::rigid_energy_test
