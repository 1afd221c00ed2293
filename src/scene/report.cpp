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

double pin_distance(const TimedMap& timed, const TimedMap::Frame& frame) {
  Points pins, targets;
  for (size_t i = 0; i < timed.prepared().rest.pins.size(); ++i)
    if (contains(frame.scene.rest, timed.prepared().rest.pins[i].position)) {
      pins.push_back(timed.prepared().rest.pins[i].position);
      targets.push_back(frame.scene.pins[i].pose);
    }
  if (targets.empty()) return 0;
  const SampledMap map = timed.at(frame, pins);
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

SceneReport report_of(const TimedMap& timed, const TimedMap::Frame& frame) {
  const PreparedMap& prepared = timed.prepared();
  const Mesh& mesh = timed.mesh();
  SceneReport report;
  if (frame.pose) {
    const double start = now_ms();
    SampledMap again;
    prepared.deformer->deform(*frame.pose, again, {});
    report.pose_milliseconds = now_ms() - start;
  }
  report.method = frame.scene.method;
  report.status = frame.pose ? name_of(frame.map.status) : "blended";
  report.note = frame.map.note;
  report.iterations = frame.map.iterations;
  report.cage_vertices = static_cast<int>(frame.scene.rest.size());
  report.pins = static_cast<int>(frame.scene.pins.size());
  report.mesh_vertices = static_cast<int>(mesh.vertices.size());
  report.mesh_triangles = static_cast<int>(mesh.triangles.size());
  report.prepare_milliseconds = prepared.milliseconds;
  report.map = report_of(mesh, frame.map);
  report.folds_visibly = injectivity_of(mesh, frame.map.f).folds();
  const double length = perimeter(outline_of(frame.scene.rest)) / (2 * kPi);
  report.smoothness_energy = smoothness(mesh, prepared.rest.derivative_samples, frame.map, length);
  report.pin_rms = pin_distance(timed, frame);
  return report;
}

namespace {

nlohmann::ordered_json json_of(const SceneReport& report) {
  nlohmann::ordered_json zeros = nlohmann::ordered_json::array();
  for (const Complex& z : report.map.zeros) zeros.push_back({z.real(), z.imag()});
  nlohmann::ordered_json json;
  if (report.frame) json = {{"frame", *report.frame}, {"time", report.time}};
  json.update(
      {{"method", report.method},
       {"status", report.status},
       {"note", report.note},
       {"iterations", report.iterations},
       {"energies", {{"smoothness", report.smoothness_energy}, {"pins_rms", report.pin_rms}}},
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
       {"mesh", {{"vertices", report.mesh_vertices}, {"triangles", report.mesh_triangles}}},
       {"timings",
        {{"prepare_ms", report.prepare_milliseconds}, {"pose_ms", report.pose_milliseconds}}}});
  return json;
}

}  // namespace

std::string json_of(const std::vector<SceneReport>& reports) {
  if (reports.size() == 1 && !reports[0].frame) return json_of(reports[0]).dump(2) + "\n";
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SceneReport& report : reports) list.push_back(json_of(report));
  return list.dump(2) + "\n";
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
  if (!report.frame) return text;
  char when[80];
  std::snprintf(when, sizeof when, "frame            %d, at %.4g s\n", *report.frame, report.time);
  return when + std::string(text) + "\n";
}

}  // namespace holomorph
