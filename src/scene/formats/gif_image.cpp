// Reads GIF files with giflib. The result is the first picture of the file, placed on the canvas.
#include <gif_lib.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "core/error.h"
#include "scene/formats/image_formats.h"

namespace holomorph {
namespace {

struct Stream {
  const std::string& bytes;
  size_t at = 0;
  bool ended = false;
};

int take(GifFileType* file, GifByteType* out, int count) {
  auto& stream = *static_cast<Stream*>(file->UserData);
  const size_t left = stream.bytes.size() - stream.at,
               got = std::min(left, static_cast<size_t>(count));
  stream.ended = stream.ended || got < static_cast<size_t>(count);
  std::memcpy(out, stream.bytes.data() + stream.at, got);
  stream.at += got;
  return static_cast<int>(got);
}

struct CloseGif {
  void operator()(GifFileType* file) const { DGifCloseFile(file, nullptr); }
};

class GifReader {
 public:
  GifReader(const std::string& bytes, const std::string& name) : stream_{bytes}, name_(name) {
    file_.reset(DGifOpen(&stream_, take, nullptr));
    if (!file_) fail();
  }

  /// The number of pictures from here on. What is damaged after the first one does not count.
  size_t count() {
    size_t pictures = 0;
    try {
      for (; find_picture(); ++pictures) {
        GifByteType* block = nullptr;
        int code = 0;
        must(DGifGetCode(file_.get(), &code, &block));
        while (block) must(DGifGetCodeNext(file_.get(), &block));
      }
    } catch (const Error&) {
      return pictures;
    }
    return pictures;
  }

  Image read(PixelBudget& pixels) {
    pixels.take(static_cast<unsigned>(file_->SWidth), static_cast<unsigned>(file_->SHeight), name_);
    if (!find_picture()) fail();
    PixelBudget frame;  // parts outside the canvas are decoded too
    frame.take(static_cast<size_t>(file_->Image.Width), static_cast<size_t>(file_->Image.Height),
               name_);
    Image image(file_->SWidth, file_->SHeight);
    const GifImageDesc& at = file_->Image;
    const ColorMapObject* colors = at.ColorMap ? at.ColorMap : file_->SColorMap;
    if (!colors || at.Width < 1 || at.Height < 1) fail();
    std::vector<GifPixelType> line(static_cast<size_t>(at.Width));
    // Interlaced files store every eighth row first, then the rows halfway between, and so on.
    const std::vector<std::pair<int, int>> passes =
        at.Interlace ? std::vector<std::pair<int, int>>{{0, 8}, {4, 8}, {2, 4}, {1, 2}}
                     : std::vector<std::pair<int, int>>{{0, 1}};
    for (const auto& [first, step] : passes)
      for (int r = first; r < at.Height; r += step) {
        must(DGifGetLine(file_.get(), line.data(), at.Width));
        for (int c = 0; c < at.Width; ++c) {
          const int column = at.Left + c, row = at.Top + r, index = line[static_cast<size_t>(c)];
          if (column >= image.width || row >= image.height || index == transparent_) continue;
          if (index >= colors->ColorCount) fail();
          const GifColorType& color = colors->Colors[index];
          const std::uint8_t pixel[4] = {color.Red, color.Green, color.Blue, 255};
          std::memcpy(image.at(column, row), pixel, 4);
        }
      }
    return image;
  }

 private:
  /// Goes to the next picture. Returns whether there is one.
  bool find_picture() {
    while (true) {
      GifRecordType type;
      must(DGifGetRecordType(file_.get(), &type));
      if (type == TERMINATE_RECORD_TYPE) return false;
      if (type == IMAGE_DESC_RECORD_TYPE) {
        must(DGifGetImageDesc(file_.get()));
        return true;
      }
      if (type != EXTENSION_RECORD_TYPE) fail();
      int code = 0;
      GifByteType* block = nullptr;
      must(DGifGetExtension(file_.get(), &code, &block));
      if (code == GRAPHICS_EXT_FUNC_CODE && block && block[0] >= 4) {
        GraphicsControlBlock control;
        must(DGifExtensionToGCB(block[0], block + 1, &control));
        transparent_ = control.TransparentColor;
      }
      while (block) must(DGifGetExtensionNext(file_.get(), &block));
    }
  }

  void must(int result) const {
    if (result != GIF_OK) fail();
  }
  [[noreturn]] void fail() const {
    throw Error(ErrorKind::bad_input,
                name_ + (stream_.ended ? ": the picture is incomplete: the file ends too early"
                                       : ": the GIF picture is damaged"));
  }

  Stream stream_;
  const std::string& name_;
  std::unique_ptr<GifFileType, CloseGif> file_;
  int transparent_ = NO_TRANSPARENT_COLOR;
};

}  // namespace

bool is_gif(const std::string& bytes) {
  return bytes.starts_with("GIF8");
}

void report_gif(const std::string& bytes, const std::string& name, ImportReport& report) {
  report_first_of(GifReader(bytes, name).count(), "pictures", report);
}

Image decode_gif(const std::string& bytes, const std::string& name, PixelBudget& pixels) {
  return GifReader(bytes, name).read(pixels);
}

}  // namespace holomorph
