// A path is first checked by name alone. Even if the name is in reach, the path may be a link, so
// its target is checked too.
#include "scene/reach.h"

#include <algorithm>

namespace holomorph {
namespace {

bool lies_in(const Path& file, const Path& folder) {
  const Path way = file.lexically_relative(folder);
  return !way.empty() && *way.begin() != "..";
}

/// The path with all links resolved. The file need not exist. Empty if the links form a cycle or
/// cannot be followed.
Path real_path(Path path) {
  constexpr int kMostLinks = 40;
  std::error_code wrong;
  for (int links = 0; links < kMostLinks; ++links) {
    path = std::filesystem::weakly_canonical(path, wrong);
    if (wrong) return {};
    if (!std::filesystem::is_symlink(path, wrong)) return path;
    path = path.parent_path() / std::filesystem::read_symlink(path, wrong);
    if (wrong) return {};
  }
  return {};
}

}  // namespace

bool Reach::covers(const Path& file, const Path& scene_folder) const {
  if (everywhere) return true;
  const Path name = file.lexically_normal(),
             folder = absolute_path(scene_folder / "x").parent_path();
  const auto is_known = [&](const Path& each) {
    return std::ranges::find(folders, each.parent_path()) != folders.end();
  };
  if (!lies_in(name, folder) && !is_known(name)) return false;
  // The name is in reach, but the path may be a link to a file elsewhere.
  const Path real = real_path(name);
  if (real.empty()) return false;
  return lies_in(real, real_path(folder)) || std::ranges::any_of(folders, [&](const Path& each) {
           return real.parent_path() == real_path(each);
         });
}

}  // namespace holomorph
