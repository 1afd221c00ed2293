// Method `strokes`: maps curves inside the cage onto other curves. Points may slide along the
// curves (Segall, Ben-Chen 2016, E_s2s). Elsewhere the map is as smooth (E_s), as rigid (E_r) and
// as conformal as the parameters ask for.
//
// f is the cage's map plus h, with h in a smooth basis. Alternating least squares minimize the
// residuals of pins, strokes and rigidity. Without strokes, this is method `pins`.
#include <cstdio>

#include "core/cauchy/boundary_basis.h"
#include "core/cauchy/cauchy.h"
#include "core/error.h"
#include "core/geometry/polyline.h"
#include "core/maps/acting_pins.h"
#include "core/methods/linear.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"
#include "core/solvers/alternating_fit.h"

namespace holomorph {
namespace {

constexpr int kSamplesPerVertex = 2;
constexpr double kInsetSpacings =
    1;                             ///< inset of the inner points, in units of the samples' spacing
constexpr double kPerLength = 20;  ///< samples per length L of a stroke
constexpr double kLittle = 1e-3;   ///< factor on the weight of rigidity in the first solve
constexpr int kFewestSamples = 8, kMostSamples = 40;
constexpr int kDraftFitSteps = 20, kFitSteps = 300;
constexpr double kDraftSettled = 1e-3, kSettled = 1e-5;

/// The samples of a stroke at rest, and the position of each sample as a fraction of the stroke's
/// length.
struct Samples {
  Points points;
  std::vector<double> fractions;
  size_t stroke = 0;     ///< the stroke's index in the rest
  bool clipped = false;  ///< whether a part of the stroke lies outside the cage
};

Samples samples_of(const Points& stroke, const Cage& cage, double unit) {
  const Polyline line(without_repeats(stroke), false);
  const Index count = static_cast<Index>(std::clamp<double>(
      std::round(kPerLength * line.length() / unit), kFewestSamples, kMostSamples));
  Samples samples;
  for (Index i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(count - 1);
    const Complex z = line.at(fraction * line.length());
    if (contains(cage, z))
      samples.points.push_back(z), samples.fractions.push_back(fraction);
    else
      samples.clipped = true;
  }
  return samples;
}

/// The targets of the fit's terms in a pose, for the strokes' samples and for f' at inner points.
class StrokeTargets {
 public:
  /// `on` and `slopes` describe the cage's map. `on` holds the displacements of the samples, and
  /// `slopes` holds L f' at the inner points.
  StrokeTargets(const std::vector<Samples>& strokes, const std::vector<Points>& posed,
                const VectorXc& on, VectorXc slopes, double unit)
      : slopes_(std::move(slopes)), unit_(unit) {
    for (const Samples& stroke : strokes) {
      const Polyline& curve = curves_.emplace_back(without_repeats(posed[stroke.stroke]), false);
      for (size_t i = 0; i < stroke.points.size(); ++i) {
        const Index row = static_cast<Index>(samples_.size());
        samples_.push_back({curves_.size() - 1, stroke.points[i] + on[row]});
        shares_.push_back(stroke.fractions[i]);
      }
      lengths_.push_back(curve.length());
    }
    hints_.assign(samples_.size(), 0);
  }

  const std::vector<double>& fractions() const { return shares_; }
  /// The displacements that take the samples to these fractions of the posed strokes' lengths.
  VectorXc at(const std::vector<double>& fractions) const {
    VectorXc targets(static_cast<Index>(samples_.size()));
    for (size_t i = 0; i < samples_.size(); ++i)
      targets[static_cast<Index>(i)] =
          curves_[samples_[i].curve].at(fractions[i] * lengths_[samples_[i].curve]) -
          samples_[i].place;
    return targets;
  }
  /// Sets the targets to the nearest points on the posed strokes.
  void project(const VectorXc& values, VectorXc& targets) {
    for (size_t i = 0; i < samples_.size(); ++i) {
      const auto& [c, place] = samples_[i];
      const Index row = static_cast<Index>(i);
      const auto nearest = curves_[c].nearest(place + values[row], hints_[i]);
      hints_[i] = nearest.segment;
      shares_[i] = curves_[c].length_at(nearest.segment, nearest.parameter) / lengths_[c];
      targets[row] = nearest.point - place;
    }
  }
  /// Sets the targets that make f' the nearest number of modulus 1.
  void make_rigid(const VectorXc& values, VectorXc& targets) const {
    for (Index i = 0; i < values.size(); ++i) {
      const Complex slope = slopes_[i] + values[i];
      const double size = std::abs(slope);
      targets[i] = (size > 0 ? unit_ * slope / size : Complex(unit_)) - slopes_[i];
    }
  }

 private:
  struct CurveSample {
    size_t curve;
    Complex place;  ///< the sample's image under the cage's map
  };
  std::vector<Polyline> curves_;
  std::vector<double> lengths_;
  std::vector<CurveSample> samples_;
  std::vector<double> shares_;
  std::vector<Index> hints_;
  VectorXc slopes_;
  double unit_;
};

template <class T>
class StrokesDeformer final : public Deformer {
 public:
  explicit StrokesDeformer(const Rest& rest)
      : rest_(rest), method_(method_named("strokes")), pins_(usable_pins(rest)) {
    for (const Points& stroke : rest.strokes) check_stroke(stroke);
    const double unit = perimeter(outline_of(rest.cage)) / (2 * kPi);
    for (size_t i = 0; i < rest.strokes.size(); ++i) {
      Samples samples = samples_of(rest.strokes[i], rest.cage, unit);
      if (samples.clipped)
        note_ += (note_.empty() ? "" : ". ") + ("Stroke " + std::to_string(i + 1)) +
                 (samples.points.empty() ? " is outside the cage and has no effect"
                                         : " leaves the cage; only the part inside has an effect");
      samples.stroke = i;
      if (!samples.points.empty()) strokes_.push_back(std::move(samples));
    }
    prepare_base();
    if (strokes_.empty()) return;
    if (!pins_.note.empty()) note_ += (note_.empty() ? "" : ". ") + pins_.note;
    prepare(unit);
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    check_pose(rest_, pose);
    if (strokes_.empty()) {
      SampledMap out = fallback_->deform(without_strokes(pose), options);
      if (!note_.empty()) out.note = note_ + (out.note.empty() ? "" : ". ") + out.note;
      return out;
    }
    SampledMap out = cage_->deform(without_handles(pose), options);
    out.note = note_;
    if (is_at_rest(pose)) return out;
    const auto found = std::make_shared<const Correction>(
        solved(pose, options.draft, dynamic_cast<const Correction*>(from)));
    out.solution = found;
    out.iterations = found->iterations;
    if (!found->settled) out.status = SampledMap::Status::iterating;
    char text[80];
    constexpr double kMet = 0.005;  // px
    if (found->miss < kMet)
      std::snprintf(text, sizeof text, "The picture meets the strokes");
    else
      std::snprintf(text, sizeof text, "The picture misses the strokes by %.1f px on average",
                    found->miss);
    out.note = text + (note_.empty() ? "" : ". " + note_);
    out.f += product(value_, found->phi);
    if (soft_) out.f += product(value_, found->psi).conjugate();
    if (!options.derivatives || rest_.samples.empty()) return out;
    if (slope_.rows() == 0)
      slope_ = planar_coordinates<T>(
          polygon_cage(basis_->polygon()),
          rest_.derivative_samples.empty() ? rest_.samples : rest_.derivative_samples, 1);
    out.fz += product(slope_, found->phi);
    if (soft_) out.fzbar += product(slope_, found->psi).conjugate();
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(rest_, pose);
    if (strokes_.empty()) return fallback_->point_map(without_strokes(pose));
    auto map = std::make_unique<SumMap>();
    map->terms.emplace_back(rest_.cage, cage_displacement(rest_, pose));
    if (is_at_rest(pose)) return map;
    const Correction moved = solved(pose, false, nullptr);
    const Cage polygon = polygon_cage(basis_->polygon());
    map->terms.emplace_back(polygon, moved.phi);
    if (soft_) map->conjugates.emplace_back(polygon, moved.psi);
    return map;
  }

 private:
  /// The correction h = C phi + conj(C psi) over the polygon of the basis.
  struct Correction : Solution {
    VectorXc phi, psi;
    int iterations = 0;
    bool settled = true;
    double miss = 0;                ///< root mean square distance from the posed strokes
    std::vector<double> fractions;  ///< the samples' positions as fractions of the posed strokes
    VectorXc unknowns;              ///< whitened
  };
  enum Term : size_t { on_strokes, rigid, on_pins };

  double value(const char* key) const { return parameter(method_, rest_.parameters, key); }

  static Pose without_handles(const Pose& pose) { return {pose.cage, {}}; }
  static Pose without_strokes(const Pose& pose) { return {pose.cage, pose.pins}; }

  /// Prepares the cage's map, which the strokes correct, or method `pins` if there are no strokes.
  void prepare_base() {
    Rest rest = rest_;
    rest.parameters.clear();
    rest.strokes.clear();
    if (strokes_.empty()) {
      fallback_ = usual_method(MethodUse::pins).prepare(rest, nullptr);
      return;
    }
    rest.pins.clear();
    cage_ = usual_method(MethodUse::cage).prepare(rest, nullptr);
  }

  void prepare(double unit) {
    const int vertices = BoundaryBasis::usual_size(rest_.cage.size());
    basis_ =
        std::make_shared<const BoundaryBasis>(rest_.cage, vertices, kSamplesPerVertex * vertices);
    soft_ = value("softness") > 0;
    value_ = planar_coordinates<T>(polygon_cage(basis_->polygon()), rest_.samples, 0);
    Points on, held, turning;
    for (const Samples& stroke : strokes_)
      on.insert(on.end(), stroke.points.begin(), stroke.points.end());
    for (const size_t i : pins_.used) {
      held.push_back(rest_.pins[i].position);
      if (rest_.pins[i].has_frame) turning.push_back(rest_.pins[i].position);
    }
    const Points inner = basis_->inset(kInsetSpacings);
    cage_on_ = as_complex(planar_coordinates<double>(rest_.cage, on));
    cage_inner_ = unit * as_complex(planar_coordinates<double>(rest_.cage, inner, 1));
    const Index n = basis_->size(), p = static_cast<Index>(held.size()),
                q = static_cast<Index>(turning.size());
    MatrixXc pins(p + q, n);
    pins.topRows(p) = basis_->values(held);
    pins.bottomRows(q) = unit * basis_->values(turning, 1);
    cage_at_pins_.resize(p + q, rest_.cage.control_count());
    cage_at_pins_.topRows(p) = as_complex(planar_coordinates<double>(rest_.cage, held));
    cage_at_pins_.bottomRows(q) =
        unit * as_complex(planar_coordinates<double>(rest_.cage, turning, 1));
    unit_ = unit;
    const MatrixXc bent =
        unit * unit * cauchy_coordinates(polygon_cage(basis_->polygon()), inner, 2);
    const MatrixXc slopes = unit * basis_->values(inner, 1);

    std::vector<FitTerm> terms;
    const auto follows_values = [](const VectorXc&, VectorXc&) {};
    terms.push_back({with_psi(basis_->values(on), Psi::added), 1});
    terms[on_strokes].project = follows_values;
    terms.push_back({with_psi(slopes, Psi::none), value("rigidity")});
    terms[rigid].project = follows_values;
    if (p + q > 0) terms.push_back({with_psi(pins, Psi::added, p), value("pin_weight")});
    terms.push_back({with_psi(bent, Psi::none), value("smoothness")});
    if (soft_) {
      terms.push_back({with_psi(bent, Psi::alone), value("smoothness")});
      terms.push_back({with_psi(slopes, Psi::alone), stiffness_of(value("softness"))});
      // A constant can move between phi and psi. This term fixes it.
      MatrixXc constant = MatrixXc::Zero(1, 2 * basis_->unknowns());
      constant.rightCols(basis_->unknowns()) = basis_->one().transpose();
      terms.push_back({std::move(constant)});
    }
    fit_.emplace(terms);
    terms[rigid].weight *= kLittle;
    terms[rigid].project = nullptr;
    loose_.emplace(std::move(terms));
  }

  /// Rows for whitened unknowns: of phi alone, of phi and conj(psi), or of conj(psi) alone. From
  /// row `holomorphic` on, the rows belong to f_z, which does not depend on psi.
  enum class Psi { none, added, alone };
  MatrixXc with_psi(const MatrixXc& values, Psi psi, Index holomorphic = -1) const {
    const MatrixXc rows = basis_->whitened(values);
    if (!soft_) return rows;
    MatrixXc both = MatrixXc::Zero(rows.rows(), 2 * rows.cols());
    if (psi != Psi::alone) both.leftCols(rows.cols()) = rows;
    const Index count = holomorphic < 0 ? rows.rows() : holomorphic;
    if (psi != Psi::none) both.topRightCorner(count, rows.cols()) = rows.topRows(count).conjugate();
    return both;
  }

  bool is_at_rest(const Pose& pose) const {
    if (pose.strokes != rest_.strokes || pose.cage != rest_.cage) return false;
    for (size_t i = 0; i < rest_.pins.size(); ++i) {
      const PosePin& pin = pose.pins[i];
      if (pin.position != rest_.pins[i].position) return false;
      if (rest_.pins[i].has_frame && (pin.angle != 0 || pin.scale != 1)) return false;
    }
    return true;
  }

  /// Drafts continue from `before` unless it is null.
  Correction solved(const Pose& pose, bool draft, const Correction* before) const {
    const VectorXc cage = cage_displacement(rest_, pose);
    const auto targets =
        std::make_shared<StrokeTargets>(strokes_, pose.strokes, cage_on_ * cage,
                                        VectorXc((cage_inner_ * cage).array() + unit_), unit_);
    AlternatingFit fit = *fit_;
    fit.set_projection(on_strokes, [targets](const VectorXc& values, VectorXc& projected) {
      targets->project(values, projected);
    });
    fit.set_projection(rigid, [targets](const VectorXc& values, VectorXc& projected) {
      targets->make_rigid(values, projected);
    });
    const bool warm = draft && before && before->fractions.size() == targets->fractions().size();
    const VectorXc first = targets->at(warm ? before->fractions : targets->fractions());
    if (!pins_.used.empty()) fit.set_targets(on_pins, pin_targets(pose, cage));
    if (warm) {
      fit.reset(before->unknowns);
    } else {
      // The first solve has almost no rigidity. Full rigidity would keep parts near their original
      // directions even if they must rotate far.
      AlternatingFit loose = *loose_;
      if (!pins_.used.empty()) loose.set_targets(on_pins, pin_targets(pose, cage));
      loose.start(first);
      fit.reset(loose.unknowns());
    }
    fit.start(first);
    const int most = draft ? kDraftFitSteps : kFitSteps;
    Correction found;
    found.iterations =
        fit.run(AlternatingFit::Mode::anderson, draft ? kDraftSettled : kSettled, most);
    found.settled = found.iterations < most;
    found.fractions = targets->fractions();
    found.miss = fit.distance(on_strokes);
    found.unknowns = fit.unknowns();
    const Index n = basis_->unknowns();
    found.phi = basis_->coefficients(found.unknowns.head(n));
    if (soft_) found.psi = basis_->coefficients(found.unknowns.tail(n).conjugate());
    return found;
  }

  VectorXc pin_targets(const Pose& pose, const VectorXc& cage) const {
    VectorXc targets = -(cage_at_pins_ * cage);
    Index row = 0;
    for (const size_t i : pins_.used)
      targets[row++] += pose.pins[i].position - rest_.pins[i].position;
    for (const size_t i : pins_.used)
      if (rest_.pins[i].has_frame)
        targets[row++] += unit_ * (std::polar(pose.pins[i].scale, pose.pins[i].angle) - 1.0);
    return targets;
  }

  Rest rest_;
  const Method& method_;
  UsablePins pins_;
  std::shared_ptr<Deformer> fallback_, cage_;
  std::string note_;
  std::vector<Samples> strokes_;
  std::shared_ptr<const BoundaryBasis> basis_;
  bool soft_ = false;
  double unit_ = 1;                               ///< L
  MatrixXc cage_on_, cage_inner_, cage_at_pins_;  ///< cage coordinates at strokes, inside, at pins
  PlanarMatrix<T> value_, slope_;
  std::optional<AlternatingFit> fit_, loose_;  ///< loose_ has almost no rigidity
};

std::unique_ptr<Deformer> make_strokes(const Rest& rest, const Deformer*) {
  if (rest.precision == Precision::full) return std::make_unique<StrokesDeformer<double>>(rest);
  return std::make_unique<StrokesDeformer<float>>(rest);
}

}  // namespace

Method strokes_method() {
  return {
      .id = "strokes",
      .label = "Strokes",
      .summary = "Follows the lines that you draw and reshape.",
      .hint =
          "Draw lines on the picture and reshape them. The picture follows smoothly and slides "
          "along "
          "them.",
      .parameters = {by_decades("smoothness", "Smoothness", "Higher values bend the picture less",
                                1e-5, 1e-8, 1e-1),
                     by_decades("rigidity", "Rigidity",
                                "Higher values resist growing and shrinking; strokes slide along "
                                "their lines instead",
                                1e-2, 1e-5, 1),
                     in_percent(number("softness", "Softness",
                                       "0 % keeps all angles, 100 % hardly any", 0, 0, 1)),
                     by_decades("pin_weight", "Pin weight",
                                "Higher values meet the pins more closely", 1, 1e-3, 1e3)},
      .uses_pins = true,
      .uses_strokes = true,
      .iterates = true,
      .reproduces = Method::Motions::rigid,
      .make = make_strokes,
  };
}

}  // namespace holomorph
