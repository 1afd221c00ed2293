// Method `outline`: the cage's shape onto a drawn outline (Segall, Ben-Chen 2016).
#include <cstdio>

#include "core/cauchy_array.h"
#include "core/cauchy_map.h"
#include "core/methods/acting_pins.h"
#include "core/methods/linear.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"
#include "core/outline_match.h"

namespace holomorph {
namespace {

constexpr int kDraftVertices = 100;

class OutlineDeformer final : public Deformer {
 public:
  explicit OutlineDeformer(const Rest& rest)
      : rest_(rest), method_(method_named("outline")), pins_(acting_pins(rest)) {
    Rest free = rest;
    free.parameters.clear();
    free_ = method_named("pins").prepare(free, nullptr);
  }

  void deform(const Pose& pose, SampledMap& out, Wanted wanted) override {
    check_pose(rest_, pose);
    if (pose.outline.empty()) {
      free_->deform(pose, out, wanted);
      out.note = "Draw an outline: the picture's shape goes onto it.";
      return;
    }
    out = SampledMap{};
    if (pose != posed_ || wanted.draft != draft_) {
      match_ = matched(task(pose), settings(wanted.draft));
      posed_ = pose;
      draft_ = wanted.draft;
    }
    out.f = values(rest_.samples, 0).f;
    if (wanted.derivatives) {
      const Values slopes =
          values(rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples, 1);
      out.fz = slopes.phi;
      out.fzbar = slopes.psi;
    }
    out.iterations = match_.iterations;
    out.note = note(Polyline(pose.outline, true).diagonal());
    if (!pins_.note.empty()) out.note += "; " + pins_.note;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    if (pose.outline.empty()) return free_->point_map(pose);
    const OutlineMatch match =
        pose == posed_ && !draft_ ? match_ : matched(task(pose), settings(false));
    auto map = std::make_unique<SumMap>();
    map->terms.emplace_back(match.basis, match.phi - controls_of(match.basis));
    if (match.psi.size() > 0) map->conjugates.emplace_back(match.basis, match.psi.conjugate());
    return map;
  }

 private:
  struct Values {
    VectorXc f, phi, psi;
  };

  double value(const char* key) const { return parameter(method_, rest_.parameters, key); }

  OutlineSettings settings(bool draft) const {
    OutlineSettings settings;
    settings.published = value("published") != 0;
    settings.vertices = static_cast<int>(value("vertices"));
    settings.smoothness = value("smoothness");
    settings.pin_weight = value("pin_weight");
    settings.stiffness = stiffness_of(value("softness"));
    if (value("upright") == 0) settings.upright = 0;
    if (settings.published) settings.most_iterations = 200;
    if (draft) settings.vertices = std::min(settings.vertices, kDraftVertices);
    return settings;
  }

  OutlineTask task(const Pose& pose) const {
    OutlineTask task{rest_.cage, pose.outline, {}, {}};
    for (const size_t i : pins_.used) {
      task.pins.push_back(rest_.pins[i].position);
      task.pinned.push_back(pose.pins[i].position);
    }
    return task;
  }

  Values values(const Points& samples, int order) const {
    const PlanarMatrix<double> c = planar_coordinates<double>(match_.basis, samples, order);
    Values values;
    values.phi = product(c, match_.phi);
    values.psi = VectorXc::Zero(values.phi.size());
    if (match_.psi.size() > 0) values.psi = product(c, match_.psi.conjugate()).conjugate();
    values.f = values.phi + values.psi;
    return values;
  }

  std::string note(double size) const {
    constexpr double kReached = 0.01;
    char text[240];
    std::snprintf(text, sizeof text,
                  "The outline is met to %.2g %% of its size, %.2g %% at worst, in %d steps%s",
                  100 * match_.rms / size, 100 * match_.hausdorff / size, match_.iterations,
                  match_.zeros > 0                     ? "; the picture folds: f' has zeros"
                  : match_.hausdorff > kReached * size ? ": more softness reaches farther"
                                                       : "");
    return text;
  }

  Rest rest_;
  const Method& method_;
  ActingPins pins_;
  std::unique_ptr<Deformer> free_;  ///< cage and pins, until there is an outline
  OutlineMatch match_;
  std::optional<Pose> posed_;
  bool draft_ = false;
};

std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer*) {
  check_rest_cage(rest.cage);
  return std::make_unique<OutlineDeformer>(rest);
}

}  // namespace

Method outline_method() {
  return {
      "outline",
      "Onto an outline",
      "The shape of the cage goes onto a drawn outline, inside and all.",
      {number("softness", "Softness", "0 keeps all angles; 1 hardly any", 0, 0, 1),
       used_with(
           "published", 0,
           by_decades("smoothness", "Smoothness",
                      "How much bending costs; large values round the corners", 0.01, 1e-4, 10)),
       by_decades("pin_weight", "Pin weight", "How much missing a pin costs", 0.1, 1e-3, 1e3),
       number("vertices", "Vertices", "How finely the outline is followed", 200, 50, 400),
       used_with("published", 0,
                 toggle("upright", "Upright", "Turn the picture as little as is worth it", true)),
       toggle("published", "As published",
              "The method of the paper: equal steps along the outline, closest points from "
              "there, no smoothing")},
      true,
      true,
      false,
      prepare};
}

}  // namespace holomorph
