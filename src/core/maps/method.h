// The table of methods.
//
// To add a method, write a file in methods/ that returns its table row, and add the row to rows.h
// and methods.cpp. Sliders, the palette, JSON fields and the contract tests iterate over the table.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/maps/rest.h"

namespace holomorph {

class Deformer;

/// The description of a parameter of a method, for sliders, JSON fields and the help. The value of
/// a choice is the index of the selected option. Files store the option's id.
struct ParameterSpec {
  struct Option {
    std::string id, label;
  };
  enum class Type { number, toggle, choice };
  std::string key, label, hint;
  Type type = Type::number;
  double fallback = 0, lowest = 0, highest = 1;
  bool logarithmic = false;
  bool percent = false;  ///< the interface shows 100 times the value
  struct Condition {
    std::string key;
    double value = 0;
  };
  /// The parameter takes effect only while another parameter has this value.
  std::optional<Condition> used_when = {};
  bool needs_parts = false;          ///< it takes effect only if the cage has several parts
  std::vector<Option> options = {};  ///< for Type::choice
};

/// Named parameter values, such as "strict". Missing parameters have their defaults.
struct Preset {
  std::string label;
  Parameters parameters;
};

/// A row of the table of methods. Rows set fields by name; omitted fields keep their defaults.
struct Method {
  std::string id, label;
  std::string summary;  ///< what it keeps, in one short sentence or two
  std::string hint;
  std::vector<ParameterSpec> parameters = {};
  bool uses_pins = false, uses_strokes = false, uses_outline = false, uses_corners = false,
       uses_stiffness = false, uses_frame = false;
  bool holds_disks = false;        ///< the frame of a pin acts on a disk, not on its center alone
  bool pins_replace_cage = false;  ///< while there are pins, the posed cage has no effect
  bool limbs_in_front = false;     ///< limbs are drawn in front of the body: EqualHeights::outward
  bool never_folds = false;        ///< needs no other method to prevent folds
  bool comparable = false;         ///< core/compared can minimize its energy with the same pins
  bool iterates = false;           ///< too slow for every frame of a drag: solve it on a worker
  bool harmonic = true;            ///< f_z and conj(f_zbar) are holomorphic
  /// Motions of the plane: if all handles move by one of these, the map is that motion.
  enum class Motions { none, rigid, similar } reproduces = Motions::similar;
  bool needs_mesh = false;  ///< Rest::mesh must be set
  /// The map is smooth between the vertices of Rest::mesh, which should have edges about a fifth as
  /// long as the picture is wide there (HalfWidth). Other methods use finer meshes.
  bool smooths_mesh = false;
  bool allows_holes = true;   ///< the cage may have holes
  bool allows_parts = false;  ///< the cage may have several parts
  bool follows_others =
      false;  ///< approximates the map of another method, which has its own parameters
  /// Called by `prepare` with a checked rest.
  std::unique_ptr<Deformer> (*make)(const Rest& rest, const Deformer* previous) = nullptr;
  std::vector<Preset> presets = {};

  /// Precomputes a deformer. `previous` is this method's last deformer, or null. Work that depends
  /// only on inputs that both rests share need not be repeated. Throws Error for a rest that cannot
  /// be used.
  ///
  /// Threads: this may run on one thread while `previous->deform` runs on another. Therefore `make`
  /// reads only members of `previous` that do not change after construction. It keeps them alive
  /// through shared ownership, because `previous` may be destroyed as soon as this returns.
  std::unique_ptr<Deformer> prepare(const Rest& rest, const Deformer* previous) const;
};

/// The table of methods, in menu order.
const std::vector<Method>& methods();
/// The row with this id. Throws Error with a list of the known ids.
const Method& method_named(const std::string& id);

/// The features of a method that an edit or a tool may need.
enum class MethodUse {
  cage,
  puppet,  ///< pins in a cage that is at rest
  pins,    ///< pins and posed cage points
  strokes,
  outline,
  corners,
  stiffness,
  bounds
};
/// The method to switch to when the current one does not support this use.
const Method& usual_method(MethodUse use);
/// The method that this one follows, or the method itself if it follows none.
const Method& followed_method(const Method& method, const Parameters& values);

/// The rest or the pose with only the handles that the method uses.
Rest used_by(const Method& method, Rest rest);
Pose used_by(const Method& method, Pose pose);

/// The parameters that a rest stores for the followed method.
Parameters parameters_of(const Rest& rest, const Method& followed);

/// The parameter's value, or its default when it is missing.
double parameter(const Method& method, const Parameters& values, const std::string& key);
/// Whether a parameter has any effect, given the values of the others.
bool is_used(const Method& method, const Parameters& values, const ParameterSpec& spec);
/// The id of the selected option of a choice.
std::string choice(const Method& method, const Parameters& values, const std::string& key);

}  // namespace holomorph
