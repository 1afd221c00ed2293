// Method `bounded`: drags, shapes of cages, all references, and degenerate input.

#include <random>

#include "core/cauchy/boundary_basis.h"
#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::bounded_method_test {

namespace {

/// A rest of method `bounded` with a cage and pins, its pose and its deformer.
struct Setting {
  Rest rest;
  Pose pose;
  std::unique_ptr<Deformer> deformer;
  std::shared_ptr<const Solution> last;

  explicit Setting(const Cage& cage, const Points& pins, const Parameters& parameters = {},
                   int vertices = 800) {
    rest.cage = cage;
    rest.mesh = std::make_shared<const Mesh>(domain_mesh(rest.cage, {vertices}));
    rest.samples = rest.mesh->vertices;
    rest.parameters = parameters;
    pose.cage = rest.cage;
    for (const Complex z : pins) {
      rest.pins.push_back({z, false});
      pose.pins.push_back({z, 0, 1});
    }
    deformer = method_named("bounded").prepare(rest, nullptr);
  }

  /// Drafts continue from the last map.
  SampledMap map(EvalOptions options = {true, false}) {
    SampledMap map = deformer->deform(pose, options, last.get());
    last = map.solution;
    return map;
  }

  int flipped_triangle_count(const SampledMap& map) const {
    int count = 0;
    for (const auto& [i, j, k] : rest.mesh->triangles)
      count += cross(map.f[j] - map.f[i], map.f[k] - map.f[i]) <= 0;
    return count;
  }
};

/// The parameter value that selects an option of a choice.
double option(const std::string& key, const std::string& id) {
  for (const ParameterSpec& spec : method_named("bounded").parameters)
    for (size_t i = 0; spec.key == key && i < spec.options.size(); ++i)
      if (spec.options[i].id == id) return static_cast<double>(i);
  throw std::invalid_argument(id);
}

Points long_bar() {
  return {{0, 0}, {200, 0}, {400, 0}, {600, 0}, {600, 100}, {400, 100}, {200, 100}, {0, 100}};
}

}  // namespace

TEST_CASE("Bounded method: every frame of a drag is certified, and no triangle flips") {
  using Row = std::pair<const char*, const char*>;
  for (const auto& [reference, space] :
       {Row{"pins", "nu"}, Row{"har_arap", "nu"}, Row{"arap", "nu"}, Row{"pins", "psi"},
        Row{"har_arap", "psi"}, Row{"har_arap", "h"}}) {
    const Parameters parameters{{"reference", option("reference", reference)},
                                {"space", option("space", space)}};
    Setting bar(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}}, parameters);
    for (int frame = 0; frame < 20; ++frame) {
      const double t = frame / 20.0;
      bar.pose.pins[2].position = Complex(300, 50) + (270 - 240 * t) * std::polar(1.0, 6 * t);
      const bool draft = frame % 5 != 4;
      const SampledMap map = bar.map({true, draft});
      INFO(reference << ", " << space << ", frame " << frame << ": " << map.note);
      CHECK(map.status == SampledMap::Status::certified);
      CHECK(bar.flipped_triangle_count(map) == 0);
      for (Index i = 0; i < map.f.size(); ++i) {
        const double fz = std::abs(map.fz[i]), fzbar = std::abs(map.fzbar[i]);
        REQUIRE(fz - fzbar >= 0.2);
        REQUIRE(fz + fzbar <= 5);
        REQUIRE(fzbar <= 0.7 * fz);
      }
    }
  }
}

TEST_CASE("Bounded method: drags of cages with many points, curves or holes are certified") {
  for (const unsigned seed : seeds_of("large bounded cages", {1, 3205632981u})) {
    std::mt19937 random(seed);
    Cage ring = shapes::curved_star(12, 3, 0.2, seed + 2);
    Points hole;
    for (int i = 0; i < 9; ++i)
      hole.push_back(Complex(200, 200) + std::polar(25.0, -2 * kPi * i / 9));
    add_hole(ring, polygon_cage(hole).segments);
    Points wavy;
    const double waves = 3 + static_cast<double>(random() % 4),
                 phase = random_complex(random).real();
    for (int i = 0; i < 110; ++i) {
      const double angle = 2 * kPi * i / 110;
      wavy.push_back(Complex(200, 200) +
                     std::polar(100 * (1 + 0.2 * std::sin(waves * angle + phase)), angle));
    }
    for (const Cage& cage : {polygon_cage(wavy), shapes::curved_star(20, 3, 0.2, seed + 1), ring}) {
      const Complex middle(200, 200);
      Points pins;
      for (int i = 0; i < 5; ++i) pins.push_back(middle + std::polar(60.0, 2 * kPi * i / 5));
      Setting setting(cage, pins, {}, 6000);
      const double turn = 3 + random_complex(random).real();
      for (int frame = 0; frame < 12; ++frame) {
        const double t = frame / 12.0;
        setting.pose.pins[0].position = middle + (60 - 100 * t) * std::polar(1.0, turn * t);
        const SampledMap map = setting.map({false, true});
        INFO("seed " << seed << ", " << cage.size() << " segments, frame " << frame << ": "
                     << map.note);
        CHECK(map.status == SampledMap::Status::certified);
        CHECK(setting.flipped_triangle_count(map) == 0);
      }
    }
  }
}

namespace {

/// A square with a notch of the given angle.
Points notched(double degrees) {
  const double half = 700 * std::tan(0.5 * degrees * kPi / 180);
  return {{0, 0},     {1000, 0},          {1000, 1000}, {500 + half, 1000},
          {500, 300}, {500 - half, 1000}, {0, 1000}};
}

}  // namespace

TEST_CASE(
    "Boundary basis: the polygon surrounds notches, spikes and slots, and insets stay inside") {
  std::vector<Cage> cages{polygon_cage(Points{{0, 0}, {600, 0}, {600, 3}, {0, 3}}),
                          polygon_cage(Points{{0, 0}, {400, -4}, {0, 300}}),
                          shapes::curved_star(11, 4, 0.3, 8)};
  for (const double degrees : {2.0, 4.9, 8.0, 9.8, 30.0})
    cages.push_back(polygon_cage(notched(degrees)));
  for (const Cage& cage : cages) {
    const BoundaryBasis basis(cage, 50, 300);
    CHECK_FALSE(self_crossing(basis.polygon()));
    const Points fine = flattened(cage).points;
    for (const BoundaryPiece& piece : basis.pieces())
      for (const double t : {0.25, 0.5, 0.75}) {
        const Complex z = piece.start + t * (piece.end - piece.start);
        CHECK(winding_number(basis.polygon(), z) == 1);
      }
    for (const Complex& z : basis.polygon()) CHECK(winding_number(fine, z) == 0);
    for (const Complex& z : basis.inset(1)) CHECK(winding_number(fine, z) == 1);
  }
}

TEST_CASE("Bounded method: notches, curves and clockwise cages are certified and do not flip") {
  std::vector<Cage> cages{shapes::curved_star(8, 3, 0.25, 3), polygon_cage(notched(8)),
                          polygon_cage(notched(4.9)), polygon_cage(shapes::comb(4)),
                          reversed(polygon_cage(shapes::l_shape()))};
  const auto& options = method_named("bounded").parameters[0].options;
  for (const Cage& cage : cages)
    for (size_t reference = 0; reference < options.size(); ++reference) {
      const Box box = box_of(controls_of(cage));
      Setting setting(cage, {}, {{"reference", static_cast<double>(reference)}});
      for (Points& segment : setting.pose.cage.segments)
        for (Complex& z : segment)
          z += 0.1 * box.width() * std::sin(4 * (z.imag() - box.bottom) / box.height());
      const SampledMap map = setting.map();
      INFO(options[reference].id << ", " << cage.size() << " segments: " << map.note);
      CHECK(map.status == SampledMap::Status::certified);
      CHECK(setting.flipped_triangle_count(map) == 0);
    }
}

TEST_CASE("Bounded method: references that ignore pins are followed even if there are pins") {
  const auto& options = method_named("bounded").parameters[0].options;
  for (size_t reference = 0; reference < options.size(); ++reference) {
    Setting bar(polygon_cage(long_bar()), {{30, 50}, {570, 50}},
                {{"reference", static_cast<double>(reference)}});
    bar.pose.pins[1].position += Complex(-20, 60);
    CHECK(bar.map().status == SampledMap::Status::certified);
  }
}

TEST_CASE(
    "Bounded method: L_psi meets pins more closely, and the note names the limit that holds them") {
  double off[2] = {};
  for (const char* space : {"nu", "psi"}) {
    Setting bar(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}},
                {{"reference", option("reference", "har_arap")},
                 {"space", option("space", space)},
                 {"pin_weight", 1e5},
                 {"k", 0.8}});
    bar.pose.pins[1].position += Complex(0, 60);
    const SampledMap map = bar.map();
    CHECK(map.status == SampledMap::Status::certified);
    const auto points = bar.deformer->point_map(bar.pose);
    for (size_t i = 0; i < 3; ++i)
      off[space == std::string("psi")] +=
          std::abs(points->at(bar.rest.pins[i].position).f - bar.pose.pins[i].position);
  }
  INFO(off[0] << " px in L_nu, " << off[1] << " px in L_psi");
  CHECK(off[1] < 0.2 * off[0]);
  Setting far(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}},
              {{"space", option("space", "psi")}, {"Sigma", 1.5}, {"sigma", 0.5}});
  far.pose.pins[2].position = {1500, 50};
  const std::string note = far.map().note;
  INFO(note);
  CHECK(note.find("px short (limit: max growth 150 %)") != std::string::npos);
}

namespace {

const std::vector<Parameters>& specified_bounds() {
  static const std::vector<Parameters> bounds{{{"k", 0.7}, {"sigma", 0.2}, {"Sigma", 5}},
                                              {{"k", 0.5}, {"sigma", 0.5}, {"Sigma", 1.5}}};
  return bounds;
}

/// Checks all bounds at single points between the mesh's vertices.
void check_bounds_inside(const Setting& setting, const Parameters& bounds) {
  const auto points = setting.deformer->point_map(setting.pose);
  const Mesh& mesh = *setting.rest.mesh;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    Complex z = 0;
    for (const int v : mesh.triangles[t]) z += mesh.vertices[static_cast<size_t>(v)] / 3.0;
    const auto at = points->at(z);
    const double fz = std::abs(at.fz), fzbar = std::abs(at.fzbar);
    REQUIRE(fzbar <= bounds.at("k") * fz);
    REQUIRE(fz + fzbar <= bounds.at("Sigma"));
    REQUIRE(fz - fzbar >= bounds.at("sigma"));
  }
}

}  // namespace

TEST_CASE("Bounded method: a bar bent by 270 degrees with arap has zeros and is certified") {
  // Map (d) of the specification: one end is held in place, and the other is rotated.
  for (const Parameters& bounds : specified_bounds()) {
    Parameters parameters = bounds;
    parameters["reference"] = option("reference", "arap");
    Points ends;
    for (const double x : {0.05, 5.95})
      for (const double y : {-0.45, 0.0, 0.45}) ends.push_back({x, y});
    Setting bar(polygon_cage(Points{{0, -0.5}, {6, -0.5}, {6, 0.5}, {0, 0.5}}), ends, parameters);
    const double radius = 6 / (1.5 * kPi);
    for (size_t i = 3; i < 6; ++i)
      bar.pose.pins[i].position =
          Complex(-radius, radius) + std::polar(1.0, 1.5 * kPi) * (ends[i] - Complex(6, 0));
    const SampledMap map = bar.map();
    INFO(map.note);
    CHECK_FALSE(map.zeros.empty());
    CHECK(map.status == SampledMap::Status::certified);
    CHECK(bar.flipped_triangle_count(map) == 0);
    check_bounds_inside(bar, bounds);
  }
}

TEST_CASE("Bounded method: a cage with two zeros of f' inside is certified") {
  // Map (e) of the specification: f' = 3 (z - a) (z - b) on a square.
  const Complex a(0.4, 0.1), b(-0.3, 0.2);
  const auto f = [&](Complex z) { return z * z * z - 1.5 * (a + b) * z * z + 3.0 * a * b * z; };
  for (const Parameters& bounds : specified_bounds()) {
    Parameters parameters = bounds;
    parameters["reference"] = option("reference", "cage");
    Points square;
    for (const Complex corner : {Complex(-1, -1), Complex(1, -1), Complex(1, 1), Complex(-1, 1)})
      for (int i = 0; i < 10; ++i)
        square.push_back(corner + 0.2 * i * (kI * corner).real() +
                         kI * (0.2 * i * (kI * corner).imag()));
    Setting setting(polygon_cage(square), {}, parameters);
    for (Points& segment : setting.pose.cage.segments) segment[0] = f(segment[0]);
    const SampledMap map = setting.map();
    INFO(map.note);
    REQUIRE(map.zeros.size() == 2);
    for (const Complex zero : map.zeros)
      CHECK(std::min(std::abs(zero - a), std::abs(zero - b)) <= 0.1);
    CHECK(map.status == SampledMap::Status::certified);
    CHECK(setting.flipped_triangle_count(map) == 0);
    check_bounds_inside(setting, bounds);
  }
}

TEST_CASE("Bounded method: at rest, it is the identity to the last bit, whatever it follows") {
  for (const ParameterSpec& spec : method_named("bounded").parameters)
    for (size_t i = 0; spec.key == "reference" && i < spec.options.size(); ++i) {
      CAPTURE(spec.options[i].id);
      Setting setting(polygon_cage(shapes::star(7, 0.3, 5)), {{5, 8}, {-30, 20}},
                      {{"reference", static_cast<double>(i)}}, 300);
      CHECK(setting.map().f ==
            Eigen::Map<const VectorXc>(setting.rest.samples.data(),
                                       static_cast<Index>(setting.rest.samples.size())));
    }
}

TEST_CASE("Bounded method: proved extremes lie within the bounds that were asked for") {
  for (const unsigned seed : seeds_of("bounds asked for", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    Setting setting(polygon_cage(shapes::star(7, 0.3, seed)), {{5, 8}, {-30, 20}, {20, -35}},
                    {{"k", 0.3}, {"sigma", 0.4}, {"Sigma", 2.5}}, 300);
    for (PosePin& pin : setting.pose.pins) pin.position += 60.0 * random_complex(random);
    const SampledMap map = setting.map();
    if (map.status != SampledMap::Status::certified) continue;
    CHECK(map.extremes.value().shear <= 0.3);
    CHECK(map.extremes.value().smallest >= 0.4);
    CHECK(map.extremes.value().largest <= 2.5);
  }
}

TEST_CASE("Bounded method: a final frame depends only on rest and pose") {
  Setting bar(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}});
  bar.pose.pins[2].position = {350, 180};
  const SampledMap first = bar.map();
  bar.pose.pins[2].position = {100, 300};
  bar.map({false, true});
  bar.pose.pins[2].position = {350, 180};
  bar.map({false, true});
  CHECK(bar.map().f == first.f);
  CHECK(bar.map().fzbar == first.fzbar);
}

TEST_CASE("Bounded method: the map at single points equals the map on the mesh, in all spaces") {
  const char* space = GENERATE("nu", "psi", "h");
  Setting bar(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}},
              {{"reference", option("reference", "har_arap")}, {"space", option("space", space)}});
  // The pins also rotate and move as a whole.
  bar.pose.pins = {{{50, 30}}, {{50, 300}}, {{-120, 350}}};
  const SampledMap map = bar.map();
  REQUIRE(map.fzbar.cwiseAbs().maxCoeff() > 0.01);
  const auto points = bar.deformer->point_map(bar.pose);
  const double h = 1e-4;
  for (const Complex z : {Complex(90, 40), Complex(310, 71), Complex(555, 12)}) {
    const auto at = points->at(z);
    const Complex fx = (points->at(z + h).f - points->at(z - h).f) / (2 * h),
                  fy = (points->at(z + h * kI).f - points->at(z - h * kI).f) / (2 * h);
    CHECK(std::abs((fx - kI * fy) / 2.0 - at.fz) <= 1e-7);
    CHECK(std::abs((fx + kI * fy) / 2.0 - at.fzbar) <= 1e-7);
  }
  for (size_t v = 0; v < bar.rest.mesh->vertices.size(); v += 20) {
    const auto at = points->at(bar.rest.mesh->vertices[v]);
    const Index i = static_cast<Index>(v);
    CHECK(std::abs(at.f - map.f[i]) <= 1e-9);
    CHECK(std::abs(at.fz - map.fz[i]) <= 1e-9);
    CHECK(std::abs(at.fzbar - map.fzbar[i]) <= 1e-9);
  }
}

TEST_CASE("Bounded method: a cage whose mesh has no inner vertices is aligned by its boundary") {
  for (const char* reference : {"cage", "pins", "arap", "har_arap"}) {
    Setting thin(polygon_cage(Points{{0, 0}, {600, 0}, {600, 1}, {0, 1}}), {},
                 {{"reference", option("reference", reference)}});
    for (Points& segment : thin.pose.cage.segments) segment[0] *= std::polar(1.2, 0.5);
    const SampledMap map = thin.map();
    INFO(reference << ": " << map.note);
    CHECK(map.status == SampledMap::Status::certified);
    for (Index i = 0; i < map.f.size(); ++i)
      REQUIRE(std::abs(map.f[i] -
                       std::polar(1.2, 0.5) * thin.rest.samples[static_cast<size_t>(i)]) <= 130);
  }
}

TEST_CASE("Bounded method: the note names ignored pins and pins outside, and the iteration ends") {
  Setting bar(polygon_cage(long_bar()), {{30, 50}, {570, 50}},
              {{"reference", option("reference", "cage")}});
  bar.pose.pins[1].position += Complex(-20, 60);
  SampledMap map = bar.map();  // the cage is at rest
  CHECK(map.ignores_pins);
  CHECK(map.note.find("ignores pins") != std::string::npos);
  bar.pose.cage.segments[0][0] += Complex(5, 20);
  map = bar.map();
  CHECK(map.ignores_pins);
  CHECK(map.note.find("ignores pins") != std::string::npos);
  Setting outside(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {900, 900}});
  outside.pose.pins[1].position += Complex(0, 30);
  map = outside.map();
  CHECK_FALSE(map.ignores_pins);
  INFO(map.note);
  CHECK(map.note.find("in 3") != std::string::npos);
}

TEST_CASE("Bounded method: degenerate input gives an error or a map") {
  const auto ends_well = [](const char* what, Setting& setting) {
    INFO(what);
    try {
      const SampledMap map = setting.map();
      CHECK(map.f.allFinite());
      // A map for which the mesh is too coarse must not have the status certified.
      CHECK((setting.flipped_triangle_count(map) == 0) ==
            (map.status == SampledMap::Status::certified));
    } catch (const Error& error) {
      CHECK(std::string(error.what()).size() > 10);
    }
  };
  Setting triangle(polygon_cage(Points{{0, 0}, {300, 0}, {100, 200}}), {{80, 40}, {200, 40}});
  triangle.pose.pins[1].position = {90, 150};
  ends_well("triangle", triangle);
  Setting collapsed(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}});
  for (PosePin& pin : collapsed.pose.pins) pin.position = {300, 50};
  ends_well("collapsed", collapsed);
  for (Points& segment : collapsed.pose.cage.segments) segment[0] = {300, 50};
  ends_well("collapsed", collapsed);
  Setting far(polygon_cage(long_bar()), {{30, 50}, {300, 50}, {570, 50}});
  far.pose.pins[2].position = {1e7, -1e7};
  ends_well("far", far);
  Setting outside(polygon_cage(long_bar()), {{30, 50}, {900, 900}});
  outside.pose.pins[1].position = {0, 0};
  ends_well("outside", outside);
  Setting thin(polygon_cage(Points{{0, 0}, {600, 0}, {600, 1}, {0, 1}}), {{30, 0.5}, {570, 0.5}});
  thin.pose.pins[1].position = {30, 500};
  ends_well("thin", thin);
  Setting mirrored(polygon_cage(long_bar()), {});
  for (Points& segment : mirrored.pose.cage.segments)
    for (Complex& z : segment) z = std::conj(z);
  ends_well("mirrored", mirrored);
}

TEST_CASE("Bounded method: positions are continuous, and their differences satisfy the bounds") {
  constexpr double kStep = 1e-6, kSlack = 1e-4;
  for (const unsigned seed : seeds_of("bounded differences", {41, 42})) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const double k : {0.0, 0.6}) {
      const Cage cage = polygon_cage(shapes::star(7, 0.3, seed));
      Setting setting(cage, {}, {{"k", k}, {"sigma", 0.4}, {"Sigma", 2.5}});
      for (Points& segment : setting.pose.cage.segments)
        for (Complex& z : segment) z += 60.0 * Complex(unit(random) - 0.5, unit(random) - 0.5);
      Rest rest = setting.rest;
      rest.precision = Precision::full;
      rest.samples.clear();
      // Points across the sides of triangles, next to the boundary, and anywhere else.
      Points at;
      for (int i = 0; i < 120; ++i) {
        const Mesh& mesh = *rest.mesh;
        const Triangle& corners = mesh.triangles[random() % mesh.triangles.size()];
        const Complex a = mesh.vertices[static_cast<size_t>(corners[0])],
                      b = mesh.vertices[static_cast<size_t>(corners[1])],
                      c = mesh.vertices[static_cast<size_t>(corners[2])];
        const double s = unit(random), t = (1 - s) * (i % 2 ? unit(random) : 0);
        const Complex z = a + s * (b - a) + t * (c - a) + 0.5 * kStep * (c - a) / std::abs(c - a);
        if (!contains(cage, z) || !contains(cage, z + kStep) || !contains(cage, z + kI * kStep))
          continue;
        at.push_back(z);
        for (const Complex by : {Complex(0), Complex(kStep), kI * kStep, Complex(-1e-12, 1e-12)})
          rest.samples.push_back(z + by);
      }
      REQUIRE(at.size() > 80);
      SampledMap map = method_named("bounded").prepare(rest, nullptr)->deform(setting.pose, {true});
      REQUIRE(map.status == SampledMap::Status::certified);
      for (size_t i = 0; i < at.size(); ++i) {
        const Index first = static_cast<Index>(4 * i);
        const Complex x = (map.f[first + 1] - map.f[first]) / kStep,
                      y = (map.f[first + 2] - map.f[first]) / (kI * kStep);
        const double fz = std::abs(0.5 * (x + y)), fzbar = std::abs(0.5 * (x - y));
        INFO("seed " << seed << ", k " << k << ", at " << at[i].real() << " " << at[i].imag());
        CHECK(fzbar <= (k + kSlack) * fz);
        CHECK(fz + fzbar <= 2.5 + kSlack);
        CHECK(fz - fzbar >= 0.4 - kSlack);
        CHECK(std::abs(map.f[first + 3] - map.f[first]) <=
              2e-10);  // the two points are 1e-12 apart
      }
    }
  }
}

}  // namespace holomorph::bounded_method_test
