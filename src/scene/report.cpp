// Measured on the default domain mesh.
#include "scene/report.h"

#include <nlohmann/json.hpp>

#include "core/cauchy.h"
#include "core/clock.h"
#include "core/injectivity.h"

namespace holomorph {
namespace {

/// mean |f_zz|^2 L^2 by the difference of f_z over mesh edges, area-weighted per triangle.
double smoothness(const Mesh& mesh, const Points& samples, const SampledMap& map, double length) {
  double energy = 0, total = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Complex a = samples[j] - samples[i], b = samples[k] - samples[i];
    const double area = cross(a, b);
    if (!(area > 0)) continue;
    const Complex slope = ((map.fz[j] - map.fz[i]) / a + (map.fz[k] - map.fz[i]) / b) / 2.0;
    energy += area * std::norm(slope);
    total += area;
  }
  return total > 0 ? energy / total * length * length : 0;
}

double pin_distance(const PreparedMap& prepared, const Scene& scene) {
  if (prepared.rest.pins.empty()) return 0;
  Rest rest = prepared.rest;
  rest.samples.clear();
  rest.derivative_samples.clear();
  Points targets;
  for (size_t i = 0; i < rest.pins.size(); ++i)
    if (contains(rest.cage, rest.pins[i].position)) {
      rest.samples.push_back(rest.pins[i].position);
      targets.push_back(scene.pins[i].pose);
    }
  if (targets.empty()) return 0;
  SampledMap map;
  method_named(prepared.method).prepare(rest, nullptr)->deform(pose_of(scene), map, {});
  double sum = 0;
  for (size_t i = 0; i < targets.size(); ++i)
    sum += std::norm(map.f[static_cast<Index>(i)] - targets[i]);
  return std::sqrt(sum / static_cast<double>(targets.size()));
}

}  // namespace

const char* name_of(SampledMap::Status status) {
  switch (status) {
    case SampledMap::Status::exact:
      return "exact";
    case SampledMap::Status::iterating:
      return "iterating";
    case SampledMap::Status::certified:
      return "certified";
    case SampledMap::Status::infeasible:
      return "infeasible";
  }
  return "";
}

SceneReport report_of(const Scene& scene) {
  const auto prepared = prepared_map(scene, Precision::full, MeshOptions{});
  SampledMap map;
  prepared->deformer->deform(pose_of(scene), map, {true});
  const double start = now_ms();
  SampledMap again;
  prepared->deformer->deform(pose_of(scene), again, {});
  SceneReport report;
  report.pose_milliseconds = now_ms() - start;
  report.method = scene.method;
  report.status = name_of(map.status);
  report.note = map.note;
  report.iterations = map.iterations;
  report.cage_vertices = static_cast<int>(scene.rest.size());
  report.pins = static_cast<int>(scene.pins.size());
  report.mesh_vertices = static_cast<int>(prepared->mesh->vertices.size());
  report.mesh_triangles = static_cast<int>(prepared->mesh->triangles.size());
  report.prepare_milliseconds = prepared->milliseconds;
  report.map = report_of(*prepared->mesh, map);
  report.folds_visibly = injectivity_of(*prepared->mesh, map.f).folds();
  const double length = perimeter(outline_of(scene.rest)) / (2 * kPi);
  report.smoothness_energy =
      smoothness(*prepared->mesh, prepared->rest.derivative_samples, map, length);
  report.pin_rms = pin_distance(*prepared, scene);
  return report;
}

std::string json_of(const SceneReport& report) {
  nlohmann::ordered_json zeros = nlohmann::ordered_json::array();
  for (const Complex& z : report.map.zeros) zeros.push_back({z.real(), z.imag()});
  const nlohmann::ordered_json json{
      {"method", report.method},
      {"status", report.status},
      {"note", report.note},
      {"iterations", report.iterations},
      {"energies", {{"smoothness", report.smoothness_energy}, {"pins_rms", report.pin_rms}}},
      {"prepare_ms", report.prepare_milliseconds},
      {"pose_ms", report.pose_milliseconds},
      {"max_k", report.map.max_k},
      {"min_sigma", report.map.min_sigma},
      {"max_sigma", report.map.max_sigma},
      {"zeros", zeros},
      {"turning_number", report.map.turning_number},
      {"simple_boundary", report.map.simple_boundary},
      {"flipped_triangles", report.map.flipped_triangles},
      {"locally_injective", report.map.locally_injective()},
      {"folds_visibly", report.folds_visibly},
      {"certified", report.status == "certified"},
      {"cage_vertices", report.cage_vertices},
      {"pins", report.pins},
      {"mesh", {{"vertices", report.mesh_vertices}, {"triangles", report.mesh_triangles}}}};
  return json.dump(2) + "\n";
}

std::string text_of(const SceneReport& report) {
  char text[1200];
  std::snprintf(
      text, sizeof text,
      "method           %s\nstatus           %s%s%s\niterations       %d\n"
      "energies         smoothness %.4g, pins rms %.4g px\n"
      "time             prepare %.1f ms, pose %.2f ms\n"
      "max k            %.4g\nmin sigma        %.4g\nmax Sigma        %.4g\n"
      "zeros of f'      %zu\nturning number   %.3f\nsimple boundary  %s\n"
      "flipped          %d of %d triangles\nfolds            %s\ncertified        %s\n"
      "cage, pins       %d vertices, %d pins\nmesh             %d vertices, %d triangles\n",
      report.method.c_str(), report.status.c_str(), report.note.empty() ? "" : ": ",
      report.note.c_str(), report.iterations, report.smoothness_energy, report.pin_rms,
      report.prepare_milliseconds, report.pose_milliseconds, report.map.max_k, report.map.min_sigma,
      report.map.max_sigma, report.map.zeros.size(), report.map.turning_number,
      report.map.simple_boundary ? "yes" : "no", report.map.flipped_triangles,
      report.mesh_triangles,
      report.map.locally_injective() ? "none found"
      : report.folds_visibly         ? "yes"
                                     : "specks only",
      report.status == "certified" ? "yes" : "no", report.cage_vertices, report.pins,
      report.mesh_vertices, report.mesh_triangles);
  return text;
}

}  // namespace holomorph
