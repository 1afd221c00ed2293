// Motion of all parts of a picture: each part's own, put together at every moment.
#include "core/methods/notes.h"
#include "core/methods/sheet_parts.h"

namespace holomorph {
namespace {

/// What the intervals of the parts have found; null for loose parts.
struct BlendedParts final : Solution {
  std::vector<std::shared_ptr<const Solution>> parts;
};

class PartsInterval final : public MotionInterval {
 public:
  PartsInterval(std::shared_ptr<const SheetParts> sheets,
                std::vector<std::unique_ptr<MotionInterval>> parts)
      : sheets_(std::move(sheets)), parts_(std::move(parts)) {}

  SampledMap at(double u, bool measures) const override {
    std::vector<MapOfPart> maps(parts_.size());
    const auto found = std::make_shared<BlendedParts>();
    found->parts.resize(parts_.size());
    std::string slides, unproved;
    for (size_t p = 0; p < parts_.size(); ++p) {
      if (!parts_[p]) continue;
      SampledMap& map = maps[p].map = parts_[p]->at(u, measures);
      found->parts[p] = map.solution;
      const Index anchors = static_cast<Index>(sheets_->division.parts()[p].anchors.size()),
                  count = map.f.size() - anchors;
      for (Index i = count; i < count + anchors; ++i)
        maps[p].anchors.push_back({map.f[i], map.fz[i], map.fzbar[i]});
      for (VectorXc* values : {&map.f, &map.fz, &map.fzbar}) values->conservativeResize(count);
      if (map.status == SampledMap::Status::certified)
        slides += map.note.substr(kNoFoldsBetween.size());
      else if (unproved.empty())
        unproved = map.note;
    }
    SampledMap all = sheets_->merged(std::move(maps), true);
    if (all.coarse_triangles > 0) all.status = SampledMap::Status::infeasible;
    all.note = !unproved.empty()          ? std::move(unproved)
               : all.coarse_triangles > 0 ? coarse_mesh_text(all.coarse_triangles) + slides
                                          : kNoFoldsBetween + slides;
    all.solution = found;
    return all;
  }

 private:
  std::shared_ptr<const SheetParts> sheets_;
  std::vector<std::unique_ptr<MotionInterval>> parts_;  ///< null for loose parts
};

class PartsMotion final : public ProvedMotion {
 public:
  explicit PartsMotion(std::shared_ptr<const SheetParts> sheets) : sheets_(std::move(sheets)) {
    for (const auto& part : sheets_->parts) motions_.push_back(part ? part->motion() : nullptr);
  }

  std::unique_ptr<MotionInterval> interval(const MotionKey* before, const MotionKey& from,
                                           const MotionKey& to, const MotionKey* after,
                                           bool smooth) const override {
    std::vector<std::unique_ptr<MotionInterval>> intervals(motions_.size());
    for (size_t p = 0; p < motions_.size(); ++p) {
      if (!motions_[p]) continue;
      std::array<std::optional<KeyOfPart>, 4> keys{key(p, before), key(p, &from), key(p, &to),
                                                   key(p, after)};
      if (!keys[1] || !keys[2]) return nullptr;
      for (auto& own : keys)
        if (own) own->key.pose = &own->pose;
      intervals[p] = motions_[p]->interval(keys[0] ? &keys[0]->key : nullptr, keys[1]->key,
                                           keys[2]->key, keys[3] ? &keys[3]->key : nullptr, smooth);
      if (!intervals[p]) return nullptr;
    }
    return std::make_unique<PartsInterval>(sheets_, std::move(intervals));
  }

  std::unique_ptr<PointMap> point_map(const SampledMap& between) const override {
    const auto* found = dynamic_cast<const BlendedParts*>(between.solution.get());
    if (!found) return nullptr;
    std::vector<std::unique_ptr<PointMap>> maps(motions_.size());
    for (size_t p = 0; p < motions_.size(); ++p) {
      if (!motions_[p]) continue;
      SampledMap part;
      part.solution = found->parts[p];
      maps[p] = motions_[p]->point_map(part);
    }
    return map_of_parts(sheets_, std::move(maps));
  }

 private:
  struct KeyOfPart {
    MotionKey key;
    Pose pose;
  };
  /// None if the key has no solution.
  std::optional<KeyOfPart> key(size_t p, const MotionKey* whole) const {
    if (!whole) return {};
    const auto* found = dynamic_cast<const SheetSolutions*>(whole->solution.get());
    if (!found || found->parts.size() != motions_.size() || !found->parts[p]) return {};
    KeyOfPart own{*whole, sheets_->division.pose_of(p, *whole->pose)};
    own.key.solution = found->parts[p];
    const std::vector<double>& turns = found->parts[p]->state.turns;
    if (motions_.size() > 1 && !turns.empty()) {
      own.key.rotation = 0;
      for (const double turn : turns) own.key.rotation += turn / static_cast<double>(turns.size());
    }
    return own;
  }

  std::shared_ptr<const SheetParts> sheets_;
  std::vector<std::shared_ptr<const ProvedMotion>> motions_;  ///< null for loose parts
};

}  // namespace

std::shared_ptr<const ProvedMotion> motion_of_parts(std::shared_ptr<const SheetParts> sheets) {
  return std::make_shared<const PartsMotion>(std::move(sheets));
}

}  // namespace holomorph
