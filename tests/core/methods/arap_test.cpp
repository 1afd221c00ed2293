// Methods `arap` and `har_arap`: as-rigid-as-possible maps, on triangles and among smooth maps.

#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::arap_test {

namespace {

/// A bar held at both ends, with one end rotated by `angle` around the middle of the bar.
struct Bar {
  Rest rest;
  Pose pose;

  explicit Bar(double angle, int vertices = 600) {
    rest.cage = polygon_cage(shapes::rectangle(600, 100));
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {vertices}));
    rest.samples = rest.mesh->vertices;
    rest.precision = Precision::full;
    pose.cage = rest.cage;
    for (const Complex z : {Complex(20, 20), Complex(20, 80), Complex(580, 20), Complex(580, 80)}) {
      rest.pins.push_back({z, false});
      const bool turned = z.real() > 300;
      const Complex center(300, 50);
      pose.pins.push_back({turned ? center + std::polar(1.0, angle) * (z - center) : z, 0, 1});
    }
  }
};

/// The mean of |f_z - f_z / |f_z||^2 + |f_zbar|^2 over the area.
double energy(const Mesh& mesh, const VectorXc& f) {
  double sum = 0, total = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Complex a = mesh.vertices[static_cast<size_t>(j)] - mesh.vertices[static_cast<size_t>(i)],
                  b = mesh.vertices[static_cast<size_t>(k)] - mesh.vertices[static_cast<size_t>(i)];
    const Complex u = f[j] - f[i], v = f[k] - f[i];
    const Complex over = 1.0 / (a * std::conj(b) - b * std::conj(a));
    const Complex fz = (u * std::conj(b) - v * std::conj(a)) * over, fzbar = (a * v - b * u) * over;
    const double area = 0.5 * cross(a, b);
    sum += area * (std::pow(std::abs(fz) - 1, 2) + std::norm(fzbar));
    total += area;
  }
  return sum / total;
}

/// A body with five thin arms in a cage of about a hundred points, with two pins in each arm. The
/// pose bends the arms.
struct Animal {
  Rest rest;
  Pose pose;

  explicit Animal(std::mt19937& random) {
    constexpr int kArms = 5;
    constexpr double kBody = 70, kWidth = 15, kStep = 19;
    const auto between = [&](double least, double most) {
      return std::uniform_real_distribution<double>(least, most)(random);
    };
    Points outline;
    for (int arm = 0; arm < kArms; ++arm) {
      const Complex along = std::polar(1.0, 2 * kPi * (arm + between(-0.15, 0.15)) / kArms);
      const double length = between(110, 200);
      const int steps = static_cast<int>(length / kStep);
      for (int i = 0; i <= steps; ++i)
        outline.push_back(along * Complex(kBody + length * i / steps, -kWidth));
      for (int i = steps; i >= 0; --i)
        outline.push_back(along * Complex(kBody + length * i / steps, kWidth));
      const double bend = between(-0.7, 0.7);
      for (const double part : {0.5, 0.95}) {
        rest.pins.push_back({along * (kBody + part * length)});
        const Complex posed = along * (kBody + part * length * std::polar(1.0, part * bend));
        pose.pins.push_back({posed + 6.0 * random_complex(random), 0, 1});
      }
    }
    rest.cage = polygon_cage(outline);
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {9000}));
    rest.samples = rest.mesh->vertices;
    pose.cage = rest.cage;
  }
};

}  // namespace

TEST_CASE("As rigid as possible: smooth maps of thin arms are about as rigid as triangles") {
  for (const unsigned seed : seeds_of("rigid and smooth arms", {1, 2, 3})) {
    std::mt19937 random(seed);
    const Animal animal(random);
    const auto energy_of = [&](const char* id) {
      return energy(*animal.rest.mesh,
                    method_named(id).prepare(animal.rest, nullptr)->deform(animal.pose, {}).f);
    };
    const double mesh = energy_of("arap"), smooth = energy_of("har_arap");
    CAPTURE(seed, mesh, smooth);
    CHECK(smooth < 2.5 * mesh + 0.001);
  }
}

TEST_CASE(
    "As rigid as possible: a bent bar is more rigid than with method pins, and meets its pins") {
  for (const double angle : {0.8, 1.6}) {
    const Bar bar(angle);
    const auto run = [&](const char* id) {
      SampledMap map = method_named(id).prepare(bar.rest, nullptr)->deform(bar.pose, {});
      return map;
    };
    const double pins = energy(*bar.rest.mesh, run("pins").f);
    const SampledMap mesh = run("arap"), smooth = run("har_arap");
    INFO("angle " << angle << ": pins " << pins << ", arap " << energy(*bar.rest.mesh, mesh.f)
                  << ", har_arap " << energy(*bar.rest.mesh, smooth.f));
    CHECK(energy(*bar.rest.mesh, mesh.f) < 0.8 * pins);
    CHECK(energy(*bar.rest.mesh, smooth.f) < 0.9 * pins);
    for (const SampledMap* map : {&mesh, &smooth})
      for (size_t i = 0; i < bar.rest.pins.size(); ++i) {
        const auto at = locate(*bar.rest.mesh, bar.rest.mesh->vertices, bar.rest.pins[i].position);
        const Complex place = at->in(*bar.rest.mesh, as_span(map->f));
        CHECK(std::abs(place - bar.pose.pins[i].position) < 3);  // pixels, of a length of 600
      }
  }
}

TEST_CASE("As rigid as possible: no small change of the map is more rigid") {
  const Bar bar(1.2);
  SampledMap map = method_named("arap").prepare(bar.rest, nullptr)->deform(bar.pose, {});
  const double least = energy(*bar.rest.mesh, map.f);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    // A smooth bump between the ends, which does not move the pins.
    const Complex center(120 + 360 * std::abs(unit(random)), 50), by{unit(random), unit(random)};
    VectorXc moved = map.f;
    for (Index i = 0; i < moved.size(); ++i) {
      const double distance =
          std::abs(bar.rest.mesh->vertices[static_cast<size_t>(i)] - center) / 60;
      moved[i] += by * std::exp(-distance * distance);
    }
    CHECK(energy(*bar.rest.mesh, moved) > least - 1e-7);
  }
}

TEST_CASE("As rigid as possible: drafts of a bar that buckles come to rest") {
  // Cycles alone alternate between two states of this bar, 3 px apart; see rigid_energy_test.
  Bar bar(0.96962969434404367, 5544);
  bar.rest.stiffness.push_back({{300, 50}, 150, -1.003053285682554});
  const Complex by[] = {{1.62460891313, -0.59357541451},
                        {-2.30374553642, 0.52186440728},
                        {2.28504526825, 0.81893693762},
                        {-0.50365271697, 2.54998814762}};
  const auto deformer = method_named("arap").prepare(bar.rest, nullptr);
  Pose pose = bar.pose;
  for (size_t k = 0; k < 4; ++k) pose.pins[k].position = bar.rest.pins[k].position;
  SampledMap map = deformer->deform(pose, {});
  for (size_t k = 0; k < 4; ++k) pose.pins[k].position = bar.pose.pins[k].position + by[k];
  int drafts = 0;
  do {
    map = deformer->deform(pose, {.draft = true}, map.solution.get());
    ++drafts;
  } while (map.status == SampledMap::Status::iterating && drafts < 1000);
  INFO(drafts << " drafts");
  CHECK(map.status == SampledMap::Status::exact);
}

TEST_CASE(
    "As rigid as possible: drafts continue from the last frame and converge to the final map") {
  for (const char* id : {"arap", "har_arap"}) {
    const Bar bar(0.7);
    const auto deformer = method_named(id).prepare(bar.rest, nullptr);
    SampledMap draft, final_map;
    final_map = deformer->deform(bar.pose, {});
    for (int frame = 0; frame < 40; ++frame)
      draft = deformer->deform(bar.pose, {false, true}, draft.solution.get());
    INFO(id);
    CHECK((draft.f - final_map.f).cwiseAbs().maxCoeff() < 0.3);
    SampledMap again = deformer->deform(bar.pose, {});
    CHECK(again.f == final_map.f);  // regardless of what was dragged before
  }
}

TEST_CASE(
    "As rigid as possible: without pins, maps follow the vertices of curved and clockwise cages") {
  for (const Cage& cage : {polygon_cage(shapes::l_shape()), shapes::curved_star(7, 3, 0.2, 2),
                           reversed(polygon_cage(shapes::l_shape()))})
    for (const char* id : {"arap", "har_arap"}) {
      Rest rest;
      rest.cage = cage;
      rest.mesh = std::make_shared<const Mesh>(domain_mesh(cage, {600}));
      rest.samples = rest.mesh->vertices;
      Pose pose{cage, {}};
      pose.cage.segments[1][0] += Complex(8, -14);
      SampledMap map = method_named(id).prepare(rest, nullptr)->deform(pose, {});
      INFO(id << ", " << cage.size() << " segments");
      for (Index v = 0; v < cage.size(); ++v)
        CHECK(std::abs(map.f[rest.mesh->cage_vertices[static_cast<size_t>(v)]] -
                       pose.cage.vertex(v)) < 1.5);  // a vertex moves by 16
    }
}

}  // namespace holomorph::arap_test
