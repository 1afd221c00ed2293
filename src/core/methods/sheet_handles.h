// The handles of method `sheet`: what a rest holds, and where a pose pulls it.
#pragma once

#include "core/geometry/similarity.h"
#include "core/methods/puppet_handles.h"
#include "core/sheet/sheet_domain.h"
#include "core/sheet/sheet_program.h"

namespace holomorph {

/// Pins, points along strokes and, without either, the cage's boundary are rows of the sheet. Pins
/// with frames pull at the vertices of their disks.
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
  /// The pins that act, which have the first rows, and where they lie in the mesh.
  const std::vector<size_t>& pins() const { return handles_.pins(); }
  const std::vector<Location>& places() const { return places_; }
  const std::string& note() const { return handles_.note(); }
  bool moves_cage() const { return handles_.moves_cage(); }

  /// The radius of the disk around a pin without one.
  double usual_radius(Complex pin) const;

  /// Where a pose takes the handles.
  struct Target {
    VectorXc displacements;       ///< of the rows
    std::vector<Complex> frames;  ///< log scale + i angle, for each pin with a frame
    Turns turns;                  ///< of the pins

    /// The farthest way of a row, and the largest rotation of a pin or a frame.
    double farthest() const;
    double largest_turn() const;
    bool has_turns() const;  ///< whether a pin has a turn that is not 0
  };
  /// Throws Error if check_pose does.
  Target target(const Pose& pose) const;
  /// The rigid motion that takes all handles to their targets up to rounding, or nothing if none
  /// exists. At rest, the motion is exactly the identity.
  std::optional<Similarity> rigid(const Target& target) const;
  /// Where the rows are after this part of the straight way from rest to their targets.
  Points straight(const Target& target, double part) const;
  /// The pull at a part of the way, where the rows are at these points. Pins with turns also turn
  /// the disks around them, with this part of the pull of a frame.
  SheetPull pull(const Target& target, const Points& at, double part, double guide) const;
  /// The pull at the end.
  SheetPull pull(const Target& target) const { return pull(target, straight(target, 1), 1, 0); }
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
  void add_frame(const Rest& rest);
  void hold_beyond(double radius);

  PuppetHandles handles_;
  std::shared_ptr<const Mesh> mesh_;
  const SheetDomain& domain_;
  SheetHolds holds_;
  std::vector<Spring> springs_;  ///< of the rows, where these are far from rest
  std::vector<Location> places_;
  std::vector<Disk> guides_;    ///< around all pins
  std::vector<size_t> framed_;  ///< the rows of pins with frames
};

}  // namespace holomorph
