// For every method, a Rest or Pose with missing or invalid data is an Error, and unusual data does
// not crash the program.
#include <functional>

#include "core/error.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "support/catch.h"
#include "support/contract_setup.h"

namespace holomorph::bad_input_test {

namespace {

/// A change that invalidates a Rest or Pose, and the methods that must then refuse it.
struct Damage {
  const char* name;
  std::function<void(Setup&)> act;
  std::function<bool(const Method&)> matters = [](const Method&) { return true; };
};

/// Changes the mesh of a rest.
std::function<void(Setup&)> with_mesh(const std::function<void(Mesh&)>& change) {
  return [change](Setup& s) {
    Mesh mesh = *s.rest.mesh;
    change(mesh);
    s.rest.mesh = std::make_shared<const Mesh>(mesh);
  };
}

std::vector<Damage> damages() {
  const auto pins = [](const Method& m) { return m.uses_pins; };
  const auto strokes = [](const Method& m) { return m.uses_strokes; };
  const Complex nan(NAN, 0);
  return {
      {"no cage", [](Setup& s) { s.rest.cage = {}; }},
      {"a cage that is not finite", [=](Setup& s) { s.rest.cage.segments[1][0] = nan; }},
      {"a cage that crosses itself",
       [](Setup& s) { std::swap(s.rest.cage.segments[0], s.rest.cage.segments[2]); }},
      {"a sample that is not finite", [=](Setup& s) { s.rest.samples[3] = nan; }},
      {"too few derivative samples", [](Setup& s) { s.rest.derivative_samples.pop_back(); }},
      {"a derivative sample that is not finite",
       [=](Setup& s) { s.rest.derivative_samples[3] = nan; }},
      {"no mesh", [](Setup& s) { s.rest.mesh = nullptr; },
       [](const Method& m) { return m.needs_mesh; }},
      {"an empty mesh", [](Setup& s) { s.rest.mesh = std::make_shared<const Mesh>(); }},
      {"a cage segment without points", [](Setup& s) { s.rest.cage.segments[1].clear(); }},
      {"a cage segment of degree 9",
       [](Setup& s) {
         const Complex from = s.rest.cage.vertex(0), to = s.rest.cage.vertex(1);
         s.rest.cage.segments[0].clear();
         for (int k = 0; k < 9; ++k)
           s.rest.cage.segments[0].push_back(from + (to - from) * (k / 9.0));
       }},
      {"a cage whose areas overflow", [](Setup& s) { s.rest.cage.segments[1][0] = 1e160; }},
      {"a sample whose products overflow",
       [](Setup& s) {
         s.rest.samples[3] = {0, -1e308};
       }},
      {"a mesh that refers to a vertex that it does not have",
       with_mesh([](Mesh& mesh) { mesh.triangles[5][1] = 1 << 20; })},
      {"a mesh that is not finite", with_mesh([=](Mesh& mesh) { mesh.vertices[7] = nan; })},
      {"a mesh with a clockwise triangle",
       with_mesh([](Mesh& mesh) { std::swap(mesh.triangles[4][0], mesh.triangles[4][1]); })},
      {"a mesh with a vertex that belongs to no triangle", with_mesh([](Mesh& mesh) {
         mesh.vertices.push_back({100, 100});
       })},
      {"a mesh whose boundary refers to a vertex that does not exist",
       with_mesh([](Mesh& mesh) { mesh.boundary[2] = -1; })},
      {"a mesh without a boundary", with_mesh([](Mesh& mesh) { mesh.boundary.clear(); })},
      {"a mesh with too few cage vertices",
       with_mesh([](Mesh& mesh) { mesh.cage_vertices.pop_back(); })},
      {"a mesh with a repeated cage vertex",
       with_mesh([](Mesh& mesh) { mesh.cage_vertices[1] = mesh.cage_vertices[0]; })},
      {"another method's parameter that is not finite",
       [](Setup& s) { s.rest.other_parameters["pins"]["smoothness"] = NAN; }},
      {"a posed segment without points", [](Setup& s) { s.pose.cage.segments[1].clear(); }},
      {"too few posed strokes", [](Setup& s) { s.pose.strokes.clear(); }, strokes},
      {"the mesh of another cage",
       [](Setup& s) {
         s.rest.mesh = std::make_shared<const Mesh>(
             domain_mesh(polygon_cage(shapes::star(6, 0.2, 3)), {200}));
       }},
      {"a pin that is not finite", [=](Setup& s) { s.rest.pins[0].position = nan; }, pins},
      {"a stroke of one point", [](Setup& s) { s.rest.strokes[0].resize(1); }, strokes},
      {"a stroke of no points", [](Setup& s) { s.rest.strokes[0].clear(); }, strokes},
      {"an outline that is not finite",
       [=](Setup& s) {
         s.rest.outline = {0, 1, nan, 3};
       }},
      {"an outline of two points",
       [](Setup& s) {
         s.rest.outline = {0, 100};
       },
       [](const Method& m) { return m.id == "outline"; }},
      {"corners out of order",
       [](Setup& s) {
         s.rest.corners = {2, 1, 3};
       }},
      {"a corner beyond the cage",
       [](Setup& s) {
         s.rest.corners = {0, 1, 99};
       }},
      {"a brush dab that is not finite",
       [=](Setup& s) {
         s.rest.stiffness = {{nan, 10, 1}};
       }},
      {"a brush dab without radius",
       [](Setup& s) {
         s.rest.stiffness = {{50, 0, 1}};
       }},
      {"too few posed segments", [](Setup& s) { s.pose.cage.segments.pop_back(); }},
      {"a posed degree that is too high",
       [](Setup& s) {
         s.pose.cage.segments[0].insert(s.pose.cage.segments[0].end(), 7, Complex(1));
       }},
      {"a pose that is not finite", [=](Setup& s) { s.pose.cage.segments[2][0] = nan; }},
      {"too few posed pins", [](Setup& s) { s.pose.pins.pop_back(); }, pins},
      {"too many posed pins", [](Setup& s) { s.pose.pins.push_back({}); }},
      {"a posed pin that is not finite", [=](Setup& s) { s.pose.pins[1].position = nan; }, pins},
      {"a posed pin with a turn that is not finite", [](Setup& s) { s.pose.pins[1].turn = NAN; },
       pins},
      {"a posed pin without size", [](Setup& s) { s.pose.pins[1].scale = 0; }, pins},
      {"too many posed strokes",
       [](Setup& s) {
         s.pose.strokes.push_back({0, 1});
       }},
      {"a posed stroke that is not finite", [=](Setup& s) { s.pose.strokes[0][0] = nan; }, strokes},
      {"a posed stroke without points", [](Setup& s) { s.pose.strokes[0].clear(); }, strokes},
      {"too many posed corners", [](Setup& s) { s.pose.corners.push_back({}); }},
      {"a posed corner that is not finite",
       [](Setup& s) {
         s.rest.corners = {0, 1, 2};
         s.pose.corners.resize(3);
         s.pose.corners[1].before = NAN;
       }},
  };
}

}  // namespace

TEST_CASE("Contract: unusual input gives finite numbers or an Error, and never a crash") {
  using Change = std::function<void(Setup&)>;
  const auto each_posed = [](Setup& s, const std::function<Complex(Complex)>& to) {
    for (Points& segment : s.pose.cage.segments)
      for (Complex& z : segment) z = to(z);
  };
  const std::vector<std::pair<const char*, Change>> changes{
      {"pins that coincide",
       [](Setup& s) {
         for (RestPin& pin : s.rest.pins) pin.position = {60, 60};
       }},
      {"pins with angles on the cage's vertices",
       [](Setup& s) {
         for (size_t i = 0; i < s.rest.pins.size(); ++i)
           s.rest.pins[i] = {s.rest.cage.vertex(static_cast<Index>(i)), true};
         for (PosePin& pin : s.pose.pins) pin.angle = 0.2;
       }},
      {"pins far outside",
       [](Setup& s) {
         for (RestPin& pin : s.rest.pins) pin.position = 1e60;
       }},
      {"a pin posed very far away",
       [](Setup& s) {
         for (PosePin& pin : s.pose.pins) pin.position = 1e60;
       }},
      {"pins with turns that contradict each other",
       [](Setup& s) {
         for (size_t i = 0; i < s.pose.pins.size(); ++i) s.pose.pins[i].turn = i % 2 ? 1e5 : -1e5;
       }},
      {"a pin posed beyond all numbers",
       [](Setup& s) {
         for (PosePin& pin : s.pose.pins) pin.position = 1e200;
       }},
      {"samples far outside",
       [](Setup& s) {
         for (Complex& z : s.rest.samples) z += 1e4;
         s.rest.derivative_samples.clear();
       }},
      {"a pose with all points in one place",
       [&](Setup& s) { each_posed(s, [](Complex) { return Complex(5); }); }},
      {"a pose on a line", [&](Setup& s) { each_posed(s, [](Complex z) { return z.real(); }); }},
      {"a mirrored pose", [&](Setup& s) { each_posed(s, [](Complex z) { return std::conj(z); }); }},
      {"a pose far away", [&](Setup& s) { each_posed(s, [](Complex z) { return 1e60 * z; }); }},
      {"one sample",
       [](Setup& s) {
         s.rest.samples.resize(1);
         s.rest.derivative_samples.clear();
       }},
      {"no samples",
       [](Setup& s) {
         s.rest.samples.clear();
         s.rest.derivative_samples.clear();
       }},
      {"a stroke outside",
       [](Setup& s) {
         for (Points& stroke : s.rest.strokes)
           for (Complex& z : stroke) z += 1e4;
       }},
      {"an outline like a needle",
       [](Setup& s) {
         s.rest.outline = {{0, 0}, {100, 0}, {100, 1e-9}};
       }},
      {"brush dabs of extreme size and strength",
       [](Setup& s) {
         s.rest.stiffness.assign(3, {{50, 50}, 1e60, -1e60});
       }},
      {"a single corner",
       [](Setup& s) {
         s.rest.corners = {1};
         s.pose.corners.resize(1);
       }},
  };
  for (const Method& method : methods()) {
    const Setup whole = setup(method, Precision::full);
    for (const auto& [name, change] : changes) {
      Setup odd = whole;
      change(odd);
      INFO(method.id << ": " << name);
      try {
        const auto deformer = method.prepare(odd.rest, nullptr);
        for (const bool draft : {false, true}) {
          SampledMap map = deformer->deform(odd.pose, {.derivatives = true, .draft = draft});
          CHECK(map.f.size() == static_cast<Index>(odd.rest.samples.size()));
          CHECK(map.f.allFinite());
        }
        if (const auto points = deformer->point_map(odd.pose))
          CHECK(is_finite(points->at(box_of(whole.rest.samples).center()).f));
      } catch (const Error& error) {
        CHECK(std::string(error.what()).size() > 10);
      }
    }
  }
}

TEST_CASE("Contract: missing or invalid data in a rest or pose is an Error") {
  for (const Method& method : methods()) {
    const Setup whole = setup(method, Precision::full);
    const auto throws = [](const std::function<void()>& call) {
      try {
        call();
      } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::bad_input);
        CHECK(std::string(error.what()).size() > 10);
        return true;
      }
      return false;
    };
    const auto is_refused = [&](const Setup& s) {
      std::unique_ptr<Deformer> deformer;
      if (throws([&] { deformer = method.prepare(s.rest, nullptr); })) return true;
      SampledMap map;
      const bool refused = throws([&] { map = deformer->deform(s.pose, {true}); });
      CHECK(throws([&] { map = deformer->deform(s.pose, {.draft = true}); }) == refused);
      std::unique_ptr<PointMap> points;
      const bool none = throws([&] { points = deformer->point_map(s.pose); }) || !points;
      if (refused) CHECK(none);
      return refused;
    };
    REQUIRE_FALSE(is_refused(whole));
    for (const Damage& damage : damages()) {
      if (!damage.matters(method)) continue;
      Setup broken = whole;
      damage.act(broken);
      INFO(method.id << ": " << damage.name);
      CHECK(is_refused(broken));
    }
    for (const ParameterSpec& spec : method.parameters) {
      const double beyond = spec.type == ParameterSpec::Type::choice
                                ? static_cast<double>(spec.options.size())
                                : spec.highest * 1.01 + 1;
      for (const double value : {static_cast<double>(NAN), beyond, -1e9}) {
        if (spec.type == ParameterSpec::Type::toggle && std::isfinite(value)) continue;
        Setup broken = whole;
        broken.rest.parameters[spec.key] = value;
        INFO(method.id << ": parameter " << spec.key << " = " << value);
        CHECK(is_refused(broken));
      }
    }
  }
}

}  // namespace holomorph::bad_input_test
