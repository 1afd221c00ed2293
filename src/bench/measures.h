// The measurements behind the table of benchmarks, and the timer that they use. Unless a comment
// says otherwise, they return medians of `runs` runs in the unit of their name.
#pragma once

#include <functional>
#include <string>

#include "bench/bench.h"
#include "core/cauchy/cauchy_array.h"

namespace holomorph::bench {

/// The median time of `work` in milliseconds, after one warm-up run.
double median_ms(int runs, const std::function<void()>& work);

/// AVX2 where the processor has it.
Kernel avx2_or_portable();
/// Coordinates of 15000 points for 100 edges, per point and edge. T is float or double.
template <class T>
double coordinates_ns(Kernel kernel, int order, int runs);
/// Points in the cage in random order, per point and edge.
double random_coordinates_ns(int runs);
double scalar_log_ns(int runs);
/// The time that it takes, per point and edge, to compute the coordinates of a straight cage whose
/// pose has this degree.
double raised_coordinates_ns(int degree, int runs);
double coordinates_ms(int runs);
/// Points in a picture of 1000 x 1000 pixels, and their derivatives, as Python gets them.
double million_points_ms(int runs);

/// The composition through an intermediate polygon (Lin and Chen 2024, section 4.3): u2 after the
/// inverse of u1, where u1 maps the polygon of the segments' endpoints to the curved rest cage.
/// Measures what percentage of the domain's samples have no preimage under u1, and how long it
/// takes to set up the composition and find the preimages.
struct PolygonRoute {
  double missing_percent = 0, milliseconds = 0;
};
PolygonRoute polygon_route();
/// The time to find 10000 preimages for a pose of 20 cubic segments, without setting up the
/// inverse.
double inverse_ms(int runs);

double mesh_ms(int runs);
double curved_prepare_ms(int runs);
double prepare_ms(int points, int runs);
/// The time that a method needs to prepare its map of a cage of this many points, on a mesh of
/// about 9000 vertices that exists already.
double prepare_method_ms(const char* method, int points, int runs);
double add_pin_ms(int runs);
double frame_ms(int runs);

/// The memory of the process with a picture and a map. Earlier benchmarks would add theirs, so this
/// one is the first.
double memory_mb();
/// The time of the slowest method for the map at every pixel of a picture of 2000 x 2000, which a
/// cage of 32 points and three pins bend.
double st_map_ms();
double unwarp_ms();
double export_ms(int side, int vertices, int runs, int threads);
/// The time per frame of a film of 100 frames of 1000 x 1000 pixels with three keyframes, on all
/// cores, from preparation to pixels.
double film_frame_ms(const char* method);
/// How much longer one frame takes in a film with 200 keyframes than in one with four.
double many_keys_ratio(int runs);
double auto_cage_ms(int runs);

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
/// The same for a bar that follows its pins, without a method to follow.
BoundedDrag bar_drag();
/// The median time to project and prove the slowest of the known maps, from a cold start.
double bounded_solve_ms(int vertices, int samples, int runs);
double bounded_cold_ms(int runs);

/// The name prefix of the rows that project the same folded bar with each published method. They
/// have the time and, as text, properties of the map.
inline constexpr const char* kCompared = "compared on a folded bar, 800 mesh vertices: ";
void compare_on_folded_bar(const std::function<void(const Result&)>& report);

/// A body of radius 100 with eight limbs that are 60 wide at the body and 200 long.
Points limbed_body();

/// Figures for a drag of 300 frames of an elastic sheet with 10 pins, with the default drawn mesh.
enum class SheetScene { limbs, photograph };
struct SheetFigures {
  double preparation_ms = 0, median_ms = 0, longest_ms = 0;
  double final_ms = 0;   ///< the pin released half way
  double megabytes = 0;  ///< growth of the process's resident memory
  int unproved = 0;
};
SheetFigures sheet_drag(SheetScene scene);

/// The resident memory of the process, in megabytes.
double resident_mb();

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
