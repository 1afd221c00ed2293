// The two inner loops that are compiled twice, for any processor and for AVX2 with FMA.
// Plain pointers and no templates of other headers: nothing compiled with wider instructions can
// leak into the rest of the program through the linker.
#pragma once

namespace holomorph::kernel {

inline constexpr int kBlock = 32;          ///< points per call of edge_series
inline constexpr double kNear2 = 2.25;     ///< |w|^2 below which the series is not used

/// One edge for one block of points: s = -(a - z) / A with A = b - a and (ux, uy) = 1 / A.
struct Edge {
  double ax, ay, ux, uy;
};

/// The start and end halves of an edge's coordinates at kBlock points; w2 is |w|^2 for each.
struct Halves {
  double start_re[kBlock], start_im[kBlock], end_re[kBlock], end_im[kBlock], w2[kBlock];
};

/// Fills `out` for points x, y (kBlock of each) by the series; entries with w2 < kNear2 are not
/// meaningful. `order` is 0 or 1.
using EdgeSeries = void (*)(const Edge& edge, const double* x, const double* y, int order,
                            Halves& out);

/// out += matrix * factors for a block of rows: matrix is column-major with leading dimension
/// `stride`, `rows` x `inner`; factors are inner complex numbers.
template <class T>
using BlockProduct = void (*)(const T* re, const T* im, long stride, long rows, long inner,
                              const T* factor_re, const T* factor_im, T* out_re, T* out_im);

struct Table {
  EdgeSeries edge_series;
  BlockProduct<float> product_float;
  BlockProduct<double> product_double;
};

extern const Table kPortable;
extern const Table kAvx2;

}  // namespace holomorph::kernel
