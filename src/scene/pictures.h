// The decoded pictures of a scene's layers. A scene contains only references to its pictures. The
// pixels are stored here.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "scene/formats/image.h"
#include "scene/scene.h"

namespace holomorph {

/// A picture and the properties of its file.
struct Picture {
  std::shared_ptr<const Image> image;
  std::string sha256;                            ///< of the file's bytes
  std::filesystem::file_time_type changed = {};  ///< the file's modification time
};

/// Reads the pictures named by references. A file named by several references is read once.
class PictureFiles {
 public:
  /// `open` is the number of pixels in pictures that are already open.
  explicit PictureFiles(double open = 0) : pixels_(open) {}
  /// Reads the picture that a reference names. Throws Error.
  Picture picture(const ImageReference& reference);
  /// The SHA-256 of a file's bytes. Does not decode the picture. Throws Error.
  const std::string& sha256(const std::string& file) { return read(file).sha256; }

 private:
  struct File {
    std::string bytes, sha256;
    std::filesystem::file_time_type changed = {};
  };
  const File& read(const std::string& name);

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
/// The reference with the size and SHA-256 of this picture.
ImageReference described(ImageReference reference, const Picture& picture);

/// A collection of pictures, looked up by the file's absolute path and the layer in the file.
class Pictures {
 public:
  /// The picture of a layer; null if it has none, or if it was not read.
  const Image* of(const Layer& layer) const;
  std::shared_ptr<const Image> shared(const Layer& layer) const;
  const Picture* find(const ImageReference& reference) const;
  void put(const ImageReference& reference, Picture picture);
  /// Withholds a file that a scene names: it must not be accessed until the user agrees.
  void withhold(const std::string& file) { withheld_.insert(file); }
  const std::set<std::string>& withheld() const { return withheld_; }
  void release() { withheld_.clear(); }
  /// Adds the pictures and the withheld files of another collection.
  void add(const Pictures& others);
  /// The total number of pixels in all pictures.
  double pixels() const;
  /// The pictures whose files have changed since they were read and still exist.
  std::vector<ImageReference> changed() const;

 private:
  std::map<std::pair<std::string, std::string>, Picture> all_;  ///< keyed by file and entry
  std::set<std::string> withheld_;
};

}  // namespace holomorph
