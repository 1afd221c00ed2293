// Method `bounded`: among all maps that fold nowhere and stretch no more than allowed, finds the
// map nearest to another method's map (Levi, Weber 2016).
//
// The steps are: reference at the boundary's samples -> continuous ln f_z -> cone program -> proof
// -> integration along the mesh.
#include <cstdio>
#include <mutex>

#include "core/bounded/bounded_reference.h"
#include "core/bounded/hole_closing.h"
#include "core/bounded/psi_space.h"
#include "core/error.h"
#include "core/geometry/similarity.h"
#include "core/maps/distortion.h"
#include "core/methods/bounded_points.h"
#include "core/methods/linear.h"
#include "core/methods/notes.h"
#include "core/methods/parameters.h"
#include "core/methods/proved_motion.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

/// Extremes of a map that is proved to be within bounds. They are found only to within 1 %, so the
/// bounds may be tighter.
Extremes within(const Bounds& bounds, Extremes extremes) {
  return {std::min(extremes.shear, bounds.k), std::max(extremes.smallest, bounds.sigma),
          std::min(extremes.largest, bounds.Sigma)};
}

class BoundedDeformer final : public Deformer {
 public:
  /// The polygon of the basis has about `basis` vertices. The basis has at most about `most`
  /// unknowns.
  BoundedDeformer(const Rest& rest, int basis, std::optional<int> most = {})
      : rest_(rest),
        method_(method_named("bounded")),
        bounds_(bounds_of(rest.parameters)),
        space_(choice(method_, rest.parameters, "space")) {
    check(rest.mesh != nullptr, "method bounded: the rest has a mesh");
    bounds_.check_usable();
    basis_ = std::make_shared<const BoundaryBasis>(
        rest.cage, basis, ReferenceSampler::kSamplesPerVertex * basis, most);
    on_mesh_ = std::make_unique<MapOnMesh>(*basis_, *rest.mesh);
    closing_ = std::make_unique<HoleClosing>(*basis_, *rest.mesh);
    reference_ = std::make_unique<ReferenceSampler>(
        rest, method_named(choice(method_, rest.parameters, "reference")), *basis_, *on_mesh_);
    for (const RestPin& pin : rest.pins)
      pins_.push_back(locate(*rest.mesh, rest.mesh->vertices, pin.position));
    prepare_space();
  }

  static int final_basis(const Cage& cage) { return BoundaryBasis::usual_size(2 * cage.size()); }
  /// Prepares a coarser basis, which keeps drags fast when the cage has many points or curves. The
  /// time grows with the cube of the number of unknowns. The bounds are proved in any case.
  void prepare_draft() {
    const int coarse = BoundaryBasis::usual_size(rest_.cage.size()), most = 25 + coarse / 2;
    if (coarse < final_basis(rest_.cage) || basis_->unknowns() > most)
      draft_ = std::make_unique<BoundedDeformer>(rest_, coarse, most);
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    check_pose(rest_, pose);
    if (options.draft && draft_) return draft_->deform(pose, options, from);
    const auto* before = dynamic_cast<const Found*>(from);
    if (!options.draft || (before && before->basis != basis_)) before = nullptr;
    const auto found = std::make_shared<Found>();
    found->basis = basis_;
    SampledMap out;
    solve(pose, options, before, *found, out.zeros);
    answer(*found, out, options);
    out.status = found->solution.certificate.holds && found->flipped_triangles == 0
                     ? SampledMap::Status::certified
                     : SampledMap::Status::infeasible;
    if (!options.draft && out.status == SampledMap::Status::certified)
      out.extremes = within(
          bounds_, nu_ ? nu_->extremes(found->solution.map) : psi_->extremes(found->solution.map));
    out.iterations = found->conformal.iterations + found->solution.iterations;
    out.ignores_pins = !reference_->uses_pins();
    if (found->solution.certificate.holds) out.coarse_triangles = found->flipped_triangles;
    out.note = note(pose, *found, options.draft);
    out.solution = found;
    return out;
  }

  std::shared_ptr<const ProvedMotion> motion() const override {
    std::call_once(motion_once_, [this] {
      MotionSetting setting{basis_, rest_.mesh, {}, {}, {}};
      for (size_t i = 0; i < pins_.size(); ++i)
        if (pins_[i] && reference_->uses_pins()) {
          setting.pins.push_back(i);
          setting.positions.push_back(rest_.pins[i].position);
        }
      setting.map_of = [basis = basis_](const Solution& solution) -> const LogMap* {
        const auto* found = dynamic_cast<const Found*>(&solution);
        return found && found->basis == basis ? &found->solution.map : nullptr;
      };
      motion_ = proved_motion(std::move(setting));
    });
    return motion_;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(rest_, pose);
    BoundedDeformer copy(rest_, final_basis(rest_.cage));
    Found found;
    Points zeros;
    copy.solve(pose, {}, nullptr, found, zeros);
    return std::make_unique<BoundedPointMap>(copy.basis_, rest_.mesh,
                                             evaluator_of(found.solution.map), found.f);
  }

 private:
  struct Found : Solution {
    std::shared_ptr<const BoundaryBasis> basis;
    BoundedMap solution, conformal;
    bool is_identity = false;
    int flipped_triangles = 0;  ///< triangles inverted because the mesh is too coarse
    VectorXc f;                 ///< at the mesh's vertices
    Derivatives first;
    std::shared_ptr<const Solution> reference;
  };

  /// Drafts continue from `before` unless it is null.
  void solve(const Pose& pose, const EvalOptions& options, const Found* before, Found& found,
             Points& zeros) {
    reference_->deform(pose, options, before ? before->reference.get() : nullptr);
    throw_if_stopped(options.stop);
    found.reference = reference_->solution();
    if (reference_->is_identity() && bounds_.sigma <= 1 && bounds_.Sigma >= 1) {
      set_identity(found);
      return;
    }
    project(reference_->reference(zeros), pose, before && !before->is_identity ? before : nullptr,
            found);
    throw_if_stopped(options.stop);
    if (closing_->has_holes() && found.solution.certificate.holds) close(found.solution);
    integrate(pose, options.draft, found);
  }

  /// The locations of the pins that the solve takes into account.
  std::vector<Location> pin_locations() const {
    std::vector<Location> places;
    if (space_ == "psi" && reference_->uses_pins())
      for (const auto& pin : pins_)
        if (pin) places.push_back(*pin);
    return places;
  }

  void prepare_space() {
    if (space_ == "nu") {
      nu_ = std::make_unique<BoundedSpace>(basis_, reference_->points(), BoundedSettings{bounds_});
      return;
    }
    PinRows rows;
    rows.weight = parameter(method_, rest_.parameters, "pin_weight");
    rows.size = box_of(rest_.mesh->vertices).diagonal();
    if (const std::vector<Location> places = pin_locations(); !places.empty())
      rows.psi = on_mesh_->psi_rows(places, basis_->coefficients());
    psi_ = std::make_unique<PsiSpace>(basis_, reference_->points(), BoundedSettings{bounds_},
                                      std::move(rows));
  }

  void project(const BoundedReference& followed, const Pose& pose, const Found* before,
               Found& found) const {
    if (nu_) {
      found.solution = nu_->nearest(followed, before ? &before->solution : nullptr);
      return;
    }
    const BoundedReference target = space_ == "h" ? psi_->convexified(followed) : followed;
    found.conformal = psi_->conformal(target, before ? &before->conformal : nullptr);
    found.solution = psi_->nearest(found.conformal, target, psi_at_pins(pose, found),
                                   before ? &before->solution : nullptr);
  }

  /// The values that Psi must have at the pins to take them to their targets.
  VectorXc psi_at_pins(const Pose& pose, const Found& found) const {
    if (pin_locations().empty()) return {};
    const VectorXc phi = on_mesh_->phi(found.conformal.map.l);
    const std::span<const Complex> places(phi.data(), static_cast<size_t>(phi.size()));
    std::vector<Complex> left;
    for (size_t i = 0; i < pins_.size(); ++i)
      if (pins_[i])
        left.push_back(std::conj(pose.pins[i].position - pins_[i]->in(*rest_.mesh, places)));
    return Eigen::Map<const VectorXc>(left.data(), static_cast<Index>(left.size()));
  }

  void set_identity(Found& found) const {
    found.is_identity = true;
    found.f = Eigen::Map<const VectorXc>(rest_.mesh->vertices.data(),
                                         static_cast<Index>(rest_.mesh->vertices.size()));
    found.solution.map = {VectorXc::Zero(basis_->size()), VectorXc::Zero(basis_->size())};
    found.solution.certificate.holds = true;
    found.solution.solution.status = ConeSolution::Status::solved;
  }

  Certificate certify(const LogMap& map) const {
    return nu_ ? nu_->certify(map) : psi_->certify(map);
  }

  /// Makes the map single-valued around the holes. If the closed map violates the bounds, starts
  /// nearer to a similarity, which is closed.
  void close(BoundedMap& solution) const {
    const VectorXc l = solution.map.l, w = solution.map.w;
    const Complex middle(bounds_.tightened(kTightening).middle(),
                         on_mesh_->function(l).mean().imag());
    for (double part = 0; part <= 1; part = part == 0 ? 1.0 / 64 : 2 * part) {
      LogMap map{l * (1 - part), w * (1 - part), solution.map.second};
      map.l.array() += part * middle;
      map = closing_->closed(std::move(map), bounds_.k == 0);
      solution.certificate = certify(map);
      solution.certificate.holds = solution.certificate.holds && closing_->is_closed(map);
      solution.map = std::move(map);
      if (solution.certificate.holds) return;
    }
  }

  /// Integrates the map along the mesh and aligns it.
  void integrate(const Pose& pose, bool draft, Found& found) const {
    MapOnMesh::Values values = on_mesh_->values(found.solution.map);
    found.first = std::move(values.first);
    // Next to the boundary, the quadrature along the tree is off by a thousandth of a pixel or
    // more, which may invert small triangles.
    if (draft) found.f = without_gaps(found, std::move(values.f));
    if (!draft || flipped_triangles(*rest_.mesh, found.f) > 0)
      found.f = without_gaps(found, on_mesh_->integrated(found.solution.map));
    align(pose, found);
    found.flipped_triangles = flipped_triangles(*rest_.mesh, found.f);
  }

  /// f without the jumps that integration around holes leaves.
  VectorXc without_gaps(const Found& found, VectorXc f) const {
    if (closing_->has_holes())
      f -= closing_->loops().correction(on_mesh_->tree(), closing_->gaps(found.solution.map));
    return f;
  }

  /// Rotates, scales and moves the map to the pins' targets or, with fewer than two pins, to the
  /// reference. The space L_nu determines rotation and scale only up to noise. A rotation preserves
  /// all bounds. A change of scale requires a new certificate. If that fails, the scale is not
  /// changed.
  void align(const Pose& pose, Found& found) const {
    Points from, to;
    const std::span<const Complex> f = as_span(found.f);
    if (reference_->uses_pins())
      for (size_t i = 0; i < pins_.size(); ++i)
        if (pins_[i]) {
          from.push_back(pins_[i]->in(*rest_.mesh, f));
          to.push_back(pose.pins[i].position);
        }
    if (from.size() < 2) {
      from.clear();
      for (const int v : reference_->anchors()) from.push_back(found.f[v]);
      to.assign(reference_->anchor_images().begin(), reference_->anchor_images().end());
    }
    const Similarity nearest = similarity_between(from, to);
    Complex factor = nearest.factor;
    LogMap map = scaled(found.solution.map, factor);
    const Certificate certificate = certify(map);
    if (certificate.holds) {
      found.solution.certificate = certificate;
    } else {
      factor /= std::abs(factor);
      map = scaled(found.solution.map, factor);
    }
    found.solution.map = std::move(map);
    found.first.phi *= factor;
    found.first.psi *= std::conj(factor);
    for (Complex& w : found.f) w = Similarity{factor, nearest.from, nearest.to}(w);
  }

  void answer(const Found& found, SampledMap& out, EvalOptions options) const {
    if (found.is_identity) {
      const Index count = static_cast<Index>(rest_.samples.size());
      out.f = Eigen::Map<const VectorXc>(rest_.samples.data(), count);
      if (!options.derivatives) return;
      out.fz = VectorXc::Ones(count);
      out.fzbar = VectorXc::Zero(count);
      return;
    }
    if (rest_.samples == rest_.mesh->vertices) {
      out.f = found.f;
      if (!options.derivatives) return;
      out.fz = found.first.phi;
      out.fzbar = found.first.psi.conjugate();
      return;
    }
    SampledMap map = BoundedPointMap(basis_, rest_.mesh, evaluator_of(found.solution.map), found.f)
                         .at(rest_.samples);
    out.f = std::move(map.f);
    out.fz = std::move(map.fz);
    out.fzbar = std::move(map.fzbar);
  }

  /// A limit as text, for example "smallest size 20 %".
  std::string limit_text(Bound bound) const {
    const double value = bound == Bound::k       ? bounds_.k
                         : bound == Bound::sigma ? bounds_.sigma
                                                 : bounds_.Sigma;
    char text[64];
    std::snprintf(text, sizeof text, "%s %.3g %%", bound_name(bound), 100 * value);
    return text;
  }

  /// The result of the proof, and other remarks for the user.
  std::string note(const Pose& pose, const Found& found, bool draft) const {
    const Certificate& certificate = found.solution.certificate;
    if (!certificate.holds)
      return std::string("Not proved: limit on ") + bound_name(certificate.failed) + " near " +
             point_text(certificate.where);
    std::string text = "No folds" + pin_note(pose, found);
    if (!reference_->note().empty()) text += ". " + reference_->note();
    if (!draft && found.solution.solution.status != ConeSolution::Status::solved)
      text += ". A nearer map may exist";
    if (found.flipped_triangles > 0) return coarse_mesh_text(found.flipped_triangles);
    return text;
  }

  /// Names the pin that is farthest from its target, and the bound that holds it back.
  std::string pin_note(const Pose& pose, const Found& found) const {
    if (!reference_->uses_pins()) return pins_.empty() ? "" : ". The followed method ignores pins";
    const std::span<const Complex> f = as_span(found.f);
    double farthest = 0;
    size_t which = 0;
    for (size_t i = 0; i < pins_.size(); ++i) {
      if (!pins_[i]) continue;
      const double off = std::abs(pins_[i]->in(*rest_.mesh, f) - pose.pins[i].position);
      if (off > farthest) farthest = off, which = i;
    }
    const double visible = kMissed * box_of(rest_.mesh->vertices).diagonal();
    if (farthest < visible) return "";
    const std::string text = short_pin_text(which, farthest);
    if (const auto bound =
            binding_constraint({&found.conformal.solution, &found.solution.solution}))
      return text + " (limit: " + limit_text(*bound) + ")";
    const std::optional<Complex> followed = reference_->pin_image(which);
    const bool misses = followed && std::abs(*followed - pose.pins[which].position) >= visible;
    if (misses) return text + ", as in the followed map";
    return text + (space_ == "psi" ? ", because the pin weight is low"
                                   : std::string(", because ") +
                                         (space_ == "nu" ? "shape" : "size") + " is preferred");
  }

  Rest rest_;
  const Method& method_;
  Bounds bounds_;
  std::string space_;
  std::shared_ptr<const BoundaryBasis> basis_;
  std::unique_ptr<MapOnMesh> on_mesh_;
  std::unique_ptr<HoleClosing> closing_;
  std::unique_ptr<ReferenceSampler> reference_;
  std::unique_ptr<BoundedSpace> nu_;  ///< null when psi_ is used
  std::unique_ptr<PsiSpace> psi_;
  std::vector<std::optional<Location>> pins_;
  std::unique_ptr<BoundedDeformer> draft_;
  mutable std::once_flag motion_once_;
  mutable std::shared_ptr<const ProvedMotion> motion_;
};

std::unique_ptr<Deformer> make_bounded(const Rest& rest, const Deformer*) {
  auto deformer = std::make_unique<BoundedDeformer>(rest, BoundedDeformer::final_basis(rest.cage));
  deformer->prepare_draft();
  return deformer;
}

}  // namespace

Method bounded_method(const std::vector<Method>& references, const std::string& usual_id) {
  std::vector<ParameterSpec::Option> followed;
  size_t usual = 0;
  for (const Method& method : references) {
    if (method.id == usual_id) usual = followed.size();
    followed.push_back({method.id, method.label});
  }
  return {
      .id = "bounded",
      .label = "No folds",
      .summary = "Nothing folds. Limits how much anything stretches.",
      .hint =
          "Nothing folds and nothing stretches more than you allow. This is proved for every "
          "frame.",
      .parameters = {one_of("reference", "Follows",
                            "The method whose map is kept within the limits", followed, usual),
                     one_of("space", "Prefer",
                            "What to preserve first if the limits rule out preserving everything",
                            {{"nu", "shape"}, {"psi", "pins"}, {"h", "size"}}),
                     in_percent(number("k", "Max shear",
                                       "0 % keeps all angles; near 100 %, circles may become flat",
                                       0.7, 0, 0.99)),
                     in_percent(number("sigma", "Smallest size",
                                       "No length shrinks below this part of its original", 0.2,
                                       0.01, 0.99)),
                     in_percent(by_decades("Sigma", "Max growth",
                                           "No length grows beyond this size", 5, 1.01, 100)),
                     used_with(
                         "space", 1,
                         by_decades("pin_weight", "Pin weight",
                                    "Higher values meet the pins more closely", 1000, 1, 1e6))},
      .uses_pins = true,
      .uses_strokes = true,
      .uses_outline = true,
      .uses_corners = true,
      .iterates = true,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .follows_others = true,
      .make = make_bounded,
      .presets = {{"Conformal", {{"k", 0}}},
                  {"Strict", {{"k", 0.5}, {"sigma", 0.5}, {"Sigma", 1.5}}},
                  {"Default", {}},
                  {"Loose", {{"k", 0.9}, {"sigma", 0.05}, {"Sigma", 20}}}},
  };
}

}  // namespace holomorph
