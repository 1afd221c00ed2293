// The decoded pictures of a scene's layers. A scene contains only references to its pictures. The
// pixels are stored here.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "scene/footage.h"
#include "scene/formats/layered.h"
#include "scene/scene.h"

namespace holomorph {

/// A picture and the properties of its file.
struct Picture {
  std::shared_ptr<const Image> image;               ///< of a film, its first frame
  std::string sha256;                               ///< as in ImageReference
  std::filesystem::file_time_type changed = {};     ///< the file's modification time
  std::shared_ptr<Footage> footage = {};            ///< if the picture moves
  std::shared_ptr<const std::string> drawing = {};  ///< the text of an SVG file
  std::optional<LayerMark> mark = {};               ///< of a layer of a file
};

/// Reads the pictures named by references. A file named by several references is read once.
class PictureFiles {
 public:
  /// `open` is the number of pixels in pictures that are already open.
  explicit PictureFiles(double open = 0) : pixels_(open) {}
  /// Reads the picture that a reference names: a film, the numbered pictures that begin with this
  /// file if the reference has a clip, or else a picture. Throws Error.
  Picture picture(const ImageReference& reference);
  /// The SHA-256 of a file, as in ImageReference. Does not decode the picture. Throws Error.
  const std::string& sha256(const std::string& file) { return read(file).sha256; }
  /// The layers of a file with layers. Throws Error.
  const FileLayers& layers(const std::string& file);
  /// What a layer of a file is like. Decodes it, unless it is known. Throws Error.
  const LayerMark& mark(const std::string& file, const std::string& entry);

 private:
  struct File {
    std::string bytes, sha256;  ///< of a film, no bytes
    std::filesystem::file_time_type changed = {};
    std::shared_ptr<Footage> footage = {};        ///< once it was asked for
    std::optional<FileLayers> layers = {};        ///< once they were asked for
    std::map<std::string, LayerMark> marks = {};  ///< of the layers that were decoded, by entry
  };
  File& read(const std::string& name);
  Picture layer_picture(const ImageReference& reference);
  const LayerMark& keep_mark(const std::string& file, const std::string& entry, const Image& image);

  std::map<std::string, File> files_;  ///< keyed by path
  PixelBudget pixels_;
};
/// Reads a single picture. Throws Error.
inline Picture read_picture(const ImageReference& reference, double open = 0) {
  return PictureFiles(open).picture(reference);
}
/// A reference to the picture in a file, or to one layer (`entry`) of a file with layers. The
/// reference has the file's absolute path.
ImageReference reference_in(const Path& file, const std::string& entry = "");
/// The reference with the size and SHA-256 of this picture. A film without a clip gets one that
/// plays all of it, from time 0 on.
ImageReference described(ImageReference reference, const Picture& picture);

/// A collection of pictures, looked up by the file's absolute path and the layer in the file.
class Pictures {
 public:
  /// The picture of a layer; null if it has none, or if it was not read. Of a film, the frame that
  /// show_frame() chose.
  const Image* of(const Layer& layer) const;
  std::shared_ptr<const Image> shared(const Layer& layer) const;
  /// The same, but always the first frame of a film.
  std::shared_ptr<const Image> still(const Layer& layer) const;
  /// The film of a layer whose picture moves; null for all others.
  std::shared_ptr<Footage> footage(const Layer& layer) const;
  /// The text of a layer's SVG file; null if its picture is not a drawing.
  std::shared_ptr<const std::string> drawing(const Layer& layer) const;
  /// Makes the frame with this number of a layer's film the picture of this layer. Cages, pins and
  /// the canvas therefore need not know about films.
  void show_frame(const Layer& layer, int number, std::shared_ptr<const Image> frame);
  /// Does so for all films of a scene, with their frames at a time. Throws Error.
  void show_time(const Scene& scene, double time);
  const Picture* find(const ImageReference& reference) const;
  void put(const ImageReference& reference, Picture picture);
  /// Withholds a file that a scene names: it must not be accessed until the user agrees.
  void withhold(const std::string& file) { withheld_.insert(file); }
  const std::set<std::string>& withheld() const { return withheld_; }
  void release() { withheld_.clear(); }
  /// The same pictures with the fine pixels that their files have. Where that is not possible,
  /// because a file has changed or is too large, a picture stays as it is, and `losses` gets a
  /// message. Calls `keep_going` before each picture; an exception from it ends the work. Cost:
  /// reads the files again.
  Pictures fine(
      std::vector<std::string>& losses, const std::function<void()>& keep_going = [] {}) const;
  /// Adds the pictures and the withheld files of another collection.
  void add(const Pictures& others);
  /// The total number of pixels in all pictures.
  double pixels() const;
  /// The pictures whose files have changed since they were read and still exist.
  std::vector<ImageReference> changed() const;

 private:
  /// What a picture is read from. A file may be used as a picture and as the first of many frames.
  struct Source {
    std::string file, entry;
    bool moves = false;
    PixelPosition corner = {};  ///< as in ImageReference
    auto operator<=>(const Source&) const = default;
  };
  static Source source_of(const ImageReference& reference);
  std::map<Source, Picture> all_;
  /// The frames of films, by the id of the layer that shows them.
  struct ShownFrame {
    std::weak_ptr<Footage> footage;  ///< to which the frame belongs
    int number = 0;
    std::shared_ptr<const Image> image;
  };
  std::map<int, ShownFrame> frames_;
  std::set<std::string> withheld_;
  static Picture fine_picture(const Source& source, Picture picture, PixelBudget& pixels);
};

}  // namespace holomorph
