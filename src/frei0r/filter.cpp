// A frei0r filter for ffmpeg and video editors. It warps each frame as if it were the scene's
// picture, or draws the scene over the frame.
#include <dlfcn.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "core/clock.h"
#include "core/error.h"
#include "frei0r/host_time.h"
#include "raster/compose.h"
#include "raster/picture.h"
#include "scene/clips.h"
#include "scene/keyframes.h"
#include "scene/loading.h"
#include "system/text.h"

// The functions that hosts find are those that are declared here.
#pragma GCC visibility push(default)
extern "C" {
#include <frei0r.h>
}
#pragma GCC visibility pop

using namespace holomorph;

namespace {

enum Parameter { kScene, kRate, kMode, kParameters };

/// Whether the host is one of those that pass seconds.
bool passes_seconds() {
  return dlsym(RTLD_DEFAULT, "mlt_factory_init") || dlsym(RTLD_DEFAULT, "gst_init");
}

/// The number of pixels from one row of a frame to the next. ffmpeg before 6.1 pads rows but tells
/// filters only the width.
int row_pixels(int width) {
  constexpr int kPadded = 16;
  constexpr unsigned kLibavfilterOf61 = 9 << 16 | 12 << 8;
  const auto version = reinterpret_cast<unsigned (*)()>(dlsym(RTLD_DEFAULT, "avfilter_version"));
  const bool pads = version && version() < kLibavfilterOf61 && !passes_seconds();
  return pads ? (width + kPadded - 1) / kPadded * kPadded : width;
}

/// The picture in another size. Pixels at its edges are repeated outside, so that edges stay
/// opaque.
Image stretched(const Image& image, int width, int height) {
  Image wide(image.width + 2, image.height + 2);
  for (int y = 0; y < wide.height; ++y)
    for (int x = 0; x < wide.width; ++x)
      std::memcpy(
          wide.at(x, y),
          image.at(std::clamp(x - 1, 0, image.width - 1), std::clamp(y - 1, 0, image.height - 1)),
          4);
  const double across = double(width) / image.width, down = double(height) / image.height;
  RasterJob job;
  job.source = &wide;
  job.box = Box{0, 0, width + 2 * across, height + 2 * down};
  job.placement = {1, {across, down}, 0};
  job.region = Box{0, 0, double(width), double(height)};
  job.top = height;
  return rasterized(job).image;
}

/// Modes warp the film or draw over it.
bool is_over(double mode) {
  return mode >= 0.5;
}

/// A scene that is ready to draw in one of the modes.
class ScenePlayer {
 public:
  ScenePlayer(const Path& file, bool over)
      : loaded_(loaded(file, over)),
        maker_(loaded_.scene, loaded_.image(), loaded_.pictures),
        plays_(has_playing_keys(loaded_.scene) || has_clips(loaded_.scene)) {}

  double rate() const { return loaded_.scene.animation.frames_per_second; }

  /// The frame, warped as the picture of the edited layer. The scene's lowest picture is stretched
  /// to the frame's size.
  Image warped(Image frame, double time) {
    const int width = frame.width, height = frame.height;
    frame_ = std::move(frame);
    maker_.show(frame_);
    const Box box = maker_.rectangle();
    const double scale = std::max(width / box.width(), height / box.height());
    const auto pixels = [&](double length) {
      return std::max(1, static_cast<int>(std::lround(length * scale)));
    };
    const int columns = pixels(box.width()), rows = pixels(box.height());
    Image drawn = part({box.left, box.top}, scale, columns, rows, time);
    if (columns == width && rows == height) return drawn;
    return stretched(drawn, width, height);
  }

  /// The scene drawn over a frame. The lowest picture is scaled to fit, and centered.
  Image composed(Image frame, double time) {
    const int width = frame.width, height = frame.height;
    const Box box = maker_.rectangle();
    if (box.empty()) return frame;  // nothing is visible
    const double scale = std::min(width / box.width(), height / box.height());
    const double left = std::floor((width - box.width() * scale) / 2),
                 top = std::floor((height - box.height() * scale) / 2);
    Composition all(1);
    all.add({std::move(frame), {}});
    all.add(
        {part({box.left - left / scale, box.top + top / scale}, scale, width, height, time), {}});
    return std::move(all).result().image;
  }

 private:
  static LoadedScene loaded(const Path& file, bool over) {
    LoadedScene loaded = load_scene(file, {.pictures_may_be_missing = true});
    const Scene& scene = loaded.scene;
    if (!over && !scene.layer().visible)
      throw Error(ErrorKind::bad_input,
                  file.string() + ": the edited layer is hidden; show it, or use mode 1");
    // Mode 0 does not need the picture that frames replace.
    for (size_t i = 0; i < scene.layers.size(); ++i)
      if (const Layer& layer = *scene.layers[i];
          layer.visible && layer.image && (over || i != scene.edited) && !loaded.pictures.of(layer))
        throw Error(ErrorKind::bad_input, file.string() + ": " + loaded.warning);
    return loaded;
  }

  /// The part of the scene's picture with this many pixels whose top left corner is nearest to a
  /// point.
  Image part(Complex corner, double scale, int width, int height, double time) {
    const double inside = 1e-3 / scale;  // rounding errors must not add a row of pixels
    PictureOptions options;
    options.scale = scale;
    options.region = Box{corner.real() + inside, corner.imag() - height / scale + inside,
                         corner.real() + width / scale - inside, corner.imag() - inside};
    if (plays_) options.time = time;
    RasterResult drawn = maker_.picture(options);
    if (drawn.image.width == width && drawn.image.height == height) return std::move(drawn.image);
    Image cut(width, height);  // the corner lies inside a pixel
    const size_t row = 4 * static_cast<size_t>(std::min(width, drawn.image.width));
    for (int y = 0; y < std::min(height, drawn.image.height); ++y)
      std::memcpy(cut.at(0, y), drawn.image.at(0, y), row);
    return cut;
  }

  LoadedScene loaded_;
  PictureMaker maker_;
  bool plays_;
  Image frame_;
};

/// An instance of the filter in a host.
class Filter {
 public:
  Filter(int width, int height) : width_(width), height_(height), row_(row_pixels(width)) {}

  /// Copies a parameter from the host.
  void set(int parameter, f0r_param_t value) {
    const std::lock_guard lock(mutex_);
    if (parameter == kMode) {
      const double mode = *static_cast<double*>(value);
      if (is_over(mode) != is_over(mode_)) reload();
      mode_ = mode;
    }
    if (parameter != kScene && parameter != kRate) return;
    std::string& text = parameter == kScene ? scene_ : rate_;
    const char* given = *static_cast<char**>(value);
    if (!given || text == given) return;
    text = given;
    time_.reset();
    reload();
  }

  /// Gives a parameter to the host.
  void get(int parameter, f0r_param_t value) {
    const std::lock_guard lock(mutex_);
    if (parameter == kMode) *static_cast<double*>(value) = mode_;
    if (parameter == kScene) *static_cast<char**>(value) = scene_.data();
    if (parameter == kRate) *static_cast<char**>(value) = rate_.data();
  }

  /// Draws a frame. If that fails, the frame is passed through, and the reason is printed once.
  void update(double passed, const std::uint32_t* in, std::uint32_t* out) {
    const std::lock_guard lock(mutex_);
    if (in != out)
      std::memcpy(out, in, 4 * static_cast<size_t>(row_) * static_cast<size_t>(height_));
    reload_changed();
    if (failed_) return;
    try {
      if (scene_.empty())
        throw Error(ErrorKind::bad_input, "the parameter Scene must be the file of a scene");
      if (!player_) player_.emplace(scene_, is_over(mode_));
      if (!time_) {
        const std::optional<double> rate = frames_per_second();
        time_.emplace(rate.value_or(player_->rate()), rate.has_value(), passes_seconds());
      }
      const double time = time_->seconds(passed);
      Image frame(width_, height_);
      const size_t row = static_cast<size_t>(row_), bytes = 4 * static_cast<size_t>(width_);
      for (int y = 0; y < height_; ++y)
        std::memcpy(frame.at(0, y), in + row * static_cast<size_t>(y), bytes);
      const Image drawn = is_over(mode_) ? player_->composed(std::move(frame), time)
                                         : player_->warped(std::move(frame), time);
      for (int y = 0; y < height_; ++y)
        std::memcpy(out + row * static_cast<size_t>(y), drawn.at(0, y), bytes);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "holomorph: %s\n", printable(what_of(error)).c_str());
      failed_ = true;
    }
  }

 private:
  void reload() {
    player_.reset();
    failed_ = false;
  }

  /// Reloads a scene that was saved meanwhile. Looks once a second.
  void reload_changed() {
    constexpr double kPause = 1000;  // ms
    const double now = now_ms();
    if (now - looked_ < kPause) return;
    looked_ = now;
    std::error_code error;
    const auto saved = std::filesystem::last_write_time(scene_, error);
    if (error || saved == saved_) return;
    saved_ = saved;
    reload();
  }

  /// The rate that the host gives, such as "25" or "30000/1001"; none if it gives none.
  std::optional<double> frames_per_second() const {
    if (rate_.empty() || rate_ == "0") return {};
    double frames = 0, seconds = 1;
    const char* end = rate_.data() + rate_.size();
    auto read = std::from_chars(rate_.data(), end, frames);  // in any locale of the host
    if (read.ec == std::errc() && read.ptr != end && *read.ptr == '/')
      read = std::from_chars(read.ptr + 1, end, seconds);
    const double rate = frames / seconds;
    if (read.ec != std::errc() || read.ptr != end || !(rate > 0 && rate <= 1000))
      throw Error(ErrorKind::bad_input, "the frame rate '" + rate_ +
                                            "' is not a number of frames per second, such as 25 or "
                                            "30000/1001");
    return rate;
  }

  int width_, height_;
  int row_;  ///< pixels from one row to the next
  std::mutex mutex_;
  std::string scene_, rate_ = "0";
  double mode_ = 0;
  std::optional<ScenePlayer> player_;
  std::optional<HostTime> time_;
  bool failed_ = false;        ///< and the reason was printed
  double looked_ = -HUGE_VAL;  ///< when the scene's file was looked at
  std::filesystem::file_time_type saved_ = {};
};

/// Runs a function that a host calls, and which must not throw.
template <class Function>
auto guarded(Function function) -> decltype(function()) {
  try {
    return function();
  } catch (...) {
    return decltype(function())();
  }
}

}  // namespace

extern "C" {

int f0r_init() {
  return 1;
}
void f0r_deinit() {}

void f0r_get_plugin_info(f0r_plugin_info_t* info) {
  *info = {"Holomorph",
           "The Holomorph developers",
           F0R_PLUGIN_TYPE_FILTER,
           F0R_COLOR_MODEL_RGBA8888,
           FREI0R_MAJOR_VERSION,
           0,
           1,
           kParameters,
           "Warps each frame as the picture of a Holomorph scene, or draws the scene over it"};
}

void f0r_get_param_info(f0r_param_info_t* info, int parameter) {
  static constexpr f0r_param_info_t kInfo[kParameters] = {
      {"Scene", F0R_PARAM_STRING, "The file of a Holomorph scene (.json)"},
      {"Frame rate", F0R_PARAM_STRING,
       "Frames per second of the film, such as 25 or 30000/1001; 0: as in the scene"},
      {"Mode", F0R_PARAM_DOUBLE,
       "0 warps the frame as the picture of the scene's edited layer, 1 draws the scene over it"}};
  if (parameter >= 0 && parameter < kParameters) *info = kInfo[parameter];
}

f0r_instance_t f0r_construct(unsigned int width, unsigned int height) {
  return guarded([&]() -> f0r_instance_t {
    return new Filter(static_cast<int>(width), static_cast<int>(height));
  });
}
void f0r_destruct(f0r_instance_t instance) {
  delete static_cast<Filter*>(instance);
}

void f0r_set_param_value(f0r_instance_t instance, f0r_param_t value, int parameter) {
  guarded([&] { static_cast<Filter*>(instance)->set(parameter, value); });
}
void f0r_get_param_value(f0r_instance_t instance, f0r_param_t value, int parameter) {
  static_cast<Filter*>(instance)->get(parameter, value);
}

void f0r_update(f0r_instance_t instance, double time, const std::uint32_t* in, std::uint32_t* out) {
  guarded([&] { static_cast<Filter*>(instance)->update(time, in, out); });
}

}  // extern "C"
