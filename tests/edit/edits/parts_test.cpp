// Edits to cages with several parts.
#include "core/cauchy/inside.h"
#include "edit/edits/hole_edits.h"
#include "edit/edits/method_edits.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/part_pictures.h"

namespace holomorph::edit_parts_test {

TEST_CASE("Parts: other methods get one outline around them, posed as they were") {
  for (const std::string id : {"cage", "pins", "puppet"}) {
    const Deformation before = scene_with_parts().deformation(), after = with_method(before, id);
    CHECK(after.rest.part_count() == 1);
    CHECK(!rest_fault(after.rest));
    CHECK(playing_keys(after).size() == 2);
    const Inside inside(after.rest);
    for (const Complex& z : vertices_of(before.rest)) {
      const bool deep = nearest_on_polygon(flattened(after.rest), z).distance > 2;
      if (deep) CHECK(inside.contains(z));
    }
    for (const Pin& pin : after.pins) CHECK(inside.contains(pin.rest));
    CHECK(after.pose == after.rest);
    // The last keyframe has moved a point of the old cage.
    double farthest = 0;
    const Cage& key = after.keyframes[1].pose.cage;
    for (Index e = 0; e < key.size(); ++e)
      farthest = std::max(farthest, std::abs(key.vertex(e) - after.rest.vertex(e)));
    CHECK(farthest <= 5 + 1e-9);
    CHECK(farthest > 0);
    CHECK(prepared_map(after, Precision::single, {500})->mesh->vertices.size() > 100);
  }
}

TEST_CASE("Parts: holes are added to the part around them") {
  Deformation deformation = scene_with_parts().deformation();
  Points triangle{{285, 95}, {300, 95}, {290, 105}};
  const Deformation more = with_hole(deformation, polygon_cage(triangle));
  const Index bar = PartFinder(deformation.rest).at({290, 100});
  CHECK(part_of(more.rest, bar).starts.size() == 1);
  for (Index p = 0; p < 3; ++p)
    if (p != bar) CHECK(part_of(more.rest, p) == part_of(deformation.rest, p));
  CHECK(playing_keys(more).size() == 2);
  CHECK(filled(more, {}).rest.has_holes() == false);
  CHECK(without_hole(more, loops_of_part(more.rest, bar).end - 1).rest == deformation.rest);
}

TEST_CASE("Parts: close parts stay together in one outline, with their pins") {
  // Two squares with a gap of four pixels in a picture of 1,000 pixels.
  Deformation deformation = with_cage({}, Points{{0, 0}, {498, 0}, {498, 400}, {0, 400}});
  add_part(deformation.rest, polygon_cage(Points{{502, 0}, {1000, 0}, {1000, 400}, {502, 400}}));
  deformation.pose = deformation.rest;
  deformation.method = "sheet";
  for (const double x : {250.0, 750.0}) deformation.pins.push_back({{x, 200}, {x, 200}, {}, {}});
  const Deformation after = with_method(deformation, "pins");
  CHECK(after.rest.part_count() == 1);
  for (const Pin& pin : after.pins) CHECK(contains(after.rest, pin.rest));
}

TEST_CASE("Parts: deleting all points of one deletes it, but not the last one") {
  const Scene scene = scene_with_parts();
  const Deformation& before = scene.deformation();
  const auto points_of = [&](Index part) {
    Selection selection;
    const auto [first, end] = loops_of_part(before.rest, part);
    for (Index i = before.rest.loops().first(first); i < before.rest.loops().end(end - 1); ++i)
      selection.insert({Handle::Kind::cage, i, 0});
    return selection;
  };
  for (Index part = 0; part < 3; ++part) {
    const Deformation after = erased(before, points_of(part));
    CHECK(after.rest.part_count() == 2);
    CHECK(after == without_part(before, part));
    CHECK(playing_keys(after).size() == 2);
    CHECK(scene_from_json(json_of(with_deformation(scene, after)), "again").deformation() == after);
  }
  Selection all = points_of(0);
  for (const Index part : {1, 2}) all.merge(points_of(part));
  CHECK_THROWS_AS(erased(before, all), Error);
}

TEST_CASE("Parts: unknown keys stay with their part") {
  std::string text = json_of(scene_with_parts());
  const size_t at = text.find("\"parts\": [");
  text.insert(text.find('{', at) + 1, "\"name\": \"eye\", ");
  const Scene named = scene_from_json(text, "named");
  CHECK_THAT(json_of(named), Catch::Contains("\"name\": \"eye\""));
  const auto without = [&](Index part) {
    return json_of(with_deformation(named, without_part(named.deformation(), part)));
  };
  CHECK_THAT(without(0), !Catch::Contains("eye"));  // it has become the first part
  CHECK_THAT(without(2), Catch::Contains("eye"));
}

}  // namespace holomorph::edit_parts_test
