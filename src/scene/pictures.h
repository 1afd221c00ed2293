// The decoded pictures of a scene's layers. Scenes name them; here they are.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "scene/formats/image.h"
#include "scene/scene.h"

namespace holomorph {

/// A picture, and the file that it was read from.
struct Picture {
  std::shared_ptr<const Image> image;
  std::string sha256;                            ///< of the file
  std::filesystem::file_time_type changed = {};  ///< when the file was
};

/// Reads what references name; a file that several of them share once.
class PictureFiles {
 public:
  /// `open` is how many pixels are there already.
  explicit PictureFiles(double open = 0) : pixels_(open) {}
  /// Throws Error.
  Picture picture(const ImageReference& reference);
  /// Of a file's bytes, which are not decoded. Throws Error.
  const std::string& sha256(const std::string& file) { return read(file).sha256; }

 private:
  struct File {
    std::string bytes, sha256;
    std::filesystem::file_time_type changed = {};
  };
  const File& read(const std::string& name);

  std::map<std::string, File> files_;  ///< by path
  PixelBudget pixels_;
};
/// One of them alone. Throws Error.
inline Picture read_picture(const ImageReference& reference, double open = 0) {
  return PictureFiles(open).picture(reference);
}
/// What names a picture: its file, whose path becomes absolute, and its layer in there if it is
/// one.
ImageReference reference_in(const Path& file, const std::string& entry = "");
/// A reference with what was read: size and SHA-256.
ImageReference described(ImageReference reference, const Picture& picture);

/// Pictures by what names them: the absolute path of the file, and the layer in there.
class Pictures {
 public:
  /// The picture of a layer alone; null when it has none, or none that was read.
  const Image* of(const Layer& layer) const;
  std::shared_ptr<const Image> shared(const Layer& layer) const;
  const Picture* find(const ImageReference& reference) const;
  void put(const ImageReference& reference, Picture picture);
  /// Files that a scene names and that are not to be looked at before the user agrees.
  void withhold(const std::string& file) { withheld_.insert(file); }
  const std::set<std::string>& withheld() const { return withheld_; }
  void release() { withheld_.clear(); }
  /// What another collection has.
  void add(const Pictures& others);
  /// How many pixels all of them have.
  double pixels() const;
  /// What lies in files that have changed since they were read, and are still there.
  std::vector<ImageReference> changed() const;

 private:
  std::map<std::pair<std::string, std::string>, Picture> all_;  ///< by file and entry
  std::set<std::string> withheld_;
};

}  // namespace holomorph
