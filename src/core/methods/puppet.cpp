// Method `puppet`: pins move parts of the picture, which keeps its sizes and shapes as far as
// possible and cannot fold. The energy is the symmetric Dirichlet energy, in unknowns in which it
// is convex.
#include <algorithm>
#include <mutex>

#include "core/error.h"
#include "core/geometry/simplify.h"
#include "core/geometry/stiffness.h"
#include "core/isometric/isometric_space.h"
#include "core/isometric/mesh_display.h"
#include "core/maps/distortion.h"
#include "core/methods/bounded_points.h"
#include "core/methods/notes.h"
#include "core/methods/parameters.h"
#include "core/methods/proved_motion.h"
#include "core/methods/puppet_handles.h"
#include "core/methods/rows.h"

namespace holomorph {
namespace {

constexpr int kBoundarySamples = 6;
constexpr size_t kSamplesInside = 300;

class PuppetDeformer final : public Deformer {
 public:
  /// Shares what depends on the domain alone with `previous`, which may be null.
  PuppetDeformer(const Rest& rest, const PuppetDeformer* previous)
      : rest_(rest),
        method_(method_named("puppet")),
        handles_(rest_, {.frame_weight = value("frame_weight")}) {
    if (previous && previous->rest_.cage == rest.cage && previous->rest_.mesh == rest.mesh &&
        previous->handles_.moves_cage() == handles_.moves_cage()) {
      basis_ = previous->basis_;
      display_ = previous->display_;
    } else {
      basis_ = basis_for(handles_.moves_cage() ? rest.cage : thinned(rest.cage));
      display_ = std::make_shared<const MeshDisplay>(*basis_, *rest_.mesh);
    }
    const std::vector<AreaSample> inner = inner_samples();
    space_ = std::make_shared<const IsometricSpace>(basis_, *rest_.mesh, handles_.isometric(),
                                                    inner, stiffness(inner), energy(), bounds());
    for (const Complex& z : handles_.isometric().stations)
      locations_.push_back(locate_near(*rest_.mesh, z));
  }

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    const IsometricTarget target = handles_.target(pose);
    const auto* before = dynamic_cast<const Found*>(from);
    const auto found = std::make_shared<Found>();
    found->basis = basis_;
    found->space = space_;
    if (options.draft && before && before->space == space_)
      found->map = space_->followed(target, settings(), before->map);
    else
      found->map = space_->solved(target, settings(options.stop), handles_.turns(pose));
    SampledMap out;
    answer(target, options, *found, out);
    out.iterations = found->map.solution.iterations;
    out.turns.resize(rest_.pins.size());
    for (size_t k = 0; k < handles_.pins().size(); ++k)
      out.turns[handles_.pins()[k]] = found->map.turns[k];
    if (!options.draft && out.status == SampledMap::Status::certified)
      out.extremes = space_->extremes(found->map.map);
    if (found->map.certificate.holds && rest_.samples == rest_.mesh->vertices)
      out.coarse_triangles = flipped_triangles(*rest_.mesh, out.f);
    out.note = note(found->map, out);
    if (!options.draft && is_twisted(target, pose, options.stop, found->map))
      out.note += ". Untwist would relax it";
    out.solution = found;
    return out;
  }

  std::shared_ptr<const ProvedMotion> motion() const override {
    std::call_once(motion_once_, [this] {
      MotionSetting setting{basis_, rest_.mesh, handles_.pins(), {}, {}};
      for (const size_t i : setting.pins) setting.positions.push_back(rest_.pins[i].position);
      setting.map_of = [basis = basis_](const Solution& solution) -> const LogMap* {
        const auto* found = dynamic_cast<const Found*>(&solution);
        return found && found->basis == basis ? &found->map.map : nullptr;
      };
      motion_ = proved_motion(std::move(setting));
    });
    return motion_;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    const IsometricTarget target = handles_.target(pose);
    const IsometricMap map = space_->solved(target, settings(), handles_.turns(pose));
    return points_of(target, map);
  }

 private:
  struct Found : Solution {
    std::shared_ptr<const BoundaryBasis> basis;
    std::shared_ptr<const IsometricSpace> space;
    IsometricMap map;
  };

  IsometricSpace::Settings settings(std::stop_token stop = {}) const {
    return {value("pin_weight"), value("exact") != 0, false, std::move(stop)};
  }
  /// Whether the map that the turns lead to costs much more than the map without them.
  bool is_twisted(const IsometricTarget& target, const Pose& pose, const std::stop_token& stop,
                  const IsometricMap& map) const {
    constexpr double kStrained = 4, kClearly = 0.7;  // energies; 2 is rigid
    if (!map.certificate.holds || map.solution.energy < kStrained) return false;
    if (std::ranges::all_of(handles_.turns(pose),
                            [](const auto& turn) { return turn.value_or(0) == 0; }))
      return false;
    IsometricSpace::Settings quick = settings(stop);
    quick.exact = false;
    quick.estimates = true;
    return space_->solved(target, quick).solution.energy < kClearly * map.solution.energy;
  }
  double value(const char* key) const { return parameter(method_, rest_.parameters, key); }

  /// The cage without vertices that the shape does not need. It contains the cage, so what is
  /// proved for it holds in the cage. Points that were inserted into straight edges change nothing.
  static Cage thinned(const Cage& cage) {
    constexpr double kTolerance = 0.002;  // in units of the size
    return thinned_around(cage, kTolerance * box_of(vertices_of(cage)).diagonal());
  }
  static std::shared_ptr<const BoundaryBasis> basis_for(const Cage& domain) {
    const int size = BoundaryBasis::usual_size(2 * domain.size());
    return std::make_shared<const BoundaryBasis>(domain, size, kBoundarySamples * size);
  }

  IsometricEnergy energy() const {
    const std::string form = choice(method_, rest_.parameters, "energy");
    if (form == "exponential") return {IsometricEnergy::Form::exponential, value("sharpness")};
    if (form == "power") return {IsometricEnergy::Form::power, value("sharpness")};
    return {};
  }

  std::optional<Bounds> bounds() const {
    if (value("limited") == 0) return {};
    return Bounds{value("k"), value("sigma"), value("Sigma")};
  }

  std::vector<AreaSample> inner_samples() const {
    // Each dab of the brush that is wide enough to matter has a sample.
    constexpr double kWide = 0.02;
    const double size = box_of(rest_.mesh->vertices).diagonal();
    Points wanted;
    for (const BrushDab& dab : rest_.stiffness)
      if (dab.radius > kWide * size) wanted.push_back(dab.at);
    return area_samples(*rest_.mesh, kSamplesInside, wanted);
  }

  VectorXd stiffness(const std::vector<AreaSample>& inner) const {
    if (rest_.stiffness.empty()) return {};
    Points points = basis_->samples();
    for (const AreaSample& sample : inner)
      points.push_back(rest_.mesh->vertices[static_cast<size_t>(sample.vertex)]);
    VectorXd factors(static_cast<Index>(points.size()));
    for (Index i = 0; i < factors.size(); ++i)
      factors[i] = std::pow(10, stiffness_level(rest_.stiffness, points[static_cast<size_t>(i)]));
    return factors;
  }

  /// The map at any point, exact up to rounding.
  std::unique_ptr<BoundedPointMap> points_of(const IsometricTarget& target,
                                             const IsometricMap& map) const {
    VectorXc f = integrated_along(display_->tree(), *basis_, map.map);
    f -= space_->loops().correction(display_->tree(), map.solution.gaps);
    auto points =
        std::make_unique<BoundedPointMap>(basis_, rest_.mesh, evaluator_of(map.map), std::move(f));
    points->move(handles_.image(0, target, map.solution.offsets) -
                 points->at(handles_.isometric().stations[0]).f);
    return points;
  }

  /// The map at the mesh's vertices, from the matrices for display, moved to the stations.
  void answer_draft(const IsometricTarget& target, EvalOptions options, const IsometricMap& map,
                    SampledMap& out) const {
    MeshDisplay::Values values = display_->values(map.map);
    out.f =
        Eigen::Map<const VectorXc>(rest_.samples.data(), static_cast<Index>(rest_.samples.size())) +
        values.moved;
    if (map.solution.gaps.size() > 0)
      out.f -= space_->loops().correction(display_->tree(), map.solution.gaps);
    Complex off = 0;
    for (size_t i = 0; i < locations_.size(); ++i)
      off += handles_.image(static_cast<Index>(i), target, map.solution.offsets) -
             locations_[i].in(*rest_.mesh, as_span(out.f));
    if (!locations_.empty()) out.f.array() += off / static_cast<double>(locations_.size());
    if (!options.derivatives) return;
    out.fz = std::move(values.first.phi);
    out.fzbar = values.first.psi.conjugate();
  }

  void answer(const IsometricTarget& target, EvalOptions options, const Found& found,
              SampledMap& out) const {
    const IsometricMap& map = found.map;
    out.status =
        map.certificate.holds ? SampledMap::Status::certified : SampledMap::Status::infeasible;
    const Index count = static_cast<Index>(rest_.samples.size());
    const Eigen::Map<const VectorXc> z(rest_.samples.data(), count);
    if (map.solution.x.isZero(0)) {
      out.f = z;
      if (map.solution.move != Complex(0)) out.f.array() += map.solution.move;
      if (!options.derivatives) return;
      out.fz = VectorXc::Ones(count);
      out.fzbar = VectorXc::Zero(count);
      return;
    }
    if (rest_.samples == rest_.mesh->vertices) {
      const bool single = rest_.precision == Precision::single;
      if (options.draft && single) return answer_draft(target, options, map, out);
      out.f = points_of(target, map)->at_vertices();
      if (!options.derivatives) return;
      if (single) {
        MeshDisplay::Values values = display_->values(map.map);
        out.fz = std::move(values.first.phi);
        out.fzbar = values.first.psi.conjugate();
      } else {
        Slopes slopes = slopes_at(*basis_, evaluator_of(map.map), rest_.samples);
        out.fz = std::move(slopes.fz);
        out.fzbar = std::move(slopes.fzbar);
      }
      return;
    }
    SampledMap at = points_of(target, map)->at(rest_.samples);
    out.f = std::move(at.f);
    out.fz = std::move(at.fz);
    out.fzbar = std::move(at.fzbar);
  }

  std::string note(const IsometricMap& map, const SampledMap& out) const {
    if (!map.certificate.holds) return "Not proved near " + point_text(map.certificate.where);
    std::string text =
        out.coarse_triangles > 0 ? coarse_mesh_text(out.coarse_triangles) : "No folds";
    const std::string missed = missed_pins_text(
        handles_.pins(), std::span(map.solution.offsets.data(), handles_.pins().size()),
        kMissed * box_of(rest_.mesh->vertices).diagonal());
    text += missed;
    if (!missed.empty())
      text += value("limited") != 0 ? ". The limits allow no more" : strain_text(out.extremes);
    if (!handles_.note().empty()) text += ". " + handles_.note();
    return text;
  }

  Rest rest_;
  const Method& method_;
  PuppetHandles handles_;
  std::shared_ptr<const BoundaryBasis> basis_;
  std::shared_ptr<const MeshDisplay> display_;
  std::shared_ptr<const IsometricSpace> space_;
  mutable std::once_flag motion_once_;
  mutable std::shared_ptr<const ProvedMotion> motion_;
  std::vector<Location> locations_;  ///< of the stations
};

std::unique_ptr<Deformer> make_puppet(const Rest& rest, const Deformer* previous) {
  return std::make_unique<PuppetDeformer>(rest, dynamic_cast<const PuppetDeformer*>(previous));
}

}  // namespace

Method puppet_method() {
  return {
      .id = "puppet",
      .label = "Harmonic puppet",
      .summary = "Keeps sizes. Moves the shape as a whole.",
      .hint =
          "Pins move parts of the picture. Sizes and shapes are kept as far as possible, and "
          "nothing folds. Paint stiffness (B) on parts that should change least. Without pins, "
          "the cage points stay where you put them.",
      .parameters =
          {toggle("exact", "Exact pins", "Meet the pins exactly when the pointer is released"),
           one_of("energy", "Extremes",
                  "What to do about parts that change their size or shape most",
                  {{"plain", "Allow"}, {"power", "Reduce"}, {"exponential", "Avoid"}}),
           by_decades("sharpness", "Strength",
                      "Higher values reduce the strongest change. No effect with Allow.", 1.5, 1,
                      4),
           by_decades("pin_weight", "Pin weight", "Higher values meet the pins more closely", 1e5,
                      1e2, 1e7),
           by_decades("frame_weight", "Rotation weight",
                      "Higher values meet the rotations and scales of pins more closely", 200, 1,
                      10000),
           toggle("limited", "Limits",
                  "Keep the distortion within limits everywhere; pins then give way"),
           used_with(
               "limited", 1,
               in_percent(number("k", "Max shear",
                                 "Near 0 %, angles are kept; near 100 %, circles may become flat",
                                 0.7, 0.05, 0.99))),
           used_with("limited", 1,
                     in_percent(number("sigma", "Smallest size",
                                       "No length shrinks below this part of its original", 0.5,
                                       0.01, 0.99))),
           used_with("limited", 1,
                     in_percent(by_decades("Sigma", "Max growth",
                                           "No length grows beyond this size", 2, 1.01, 100)))},
      .uses_pins = true,
      .uses_strokes = true,
      .uses_stiffness = true,
      .holds_disks = true,
      .pins_replace_cage = true,
      .limbs_in_front = true,
      .never_folds = true,
      .comparable = true,
      .iterates = true,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .make = make_puppet,
  };
}

}  // namespace holomorph
