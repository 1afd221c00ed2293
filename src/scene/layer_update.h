// Finds the layers of a file again when the file has changed: a painting program may have added,
// removed, renamed or moved layers, or changed the canvas.
#pragma once

#include "scene/formats/import_report.h"
#include "scene/pictures.h"

namespace holomorph {

/// What becomes of the references to one layer of a file.
struct LayerChange {
  std::string entry;     ///< as in ImageReference
  PixelPosition corner;  ///< of the canvas, in the plane of the layers that show it
  PixelPosition moved;   ///< how far these planes move, with all that is in them
};

/// A layer that may be one of several layers of the file, or none of them.
struct UnclearLayer {
  std::string entry;                  ///< after apply()
  std::string name;                   ///< as it was
  std::vector<FileLayer> candidates;  ///< what it may be now, at least one
};

/// How the layers of one file are found again.
struct LayerUpdate {
  std::string file;
  /// The changes, by the entry and the corner that a reference has.
  std::map<std::pair<std::string, PixelPosition>, LayerChange> changes;
  std::vector<UnclearLayer> unclear;
  PixelPosition shift;           ///< how far the scene's content has moved on the canvas
  int width = 0, height = 0;     ///< of the canvas now
  std::vector<FileLayer> added;  ///< layers of the file that no reference shows, from bottom to top
  ImportReport report;

  /// Applies the changes to a layer that is carried this far by others. Layers that are not found
  /// only follow the canvas.
  void apply(Layer& layer, const PixelPosition& carried = {}) const;
  /// How far the layer to which a layer is attached carries it. `layers` are those of the scene,
  /// before the changes.
  PixelPosition carried(std::span<const Layer* const> layers, const Layer& layer) const;
};

/// Which layer is which, as the user says: from the entry or name of a layer before to the entry or
/// name of one in the file now, or to "" if it is lost.
using LayerChoices = std::vector<std::pair<std::string, std::string>>;

/// The name of the layer of a file that a layer shows, as far as the scene knows.
const std::string& name_in_file(const Layer& layer);

/// Whether the layers of a file must be found again, because a reference has another hash of the
/// file, or another size of the canvas.
bool needs_layer_update(std::span<const Layer> layers, const std::string& file,
                        PictureFiles& files);

/// Finds the layers of a file that the layers of one or more scenes show. A layer is found by its
/// id in a PSD file, or by its name with those of its groups if it is unique, or by its pixels, in
/// this order. Where an id and a name contradict each other, the pixels decide whether ids count.
/// Where a layer with the same pixels has moved, the planes that show it move with it. An
/// attached layer is moved by the difference to its parent in its own coordinates, or back, if it
/// has not moved in the file itself. A canvas that has
/// grown or was cropped does not move anything. Throws Error, also if a choice names no layer.
/// Cost: decodes all layers of the file.
LayerUpdate layer_update(std::span<const Layer> layers, const std::string& file,
                         PictureFiles& files, const LayerChoices& choices = {});

/// The layer of a scene for a layer of a file, whose canvas has its corner here in the plane. Reads
/// its picture into `pictures`. Throws Error.
Layer layer_in_file(const Path& file, const FileLayer& in_file, const PixelPosition& corner,
                    PictureFiles& files, Pictures& pictures);

/// The scene with the new layers of a file, each above the layer that is below it in the file.
/// Reads their pictures into `pictures`. Throws Error, for example if there are too many.
Scene with_added_layers(Scene scene, const LayerUpdate& update, PictureFiles& files,
                        Pictures& pictures);

}  // namespace holomorph
