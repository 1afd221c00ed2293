// What is measured of outlines and strokes, and how anything is timed.
#pragma once

#include <functional>

namespace holomorph::bench {

/// The median time of `work` in milliseconds, after one run that does not count.
double median_ms(int runs, const std::function<void()>& work);

/// 30 random pairs of smooth and limbed outlines: how many are reached without folds (no zero of
/// f', turning number 1, both Hausdorff distances below 1 % of the diameter), and the median time.
struct OutlineFigures {
  double reached = 0, median_ms = 0;
};
OutlineFigures outline_figures(bool published);
inline constexpr int kOutlinePairs = 30;

/// The iterations alone, 100 vertices and 400 samples, until the distance is within 1 % of its last
/// value: of the slowest of the pairs.
double outline_iterations_ms(int runs);
/// The slowest of six hard pairs, from nothing.
double hard_outline_ms();

/// Hilbert coordinates and the angle map of 20 corners at 10k mesh vertices; a frame in which one
/// corner is dragged, and one from nothing.
double angles_prepare_ms(int runs);
double angles_drag_ms(int runs);
double angles_pose_ms(int runs);
/// A frame between two keys, 20k triangles, handles included.
double playback_ms(int runs);
/// How far the area is from where it should be, at worst, when a bar is bent by 270 degrees.
double inbetween_loss_percent(bool straight);

/// A frame of dragging one of five strokes of 20 samples each, without the map at the mesh.
double strokes_drag_ms(int runs);

}  // namespace holomorph::bench
