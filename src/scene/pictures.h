// The decoded pictures of a scene's layers. Scenes name them; here they are.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "scene/image.h"
#include "scene/scene.h"

namespace holomorph {

/// A picture, and the file that it was read from.
struct Picture {
  std::shared_ptr<const Image> image;
  std::string sha256;                            ///< of the file
  std::filesystem::file_time_type changed = {};  ///< when the file was
};

/// Reads a picture. Throws Error.
Picture read_picture(const Path& file);
/// What a scene says of a picture that lies in a file. The path becomes absolute.
ImageReference reference_to(const Path& file, const Picture& picture);

/// Pictures by the absolute paths of their files.
class Pictures {
 public:
  /// The picture of a layer alone; null when it has none, or none that was read.
  const Image* of(const Scene& layer) const;
  std::shared_ptr<const Image> shared(const Scene& layer) const;
  const Picture* find(const std::string& file) const;
  void put(const std::string& file, Picture picture) { all_[file] = std::move(picture); }
  /// The files that have changed on disk since they were read, and are still there.
  std::vector<std::string> changed() const;

 private:
  std::map<std::string, Picture> all_;
};

}  // namespace holomorph
