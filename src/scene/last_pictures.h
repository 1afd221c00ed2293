// Pictures of posed scenes, kept from one session to the next. They are shown while a scene that
// takes long to solve is being opened.
#pragma once

#include <optional>
#include <string>

#include "scene/formats/image.h"

namespace holomorph {

struct LastPicture {
  Image image;
  Box box;  ///< the part of the plane that it shows
};

/// The picture that was kept for a scene file with this hash. None if there is none, if it is
/// damaged, or if the hash is empty.
std::optional<LastPicture> last_picture_of(const std::string& hash);
/// Keeps the picture of a scene file with this hash, and of all pictures the 40 newest. Does
/// nothing if the hash is empty or the user has no home folder. Throws Error{failed} or
/// std::filesystem::filesystem_error.
void keep_last_picture(const std::string& hash, const LastPicture& picture);

}  // namespace holomorph
