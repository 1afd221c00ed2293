// Method `sheet`: an elastic sheet that resists changes of size and shape, and bending. Pins act
// near where they are, because the energy is that of the picture's area and not of a space of
// harmonic maps. Each part of a picture is a sheet of its own.
#include <mutex>

#include "core/error.h"
#include "core/methods/linear.h"
#include "core/methods/notes.h"
#include "core/methods/parameters.h"
#include "core/methods/rows.h"
#include "core/methods/sheet_parts.h"

namespace holomorph {
namespace {

class SheetDeformer final : public Deformer {
 public:
  SheetDeformer(const Rest& rest, const SheetDeformer* previous)
      : rest_(rest),
        sheets_(
            std::make_shared<const SheetParts>(rest, previous ? previous->sheets_.get() : nullptr)),
        ignored_(parts().size() == 1 ? parts()[0]->note() : sheets_->division.note()) {}

  using Deformer::deform;
  SampledMap deform(const Pose& pose, EvalOptions options, const Solution* from) override {
    check_pose(rest_, pose);
    const auto* before = dynamic_cast<const SheetSolutions*>(from);
    if (before && before->parts.size() != parts().size()) before = nullptr;
    const auto solution = std::make_shared<SheetSolutions>();
    solution->parts.resize(parts().size());
    std::vector<MapOfPart> maps(parts().size());
    std::vector<std::optional<double>> turns(rest_.pins.size()), better_turns;
    std::string missed;
    std::optional<Complex> unproved;
    bool twisted = false;
    for (size_t p = 0; p < parts().size(); ++p) {
      if (!parts()[p]) continue;
      SheetPart::Found found = parts()[p]->deform(sheets_->division.pose_of(p, pose), options,
                                                  before ? before->parts[p].get() : nullptr);
      const std::vector<size_t>& pins = sheets_->division.parts()[p].pins;
      for (size_t i = 0; i < pins.size(); ++i) turns[pins[i]] = found.map.turns[i];
      if (!found.map.better_turns.empty()) {
        if (better_turns.empty())
          for (const PosePin& pin : pose.pins) better_turns.push_back(pin.turn);
        for (size_t i = 0; i < pins.size(); ++i) better_turns[pins[i]] = found.map.better_turns[i];
      }
      missed += found.missed;
      if (!unproved) unproved = found.unproved;
      twisted = twisted || found.twisted;
      solution->parts[p] = std::move(found.solution);
      maps[p] = {std::move(found.map), std::move(found.anchors)};
    }
    SampledMap out = sheets_->merged(std::move(maps), options.derivatives);
    if (options.draft) out.extremes.reset();
    out.turns = std::move(turns);
    out.better_turns = std::move(better_turns);
    out.solution = solution;
    out.note = unproved                   ? "Not proved near " + point_text(*unproved)
               : out.coarse_triangles > 0 ? coarse_mesh_text(out.coarse_triangles) + missed
                                          : "No folds" + missed;
    if (!ignored_.empty()) out.note += ". " + ignored_;
    if (twisted) out.note += ". Untwist would relax it";
    return out;
  }

  std::unique_ptr<PointMap> point_map(const Pose& pose) const override {
    check_pose(rest_, pose);
    std::vector<std::unique_ptr<PointMap>> maps;
    for (size_t p = 0; p < parts().size(); ++p)
      maps.push_back(parts()[p] ? parts()[p]->point_map(sheets_->division.pose_of(p, pose))
                                : nullptr);
    return map_of_parts(sheets_, std::move(maps));
  }

  std::optional<double> usual_radius(size_t pin) const override {
    const Complex z = rest_.pins[pin].position;
    const auto& part = parts()[sheets_->division.part_at(z)];
    return part ? std::optional(part->solver()->handles().usual_radius(z)) : std::nullopt;
  }

  std::shared_ptr<const ProvedMotion> motion() const override {
    std::call_once(motion_once_, [this] { motion_ = motion_of_parts(sheets_); });
    return motion_;
  }

 private:
  const std::vector<std::unique_ptr<SheetPart>>& parts() const { return sheets_->parts; }

  Rest rest_;
  std::shared_ptr<const SheetParts> sheets_;
  std::string ignored_;  ///< handles without effect
  mutable std::once_flag motion_once_;
  mutable std::shared_ptr<const ProvedMotion> motion_;
};

std::unique_ptr<Deformer> make_sheet(const Rest& rest, const Deformer* previous) {
  return std::make_unique<SheetDeformer>(rest, dynamic_cast<const SheetDeformer*>(previous));
}

ParameterSpec loose_stay() {
  ParameterSpec spec = toggle("loose_stay", "Loose parts stay",
                              "Parts of the picture without pins stay where they are. Otherwise, "
                              "they follow the nearest part");
  spec.needs_parts = true;
  return spec;
}

}  // namespace

Method sheet_method() {
  return {
      .id = "sheet",
      .label = "Puppet",
      .summary = "Bends where you pull. Sizes stay.",
      .hint =
          "Pins move what is near them, and what is far away stays. Sizes and shapes are kept as "
          "far as possible, and nothing folds. Paint stiffness (B) on parts that should change "
          "least. Without pins, the cage points stay where you put them.",
      .parameters =
          {number("roundness", "Roundness",
                  "Higher values spread a bend over more of a limb; at 0, pins pull out spikes",
                  0.5, 0, 4),
           toggle("exact", "Exact pins",
                  "Meet all pins within reach exactly when the pointer is released"),
           by_decades("pin_weight", "Pin weight", "Higher values meet the pins more closely", 1e5,
                      1e2, 1e7),
           in_percent(by_decades("stretch_limit", "Stretch limit",
                                 "How far pins stretch the picture before they give way", 6, 2,
                                 40)),
           loose_stay()},
      .uses_pins = true,
      .uses_strokes = true,
      .uses_stiffness = true,
      .uses_frame = true,
      .holds_disks = true,
      .pins_replace_cage = true,
      .limbs_in_front = true,
      .never_folds = true,
      .iterates = true,
      .harmonic = false,
      .reproduces = Method::Motions::rigid,
      .needs_mesh = true,
      .smooths_mesh = true,
      .allows_parts = true,
      .make = make_sheet,
  };
}

}  // namespace holomorph
