#include "core/methods/sheet_parts.h"

#include <algorithm>

#include "core/maps/distortion.h"
#include "core/methods/parameters.h"

namespace holomorph {
namespace {

void include(const std::optional<Extremes>& part, std::optional<Extremes>& all) {
  if (!part || !all) return all.reset();
  all->shear = std::max(all->shear, part->shear);
  all->smallest = std::min(all->smallest, part->smallest);
  all->largest = std::max(all->largest, part->largest);
}

/// The maps of all parts, each where the part is.
class PartsMap final : public PointMap {
 public:
  PartsMap(std::shared_ptr<const SheetParts> sheets, std::vector<std::unique_ptr<PointMap>> maps)
      : sheets_(std::move(sheets)), maps_(std::move(maps)) {
    for (size_t p = 0; p < maps_.size(); ++p) {
      std::vector<Value> anchors;
      if (maps_[p]) anchors = maps_[p]->values_at(sheets_->division.parts()[p].anchors);
      anchors_.push_back(std::move(anchors));
    }
  }
  Value at(Complex z) const override {
    const size_t p = sheets_->division.part_at(z);
    if (maps_[p]) return maps_[p]->at(z);
    return sheets_->followed(p, anchors_[sheets_->division.parts()[p].leader->part], z);
  }
  bool is_piecewise() const override { return true; }

 private:
  std::shared_ptr<const SheetParts> sheets_;
  std::vector<std::unique_ptr<PointMap>> maps_;  ///< null for loose parts
  std::vector<std::vector<Value>> anchors_;
};

}  // namespace

SheetParts::SheetParts(const Rest& rest, const SheetParts* previous)
    : division(rest, previous ? &previous->division : nullptr),
      sample_count(static_cast<Index>(rest.samples.size())),
      drawn(rest.samples == rest.mesh->vertices ? rest.mesh : rest.drawn),
      loose_stay(parameter(method_named("sheet"), rest.parameters, "loose_stay") != 0) {
  for (const SheetDivision::Part& part : division.parts()) {
    const size_t p = parts.size();
    const SheetPart* known =
        previous && p < previous->parts.size() ? previous->parts[p].get() : nullptr;
    parts.push_back(part.leader
                        ? nullptr
                        : std::make_unique<SheetPart>(part.rest, part.pins, part.anchors, known));
  }
}

PointMap::Value SheetParts::followed(size_t loose, std::span<const PointMap::Value> anchors,
                                     Complex z) const {
  const SheetDivision::Part::Leader& leader = *division.parts()[loose].leader;
  const PointMap::Value& at = anchors[leader.anchor];
  const bool is_still = at.f == leader.at && at.fz == 1.0;
  if (loose_stay || is_still) return {z, 1, 0};  // without rounding errors
  return {at.f + at.fz * (z - leader.at), at.fz, 0};
}

SampledMap SheetParts::merged(std::vector<MapOfPart> maps, bool derivatives) const {
  const auto measured = [&](SampledMap map) {
    if (drawn && map.status == SampledMap::Status::certified)
      map.coarse_triangles = flipped_triangles(*drawn, map.f);
    return map;
  };
  if (maps.size() == 1) return measured(std::move(maps[0].map));
  SampledMap all;
  all.status = SampledMap::Status::certified;
  all.extremes = Extremes{};
  all.f.resize(sample_count);
  if (derivatives) all.fz.resize(sample_count), all.fzbar.resize(sample_count);
  for (size_t p = 0; p < maps.size(); ++p) {
    const SheetDivision::Part& part = division.parts()[p];
    SampledMap& map = maps[p].map;
    if (part.leader) {
      const std::vector<PointMap::Value>& anchors = maps[part.leader->part].anchors;
      const Index count = static_cast<Index>(part.samples.size());
      map.f.resize(count), map.fz.resize(count);
      map.fzbar = VectorXc::Zero(count);
      for (Index i = 0; i < count; ++i) {
        const PointMap::Value at = followed(p, anchors, part.rest.samples[static_cast<size_t>(i)]);
        map.f[i] = at.f, map.fz[i] = at.fz;
      }
    } else {
      if (map.status != SampledMap::Status::certified) all.status = map.status;
      include(map.extremes, all.extremes);
    }
    for (size_t i = 0; i < part.samples.size(); ++i) {
      const Index from = static_cast<Index>(i), to = part.samples[i];
      all.f[to] = map.f[from];
      if (derivatives) all.fz[to] = map.fz[from], all.fzbar[to] = map.fzbar[from];
    }
  }
  return measured(std::move(all));
}

std::unique_ptr<PointMap> map_of_parts(std::shared_ptr<const SheetParts> sheets,
                                       std::vector<std::unique_ptr<PointMap>> maps) {
  if (maps.size() == 1) return std::move(maps[0]);
  return std::make_unique<PartsMap>(std::move(sheets), std::move(maps));
}

}  // namespace holomorph
