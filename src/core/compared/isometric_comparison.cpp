#include "core/compared/isometric_comparison.h"

#include "core/clock.h"
#include "core/compared/harmonic_isometric.h"
#include "core/error.h"
#include "core/maps/acting_pins.h"
#include "core/maps/distortion.h"
#include "core/maps/method.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerEdge = 6;

/// Fills in everything that is measured on the map.
void measure(const Mesh& mesh, const Rest& rest, const Pose& pose, const std::vector<size_t>& pins,
             ComparedMap& row) {
  const MapReport report = report_of_linear(mesh, row.f);
  row.max_k = report.max_k;
  row.flipped_triangles = report.flipped_triangles;
  row.turning_number = report.turning_number;
  row.max_tau = report.min_sigma > 0 ? std::max(report.max_sigma, 1 / report.min_sigma)
                                     : std::numeric_limits<double>::infinity();
  row.energy = isometric_energy_of(mesh, row.f);
  for (const size_t i : pins) {
    const Location at = locate_near(mesh, rest.pins[i].position);
    row.miss = std::max(row.miss, std::abs(at.in(mesh, as_span(row.f)) - pose.pins[i].position));
  }
}

ComparedMap by_method(const Method& method, const Rest& rest, const Pose& pose,
                      const std::stop_token& stop) {
  Rest own = used_by(method, rest);
  if (method.id != "puppet") own.parameters = parameters_of(rest, method);
  const auto deformer = method.prepare(own, nullptr);
  ComparedMap row{method.label, method.hint};
  EvalOptions options;
  options.stop = stop;
  const double start = now_ms();
  SampledMap map = deformer->deform(used_by(method, pose), options);
  row.milliseconds = now_ms() - start;
  row.f = std::move(map.f);
  row.iterations = map.iterations;
  row.settled = map.status != SampledMap::Status::iterating;
  return row;
}

ComparedMap by_chen_weber(const Rest& rest, const Pose& pose, const std::vector<size_t>& pins,
                          const std::stop_token& stop) {
  ComparedMap row{"Chen, Weber 2017",
                  "Phi + conj(Psi) of least symmetric Dirichlet energy, by projected Newton steps"};
  const int vertices = BoundaryBasis::usual_size(2 * rest.cage.size());
  const BoundaryBasis basis(rest.cage, vertices, kSamplesPerEdge * vertices);
  const double size = box_of(basis.samples()).diagonal();
  HarmonicIsometricProblem problem{
      basis.sample_weights(),
      {},
      {},
      parameter(method_named("puppet"), rest.parameters, "pin_weight") / (size * size)};
  for (const size_t i : pins) {
    problem.pins.push_back(rest.pins[i].position);
    problem.targets.push_back(pose.pins[i].position);
  }
  constexpr int kMostIterations = 500;
  const double start = now_ms();
  const HarmonicIsometricMap map = harmonic_isometric(basis, problem, kMostIterations, stop);
  row.milliseconds = now_ms() - start;
  row.iterations = map.iterations;
  row.settled = map.converged;
  const MatrixXc c = basis.values(rest.samples);
  row.f = c * map.phi + (c * map.psi).conjugate();
  return row;
}

}  // namespace

void compare_isometric(const Rest& given, const Pose& pose,
                       const std::function<void(const ComparedMap&)>& on_row,
                       std::stop_token stop) {
  check(given.mesh != nullptr, "comparison: a rest with a mesh");
  Rest rest = given;
  rest.samples = rest.mesh->vertices;
  rest.derivative_samples = derivative_samples(*rest.mesh);
  const std::vector<size_t> pins = usable_pins(rest).used;
  if (pins.empty())
    throw Error(ErrorKind::bad_input, "set a pin inside the cage; then methods can be compared");
  const auto add = [&](ComparedMap row) {
    if (stop.stop_requested()) return;
    measure(*rest.mesh, rest, pose, pins, row);
    on_row(row);
  };
  try {
    ComparedMap own = by_method(method_named("puppet"), rest, pose, stop);
    own.label += " (this program)";
    add(std::move(own));
    if (rest.cage.starts.empty()) add(by_chen_weber(rest, pose, pins, stop));
    for (const char* id : {"arap", "har_arap", "pins"})
      add(by_method(method_named(id), rest, pose, stop));
  } catch (const Stopped&) {
  }
}

}  // namespace holomorph
