// Both become cages first: those are read, traced and checked already.
#include "scene/outline_import.h"

#include "core/outline_match.h"
#include "scene/auto_cage.h"
#include "scene/svg_path.h"

namespace holomorph {
namespace {

constexpr int kVertices = 120;  ///< of a traced picture

Points fitted(Points points, const Box& onto) {
  const Box box = box_of(points);
  const double scale = onto.diagonal() / box.diagonal();
  for (Complex& z : points) z = onto.center() + scale * (z - box.center());
  return points;
}

}  // namespace

Points outline_of_file(const Path& path, double height, const Box& onto) {
  const std::string name = path.string(), bytes = read_file(path);
  try {
    Points outline;
    if (lower_case(path.extension().string()) == ".svg") {
      outline = flattened(cage_of_svg(bytes, name, height, PathUse::outline)).points;
    } else {
      const Image image = decode_image(bytes, name);
      outline = fitted(flattened(auto_cage(image, {kVertices, 0, true})).points, onto);
    }
    check_outline(outline);
    return outline;
  } catch (const Error& error) {
    const std::string what = error.what();
    throw Error(error.kind(), what.starts_with(name) ? what : name + ": " + what, error.where());
  }
}

}  // namespace holomorph
