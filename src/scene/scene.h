// The content of a scene file: the layers and their common settings. Scene is a plain value.
// Operations on the stack of layers are in layers.h.
#pragma once

#include <array>
#include <string_view>

#include "core/geometry/similarity.h"
#include "scene/deformation.h"

namespace holomorph {

/// How a film, or a sequence of numbered pictures, plays as the picture of a layer. Frames have
/// numbers from 0 on.
struct Clip {
  double frames_per_second = 24;  ///< at which it plays
  int frames = 0;                 ///< of the whole film; 0: not known, because it was not opened
  int first = 0;                  ///< the first frame that plays
  std::optional<int> last = {};   ///< the last frame that plays; none: that of the film
  double start = 0;               ///< the time of the first frame, in seconds
  /// The frames repeat forever, also before `start`. Otherwise, the first and the last one stay.
  bool loops = false;
  Extra extra = {};
  bool operator==(const Clip&) const = default;
};

/// A position in whole pixels, y up.
struct PixelPosition {
  int x = 0, y = 0;
  auto operator<=>(const PixelPosition&) const = default;
};

/// What a layer of a file with layers was like when it was last read. When the file has changed,
/// the layer is found again by this; see layer_update.h.
struct LayerMark {
  std::string name;      ///< as in FileLayer
  std::string hash;      ///< of its pixels; see mark_of(). Empty: not known, or it has no content
  PixelPosition offset;  ///< of the lower left corner of its content from that of the canvas
  bool operator==(const LayerMark&) const = default;
};

/// A reference to the picture of a layer, with properties of its file. The path is relative to the
/// scene's folder in a scene file, and absolute in a loaded scene.
struct ImageReference {
  std::string file;
  /// For a layer of a file with layers, its FileLayer::entry. While it is not found in the file,
  /// its entry begins with kLostEntry or kUnclearEntry, because other layers may get the old one.
  std::string entry = {};
  int width = 0, height = 0;  ///< of the picture, or of the canvas on which a layer lies
  PixelPosition corner = {};  ///< the lower left corner of this canvas in the layer's plane
  std::string sha256;         ///< of the file's bytes, or of the first 16 MiB of a film
  Extra extra;
  std::optional<LayerMark> mark = {};  ///< of a layer of a file
  std::optional<Clip> clip = {};       ///< if the picture moves
  /// How far the layer's plane has moved because the layer has moved in its file.
  PixelPosition moved = {};

  /// The rectangle of the picture or of its canvas.
  Box page() const {
    return {double(corner.x), double(corner.y), double(corner.x) + width,
            double(corner.y) + height};
  }
  bool operator==(const ImageReference&) const = default;
};

/// How the entry of a layer begins that is no longer in its file and shows nothing, and that of a
/// layer that may be one of several in its file until the user says which one.
inline constexpr std::string_view kLostEntry = "lost:", kUnclearEntry = "unclear:";
inline bool is_lost(const ImageReference& image) {
  return image.entry.starts_with(kLostEntry);
}
inline bool is_unclear(const ImageReference& image) {
  return image.entry.starts_with(kUnclearEntry);
}

/// How a layer's colors combine with those below it (W3C Compositing and Blending, 9.1). `add` is
/// the sum, up to white.
enum class Blending { normal, multiply, screen, overlay, add };
inline constexpr std::array kBlendingNames{"normal", "multiply", "screen", "overlay", "add"};

/// What a layer follows: a pin, a stroke or a place of the picture of another layer, its parent.
struct Attachment {
  enum class To { pin, stroke, place };
  int layer = 0;  ///< the parent's id
  To to = To::place;
  int handle = 0;      ///< the id of the parent's pin or stroke
  Complex place = {};  ///< on the parent's picture, at rest
  Extra extra = {};
  bool operator==(const Attachment&) const = default;
};

/// A picture and its deformation.
struct Layer {
  int id = 1;  ///< identifies a layer; saved only where another layer is attached to it
  std::string name = {};
  bool visible = true;
  bool locked = false;  ///< edits are refused
  double opacity = 1;   ///< 0 to 1
  Blending blending = Blending::normal;
  bool clipped = false;  ///< drawn only where its base is; see clip_base()
  std::optional<ImageReference> image = {};
  Deformation deformation = {};
  std::optional<Attachment> attachment = {};
  /// Where the layer's plane lies in the scene's. For an attached layer, where it would lie if its
  /// parent were at rest.
  Similarity placement = {};
  Extra extra = {};

  /// Compares everything except the id.
  bool operator==(const Layer& other) const;
};

/// An immutable layer, shared by copies of a scene. Scenes are copied often, for example during
/// every drag.
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
  bool linear_blend = false;  ///< in-betweens interpolate positions instead of shapes
  bool operator==(const AnimationSettings&) const = default;
};
/// The background behind the layers: nothing, a color, or the original pictures.
struct Background {
  enum class Fill { transparent, color, original };
  Fill fill = Fill::transparent;
  std::array<std::uint8_t, 3> color{255, 255, 255};  ///< red, green, blue
  bool operator==(const Background&) const = default;
};

/// Everything that a scene file contains.
struct Scene {
  std::vector<SharedLayer> layers = {Layer{}};  ///< from bottom to top, at least one
  size_t edited = 0;                            ///< the layer that tools and the inspector act on
  Background background = {};
  AnimationSettings animation = {};
  Extra animation_extra = {}, extra = {};

  const Layer& layer() const { return *layers[edited]; }  ///< the edited layer
  const Deformation& deformation() const { return layer().deformation; }
  bool operator==(const Scene&) const = default;
};

/// Replaces the edited layer, or the deformation of the edited layer.
Scene with_layer(Scene scene, Layer layer);
Scene with_deformation(Scene scene, Deformation deformation);
/// A scene with a single layer.
Scene scene_of(Layer layer);
Scene scene_of(Deformation deformation);

}  // namespace holomorph
