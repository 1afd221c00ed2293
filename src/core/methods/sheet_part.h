// One part of the picture as an elastic sheet of its own.
#pragma once

#include "core/methods/proved_sheet.h"

namespace holomorph {

/// The sheet of a cage with one part. Threads: const functions may run at the same time.
class SheetPart {
 public:
  /// `numbers` are the indices of the rest's pins among those of the whole picture, for messages.
  /// `anchors` are the points that other parts follow.
  SheetPart(const Rest& rest, std::vector<size_t> numbers, const Points& anchors,
            const SheetPart* previous);

  struct Found {
    SampledMap map;  ///< at the rest's samples, without a note
    std::vector<PointMap::Value> anchors;
    std::string missed;  ///< which pins are not met, for notes
    std::optional<Complex> unproved;
    std::shared_ptr<const SheetSolution> solution;
    bool twisted = false;  ///< without the turns of its pins, the map would cost much less
  };
  Found deform(const Pose& pose, const EvalOptions& options, const Solution* from) const;
  std::unique_ptr<PointMap> point_map(const Pose& pose) const;

  const std::shared_ptr<const SheetSolver>& solver() const { return solver_; }
  /// Motion between maps, at the samples and then at the anchors.
  std::shared_ptr<const ProvedMotion> motion() const;
  const std::string& note() const { return solver_->handles().note(); }

 private:
  const SheetDomain& domain() const { return solver_->domain(); }
  const SheetHandles& handles() const { return solver_->handles(); }
  SheetState moved(const Similarity& rigid, const SheetHandles::Target& target) const;
  SampledMap rigid_map(const Similarity& rigid, const EvalOptions& options) const;
  std::string missed_text(const SheetHandles::Target& target, const SmoothMap& map,
                          const std::optional<Extremes>& extremes) const;
  bool is_twisted(SheetHandles::Target target, const SheetState& state,
                  const std::stop_token& stop) const;

  Points samples_, anchor_points_;
  std::vector<size_t> numbers_;
  std::shared_ptr<const SheetSolver> solver_;
  std::vector<Location> places_, anchors_;  ///< of the samples and the anchors
};

}  // namespace holomorph
