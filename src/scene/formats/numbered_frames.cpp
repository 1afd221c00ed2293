// Numbers may be padded with zeros to the same number of digits, or not.
#include "scene/formats/numbered_frames.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>

#include "core/error.h"
#include "scene/budget.h"

namespace holomorph {
namespace {

/// A file name that ends with a number, such as walk-0007.png.
struct NumberedName {
  Path folder;
  std::string before, after;  ///< the texts around the number
  int digits = 0;             ///< of this name
  bool is_padded = false;     ///< the number begins with a zero
  long number = 0;

  /// The name with another number. If it is not known whether shorter numbers are padded, the file
  /// that exists decides.
  Path with(long other) const {
    const Path padded = named(other, digits);
    return is_padded || is_file(padded) ? padded : named(other, 1);
  }

 private:
  Path named(long other, int width) const {
    char text[32];
    std::snprintf(text, sizeof text, "%0*ld", width, other);
    return folder / (before + text + after);
  }
};

/// Whether a file can be a frame. Scenes may not have links out of their folder read.
bool is_frame(const Path& file) {
  std::error_code error;
  if (!is_file(file)) return false;
  if (!std::filesystem::is_symlink(file, error)) return true;
  const auto folder_of = [&](const Path& path) {
    return std::filesystem::canonical(path, error).parent_path();
  };
  return std::filesystem::canonical(file.parent_path(), error) == folder_of(file);
}

std::optional<NumberedName> numbered_name(const Path& file) {
  constexpr size_t kMostDigits = 9;
  const std::string stem = file.stem().string();
  size_t start = stem.size();
  while (start > 0 && std::isdigit(static_cast<unsigned char>(stem[start - 1])) &&
         stem.size() - start < kMostDigits)
    --start;
  if (start == stem.size()) return {};
  const std::string digits = stem.substr(start);
  return NumberedName{file.parent_path(),        stem.substr(0, start),
                      file.extension().string(), static_cast<int>(digits.size()),
                      digits[0] == '0',          std::stol(digits)};
}

class NumberedPictures final : public FrameReader {
 public:
  NumberedPictures(const Path& first, PixelDepth depth)
      : files_(numbered_pictures(first)), depth_(depth) {
    if (files_.empty())
      throw Error(ErrorKind::bad_input,
                  first.string() +
                      ": the name does not end with a number, so the file is not one "
                      "of several frames");
  }

  FilmInfo info() const override { return {static_cast<int>(files_.size())}; }

  Image read(int frame) override {
    const Path& file = files_[static_cast<size_t>(frame)];
    PixelBudget alone;
    Image image = decode_image(read_file(file), file.string(), alone, depth_);
    if (width_ == 0) width_ = image.width, height_ = image.height;
    if (image.width != width_ || image.height != height_)
      throw Error(ErrorKind::bad_input,
                  file.string() + ": this frame has " + std::to_string(image.width) + " x " +
                      std::to_string(image.height) + " pixels, and the others " +
                      std::to_string(width_) + " x " + std::to_string(height_));
    return image;
  }

 private:
  std::vector<Path> files_;
  PixelDepth depth_;
  int width_ = 0, height_ = 0;  ///< of the frame that was read first
};

}  // namespace

std::vector<Path> numbered_pictures(const Path& first) {
  std::vector<Path> files;
  const std::optional<NumberedName> name = numbered_name(first);
  if (!name || !is_file(first)) return files;
  for (Path file = first; files.empty() || is_frame(file);
       file = name->with(name->number + static_cast<long>(files.size()))) {
    files.push_back(file);
    check_budget(&Budget::frames, static_cast<double>(files.size()),
                 first.string() + ": with the pictures after it, this film has");
  }
  return files;
}

bool has_numbered_neighbor(const Path& file) {
  const std::optional<NumberedName> name = numbered_name(file);
  return name && (is_frame(name->with(name->number + 1)) ||
                  (name->number > 0 && is_frame(name->with(name->number - 1))));
}

Path first_numbered_picture(const Path& any) {
  const std::optional<NumberedName> name = numbered_name(any);
  if (!name) return any;
  long first = name->number;
  while (first > 0 && is_frame(name->with(first - 1))) --first;
  return first == name->number ? any : name->with(first);
}

std::unique_ptr<FrameReader> open_numbered_pictures(const Path& first, PixelDepth depth) {
  return std::make_unique<NumberedPictures>(first, depth);
}

}  // namespace holomorph
