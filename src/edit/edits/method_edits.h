// Edits to the method of a deformation and to its parameters. A method that is kept from folding is
// stored as the method `bounded`, which follows it. To the user it is the same method with the
// switch "Prevent folds".
#pragma once

#include "core/maps/method.h"
#include "scene/with_method.h"

namespace holomorph {

/// The method that the user has chosen: the deformation's own, or the one that it follows.
const Method& chosen_method(const Deformation& deformation);
/// Whether folds are prevented by following the chosen method.
bool prevents_folds(const Deformation& deformation);
/// Whether the switch exists for a method. It does not for methods that never fold by themselves.
bool can_prevent_folds(const Method& method);

/// Whether the deformation's chosen method is the usual method for this use.
bool has_method_for(const Deformation& deformation, MethodUse use);
/// Switches to the usual method for this use.
Deformation with_method_for(Deformation deformation, MethodUse use);

/// Chooses another method and keeps folds prevented, or not. Where the switch does not exist, its
/// state is kept until a method with a switch is chosen again.
Deformation with_chosen_method(Deformation deformation, const std::string& id);
/// Turns the switch on or off. Does nothing if the chosen method has no switch.
Deformation with_folds_prevented(Deformation deformation, bool on);

/// The parameters of the chosen method.
const Parameters& chosen_parameters(const Deformation& deformation);
/// Sets a parameter of a method, which may be the deformation's own or another one.
Deformation with_parameter(Deformation deformation, const std::string& method,
                           const std::string& key, double value);
/// Applies a preset of the deformation's own method. Parameters that only other presets set are
/// reset to their defaults.
Deformation with_preset(Deformation deformation, const Preset& preset);

/// Gives the cage the pose in which it is displayed while pins move the picture: each segment
/// becomes the curve through the images of points on the rest segment. `image` is the map.
template <class Image>
Cage image_of_cage(const Cage& rest, const Cage& pose, Image image) {
  Cage posed = pose;
  for (Index i = 0; i < rest.size(); ++i) {
    const Points controls = rest.controls(i);
    const int degree = pose.degree(i), samples = degree == 1 ? 2 : 4 * degree + 1;
    Points images;
    std::vector<double> parameters;
    for (int k = 0; k < samples; ++k) {
      parameters.push_back(static_cast<double>(k) / (samples - 1));
      images.push_back(image(bezier_point(controls, parameters.back())));
    }
    const Points curve = fitted(images, parameters, degree);
    for (int m = 0; m < degree; ++m) posed.segments[i][m] = curve[m];
  }
  return posed;
}

}  // namespace holomorph
