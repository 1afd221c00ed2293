// The handles of method `puppet`: what a rest prescribes, and the targets of a pose.
#pragma once

#include "core/isometric/isometric_space.h"
#include "core/maps/rest.h"

namespace holomorph {

/// Pins and strokes prescribe positions, and pins with frames also prescribe rotation and scale on
/// the held disks. Without pins and strokes, the cage's boundary is prescribed.
class PuppetHandles {
 public:
  struct Settings {
    double frame_weight = 1;
  };
  PuppetHandles(const Rest& rest, const Settings& settings);

  /// Whether the cage's boundary is prescribed.
  bool moves_cage() const { return !cage_.empty(); }
  const IsometricHandles& isometric() const { return handles_; }
  /// Throws Error if check_pose does.
  IsometricTarget target(const Pose& pose) const;
  /// The turns of the pins in a pose, one for each station of a pin.
  Turns turns(const Pose& pose) const;
  /// For each station of a pin, the pin's index. Pins are the first stations.
  const std::vector<size_t>& pins() const { return pins_; }
  /// The image of a station.
  Complex image(Index station, const IsometricTarget& target, const VectorXc& offsets) const;
  const std::string& note() const { return note_; }

 private:
  void add_station(Complex z, double weight);
  void add_frame(const RestPin& pin, size_t index, const Settings& settings);
  void add_strokes(double size);
  void add_cage();

  Rest rest_;
  IsometricHandles handles_;
  std::vector<size_t> pins_, framed_;  ///< framed_: the pin of each frame point
  struct StrokePoint {
    size_t stroke;
    double fraction;
  };
  std::vector<StrokePoint> strokes_;
  std::vector<std::pair<Index, double>> cage_;  ///< segments and parameters
  std::string note_;
};

}  // namespace holomorph
