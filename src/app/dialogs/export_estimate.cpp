// Files grow a little slower than their pixels, because large pictures are smoother.
#include "app/dialogs/export_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

#include "raster/layered_picture.h"

namespace holomorph {
namespace {

constexpr double kSmall = 480;       // longest side of the small picture, pixels
constexpr double kGrowth = 0.9;      // exponent of the pixels
constexpr double kLaterFrame = 0.6;  // size of a later frame of a film, relative to the first

std::string size_of(double bytes) {
  char text[40];
  if (bytes < 1e6)
    std::snprintf(text, sizeof text, "%.0f kB", std::max(1.0, bytes / 1e3));
  else
    std::snprintf(text, sizeof text, "%.1f MB", bytes / 1e6);
  return text;
}

/// What the meshes are, and how far they are from the exact motion.
std::string measured(const ExportEstimate::Question& question, const Pictures& pictures,
                     const Job::Progress& progress) {
  struct Canceled {};
  const Scene& scene = question.scene;
  try {
    const MovingMeshes moving =
        moving_meshes_of(scene, pictures.of(scene.layer()), pictures,
                         mesh_options_of(scene, *question.meshes), [&](size_t, size_t) {
                           if (progress.cancelled()) throw Canceled{};
                         });
    return mesh_counts(moving) + mesh_error_text(moving) + mesh_advice(moving, *question.meshes);
  } catch (const Error& error) {
    return error.what();
  } catch (Canceled) {
    return "";
  }
}

/// The size in bytes; none if canceled, or if it cannot be estimated.
std::optional<double> estimate(const ExportEstimate::Question& question, const Pictures& pictures,
                               const Job::Progress& progress) {
  const Scene& scene = question.scene;
  PictureMaker maker(scene, pictures.of(scene.layer()), pictures);
  PictureOptions options = question.options;
  if (question.film) options.time = question.first / scene.animation.frames_per_second;
  Box shown = options.region ? *options.region : maker.rectangle();
  const double longest = std::max({shown.width(), shown.height(), 1.0});
  options.scale = std::min(question.options.scale, kSmall / longest);
  const double more = std::pow(question.options.scale / options.scale, 2 * kGrowth);
  const LayeredFormat* layered = layered_format_of("a" + question.extension);
  if (layered && layered->keeps_drawings) return {};  // the size of drawings has no such law
  if (layered)
    return more * static_cast<double>(layered
                                          ->encode(layered_picture_of(
                                              scene, pictures.of(scene.layer()), options, pictures))
                                          .size());
  const PictureFormat* still = picture_format_named(question.extension);
  const PictureFormat& format = still ? *still : picture_format_of("a.webp");
  const int depth = depth_of(format, question.depth);
  options.fine = needs_fine_pixels(depth);
  const Image small = maker.picture(options).image;
  if (progress.cancelled()) return {};
  const double bytes = static_cast<double>(format.encode(small, depth).size());
  return bytes * more * (1 + kLaterFrame * (question.frames - 1));
}

}  // namespace

bool ExportEstimate::Question::operator==(const Question& other) const {
  const auto values = [](const Question& q) {
    const PictureOptions& o = q.options;
    const Box box = o.region.value_or(Box{});
    return std::tuple(o.view, o.scale, o.crops_to_filled, box.left, box.bottom, box.right, box.top,
                      o.time, q.extension, q.depth, q.film, q.first, q.frames);
  };
  return values(*this) == values(other) && meshes == other.meshes && scene == other.scene;
}

void ExportEstimate::update(Question question, const Pictures& pictures) {
  if (result_) {
    const std::lock_guard lock(result_->mutex);
    if (!result_->text.empty()) text_ = result_->text;
  }
  if (job_ && job_->ended()) {
    if (const auto error = job_->error()) text_ = error->what();
    job_.reset();
  }
  if (asked_ == question) return;
  if (job_) {  // the next frame after its end asks again
    job_->cancel();
    asked_.reset();
    text_.clear();
    result_.reset();
    return;
  }
  asked_ = question;
  text_.clear();
  result_ = std::make_shared<Result>();
  job_ = std::make_unique<Job>(
      "Estimating the size",
      [question = std::move(question), pictures, result = result_](Job::Progress& progress) {
        std::string text;
        if (question.meshes)
          text = measured(question, pictures, progress);
        else if (const auto bytes = estimate(question, pictures, progress))
          text = size_of(*bytes);
        const std::lock_guard lock(result->mutex);
        result->text = text;
      },
      wake_);
}

void ExportEstimate::stop() {
  if (job_) job_->cancel();
  if (job_ && job_->ended()) job_.reset();
  asked_.reset();
  text_.clear();
  result_.reset();
}

}  // namespace holomorph
