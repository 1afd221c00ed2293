// The smooth map of a sheet, with its proof.
#pragma once

#include "core/methods/sheet_solver.h"

namespace holomorph {

class ProvedSheet {
 public:
  /// The map with values f at the vertices of the solver's mesh, guarded.
  ProvedSheet(const SheetSolver& solver, const VectorXc& f);

  const SmoothMap& map() const { return *map_; }
  bool is_proved() const { return !guarded_.unproved; }
  /// A vertex next to which the proof fails, at rest.
  Complex unproved() const;
  /// The map at places in the mesh, with its status.
  SampledMap sampled(std::span<const Location> places, bool derivatives) const;
  Extremes extremes() const;
  /// The map, without this object.
  std::unique_ptr<SmoothMap> released() { return std::move(map_); }

 private:
  const Mesh& mesh_;
  std::unique_ptr<SmoothMap> map_;
  SmoothMap::Guarded guarded_;
};

}  // namespace holomorph
