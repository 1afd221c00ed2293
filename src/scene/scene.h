// The content of a scene file: layers and what they share. Scene is a plain value; layers.h has the
// operations on the stack of layers.
#pragma once

#include <array>

#include "scene/deformation.h"

namespace holomorph {

/// The picture that a scene deforms, and the properties of its file. The path is relative to the
/// scene's folder in a file, and absolute in a loaded scene.
struct ImageReference {
  std::string file;
  std::string entry = {};  ///< the layer of an OpenRaster file, by its file in the archive
  int width = 0, height = 0;
  std::string sha256;
  Extra extra;
  bool operator==(const ImageReference&) const = default;
};

/// A picture and its deformation.
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

/// A layer that copies of a scene share until one of them changes it. Every drag copies scenes.
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

/// The settings that all keyframes share.
struct AnimationSettings {
  double frames_per_second = 24;
  bool linear_blend = false;  ///< in-betweens blend positions instead of shapes
  bool operator==(const AnimationSettings&) const = default;
};
/// The background behind the layers: nothing, a color, or the original pictures.
struct Background {
  enum class Fill { transparent, color, original };
  Fill fill = Fill::transparent;
  std::array<std::uint8_t, 3> color{255, 255, 255};  ///< red, green, blue
  bool operator==(const Background&) const = default;
};

/// Everything that is saved.
struct Scene {
  std::vector<SharedLayer> layers = {Layer{}};  ///< from bottom to top, at least one
  size_t edited = 0;                            ///< the layer that tools and the inspector act on
  Background background = {};
  AnimationSettings animation = {};
  Extra animation_extra = {}, extra = {};

  const Layer& layer() const { return *layers[edited]; }  ///< the edited one
  const Deformation& deformation() const { return layer().deformation; }
  bool operator==(const Scene&) const = default;
};

/// Replaces the edited layer, or its deformation.
Scene with_layer(Scene scene, Layer layer);
Scene with_deformation(Scene scene, Deformation deformation);
/// A scene of one layer.
Scene scene_of(Layer layer);
Scene scene_of(Deformation deformation);

}  // namespace holomorph
