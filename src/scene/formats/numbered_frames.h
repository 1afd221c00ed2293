// Pictures whose names end with successive numbers, as animation programs write them.
#pragma once

#include <memory>
#include <vector>

#include "scene/formats/film_frames.h"

namespace holomorph {

/// Opens pictures whose names end with successive numbers, beginning with this one. Throws
/// Error{bad_input} if its name does not end with a number. `depth` is that of decode_image().
std::unique_ptr<FrameReader> open_numbered_pictures(const Path& first,
                                                    PixelDepth depth = PixelDepth::eight_bits);
/// The files of these pictures: this one, and those with the numbers after it up to the first gap.
/// A link that leads out of the folder is a gap. Empty if the file's name does not end with a
/// number.
std::vector<Path> numbered_pictures(const Path& first);
/// Whether there is a picture with the number before or after this one's.
bool has_numbered_neighbor(const Path& file);
/// The first of the pictures with successive numbers to which this one belongs.
Path first_numbered_picture(const Path& any);

}  // namespace holomorph
