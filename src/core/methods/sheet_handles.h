// The handles of method `sheet`: what a rest holds, and where a pose pulls it.
#pragma once

#include <algorithm>

#include "core/geometry/similarity.h"
#include "core/methods/puppet_handles.h"
#include "core/sheet/sheet_domain.h"
#include "core/sheet/sheet_program.h"

namespace holomorph {

/// Pins, points along strokes and, without either, the cage's boundary are the first rows of the
/// sheet. The others are the arms of pins with frames: vectors from the pins to the vertices of
/// their disks, which turn and scale.
class SheetHandles {
 public:
  struct Settings {
    double pin_weight = 0;  ///< per squared distance in units of the picture's size
    /// Pins and the points of strokes give way where they would stretch a limb to more than about
    /// this many times its length.
    double stretch_limit = 0;
  };
  SheetHandles(const Rest& rest, const SheetDomain& domain, const SheetEnergy& energy,
               const Settings& settings);

  const SheetHolds& holds() const { return holds_; }
  /// The rows that move: those of pins, strokes and the cage.
  std::vector<SheetRow> moving_rows() const;
  /// The pins that act, which have the first rows, and where they lie in the mesh.
  const std::vector<size_t>& pins() const { return handles_.pins(); }
  const std::vector<Location>& places() const { return places_; }
  bool is_framed(size_t row) const { return std::ranges::find(framed_, row) != framed_.end(); }
  const std::string& note() const { return handles_.note(); }
  bool moves_cage() const { return handles_.moves_cage(); }

  /// The radius of the disk around a pin without one.
  double usual_radius(Complex pin) const;

  /// Where a pose takes the handles.
  struct Target {
    VectorXc displacements;       ///< of the rows
    std::vector<Complex> frames;  ///< log scale + i angle, for each pin with a frame
    Turns turns;                  ///< of the pins; none for those with frames

    /// The farthest way of a row, and the largest rotation of a pin or a frame.
    double farthest() const;
    double largest_turn() const;
    bool has_turns() const;  ///< whether a pin has a turn that is not 0
  };
  /// Throws Error if check_pose does.
  Target target(const Pose& pose) const;
  /// The rotation of a pin: that of its frame, or else its turn, if it has one.
  std::optional<double> turn(size_t row, const Target& target) const;
  /// The whole turns that most pins ask for in addition to these rotations, one for each pin: 0 if
  /// something is fixed, and so cannot turn.
  int whole_turns(const Target& target, const std::vector<double>& rotations) const;
  /// The rigid motion that takes all handles to their targets up to rounding, or nothing if none
  /// exists. At rest, the motion is exactly the identity.
  std::optional<Similarity> rigid(const Target& target) const;
  /// Where pins, strokes and the cage are after this part of the straight way from rest to their
  /// targets.
  Points straight(const Target& target, double part) const;
  /// The pull at a part of the way, where pins, strokes and the cage are to be at these points.
  /// `turns` are the rotations of the picture at the pins. A frame asks for at most a twelfth of a
  /// turn more. Otherwise, a picture that cannot follow a ring would snap to the other side.
  SheetPull pull(const Target& target, const Points& at, double part,
                 const std::vector<double>& turns) const;
  /// The pull at the end.
  SheetPull pull(const Target& target, const std::vector<double>& turns) const {
    return pull(target, straight(target, 1), 1, turns);
  }
  /// Whether a frame is farther from its target than it pulls.
  bool is_behind(const Target& target, const std::vector<double>& turns) const;
  /// Adds pulls that turn the disks around pins with turns, at a part of the way. Their forces have
  /// no limit. `strength` is relative to the pull of a frame.
  void add_turns(const Target& target, double part, double strength, SheetPull& pull) const;
  /// The image of a row.
  Complex image(size_t row, const VectorXc& f) const { return holds_.rows[row].image(f); }
  /// Whether a row's spring gives way where it misses its target by this.
  bool gives_way(size_t row, const Target& target, double missed) const {
    const Spring own = spring(row, target);
    return 2 * own.weight * own.inverse_force * missed > 1;
  }
  Complex wanted(size_t row, const Target& target) const {
    return stations()[row] + target.displacements[static_cast<Index>(row)];
  }

 private:
  /// The vertices around a pin, with parts of its pull.
  using Disk = std::vector<std::pair<int, double>>;
  const Points& stations() const { return handles_.isometric().stations; }
  Spring usual_spring(const Rest& rest, size_t row, const SheetEnergy& energy,
                      const Settings& settings) const;
  Spring spring(size_t row, const Target& target) const;
  Disk disk_of(const Rest& rest, size_t row) const;
  SheetRow arm(size_t row, int vertex) const;
  Complex arm_at_rest(size_t row, int vertex) const;
  Spring arm_spring(size_t row, double share) const;
  void add_frame(const Rest& rest);
  void hold_beyond(double radius);

  PuppetHandles handles_;
  std::shared_ptr<const Mesh> mesh_;
  const SheetDomain& domain_;
  SheetHolds holds_;
  std::vector<Spring> springs_;  ///< of the rows, where these are far from rest
  std::vector<Location> places_;
  std::vector<Disk> disks_;     ///< around all pins
  std::vector<size_t> framed_;  ///< the rows of pins with frames
};

}  // namespace holomorph
