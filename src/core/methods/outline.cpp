// Method `outline`: maps the cage's shape onto a drawn outline (Segall, Ben-Chen 2016).
#include <algorithm>
#include <cstdio>
#include <string>

#include "core/cauchy/cauchy_array.h"
#include "core/cauchy/cauchy_map.h"
#include "core/maps/acting_pins.h"
#include "core/methods/linear.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"
#include "core/outline/outline_match.h"

namespace holomorph {
namespace {

template <class T>
class OutlineDeformer final : public Deformer {
 public:
  explicit OutlineDeformer(const Rest& rest)
      : rest_(rest), method_(method_named("outline")), pins_(usable_pins(rest)) {
    if (rest.outline.empty()) {
      Rest free = rest;
      free.parameters.clear();
      fallback_ = usual_method(MethodUse::pins).prepare(free, nullptr);
      return;
    }
    fit_ = new_fit();
    set_up_values();
    // Without pins, the solution does not depend on the pose, so it is computed here.
    if (pins_.used.empty()) solve({}, false, nullptr);
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    check_pose(rest_, pose);
    if (fallback_) {
      SampledMap out = fallback_->deform(pose, options);
      out.note =
          "Draw an outline for the picture to fill" + (out.note.empty() ? "" : ". " + out.note);
      return out;
    }
    SampledMap out;
    solve(pin_targets(pose), options.draft, dynamic_cast<const Found*>(from));
    const auto found = std::make_shared<Found>();
    found->checkpoint = fit_->checkpoint();
    out.solution = found;
    const int last = fit_->iterations();
    const OutlineMatch match = fit_->after(std::min(options.iteration.value_or(last), last));
    // The user can view an earlier iteration, which may have a different basis.
    const bool is_own = match.basis == fit_->basis();
    out.f = image(is_own ? value_ : planar_coordinates<T>(match.basis, rest_.samples), match);
    if (options.derivatives) {
      const Points& places =
          rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples;
      if (!is_own || slope_.rows() != value_.rows())
        slope_ = planar_coordinates<T>(match.basis, places, 1);
      out.fz = product(slope_, match.phi);
      out.fzbar = match.psi.size() > 0
                      ? VectorXc(product(slope_, match.psi.conjugate()).conjugate())
                      : VectorXc(VectorXc::Zero(out.fz.size()));
    }
    if (!is_own) slope_ = {};
    out.iterations = match.iterations;
    out.energies = match.energies;
    if (match.iterations < last || last == settings().most_iterations)
      out.status = SampledMap::Status::iterating;
    out.note = note(match);
    if (pose.cage != rest_.cage) out.note += ". Cage points have no effect";
    if (std::ranges::any_of(rest_.pins, &RestPin::has_frame))
      out.note += ". Pins act by position only";
    if (!pins_.note.empty()) out.note += ". " + pins_.note;
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(rest_, pose);
    if (fallback_) return fallback_->point_map(pose);
    std::unique_ptr<OutlineFit> other;
    if (pin_targets(pose) != solved_ || draft_) {
      other = new_fit();
      other->solve(pin_targets(pose));
    }
    const OutlineFit& fit = other ? *other : *fit_;
    const OutlineMatch match = fit.after(fit.iterations());
    auto map = std::make_unique<SumMap>();
    map->terms.emplace_back(match.basis, match.phi - controls_of(match.basis));
    if (match.psi.size() > 0) map->conjugates.emplace_back(match.basis, match.psi.conjugate());
    return map;
  }

 private:
  struct Found : Solution {
    OutlineFit::Checkpoint checkpoint;
  };

  double value(const char* key) const { return parameter(method_, rest_.parameters, key); }

  OutlineSettings settings() const {
    OutlineSettings settings;
    settings.published = value("published") != 0;
    settings.vertices = static_cast<int>(value("vertices"));
    settings.smoothness = value("smoothness");
    settings.pin_weight = value("pin_weight");
    settings.stiffness = stiffness_of(value("softness"));
    if (value("upright") == 0) settings.upright = 0;
    if (settings.published) settings.most_iterations = 200;
    return settings;
  }

  std::unique_ptr<OutlineFit> new_fit() const {
    Points pins;
    for (const size_t i : pins_.used) pins.push_back(rest_.pins[i].position);
    return std::make_unique<OutlineFit>(rest_.cage, rest_.outline, pins, settings());
  }

  Points pin_targets(const Pose& pose) const {
    Points pin_targets;
    for (const size_t i : pins_.used) pin_targets.push_back(pose.pins[i].position);
    return pin_targets;
  }

  void solve(Points targets, bool draft, const Found* from) {
    // A map without pins does not depend on the pose.
    if (targets == solved_ && (targets.empty() || (!draft && !draft_))) return;
    if (draft && from)
      fit_->follow(targets, from->checkpoint);
    else
      fit_->solve(targets);
    if (fit_->builds() != built_) set_up_values();
    solved_ = std::move(targets);
    draft_ = draft && from;
  }

  void set_up_values() {
    built_ = fit_->builds();
    value_ = planar_coordinates<T>(fit_->basis(), rest_.samples);
    slope_ = {};
  }

  /// The rows of c sum to one up to rounding. Subtracting the center keeps the rounding error from
  /// growing with the drawing's distance from the origin.
  static VectorXc image(const PlanarMatrix<T>& c, const OutlineMatch& match) {
    const Complex center = match.phi.mean();
    VectorXc f = product(c, VectorXc(match.phi.array() - center)).array() + center;
    if (match.psi.size() > 0) f += product(c, match.psi.conjugate()).conjugate();
    return f;
  }

  std::string note(const OutlineMatch& match) const {
    const double size = Polyline(rest_.outline, true).diameter();
    const auto percent = [&](double length) {
      char text[32];
      std::snprintf(text, sizeof text, "%.2f %%", 100 * length / size);
      return std::string(text);
    };
    std::string note = "Outline met to within " + percent(match.rms) +
                       " of its size on average and " + percent(match.hausdorff) + " at worst";
    if (match.iterations > 0)
      note += ", after " + std::to_string(match.iterations) +
              (match.iterations == 1 ? " step" : " steps");
    if (match.zeros > 0) note += ". The picture folds";
    const bool reached = match.hausdorff <= kOutlineMatched * size,
               met = match.pins_missed <= kOutlineMatched * size;
    if (match.pins_held > 0)
      note += match.pins_held == 1 ? ". A pin outside the outline is held inside"
                                   : ". Pins outside the outline are held inside";
    if (!met) note += ". A pin is missed by " + percent(match.pins_missed);
    // A conformal map onto an outline has three free parameters, and a pin fixes two of them.
    if (pins_.used.size() > 1 && !(reached && met))
      note += ". The pins contradict each other: use fewer pins or more softness";
    else if (!reached)
      note += ". Parts of the outline are not reached: use more softness";
    return note;
  }

  Rest rest_;
  const Method& method_;
  UsablePins pins_;
  /// Method `pins`, used while there is no outline. Choosing this method therefore moves nothing
  /// yet.
  std::unique_ptr<Deformer> fallback_;
  std::unique_ptr<OutlineFit> fit_;
  int built_ = 0;
  PlanarMatrix<T> value_, slope_;  ///< C and C' of the fit's basis at the samples
  std::optional<Points> solved_;   ///< the pins' targets of the last solve
  bool draft_ = false;             ///< whether the last solve was a draft
};

std::unique_ptr<Deformer> make_outline(const Rest& rest, const Deformer*) {
  if (rest.precision == Precision::full) return std::make_unique<OutlineDeformer<double>>(rest);
  return std::make_unique<OutlineDeformer<float>>(rest);
}

}  // namespace

Method outline_method() {
  return {
      .id = "outline",
      .label = "Onto an outline",
      .summary = "Fills the outline that you draw.",
      .hint = "Maps the cage and the picture inside onto an outline that you draw.",
      .parameters = {in_percent(number("softness", "Softness",
                                       "0 % keeps all angles, 100 % hardly any", 0, 0, 1)),
                     used_with(
                         "published", 0,
                         by_decades("smoothness", "Smoothness",
                                    "Higher values bend the picture less and round the corners",
                                    0.01, 1e-4, 10)),
                     by_decades("pin_weight", "Pin weight",
                                "Higher values meet the pins more closely", 0.1, 1e-3, 1e3),
                     number("vertices", "Vertices",
                            "The number of boundary points; more follow the outline more finely",
                            200, 50, 400),
                     used_with("published", 0,
                               toggle("upright", "Upright", "Avoid rotating the picture", true)),
                     toggle("published", "As published",
                            "The method of Segall and Ben-Chen, for comparison: it starts with "
                            "equal steps along "
                            "the outline, continues with closest points, and does not smooth")},
      .uses_pins = true,
      .uses_outline = true,
      .iterates = true,
      .reproduces = Method::Motions::none,
      .allows_holes = false,
      .make = make_outline,
  };
}

}  // namespace holomorph
