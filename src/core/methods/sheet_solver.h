// Finds the maps of an elastic sheet with handles.
#pragma once

#include <mutex>
#include <stop_token>

#include "core/maps/deformer.h"
#include "core/methods/sheet_handles.h"
#include "core/sheet/conformal_path.h"
#include "core/sheet/smooth_map.h"

namespace holomorph {

/// A map, as it is found.
struct SheetState {
  VectorXc f;                 ///< at the mesh's vertices
  std::vector<double> turns;  ///< of the pins: rotations of the picture there, unwrapped
  /// The targets of the rows where the last step toward them hardly lowered the energy; else empty.
  Points rests_at = {};
};

class SheetSolver;
/// A map that was found, as a value from which a draft or a motion of the same solver can continue.
struct SheetSolution : Solution {
  std::shared_ptr<const SheetSolver> solver;
  SheetState state;
};

/// What a rest determines. Threads: const functions may run at the same time; Newton steps take
/// turns.
class SheetSolver {
 public:
  /// Parts that `previous` has in common are shared; it may be null.
  struct Settings {
    double roundness = 0.5, pin_weight = 1e5, stretch_limit = 6;
    bool exact = false;
    bool operator==(const Settings&) const = default;
  };
  SheetSolver(const Rest& rest, const Settings& settings, const SheetSolver* previous);

  const SheetDomain& domain() const { return *domain_; }
  const SheetHandles& handles() const { return handles_; }
  const SheetEnergy& energy() const { return *energy_; }
  const Settings& settings() const { return settings_; }
  SheetState at_rest() const;

  /// The map of a target. It depends on nothing else: the handles go there from rest in many small
  /// steps, and pins with turns also turn the picture. If they are to turn far, they follow a
  /// conformal path, or one that winds the picture up if that turns them otherwise. If no pin has a
  /// turn, the map is the better one of those with and without such a path. Throws Stopped.
  SheetState solved(const SheetHandles::Target& target, const std::stop_token& stop) const;
  /// A step from a map toward that of a target.
  SheetState followed(const SheetHandles::Target& target, SheetState before) const;
  /// The map of a target to which many steps lead, at most 500. Throws Stopped.
  SheetState settled(const SheetHandles::Target& target, SheetState before,
                     const std::stop_token& stop) const;
  /// The exact position of each pin, for those that have one.
  using Places = std::vector<std::optional<Complex>>;
  /// The map near f to which a pull leads, after a few steps. Pins are within 1e-7 of the size of
  /// their places.
  VectorXc relaxed(const SheetPull& pull, const Places& places, VectorXc f) const;

  /// The forces that are missing for a map to be in equilibrium, one for each vertex.
  VectorXc missing_load(const SheetPull& pull, const VectorXc& f) const;

  /// The map at single points, not guarded yet.
  SmoothMap smooth(const VectorXc& f) const;

 private:
  SheetState reached(const SheetHandles::Target& target, const ConformalPaths::Path* path,
                     const std::stop_token& stop) const;
  const ConformalPaths& paths() const;
  SheetProgram::Step minimize(const SheetPull& pull, int most, SheetState& state,
                              const std::stop_token& stop = {}, bool is_near = false) const;
  void meet_within_reach(const SheetHandles::Target& target, SheetState& state) const;
  void settle(const SheetHandles::Target& target, SheetState& state,
              const std::stop_token& stop) const;
  void meet(SheetPull pull, const Places& places, double within, SheetState& state) const;

  Settings settings_;
  std::vector<BrushDab> stiffness_;
  std::shared_ptr<const SheetDomain> domain_;
  std::shared_ptr<const SheetEnergy> energy_;
  SheetHandles handles_;
  std::unique_ptr<SheetProgram> program_;
  mutable std::once_flag paths_once_;
  mutable std::unique_ptr<const ConformalPaths> paths_;
};

}  // namespace holomorph
