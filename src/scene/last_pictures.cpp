// Each picture has two files: a PNG, and a text with the box, which is written last.
#include "scene/last_pictures.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "core/error.h"
#include "scene/preferences.h"
#include "system/new_file.h"

namespace holomorph {
namespace {

constexpr size_t kMostKept = 40;

Path box_file(const std::string& hash) {
  return last_picture_folder() / (hash + ".box");
}
Path image_file(const std::string& hash) {
  return last_picture_folder() / (hash + ".png");
}

void forget_oldest() {
  namespace fs = std::filesystem;
  std::vector<std::pair<fs::file_time_type, Path>> kept;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(last_picture_folder(), error))
    if (entry.path().extension() == ".box")
      kept.emplace_back(entry.last_write_time(error), entry.path());
  if (kept.size() <= kMostKept) return;
  std::ranges::sort(kept);
  for (size_t i = 0; i + kMostKept < kept.size(); ++i) {
    fs::remove(kept[i].second, error);
    fs::remove(Path(kept[i].second).replace_extension(".png"), error);
  }
}

}  // namespace

std::optional<LastPicture> last_picture_of(const std::string& hash) {
  if (hash.empty() || last_picture_folder().empty()) return {};
  constexpr size_t kLongest = 200, kLargest = size_t{1} << 25;
  LastPicture picture;
  try {
    std::istringstream numbers(read_file(box_file(hash), kLongest));
    numbers.imbue(std::locale::classic());
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    if (!(numbers >> x0 >> y0 >> x1 >> y1)) return {};
    picture.box.include({x0, y0});
    picture.box.include({x1, y1});
    picture.image = decode_image(read_file(image_file(hash), kLargest), "the last picture");
  } catch (const Error&) {
    return {};
  }
  return picture;
}

void keep_last_picture(const std::string& hash, const LastPicture& picture) {
  if (hash.empty() || last_picture_folder().empty()) return;
  std::filesystem::create_directories(last_picture_folder());
  write_file(image_file(hash), encode_png(picture.image), NewFile::Readers::owner);
  std::ostringstream numbers;
  numbers.imbue(std::locale::classic());
  numbers.precision(17);
  const Box& box = picture.box;
  numbers << box.left << ' ' << box.bottom << ' ' << box.right << ' ' << box.top << '\n';
  write_file(box_file(hash), numbers.str(), NewFile::Readers::owner);
  forget_oldest();
}

}  // namespace holomorph
