// The two inner loops that are compiled twice, for any processor and for AVX2 with FMA.
// Plain pointers and no templates of other headers: nothing compiled with wider instructions can
// leak into the rest of the program through the linker.
#pragma once

namespace holomorph::kernel {

/// Points per call of an EdgeSeries.
inline constexpr int kBlock = 32;

/// One edge from (ax, ay) to (bx, by), (ux, uy) = 1 / (b - a); a point whose offset from the edge
/// is at most `rounding` edge lengths may be on it.
struct Edge {
  double ax, ay, bx, by, ux, uy, rounding;
};

/// kBlock points and a disc around them.
struct Block {
  double x[kBlock], y[kBlock], center_x, center_y, radius;
};

/// The start and end halves of an edge's coordinates at kBlock points.
struct Halves {
  double start_re[kBlock], start_im[kBlock], end_re[kBlock], end_im[kBlock], on_edge[kBlock];
};

/// Fills `out` for the points of a block, order 0 or 1. Returns whether some points may be on
/// the edge or its end points; then on_edge marks them with 1 and their halves are not meaningful.
using EdgeSeries = bool (*)(const Edge& edge, const Block& block, int order, Halves& out);

/// A vertex's column: the end half of the edge before it plus the start half of its own edge, for
/// the first `count` points.
template <class T>
using Join = void (*)(const Halves& before, const Halves& own, long count, T* re, T* im);

/// out += matrix * factors for a block of rows: matrix is column-major with leading dimension
/// `stride`, `rows` x `inner`; factors are inner complex numbers.
template <class T>
using BlockProduct = void (*)(const T* re, const T* im, long stride, long rows, long inner,
                              const T* factor_re, const T* factor_im, T* out_re, T* out_im);

struct Table {
  EdgeSeries edge_series;
  Join<float> join_float;
  Join<double> join_double;
  BlockProduct<float> product_float;
  BlockProduct<double> product_double;
};

extern const Table kPortable;
extern const Table kAvx2;
extern const Table kAvx512;

}  // namespace holomorph::kernel
