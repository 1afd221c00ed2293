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

/// What the picture of a scene is kept by: a hash of all that the scene contains.
std::string hash_of(const Scene& scene);
/// The kept picture; none if there is none, or if it is damaged.
std::optional<LastPicture> last_picture_of(const std::string& hash);
/// Keeps a picture, and deletes those that have not been written for longest, except the last 40.
/// Does nothing if the user has no home folder. Throws Error{failed}.
void keep_last_picture(const std::string& hash, const LastPicture& picture);

}  // namespace holomorph
