// Benchmarks of coordinates, of preparing maps, and of their inverses.
#include <array>
#include <random>

#include "bench/measures.h"
#include "bench/wavy.h"
#include "core/cauchy/cauchy.h"
#include "core/clock.h"
#include "core/maps/inverse.h"
#include "core/mesh/mesher.h"
#include "core/methods/linear.h"
#include "scene/prepared_map.h"
#include "scene/timed_map.h"

namespace holomorph::bench {
namespace {

/// The number of vertices to request for a mesh of about 15000.
constexpr int kRequestedVertices = 13000;

}  // namespace

Kernel avx2_or_portable() {
  return has_avx2() ? Kernel::avx2 : Kernel::portable;
}

template <class T>
double coordinates_ns(Kernel kernel, int order, int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  const Mesh mesh = domain_mesh(cage, {kRequestedVertices});
  PlanarMatrix<T> out;
  const double ms = median_ms(
      runs, [&] { planar_coordinates<T>(polygon_cage(cage), mesh.vertices, order, kernel, out); });
  return ms * 1e6 / (static_cast<double>(mesh.vertices.size()) * 100);
}

template double coordinates_ns<float>(Kernel, int, int);
template double coordinates_ns<double>(Kernel, int, int);

double random_coordinates_ns(int runs) {
  const Points cage = wavy(32, {500, 500}, 350);
  std::mt19937 random(1);
  Points points;
  while (points.size() < 15000) {
    const auto unit = [&] { return 1000.0 * static_cast<double>(random()) / 4294967296.0; };
    const double x = unit(), y = unit();
    if (encloses(PolygonView(cage), {x, y})) points.push_back({x, y});
  }
  PlanarMatrix<float> out;
  const double ms = median_ms(runs, [&] {
    planar_coordinates<float>(polygon_cage(cage), points, 0, avx2_or_portable(), out);
  });
  return ms * 1e6 / (static_cast<double>(points.size()) * 32);
}

double million_points_ms(int runs) {
  TimedMap map(scene_with(wavy(32, {500, 500}, 350)));
  const TimedFrame frame = map.frame({});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, 1000);
  std::array<Points, 2> points;
  for (Points& each : points)
    for (int i = 0; i < 1'000'000; ++i) each.push_back({place(random), place(random)});
  size_t call = 0;  // at() keeps what it prepared for the last points, so the points alternate
  return median_ms(runs, [&] { map.values_in_cage(frame, points[call++ % 2]); });
}

double scalar_log_ns(int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  const Mesh mesh = domain_mesh(cage, {1500});
  volatile double sum = 0;  // volatile keeps the compiler from removing the loop
  const double ms = median_ms(runs, [&] {
    for (const Complex& z : mesh.vertices)
      for (size_t e = 0; e < cage.size(); ++e)
        sum = std::log((cage[(e + 1) % cage.size()] - z) / (cage[e] - z)).imag();
  });
  return ms * 1e6 / (static_cast<double>(mesh.vertices.size()) * 100);
}

double curved_prepare_ms(int runs) {
  Deformation deformation;
  deformation.rest = wavy_curves(20, 3, 0.2);
  deformation.pose = wavy_curves(20, 3, 0.1);
  return median_ms(runs, [&] { prepared_map(deformation, Precision::single, {8700}); });
}

PolygonRoute polygon_route() {
  const Cage rest = wavy_curves(20, 3, 0.2);
  const Mesh domain = domain_mesh(rest, {8700});
  const double start = now_ms();
  const Cage polygon = elevated_to(polygon_cage(vertices_of(rest)), rest);
  const Mesh mesh = domain_mesh(vertices_of(rest), {4000});
  SumMap u1;
  u1.terms.emplace_back(polygon, controls_of(rest) - controls_of(polygon));
  Points image;
  for (const Complex& z : mesh.vertices) image.push_back(u1.at(z).f);
  const InverseMap inverse(polygon, mesh, image, u1);
  int missing = 0;
  for (const Complex& z : domain.vertices) missing += inverse.at(z).empty();
  return {100.0 * missing / static_cast<double>(domain.vertices.size()), now_ms() - start};
}

double raised_coordinates_ns(int degree, int runs) {
  const Cage straight = polygon_cage(wavy(100, {500, 500}, 350));
  Cage raised = straight;
  for (Points& segment : raised.segments) segment.resize(degree);
  raised = elevated_to(straight, raised);
  const Mesh mesh = domain_mesh(straight, {kRequestedVertices});
  PlanarMatrix<float> out;
  const double ms = median_ms(
      runs, [&] { planar_coordinates<float>(raised, mesh.vertices, 0, avx2_or_portable(), out); });
  return ms * 1e6 / (static_cast<double>(mesh.vertices.size()) * 100);
}

double inverse_ms(int runs) {
  Deformation deformation;
  deformation.rest = polygon_cage(wavy(20, {500, 500}, 350));
  deformation.pose = wavy_curves(20, 3, 0.15);
  TimedMap map(deformation);
  const auto inverse = map.inverse(map.frame({}));
  const Mesh& mesh = map.mesh();
  Points targets;  // a quarter of them near the boundary
  for (size_t i = 0; i < 10000; ++i) {
    const Triangle& t = mesh.triangles[i * 7919 % mesh.triangles.size()];
    const size_t b = i % mesh.boundary.size(), next = (b + 1) % mesh.boundary.size();
    const Complex center = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0,
                  side = mesh.vertices[mesh.boundary[next]] - mesh.vertices[mesh.boundary[b]],
                  edge = mesh.vertices[mesh.boundary[b]] + (0.5 + 1e-4 * kI) * side;
    targets.push_back(inverse->map->at(i % 4 ? center : edge).f);
  }
  return median_ms(runs, [&] { inverse->at(targets); });
}

double mesh_ms(int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  return median_ms(runs, [&] { domain_mesh(cage, {kRequestedVertices}); });
}

double coordinates_ms(int runs) {
  const Points cage = wavy(100, {500, 500}, 350);
  const Mesh mesh = domain_mesh(cage, {kRequestedVertices});
  return median_ms(runs, [&] { planar_coordinates<float>(polygon_cage(cage), mesh.vertices); });
}

double prepare_ms(int points, int runs) {
  const Deformation deformation = scene_with(wavy(points, {500, 500}, 350));
  return median_ms(runs,
                   [&] { prepared_map(deformation, Precision::single, {kRequestedVertices}); });
}

double prepare_method_ms(const char* method, int points, int runs) {
  Deformation deformation = scene_with(wavy(points, {500, 500}, 350));
  const auto before = prepared_map(deformation, Precision::single, {7500});
  deformation.method = method;
  for (const Complex z : {Complex(400, 450), Complex(500, 650), Complex(600, 400)})
    deformation.pins.push_back({z, z, {}, {}});
  const Points stroke{{400, 500}, {500, 520}, {600, 500}};
  deformation.strokes.push_back({stroke, stroke, {}});
  return median_ms(runs,
                   [&] { prepared_map(deformation, Precision::single, {7500}, before.get()); });
}

double frame_ms(int runs) {
  const Deformation deformation = scene_with(wavy(100, {500, 500}, 350));
  const auto prepared = prepared_map(deformation, Precision::single, {kRequestedVertices});
  SampledMap map;
  return median_ms(runs, [&] { map = prepared->deformer->deform(pose_of(deformation), {}); });
}

double add_pin_ms(int runs) {
  Deformation deformation = scene_with(wavy(100, {500, 500}, 350));
  deformation.method = usual_method(MethodUse::pins).id;
  for (int i = 0; i < 10; ++i)
    deformation.pins.push_back(
        {Complex(500, 500) + std::polar(150.0, 0.6 * i), {500, 500}, {}, {}});
  const auto before = prepared_map(deformation, Precision::single, {kRequestedVertices});
  deformation.pins.push_back({{510, 520}, {510, 520}, {}, {}});
  return median_ms(runs, [&] {
    prepared_map(deformation, Precision::single, {kRequestedVertices}, before.get());
  });
}

}  // namespace holomorph::bench
