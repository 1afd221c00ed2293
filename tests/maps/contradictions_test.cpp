// What a report says of one map never contradicts itself: zeros, turning number, boundary, flipped
// triangles, visible folds, status and note.
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "scene/keyframes.h"
#include "scene/report.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::contradictions_test {

namespace {

/// A hundredth to a hundred times as large, and every other one with a hole, if it may have one.
Cage varied_star(const Method& method, std::mt19937& random) {
  const double scale = std::pow(10, 2 * random_complex(random).real());
  const Complex center(200, 200);
  Points outline = shapes::star(6 + static_cast<int>(random() % 12), 0.6, random());
  for (Complex& z : outline) z = scale * (z - center);
  Cage cage = polygon_cage(outline);
  if (!method.allows_holes || random() % 2 == 0) return cage;
  Points hole = shapes::star(5, 0.5, random());
  for (Complex& z : hole) z = 0.2 * scale * (z - center);
  add_hole(cage, polygon_cage(hole).segments);
  return cage;
}

/// A random star with pins, corners and an outline, posed gently or wildly.
Deformation random_deformation(const Method& method, bool varied, std::mt19937& random) {
  Deformation deformation;
  const Cage cage =
      varied ? varied_star(method, random)
             : polygon_cage(shapes::star(6 + static_cast<int>(random() % 12), 0.6, random()));
  deformation.rest = deformation.pose = cage;
  deformation.method = method.id;
  const double size = box_of(outline_of(cage)).diagonal(),
               reach = std::pow(10, -3 + 2.7 * std::abs(random_complex(random).real())) * size;
  if (method.uses_pins) {
    const Mesh mesh = domain_mesh(cage, {200});
    for (size_t i = 0; i < 4; ++i) {
      Pin pin;
      pin.rest = mesh.vertices[random() % mesh.vertices.size()];
      if (std::ranges::any_of(deformation.pins, [&](const Pin& other) {
            return std::abs(other.rest - pin.rest) < 0.05 * size;
          }))
        continue;
      pin.pose = pin.rest + reach * random_complex(random);
      deformation.pins.push_back(pin);
    }
  }
  if (method.uses_corners)
    for (Index v = 0; v < cage.size(); ++v) {
      const auto turn = [&] { return 6 * reach / size * random_complex(random).real(); };
      const double before = turn(), after = turn();
      deformation.corners.push_back({v, {before, after, 1}});
    }
  if (method.uses_outline) {
    deformation.outline = shapes::star(10 + static_cast<int>(random() % 20), 0.7, random());
    for (Complex& z : deformation.outline) z = size / 200 * z;
  }
  if (!method.uses_pins || random() % 3 == 0)
    for (Points& segment : deformation.pose.segments)
      for (Complex& z : segment) z += reach * random_complex(random);
  return deformation;
}

void check_report(const SceneReport& report) {
  const MapReport& map = report.map;
  const bool turns_once = std::abs(map.turning_number - 1) < 0.01;
  const auto says = [&](const char* what) { return report.note.find(what) != std::string::npos; };
  INFO(text_of(report));
  if (report.status == "certified") {
    CHECK(map.zeros.empty());
    CHECK(turns_once);
    CHECK(map.flipped_triangles == 0);
    CHECK_FALSE(report.folds_visibly);
  }
  // What is proved of the smooth map is never below what is found, at keys and in between.
  if (report.proved) {
    const Extremes& proved = *report.proved;
    CHECK(map.max_k <= proved.shear + 1e-9);
    CHECK(map.min_sigma >= proved.smallest - 1e-9);
    CHECK(map.max_sigma <= proved.largest + 1e-9);
  }
  if (map.locally_injective()) CHECK_FALSE(report.folds_visibly);
  // Other methods may be known only at samples; their linear maps wind around a vertex instead.
  if (!map.zeros.empty() && !report.in_triangles && method_named(report.method).uses_outline)
    CHECK(map.min_sigma <= 0);
  if (report.folds_visibly || map.flipped_triangles > 0)
    CHECK_FALSE((says("No folds") || says("no folds")));
  if (report.folds_visibly && !report.in_triangles && method_named(report.method).never_folds)
    CHECK((says("too coarse") || says("Not proved") || says("not proved") || says("As published")));
  if (says("The picture folds")) CHECK_FALSE(map.locally_injective());
  // Each zero adds a turn to the boundary. Where triangles are flipped, the mesh is too coarse to
  // tell. A map that is not conformal may also fold in a speck smaller than a triangle, inside a
  // simple boundary.
  const bool is_upright = map.flipped_triangles == 0 && map.min_sigma >= 0;
  if (is_upright && !report.in_triangles) {
    if (!map.zeros.empty()) CHECK_FALSE(turns_once);
    if (map.zeros.empty()) CHECK(turns_once);
  }
  if (map.simple_boundary && is_upright) CHECK(map.locally_injective());
}

/// Checks the report of a random pose, and that of a frame between it and the rest.
void check_reports(const Method& method, unsigned seed, bool varied = false) {
  INFO(method.id << ", seed " << seed);
  std::mt19937 random(seed);
  Deformation deformation = random_deformation(method, varied, random);
  try {
    TimedMap alone(deformation);
    check_report(report_of(alone, alone.frame({})));
  } catch (const Error&) {
    CHECK(soaks());  // this pose has no map; the fixed ones have one
    return;
  }
  if (method.uses_outline && !soaks()) return;  // takes long
  deformation.keyframes.push_back({0, whole_pose_of(at_rest(deformation)), Ease::linear});
  deformation.keyframes.push_back({1, whole_pose_of(deformation)});
  TimedMap film(deformation);
  check_report(report_of(film, film.frame(0.6)));
}

}  // namespace

TEST_CASE("Reports of outlines with zeros next to the boundary do not contradict themselves") {
  for (const unsigned seed : seeds_of("contradictions, outline", {139}))
    check_reports(method_named("outline"), seed);
}

TEST_CASE("Reports of angle maps with loops at corners do not contradict themselves") {
  for (const unsigned seed : seeds_of("contradictions, angles", {1}))
    check_reports(method_named("angles"), seed);
}

TEST_CASE("Reports of other maps do not contradict themselves") {
  // In the fixed case, the sheet makes more than a turn at a vertex of the boundary.
  for (const unsigned seed : seeds_of("contradictions", {2123583586u}))
    for (const Method& method : methods())
      if (soaks() ? !method.uses_outline && !method.uses_corners
                  : method.id == "sheet" || method.id == "bounded" || method.id == "puppet")
        check_reports(method, seed);
}

TEST_CASE("Reports of sheets that are pulled far do not contradict themselves") {
  for (const unsigned seed : seeds_of("contradictions, far pulls", {3064923209u})) {
    INFO("seed " << seed);  // in the fixed case, a triangle of the drawn mesh is inverted
    std::mt19937 random(seed);
    Deformation deformation = random_deformation(method_named("sheet"), false, random);
    const double size = box_of(outline_of(deformation.rest)).diagonal();
    deformation.parameters["roundness"] = 0;
    for (Pin& pin : deformation.pins) {
      pin.pose = pin.rest + size * random_complex(random);
      if (random() % 2) pin.angle = 4 * random_complex(random).real();
    }
    deformation.keyframes.push_back({0, whole_pose_of(at_rest(deformation)), Ease::linear});
    deformation.keyframes.push_back({1, whole_pose_of(deformation)});
    TimedMap film(deformation);
    for (const double time : {0.97, 1.0}) check_report(report_of(film, film.frame(time)));
  }
}

TEST_CASE("Reports of maps of all sizes, and with holes, do not contradict themselves") {
  for (const unsigned seed : seeds_of("contradictions, sizes and holes", {1, 2}))
    for (const Method& method : methods())
      if (soaks() || method.id == "sheet" || method.id == "bounded" || method.id == "angles")
        check_reports(method, seed, true);
}

}  // namespace holomorph::contradictions_test
