// What a file holds: layers, and what they share. A plain value; see layers.h for what is done with
// the stack.
#pragma once

#include <array>

#include "scene/deformation.h"

namespace holomorph {

/// The picture that a scene bends, and what its file was. In a file the path is relative to the
/// scene's folder, in a loaded scene absolute.
struct ImageReference {
  std::string file;
  std::string entry = {};  ///< which layer of an OpenRaster file: its file in there
  int width = 0, height = 0;
  std::string sha256;
  Extra extra;
  bool operator==(const ImageReference&) const = default;
};

/// A picture and how it is deformed.
struct Layer {
  int id = 1;  ///< identifies a layer within a session; not saved
  std::string name = {};
  bool visible = true;
  bool locked = false;  ///< edits are refused
  std::optional<ImageReference> image = {};
  Deformation deformation = {};
  Extra extra = {};

  /// Ids are not compared.
  bool operator==(const Layer& other) const;
};

/// A layer that scenes share until one of them changes it, because every drag copies scenes.
class SharedLayer {
 public:
  SharedLayer() : SharedLayer(Layer{}) {}
  SharedLayer(Layer layer) : layer_(std::make_shared<const Layer>(std::move(layer))) {}

  const Layer& operator*() const { return *layer_; }
  const Layer* operator->() const { return layer_.get(); }
  bool operator==(const SharedLayer& other) const {
    return layer_ == other.layer_ || *layer_ == *other.layer_;
  }

 private:
  std::shared_ptr<const Layer> layer_;
};

/// What is set for all keyframes together.
struct AnimationSettings {
  double frames_per_second = 24;
  bool linear_blend = false;  ///< in-betweens blend positions instead of shapes
  bool operator==(const AnimationSettings&) const = default;
};
/// What is seen where no layer is: nothing, a color, or the pictures as they were.
struct Background {
  enum class Fill { transparent, color, original };
  Fill fill = Fill::transparent;
  std::array<std::uint8_t, 3> color{255, 255, 255};  ///< red, green, blue
  bool operator==(const Background&) const = default;
};

/// All that is saved.
struct Scene {
  std::vector<SharedLayer> layers = {Layer{}};  ///< from the bottom to the top, one at least
  size_t edited = 0;                            ///< the layer that tools and the inspector act on
  Background background = {};
  AnimationSettings animation = {};
  Extra animation_extra = {}, extra = {};

  const Layer& layer() const { return *layers[edited]; }  ///< the edited one
  const Deformation& deformation() const { return layer().deformation; }
  bool operator==(const Scene&) const = default;
};

/// The scene with another edited layer, or another deformation of that.
Scene with_layer(Scene scene, Layer layer);
Scene with_deformation(Scene scene, Deformation deformation);
/// A scene of one layer.
Scene scene_of(Layer layer);
Scene scene_of(Deformation deformation);

}  // namespace holomorph
