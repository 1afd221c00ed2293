// First by names alone; only what lies in the folder by its name is looked at.
#include "scene/reach.h"

#include <algorithm>

namespace holomorph {
namespace {

bool lies_in(const Path& file, const Path& folder) {
  const Path way = file.lexically_relative(folder);
  return !way.empty() && *way.begin() != "..";
}

}  // namespace

bool Reach::covers(const Path& file, const Path& scene_folder) const {
  if (everywhere) return true;
  const auto is_known = [&](const Path& each) {
    return std::ranges::find(folders, each.parent_path()) != folders.end();
  };
  const Path name = file.lexically_normal(),
             folder = absolute_path(scene_folder / "x").parent_path();
  if (is_known(name)) return true;
  if (!lies_in(name, folder)) return false;
  std::error_code error;
  const Path real = std::filesystem::weakly_canonical(name, error);
  if (error) return true;  // reading it will say what is wrong
  const Path real_folder = std::filesystem::weakly_canonical(folder, error);
  return error || lies_in(real, real_folder) || is_known(real);
}

}  // namespace holomorph
