// All values are measured on the default domain mesh.
#include "scene/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/cauchy/cauchy.h"
#include "core/clock.h"
#include "core/maps/argument.h"
#include "core/maps/visible_folds.h"

namespace holomorph {
namespace {

/// The mean of |f_zz|^2 L^2, weighted by the areas of the triangles. f_zz is estimated from
/// differences of f_z along mesh edges.
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

/// The distances of pins from their targets.
VectorXd pin_distances(TimedMap& timed, const TimedFrame& frame) {
  Points pins, targets;
  for (size_t i = 0; i < timed.prepared().rest.pins.size(); ++i)
    if (contains(frame.deformation.rest, timed.prepared().rest.pins[i].position)) {
      pins.push_back(timed.prepared().rest.pins[i].position);
      targets.push_back(frame.deformation.pins[i].pose);
    }
  if (targets.empty()) return VectorXd::Zero(1);
  const SampledMap map = timed.at(frame, pins);
  VectorXd distances(map.f.size());
  for (Index i = 0; i < distances.size(); ++i)
    distances[i] = std::abs(map.f[i] - targets[static_cast<size_t>(i)]);
  return distances;
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

SceneReport report_of(TimedMap& timed, const TimedFrame& frame) {
  const PreparedMap& prepared = timed.prepared();
  const Mesh& mesh = timed.mesh();
  SceneReport report;
  const double start = now_ms();
  const SampledMap map = timed.on_mesh(frame);
  if (frame.pose) report.pose_milliseconds = now_ms() - start;
  report.method = frame.deformation.method;
  // Maps that are blended triangle by triangle have no status of their own.
  report.in_triangles = !frame.pose && map.status == SampledMap::Status::exact;
  report.status = report.in_triangles ? "blended" : name_of(map.status);
  report.note = map.note;
  report.proved = map.extremes;
  report.iterations = map.iterations;
  report.cage_vertices = static_cast<int>(frame.deformation.rest.size());
  report.pins = static_cast<int>(frame.deformation.pins.size());
  report.mesh_vertices = static_cast<int>(mesh.vertices.size());
  report.mesh_triangles = static_cast<int>(mesh.triangles.size());
  report.prepare_milliseconds = prepared.milliseconds;
  const MapReport linear = report_of_linear(mesh, map.f);
  report.map = report.in_triangles ? linear : report_of(mesh, map);
  if (map.status == SampledMap::Status::certified && linear.flipped_triangles > 0) {
    // The proof is of the smooth map, but the drawn picture folds.
    report.status = name_of(SampledMap::Status::infeasible);
    report.proved.reset();
  }
  // Certified maps are proved to have no zeros.
  const bool proved = map.status == SampledMap::Status::certified;
  if (proved) report.map.zeros.clear();
  const auto point_map = proved ? nullptr : timed.point_map(frame);
  if (point_map && !point_map->is_linear_in_triangles()) {
    const Points& places = prepared.rest.derivative_samples;
    const auto fz_at = [&](const Points& points) {
      VectorXc values(static_cast<Index>(points.size()));
      Index i = 0;
      for (const PointMap::Value& value : values_on_all_cores(*point_map, points))
        values[i++] = value.fz;
      return values;
    };
    report.map.zeros.clear();
    int windings = 0;
    if (!point_map->has_no_zeros())
      for (const Zero& zero :
           zeros_of(mesh, places.empty() ? mesh.vertices : places, map.fz, fz_at)) {
        report.map.zeros.push_back(zero.position);
        windings += zero.multiplicity;
      }
    // All samples may be too far from a zero to show the fold there.
    for (const PointMap::Value& at : point_map->values_at(report.map.zeros)) {
      report.map.min_sigma = std::min(report.map.min_sigma, 0 - std::abs(at.fzbar));
      if (at.fzbar != Complex(0)) report.map.max_k = std::max(report.map.max_k, 1.0);
    }
    // The boundary of a conformal map turns once more for each zero, also where the mesh is too
    // coarse to show it, and a single loop that turns more than once crosses itself.
    if (map.fzbar.isZero(0)) {
      report.map.turning_number = 1 + windings;
      if (windings != 0 && mesh.starts.empty()) report.map.simple_boundary = false;
    }
  }
  report.least_in_triangles = linear.min_sigma;
  report.most_in_triangles = linear.max_sigma;
  report.folds_visibly = !visible_folds(mesh, map.f, injectivity_of(mesh, map.f)).empty();
  const double length = perimeter(outline_of(frame.deformation.rest)) / (2 * kPi);
  report.smoothness_energy = smoothness(mesh, prepared.rest.derivative_samples, map, length);
  report.isometric_energy = isometric_energy_of(mesh, map.f);
  const VectorXd distances = pin_distances(timed, frame);
  report.pin_rms = std::sqrt(distances.squaredNorm() / static_cast<double>(distances.size()));
  report.pin_most = distances.maxCoeff();
  return report;
}

namespace {

nlohmann::ordered_json json_of(const SceneReport& report) {
  nlohmann::ordered_json zeros = nlohmann::ordered_json::array();
  for (const Complex& z : report.map.zeros) zeros.push_back({z.real(), z.imag()});
  nlohmann::ordered_json json;
  if (report.frame) json["frame"] = *report.frame;
  if (report.time) json["time"] = *report.time;
  json.update(
      {{"method", report.method},
       {"status", report.status},
       {"note", report.note},
       {"iterations", report.iterations},
       {"energies",
        {{"smoothness", report.smoothness_energy},
         {"isometric", report.isometric_energy},
         {"pins_rms", report.pin_rms},
         {"pins_most", report.pin_most}}},
       {"measured", report.in_triangles ? "triangles" : "samples"},
       {"max_k", report.map.max_k},
       {"min_sigma", report.map.min_sigma},
       {"max_sigma", report.map.max_sigma},
       {"triangles",
        {{"min_sigma", report.least_in_triangles}, {"max_sigma", report.most_in_triangles}}},
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
       {"timings", {{"prepare_ms", report.prepare_milliseconds}}}});
  if (report.proved)
    json["proved"] = {{"k", report.proved->shear},
                      {"sigma", report.proved->smallest},
                      {"Sigma", report.proved->largest}};
  if (report.pose_milliseconds) json["timings"]["pose_ms"] = *report.pose_milliseconds;
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
  const auto line = [](const char* format, auto... values) {
    char text[300];
    std::snprintf(text, sizeof text, format, values...);
    return std::string(text);
  };
  const MapReport& map = report.map;
  std::string text;
  if (report.frame) text += line("frame            %d\n", *report.frame);
  if (report.time) text += line("time             %.4g s\n", *report.time);
  text += "method           " + report.method + "\nstatus           " + report.status +
          (report.note.empty() ? "" : ": ") + report.note + "\n";
  text +=
      line("iterations       %d\n", report.iterations) +
      line("energies         smoothness %.4g, isometric %.4g, pins rms %.4g px, at most %.4g px\n",
           report.smoothness_energy, report.isometric_energy, report.pin_rms, report.pin_most) +
      line("timings          prepare %.1f ms", report.prepare_milliseconds);
  if (report.pose_milliseconds) text += line(", pose %.2f ms", *report.pose_milliseconds);
  text +=
      line("\n%s k %.4g, sigma %.4g, Sigma %.4g\n",
           report.in_triangles ? "triangles       " : "sampled         ", map.max_k, map.min_sigma,
           map.max_sigma) +
      line("zeros of f'      %zu\nturning number   %.3f\nsimple boundary  %s\n", map.zeros.size(),
           map.turning_number, map.simple_boundary ? "yes" : "no") +
      line("flipped          %d of %d triangles\n", map.flipped_triangles, report.mesh_triangles) +
      line("folds            %s\ncertified        %s\n",
           map.locally_injective() ? "none found"
           : report.folds_visibly  ? "yes"
                                   : "specks only",
           report.status == "certified" ? "yes" : "no") +
      (report.proved ? line("proved           k %.4g, sigma %.4g, Sigma %.4g\n",
                            report.proved->shear, report.proved->smallest, report.proved->largest)
                     : "") +
      line("cage, pins       %d vertices, %d pins\n", report.cage_vertices, report.pins) +
      line("mesh             %d vertices, %d triangles\n", report.mesh_vertices,
           report.mesh_triangles);
  return report.frame ? text + "\n" : text;
}

}  // namespace holomorph
