// Small pictures of files and layers, for lists.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "render/texture.h"
#include "scene/formats/image.h"
#include "system/job.h"

namespace holomorph {

/// Draws thumbnails on another thread, and keeps those that were asked for last. Needs a current
/// OpenGL context.
class Thumbnails {
 public:
  /// `wake` is called on another thread after each thumbnail.
  explicit Thumbnails(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// The thumbnail of a scene or picture file; null while it is being drawn, or if it cannot be
  /// drawn. A file that has changed is drawn again.
  const Texture* of_file(const Path& file);
  /// The thumbnail of a picture in memory.
  const Texture* of_picture(const std::shared_ptr<const Image>& picture);

  /// Whether a file can have a thumbnail, judged by its name.
  static bool can_show(const Path& file);

 private:
  struct Key {
    Path file;
    const Image* picture = nullptr;
    auto operator<=>(const Key&) const = default;
  };
  struct Entry {
    Texture texture;
    std::filesystem::file_time_type time{};
    std::weak_ptr<const Image> picture;  ///< the picture whose address is in the key
    unsigned used = 0;
    bool ready = false;
  };
  struct Done {
    std::mutex mutex;
    std::vector<std::pair<Key, Image>> images;
  };
  using Draw = std::function<Image()>;
  void take_done();
  void start_next();
  void forget_oldest();

  std::function<void()> wake_;
  std::map<Key, Entry> entries_;
  std::deque<std::pair<Key, Draw>> waiting_;
  std::shared_ptr<Done> done_ = std::make_shared<Done>();
  std::unique_ptr<Job> job_;
  unsigned clock_ = 0;
};

/// A picture reduced so that its longer side has at most `longest` pixels.
Image reduced(const Image& picture, int longest);

}  // namespace holomorph
