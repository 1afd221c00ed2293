// Surfaces: read, checked, flattened, placed in the plane.
#include <Eigen/Geometry>

#include "core/error.h"
#include "core/geometry/curve.h"
#include "core/mesh/flatten.h"
#include "scene/document.h"
#include "scene/flattened_surface.h"
#include "scene/formats/scene_json.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "system/new_file.h"

namespace holomorph::surface_test {

namespace {

Surface surface_of(const std::string& text) {
  return surface_of_obj(text, "s.obj").surface;
}

Surface sample(const std::string& name) {
  return surface_of(read_file(std::string(HOLOMORPH_SOURCE) + "/assets/" + name));
}

/// A grid of squares, each split into two triangles, mapped into space.
Surface grid(int n, const std::function<Eigen::Vector3d(double, double)>& place) {
  Surface surface;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      surface.vertices.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / n));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      surface.triangles.push_back({a, b, d});
      surface.triangles.push_back({a, d, c});
    }
  return surface;
}

/// The largest ratio of a triangle's singular values under the flattening, less 1.
double worst_angle(const Surface& surface, const Points& flat) {
  double worst = 0;
  for (const auto& t : surface.triangles) {
    const Eigen::Vector3d p = surface.vertices[static_cast<size_t>(t[0])],
                          u = surface.vertices[static_cast<size_t>(t[1])] - p,
                          v = surface.vertices[static_cast<size_t>(t[2])] - p;
    const Complex a(u.norm(), 0), b(v.dot(u) / u.norm(), u.cross(v).norm() / u.norm());
    const Complex fa = flat[static_cast<size_t>(t[1])] - flat[static_cast<size_t>(t[0])],
                  fb = flat[static_cast<size_t>(t[2])] - flat[static_cast<size_t>(t[0])];
    // f = alpha z + beta conj(z) on the triangle.
    const Complex det = a * std::conj(b) - b * std::conj(a);
    const Complex alpha = (fa * std::conj(b) - fb * std::conj(a)) / det,
                  beta = (a * fb - b * fa) / det;
    worst = std::max(worst, 2 * std::abs(beta) / (std::abs(alpha) - std::abs(beta)));
  }
  return worst;
}

/// Relative error when three sums over at most 2232 triangles are rounded to 2^-53 at each step:
/// 7e-13 at worst.
constexpr double kSumRounding = 1e-12;

double twice_area(const Surface& surface) {
  double area = 0;
  for (const auto& t : surface.triangles)
    area +=
        (surface.vertices[static_cast<size_t>(t[1])] - surface.vertices[static_cast<size_t>(t[0])])
            .cross(surface.vertices[static_cast<size_t>(t[2])] -
                   surface.vertices[static_cast<size_t>(t[0])])
            .norm();
  return area;
}

}  // namespace

TEST_CASE("OBJ: polygons, texture coordinates, negative indices, comments and line endings") {
  const SurfaceFile file = surface_of_obj(
      "# a square\r\nmtllib x.mtl\nv 0 0 0\nv 1 0 0 # corner\nv 1 1 0\nv 0 1 0\nv 9 9 9\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 -3/-2/1 4/4/1\r\n",
      "s.obj");
  CHECK(file.surface.vertices.size() == 4);  // the fifth has no face
  CHECK(file.surface.triangles == std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}});
  CHECK(file.texture == Points{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  CHECK(surface_of_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "s.obj").texture.empty());
  // A seam: vertex 1 has two positions in the texture.
  CHECK(surface_of_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nvt 0 0\nvt 1 1\n"
                       "f 1/1 2/1 3/1\nf 1/2 4/1 2/1\n",
                       "s.obj")
            .texture.empty());
}

TEST_CASE("OBJ: damaged data are rejected with the line") {
  const auto complaint = [](const std::string& text) {
    return error_message_of([&] { surface_of_obj(text, "s.obj"); });
  };
  CHECK_THAT(complaint("v 0 0 0\nv 1 x 0\n"),
             Catch::Contains("s.obj: line 2") && Catch::Contains("'x'"));
  CHECK_THAT(complaint("v 0 0\n"), Catch::Contains("line 1"));
  CHECK_THAT(complaint("v 0 0 inf\n"), Catch::Contains("line 1"));
  CHECK_THAT(complaint("v 0 0 0\nf 1 2 3\n"),
             Catch::Contains("line 2") && Catch::Contains("no such"));
  CHECK_THAT(complaint("v 0 0 0\nf 0 1 1\n"), Catch::Contains("no such"));
  CHECK_THAT(complaint("v 0 0 0\nv 1 0 0\nf 1 2\n"), Catch::Contains("three vertices"));
  CHECK_THAT(complaint("v 0 0 0\n"), Catch::Contains("no face"));
  CHECK_THAT(complaint(""), Catch::Contains("no face"));
}

TEST_CASE("Surfaces that are not disks are rejected with the reason") {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 3 0 0\n";
  const auto refused = [&](const std::string& faces) -> std::string {
    try {
      disk_boundary(surface_of(square + faces));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(disk_boundary(surface_of(square + "f 1 2 3 4\n")) == std::vector<int>{0, 1, 2, 3});
  CHECK_THAT(refused("f 1 2 3\nf 1 3 2\n"), Catch::Contains("closed"));
  CHECK_THAT(refused("f 1 2 3\nf 5 6 7\n"), Catch::Contains("several parts"));
  CHECK_THAT(refused("f 1 2 3\nf 1 2 4\n"), Catch::Contains("opposite orientation"));
  CHECK_THAT(refused("f 1 2 4\nf 2 5 6\n"), Catch::Contains("touches itself"));
  CHECK_THAT(refused("f 1 1 2\n"), Catch::Contains("twice"));
  // A ring of squares around a hole.
  std::string ring, faces;
  for (int k = 0; k < 6; ++k) {
    ring += "v " + std::to_string(std::cos(k)) + " " + std::to_string(std::sin(k)) + " 0\nv " +
            std::to_string(2 * std::cos(k)) + " " + std::to_string(2 * std::sin(k)) + " 0\n";
    const auto n = [&](int i) { return std::to_string(1 + i % 12) + " "; };
    faces += "f " + n(2 * k) + n(2 * k + 1) + n(2 * k + 3) + n(2 * k + 2) + "\n";
  }
  CHECK_THROWS_WITH(disk_boundary(surface_of(ring + faces)), Catch::Contains("hole"));
}

TEST_CASE("A developable surface is flattened without distortion, upright and with the same area") {
  // A sheet that is rolled into an arc around a slanted axis keeps all lengths.
  const Eigen::Vector3d up = Eigen::Vector3d(0.2, 0.9, 0.1).normalized(), out = up.unitOrthogonal(),
                        across = up.cross(out);
  const Surface sheet = grid(12, [&](double s, double t) -> Eigen::Vector3d {
    const double angle = 1.5 * (s - 0.5);
    return 2 / 1.5 * (std::sin(angle) * across + std::cos(angle) * out) + t * up;
  });
  const Points flat = flattened(sheet, Flattening::lscm);
  CHECK(worst_angle(sheet, flat) < 1e-3);
  const Box box = box_of(flat);
  CHECK(box.left == Approx(0).margin(1e-12));
  CHECK(box.bottom == Approx(0).margin(1e-12));
  double area = 0;
  for (const auto& t : sheet.triangles)
    area += cross(flat[static_cast<size_t>(t[1])] - flat[static_cast<size_t>(t[0])],
                  flat[static_cast<size_t>(t[2])] - flat[static_cast<size_t>(t[0])]);
  CHECK(area == Approx(twice_area(sheet)).epsilon(kSumRounding));
  // Up is the direction in which the surface's y grows, here nearly along the axis.
  CHECK((flat[12 * 13] - flat[0]).imag() > 0.85);
}

TEST_CASE("The samples are flattened without folds and nearly conformally by both methods") {
  for (const char* name : {"mask.obj", "leaf.obj"})
    for (const Flattening how : {Flattening::lscm, Flattening::circle}) {
      const Surface surface = sample(name);
      const Points flat = flattened(surface, how);  // throws if a triangle is inverted
      INFO(name << " " << static_cast<int>(how));
      double area = 0, off = 0;
      for (const auto& t : surface.triangles)
        area += cross(flat[static_cast<size_t>(t[1])] - flat[static_cast<size_t>(t[0])],
                      flat[static_cast<size_t>(t[2])] - flat[static_cast<size_t>(t[0])]);
      CHECK(area == Approx(twice_area(surface)).epsilon(kSumRounding));
      if (how == Flattening::lscm) continue;
      const Complex centre = box_of(flat).center();
      const double radius = 0.5 * box_of(flat).width();
      for (const int v : disk_boundary(surface))
        off = std::max(off, std::abs(std::abs(flat[static_cast<size_t>(v)] - centre) - radius));
      CHECK(off < 0.01 * radius);
    }
  CHECK(worst_angle(sample("mask.obj"), flattened(sample("mask.obj"), Flattening::lscm)) < 1);
}

TEST_CASE("A placed surface is recovered from its own outline, and from no other") {
  const Surface mask = sample("mask.obj");
  Box onto;
  onto.include({100, 50});
  onto.include({700, 650});
  for (const Flattening how : {Flattening::lscm, Flattening::circle}) {
    const FlattenedSurface laid = flattened_onto(mask, how, onto);
    CHECK(std::abs(box_of(laid.plane).center() - onto.center()) < 1e-9);
    // A dozen operations on coordinates below 1024, each rounded to 2^-44 = 6e-14.
    CHECK_THAT(box_of(laid.plane).diagonal(), Catch::WithinAbs(onto.diagonal(), 1e-12));
    CHECK(signed_area(laid.outline()) > 0);
    Points outline = laid.outline();
    const FlattenedSurface again = aligned_with_outline({mask, flattened(mask, how)}, outline);
    for (size_t i = 0; i < laid.plane.size(); ++i)
      REQUIRE(std::abs(again.plane[i] - laid.plane[i]) < 1e-6);
    for (Complex& z : outline) z = std::polar(2.0, 0.7) * z + Complex(5, 9);  // moved by the user
    CHECK(std::abs(aligned_with_outline(laid, outline).plane[3] -
                   (std::polar(2.0, 0.7) * laid.plane[3] + Complex(5, 9))) < 1e-5);
    outline[4] += 5.0;
    CHECK_THROWS_WITH(aligned_with_outline(laid, outline), Catch::Contains("not this surface's"));
    CHECK_THROWS_WITH(aligned_with_outline(laid, Points{{0, 0}, {1, 0}, {0, 1}}),
                      Catch::Contains("not this surface's"));
  }
}

TEST_CASE("A scene's surface is found wherever the scene is saved, and errors say what is wrong") {
  const Path folder = std::filesystem::temp_directory_path() / "holomorph-surface-test";
  std::filesystem::create_directories(folder / "inside");
  const std::string file = std::string(HOLOMORPH_SOURCE) + "/assets/mask.obj";
  Box onto;
  onto.include({0, 0});
  onto.include({300, 400});
  Deformation deformation =
      with_cage(Deformation{}, Points{{0, 0}, {300, 0}, {300, 400}, {0, 400}});
  CHECK_THROWS_WITH(flattened_surface_of(deformation), Catch::Contains("no surface"));
  deformation.outline = flattened_onto(sample("mask.obj"), Flattening::circle, onto).outline();
  deformation.surface = SurfaceReference{file, Flattening::circle, R"({"kept":1})"};
  for (const Path& at : {folder / "s.json", folder / "inside" / "s.json"}) {
    write_file(at, json_of(portable(scene_of(deformation), at.parent_path())));
    CHECK_THAT(read_file(at), Catch::Contains("\"../") && Catch::Contains("\"kept\": 1"));
    const Deformation again = load_scene(at, {false, {true}}).scene.deformation();
    CHECK(again.surface == deformation.surface);
    CHECK(flattened_surface_of(again).plane.size() == sample("mask.obj").vertices.size());
  }
  CHECK(portable(scene_of(deformation), {}).deformation().surface ==
        deformation.surface);  // as in an autosave
  Deformation other = deformation;
  other.surface->flattening = Flattening::lscm;
  CHECK_THROWS_WITH(flattened_surface_of(other),
                    Catch::Contains("mask.obj") && Catch::Contains("not this surface's"));
  other.surface->file = (folder / "gone.obj").string();
  CHECK_THROWS_WITH(flattened_surface_of(other),
                    Catch::Contains("gone.obj") && Catch::Contains("no such file"));
  const auto complaint = [](const std::string& surface) {
    return error_message_of([&] {
      scene_from_json(R"({"format": "holomorph", "version": 1, "cage": {"rest": []}, )"
                      R"("outline": [[0, 0], [1, 0], [0, 1]], "surface": )" +
                          surface + "}",
                      "s.json");
    });
  };
  CHECK_THAT(complaint("{}"), Catch::Contains("/surface") && Catch::Contains("'file'"));
  CHECK_THAT(complaint(R"({"file": ""})"), Catch::Contains("/surface/file"));
  CHECK_THAT(complaint(R"({"file": "x.obj", "flattening": "magic"})"),
             Catch::Contains("/surface/flattening") && Catch::Contains("lscm, circle"));
  std::filesystem::remove_all(folder);
}

TEST_CASE(
    "A textured surface opens as its picture with a cage; for others, the error says what is "
    "missing") {
  const Path folder = std::filesystem::temp_directory_path() / "holomorph-textured-test";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(std::string(HOLOMORPH_SOURCE) + "/assets/fish.png",
                             folder / "my fish.png",
                             std::filesystem::copy_options::overwrite_existing);
  const std::string square =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.1 0.1\nvt 0.9 0.1\nvt 0.9 0.9\nvt 0.1 0.9\n"
      "f 1/1 2/2 3/3 4/4\n";
  write_file(folder / "my.mtl", material_of("my fish.png"));
  write_file(folder / "s.obj", "mtllib my.mtl\r\n" + square);
  const Document document = Document::open(folder / "s.obj");
  REQUIRE(document.image());
  CHECK(document.image_path().filename() == "my fish.png");
  CHECK(!document.modified());
  REQUIRE(document.scene().deformation().rest.size() == 4);
  CHECK(std::abs(document.scene().deformation().rest.segments[2][0] -
                 Complex(0.9 * document.image()->width, 0.9 * document.image()->height)) < 1e-9);
  write_file(folder / "bare.obj", square);
  CHECK_THROWS_WITH(Document::open(folder / "bare.obj"), Catch::Contains("no texture picture"));
  write_file(folder / "lost.obj", "mtllib lost.mtl\n" + square);
  CHECK_THROWS_WITH(Document::open(folder / "lost.obj"), Catch::Contains("lost.mtl"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("A written surface is read back with its texture coordinates") {
  const Surface leaf = sample("leaf.obj");
  Points texture = flattened(leaf, Flattening::lscm);
  const Box box = box_of(texture);
  for (Complex& z : texture) z = {z.real() / box.width(), z.imag() / box.height()};
  const SurfaceFile again = surface_of_obj(obj_of(leaf, texture, "leaf.mtl"), "leaf.obj");
  REQUIRE(again.texture.size() == texture.size());
  CHECK(again.surface.triangles == leaf.triangles);
  for (size_t i = 0; i < texture.size(); ++i) {
    CHECK(std::abs(again.texture[i] - texture[i]) < 1e-8);
    CHECK((again.surface.vertices[i] - leaf.vertices[i]).norm() < 1e-8);
  }
  const Points boundary = texture_boundary(again, {0, 0, 200, 100});
  CHECK(box_of(boundary).width() == Approx(200).epsilon(0.01));
  CHECK(box_of(boundary).height() == Approx(100).epsilon(0.01));
  CHECK_THROWS_WITH(texture_boundary({leaf, {}}, {0, 0, 10, 10}), Catch::Contains("no texture"));
}

TEST_CASE("Materials: the first picture, whatever blanks, options and slashes surround its name") {
  CHECK(texture_of_materials("newmtl a\nKd 1 1 1\n  map_Kd\tmy fish.png \r\nmap_Kd b.png\n") ==
        "my fish.png");
  CHECK(texture_of_materials("map_Kd -s 1 1 1 -clamp on folder\\a #2.png") == "folder/a #2.png");
  CHECK(texture_of_materials("map_Kdx a.png\nmap_Ka b.png\n").empty());
  CHECK(texture_of_materials("").empty());
  CHECK(surface_of_obj("mtllib fish #2.mtl \r\nv 0 0 0\nv 1 0 0 # a\nv 0 1 0\nf 1 2 3\n", "s.obj")
            .materials == "fish #2.mtl");
}

}  // namespace holomorph::surface_test
