// Pictures of posed scenes, kept from one session to the next. They are shown while a scene that
// takes long to solve is being opened.
#pragma once

#include <optional>

#include "scene/formats/image.h"
#include "scene/scene.h"

namespace holomorph {

struct LastPicture {
  Image image;
  Box box;  ///< the part of the plane that it shows
};

/// The key of a scene's picture: a hash of all that the scene contains. Empty if the
/// scene cannot be written to a file.
std::string hash_of(const Scene& scene);
/// The kept picture; none if there is none, if it is damaged, or if the hash is empty.
std::optional<LastPicture> last_picture_of(const std::string& hash);
/// Keeps a picture, and of all pictures the 40 newest. Does nothing if the user has no home folder.
/// Throws Error{failed} or std::filesystem::filesystem_error.
void keep_last_picture(const std::string& hash, const LastPicture& picture);

}  // namespace holomorph
