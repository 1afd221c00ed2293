// The benchmarks of outlines, angles, keyframes and strokes, and the timer of all benchmarks.
#pragma once

#include <functional>

namespace holomorph::bench {

/// The median time of `work` in milliseconds, after one warm-up run.
double median_ms(int runs, const std::function<void()>& work);

/// For 30 random pairs of smooth and limbed outlines: how many targets are reached without folds
/// (no zero of f', turning number 1, both Hausdorff distances below 1 % of the diameter), and the
/// median time.
struct OutlineFigures {
  double reached = 0, median_ms = 0;
};
OutlineFigures outline_figures(bool published);
inline constexpr int kOutlinePairs = 30;

/// The time of the iterations alone, with 100 vertices and 400 samples, until the distance is
/// within 1 % of its final value, for the slowest pair.
double outline_iterations_ms(int runs);
/// The time of the slowest of six hard pairs, from a cold start.
double hard_outline_ms();

/// Preparing the Hilbert coordinates and the angle map of 20 corners at 10k mesh vertices; a frame
/// in which one corner is dragged; and a frame in which all angles are recomputed.
double angles_prepare_ms(int runs);
double angles_drag_ms(int runs);
double angles_pose_ms(int runs);
/// A frame between two keyframes with 20k triangles, including the handles.
double playback_ms(int runs);
/// The largest relative error of the area while a bar is bent by 270 degrees; `linear_blend` blends
/// the positions linearly.
double inbetween_loss_percent(bool linear_blend);

/// A frame of dragging one of five strokes with 20 samples each, without evaluating the map on the
/// mesh.
double strokes_drag_ms(int runs);

}  // namespace holomorph::bench
