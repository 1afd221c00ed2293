// Cages with several parts, and method `sheet` in them: each part is a sheet of its own, and parts
// without pins follow.
#include <cmath>

#include "core/cauchy/cauchy.h"
#include "core/geometry/orientation.h"
#include "core/maps/deformer.h"
#include "core/maps/distortion.h"
#include "core/maps/injectivity.h"
#include "core/maps/inverse.h"
#include "core/maps/method.h"
#include "core/mesh/mesher.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/pinned_rest.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::parts_test {

namespace {

using Catch::Contains;

Points moved(Points points, Complex by) {
  for (Complex& z : points) z += by;
  return points;
}

/// A frame around a star, and two to four further stars beside them; size about 1,000.
Cage random_parts(std::mt19937& random) {
  const auto star = [&random] {
    return shapes::star(5 + static_cast<int>(random() % 12), 0.6, random());
  };
  const auto placed = [](Points points, Complex at, double size) {
    const Box box = box_of(points);
    for (Complex& z : points) z = at + size / box.diagonal() * (z - box.center());
    return polygon_cage(points);
  };
  Cage cage = polygon_cage(shapes::rectangle(300, 300));
  add_hole(cage, reversed(polygon_cage(moved(shapes::rectangle(180, 200), {60, 50}))).segments);
  add_part(cage, placed(star(), {150, 150}, 140));
  const int others = 2 + static_cast<int>(random() % 3);
  for (int i = 0; i < others; ++i)
    add_part(cage, placed(star(), {500.0 + 300 * (i % 2), 120 + 330.0 * (i / 2)}, 200));
  return cage;
}

Rest rest_of(const Cage& cage, int vertices = 2000) {
  return rest_of(cage, {}, vertices);
}

/// A point well inside a part.
Complex middle_of(const Rest& rest, Index part) {
  const PartFinder finder(rest.cage);
  Complex best = 0;
  double deepest = -1;
  for (const Complex& z : rest.mesh->vertices) {
    const double depth = nearest_on_polygon(finder.outline(part), z).distance;
    if (finder.at(z) == part && depth > deepest) deepest = depth, best = z;
  }
  return best;
}

std::unique_ptr<Deformer> prepared(const Rest& rest) {
  return method_named("sheet").prepare(rest, nullptr);
}

}  // namespace

TEST_CASE("Parts: a cage is made of them and taken apart again") {
  for (const unsigned seed : seeds_of("cages of parts", {1, 2, 3})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Cage cage = random_parts(random);
    REQUIRE(!rest_fault(cage));
    CHECK(cage.has_holes());
    Cage again = part_of(cage, 0);
    double area = 0;
    for (Index p = 0; p < cage.part_count(); ++p) {
      if (p > 0) add_part(again, part_of(cage, p));
      area += area_of(flattened(part_of(cage, p)));
    }
    CHECK(again == cage);
    CHECK(area == Approx(area_of(flattened(cage))));
    CHECK(oriented(reversed(cage)).parts == cage.parts);
    for (Index l = 0; l < cage.loops().count(); ++l)
      CHECK(signed_area(vertices_of(loop_of(oriented(cage), l))) * (cage.is_hole(l) ? -1 : 1) > 0);
    for (Index p = 0; p < cage.part_count(); ++p) {
      Cage fewer = cage;
      erase_part(fewer, p);
      CHECK(fewer.part_count() == cage.part_count() - 1);
      for (Index other = 0; other < fewer.part_count(); ++other)
        CHECK(part_of(fewer, other) == part_of(cage, other < p ? other : other + 1));
      CHECK(!rest_fault(fewer));
    }
    // A vertex, and a hole in the middle part.
    Cage more = cage;
    insert_vertex(more, 9, 0.3);
    for (Index p = 2; p < cage.part_count(); ++p) CHECK(part_of(more, p) == part_of(cage, p));
    erase_vertex(more, 10, 0.3);
    CHECK(more == cage);
    add_hole(more, polygon_cage(Points{{0, 0}, {1, 0}, {0, 1}}).segments, 2);
    CHECK(part_of(more, 2).starts.size() == 1);
    CHECK(part_of(more, 3) == part_of(cage, 3));
    erase_hole(more, loops_of_part(more, 2).end - 1);
    CHECK(more == cage);
    // What is inside is inside one of the parts.
    const PartFinder finder(cage);
    for (int i = 0; i < 300; ++i) {
      const Complex z = Complex(400, 200) + 600.0 * random_complex(random);
      bool inside = false;
      for (Index p = 0; p < cage.part_count(); ++p) inside |= contains(part_of(cage, p), z);
      CHECK(contains(cage, z) == inside);
      if (inside) CHECK(contains(part_of(cage, finder.at(z)), z));
    }
  }
}

TEST_CASE("Parts: those that overlap are refused, with their names") {
  const Points square = shapes::rectangle(100, 100);
  Cage cage = polygon_cage(square);
  add_part(cage, polygon_cage(moved(square, {200, 0})));
  const auto message = [](const Cage& wrong) {
    return error_message_of([&] { check_rest_cage(wrong); });
  };
  CHECK(message(cage).empty());
  Cage crossing = cage;
  add_part(crossing, polygon_cage(moved(square, {250, 10})));
  CHECK_THAT(message(crossing), Contains("part 2 and part 3 of the rest cage cross"));
  Cage inside = cage;
  add_part(inside, polygon_cage(moved(shapes::rectangle(20, 20), {210, 30})));
  CHECK_THAT(message(inside), Contains("part 3 of the rest cage lies inside another part"));
  Cage outside = cage;
  add_hole(outside, polygon_cage(moved(shapes::rectangle(20, 20), {30, 30})).segments, 1);
  CHECK_THAT(message(outside), Contains("hole 1 of part 2 lies outside part 2"));
  add_hole(cage, polygon_cage(moved(shapes::rectangle(40, 40), {230, 30})).segments, 1);
  add_part(cage, polygon_cage(moved(shapes::rectangle(20, 20), {240, 40})));
  CHECK(message(cage).empty());

  // All other methods need one outline.
  const Rest rest = rest_of(cage, 600);
  for (const Method& method : methods()) {
    CAPTURE(method.id);
    const std::string said = error_message_of([&] { method.prepare(rest, nullptr); });
    if (method.allows_parts)
      CHECK(said.empty());
    else
      CHECK_THAT(said, Contains("one outline"));
  }
}

TEST_CASE("Parts: meshes of parts are joined, taken apart and made from triangles") {
  for (const unsigned seed : seeds_of("meshes of parts", {1, 2})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    const Cage cage = random_parts(random);
    const Mesh mesh = domain_mesh(cage, {1500});
    double area = 0;
    for (const Triangle& t : mesh.triangles) area += area_of(mesh, t);
    CHECK(area == Approx(area_of(flattened(cage))));
    REQUIRE(mesh.boundary_loops().count() == cage.loops().count());
    const std::vector<PartMesh> parts = parts_of(mesh, cage);
    std::vector<Mesh> meshes;
    for (size_t p = 0; p < parts.size(); ++p) {
      for (size_t v = 0; v < parts[p].numbers.size(); ++v)
        CHECK(parts[p].mesh.vertices[v] == mesh.vertices[static_cast<size_t>(parts[p].numbers[v])]);
      meshes.push_back(parts[p].mesh);
    }
    const Mesh again = joined(meshes);
    CHECK(again.vertices == mesh.vertices);
    CHECK(again.triangles == mesh.triangles);
    CHECK(again.boundary == mesh.boundary);
    CHECK(again.starts == mesh.starts);
    CHECK(again.cage_vertices == mesh.cage_vertices);
    const Mesh own = mesh_of(cage, mesh.vertices, mesh.triangles);
    CHECK(own.starts == mesh.starts);
    CHECK(own.cage_vertices == mesh.cage_vertices);
  }
}

TEST_CASE("Parts: pins act on their part, and the others follow the nearest one") {
  for (const unsigned seed : seeds_of("parts without pins", {1, 2, 3, 4})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    Rest rest = rest_of(random_parts(random));
    const Index parts = rest.cage.part_count();
    // Two pins in the frame and two in the third part; the star in the frame and others have none.
    rest.pins = {{{30, 150}}, {middle_of(rest, 2)}, {{270, 150}}, {middle_of(rest, 2) + 20.0}};
    Pose pose = at_rest(rest);
    for (PosePin& pin : pose.pins) pin.position += 60.0 * random_complex(random);
    const auto deformer = prepared(rest);
    const SampledMap map = deformer->deform(pose, {.derivatives = true});
    REQUIRE(map.status == SampledMap::Status::certified);
    CHECK(flipped_triangles(*rest.mesh, map.f) == 0);
    REQUIRE(map.turns.size() == 4);
    for (const auto& turn : map.turns) CHECK(turn);

    // The same maps as of each part alone.
    const std::vector<PartMesh> meshes = parts_of(*rest.mesh, rest.cage);
    const auto alone = [&](Index part, std::vector<size_t> pins) {
      Rest own = rest;
      own.cage = part_of(rest.cage, part);
      own.mesh = std::make_shared<const Mesh>(meshes[static_cast<size_t>(part)].mesh);
      own.samples = own.mesh->vertices;
      own.pins.clear();
      Pose posed{own.cage, {}};
      for (const size_t i : pins)
        own.pins.push_back(rest.pins[i]), posed.pins.push_back(pose.pins[i]);
      return prepared(own)->point_map(posed);
    };
    const auto frame = alone(0, {0, 2}), third = alone(2, {1, 3});
    const PartFinder finder(rest.cage);
    const auto points = deformer->point_map(pose);
    for (size_t i = 0; i < rest.samples.size(); ++i) {
      const Complex z = rest.samples[i], f = map.f[static_cast<Index>(i)];
      const Index part = finder.at(z);
      CHECK(std::abs(points->at(z).f - f) < 1e-9);
      if (part == 0) CHECK(std::abs(frame->at(z).f - f) < 1e-9);
      if (part == 2) CHECK(std::abs(third->at(z).f - f) < 1e-9);
    }
    // A loose part moves by the similarity of the nearest point of a part with pins, or as another
    // loose part that is nearer.
    const auto motion_of = [&](Index part) {
      size_t i = 0;
      while (finder.at(rest.samples[i]) != part) ++i;
      const Complex f = map.f[static_cast<Index>(i)], fz = map.fz[static_cast<Index>(i)];
      return std::pair(fz, f - fz * rest.samples[i]);
    };
    for (Index part = 1; part < parts; ++part) {
      if (part == 2) continue;
      const auto [factor, shift] = motion_of(part);
      for (size_t i = 0; i < rest.samples.size(); ++i) {
        if (finder.at(rest.samples[i]) != part) continue;
        const Index at = static_cast<Index>(i);
        CHECK(std::abs(map.f[at] - (factor * rest.samples[i] + shift)) < 1e-9);
        CHECK(std::abs(map.fz[at] - factor) < 1e-12);
        CHECK(map.fzbar[at] == 0.0);
      }
      Index nearest = -1;
      double distance = 1e300;
      Complex anchor = 0;
      for (Index other = 0; other < parts; ++other) {
        if (other == part) continue;
        const FlatCage &own = finder.outline(part), &theirs = finder.outline(other);
        const auto offer = [&](double here, Complex at) {
          if (here < distance) distance = here, nearest = other, anchor = at;
        };
        for (const Complex& z : own.points) {
          const NearestPoint near = nearest_on_polygon(theirs, z);
          offer(near.distance, near.point);
        }
        for (const Complex& z : theirs.points) offer(nearest_on_polygon(own, z).distance, z);
      }
      if (nearest == 0 || nearest == 2) {
        const PointMap::Value at = (nearest == 0 ? *frame : *third).at(anchor);
        CHECK(std::abs(at.fz - factor) < 1e-9);
        CHECK(std::abs(factor * anchor + shift - at.f) < 1e-9);
      } else {
        CHECK(std::abs(motion_of(nearest).first - factor) < 1e-12);
        CHECK(std::abs(motion_of(nearest).second - shift) < 1e-9);
      }
    }

    // By the switch, they stay.
    rest.parameters["loose_stay"] = 1;
    const SampledMap still = prepared(rest)->deform(pose, {});
    for (size_t i = 0; i < rest.samples.size(); ++i) {
      const Index part = finder.at(rest.samples[i]), at = static_cast<Index>(i);
      if (part == 0 || part == 2)
        CHECK(still.f[at] == map.f[at]);
      else
        CHECK(std::abs(still.f[at] - rest.samples[i]) < 1e-12);
    }
  }
}

TEST_CASE("Parts: pins are named by their numbers in the picture") {
  std::mt19937 random(3);
  Rest rest = rest_of(random_parts(random));
  rest.pins = {{middle_of(rest, 2)}, {{30, 150}}, {{30, 20}}, {{-50, 20}}};
  Pose pose = at_rest(rest);
  rest.parameters["pin_weight"] = 100;
  pose.pins[2].position += Complex(0, -3000);  // too far for so weak a pull
  const SampledMap map = prepared(rest)->deform(pose, {});
  CHECK_THAT(map.note, Contains("Ignored: pin 4 (outside the cage)"));
  CHECK_THAT(map.note, Contains("Pin 2 stops") || Contains("Pin 3 stops"));
  CHECK(!map.turns[3]);
}

TEST_CASE("Parts: drafts, rigid motions, inverses and motion are those of all parts") {
  for (const unsigned seed : seeds_of("motion of parts", {1, 2})) {
    std::mt19937 random(seed);
    CAPTURE(seed);
    Rest rest = rest_of(random_parts(random), 1200);
    rest.pins = {{{30, 150}}, {middle_of(rest, 2)}, {{270, 150}}, {middle_of(rest, 3)}};
    const auto deformer = prepared(rest);
    const Pose start = at_rest(rest);
    SampledMap draft = deformer->deform(start, {});
    CHECK((draft.f - Eigen::Map<const VectorXc>(rest.samples.data(), draft.f.size()))
              .cwiseAbs()
              .maxCoeff() == 0);
    Pose end = start;
    end.pins[0].position += Complex(-40, 30);
    end.pins[3].position += Complex(90, -20);
    for (int step = 0; step < 30; ++step)
      draft = deformer->deform(end, {.draft = true}, draft.solution.get());
    const SampledMap last = deformer->deform(end, {});
    CHECK((draft.f - last.f).cwiseAbs().maxCoeff() < 1);
    CHECK(injectivity_of(*rest.mesh, last.f).folds_at.empty());

    // A rigid motion of all pins moves all parts rigidly.
    const Complex turn = std::polar(1.0, 0.7), shift(30, -80);
    Pose rigid = start;
    for (PosePin& pin : rigid.pins) {
      pin.position = turn * pin.position + shift;
      pin.turn = 0.7;
    }
    Pose turned = rigid;
    rest.pins[1].has_frame = rest.pins[3].has_frame = true;  // single pins do not tell the turn
    turned.pins[1].angle = turned.pins[3].angle = 0.7;
    const SampledMap moved_map = prepared(rest)->deform(turned, {});
    for (size_t i = 0; i < rest.samples.size(); ++i)
      CHECK(std::abs(moved_map.f[static_cast<Index>(i)] - (turn * rest.samples[i] + shift)) < 1e-9);

    // In between.
    const auto motion = deformer->motion();
    REQUIRE(motion);
    const SampledMap first = deformer->deform(start, {});
    const MotionKey from{first.solution, first.extremes, &start, &first.f, 0, 0},
        to{last.solution, last.extremes, &end, &last.f, 0, 1};
    const auto interval = motion->interval(nullptr, from, to, nullptr, false);
    REQUIRE(interval);
    for (const double u : {0.1, 0.5, 0.9}) {
      const SampledMap between = interval->at(u, true);
      CHECK(between.status == SampledMap::Status::certified);
      REQUIRE(between.f.size() == first.f.size());
      REQUIRE(between.fz.size() == first.f.size());
      CHECK(between.extremes);
      CHECK(flipped_triangles(*rest.mesh, between.f) == 0);
    }
    for (const double u : {1e-6, 1 - 1e-6})
      CHECK((interval->at(u, false).f - (u < 0.5 ? first.f : last.f)).cwiseAbs().maxCoeff() < 0.01);

    // Another deformer with the same mesh takes over what it can, and finds the same map.
    Rest more = rest;
    more.pins.push_back({middle_of(rest, 1)});
    Pose more_end = end;
    more_end.pins.push_back({more.pins.back().position + 10.0});
    const auto fresh = prepared(more)->deform(more_end, {});
    const auto reused = method_named("sheet").prepare(more, deformer.get())->deform(more_end, {});
    CHECK(fresh.f == reused.f);
  }
}

}  // namespace holomorph::parts_test
