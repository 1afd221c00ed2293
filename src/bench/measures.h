// The benchmarks for bounded maps, outlines, angles, keyframes and strokes, and the timer that all
// benchmarks use.
#pragma once

#include <functional>
#include <string>

#include "core/geometry/cage.h"

namespace holomorph::bench {

/// The median time of `work` in milliseconds, after one warm-up run.
double median_ms(int runs, const std::function<void()>& work);

/// Results for 30 random pairs of smooth and limbed outlines: the number of targets that are
/// reached without folds, and the median time. A target is reached if f' has no zero (turning
/// number 1) and the two-sided Hausdorff distance is below 1 % of the diameter.
struct OutlineFigures {
  double reached = 0, median_ms = 0;
};
OutlineFigures outline_figures(bool published);
inline constexpr int kOutlinePairs = 30;

/// The time that the slowest pair's iterations take to bring the distance within 1 % of its final
/// value, excluding setup. Uses 100 vertices and 400 samples.
double outline_iterations_ms(int runs);
/// The time from a cold start for the slowest of six hard pairs.
double hard_outline_ms();

/// Times for a star with 20 corners and 10k mesh vertices: preparing its Hilbert coordinates and
/// angle map, a frame in which one corner is dragged, and a frame in which all angles are
/// recomputed.
double angles_prepare_ms(int runs);
double angles_drag_ms(int runs);
double angles_pose_ms(int runs);
/// The time of a frame between two keyframes, with 20k triangles and including the handles.
double playback_ms(int runs);
/// The largest relative error of the area, in percent, while a bar is bent by 270 degrees. With
/// `linear_blend`, positions are blended linearly.
double inbetween_loss_percent(bool linear_blend);

/// The median time of a frame in which a pin of one layer is dragged, and of one in which the
/// displayed time moves on by half of the time between two keyframes. Each layer has three pins and
/// 100 keyframes. Only the maps of all layers are updated, and nothing is drawn.
double layered_drag_ms(int layers);
double layered_scrub_ms(int layers);
/// The time to open a PSD file with four layers of noise, 203 MB in all, from the system's cache.
double open_psd_ms();

/// The memory pages that the system prepares in a frame of a drag, on average over 100 frames, for
/// the method with most of them.
double drag_page_faults();

/// Figures for a drag of 300 frames of a map without folds that follows a method, with 5 pins and
/// 5k mesh vertices: the frame times, and the number of frames that were not certified.
struct BoundedDrag {
  double median_ms = 0, longest_ms = 0;
  int unproved = 0;
};
BoundedDrag bounded_drag(const Cage& cage, const std::string& reference);

/// Figures for a drag of 120 frames of a puppet with 10 pins and 10k mesh vertices, with proof and
/// evaluation on the mesh, for a basis with about this many vertices.
struct PuppetFigures {
  double median_ms = 0, longest_ms = 0;
  int unproved = 0;
  double behind_percent = 0;  ///< frames whose value is more than 5 % above the converged one
};
PuppetFigures puppet_drag(int vertices);

/// Figures for a drag of 60 frames of As rigid as possible with 10 pins, for a mesh of about this
/// many vertices: the median time of a frame, by how much a frame's energy is above the converged
/// one, at most, and the percentage of frames for which this is more than 1 %.
struct RigidFigures {
  double median_ms = 0, above_percent = 0, behind_percent = 0;
};
RigidFigures rigid_drag(int vertices);

/// The time of a frame in which one of five strokes is dragged, without evaluating the map on the
/// mesh. Each stroke has 20 samples.
double strokes_drag_ms(int runs);

}  // namespace holomorph::bench
