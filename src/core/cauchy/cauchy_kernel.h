// The inner loops, which are compiled several times: once for any processor, and again for wider
// instruction sets. They use plain pointers and no templates from other headers. Otherwise, the
// linker might use code with wider instructions in the rest of the program.
#pragma once

namespace holomorph::kernel {

/// Points per call.
inline constexpr int kBlock = 32;
/// The highest basis degree that the kernels integrate.
inline constexpr int kMaxDegree = 4;

/// An edge from (ax, ay) to (bx, by), with (ux, uy) = 1 / (b - a). A point may be on it if its
/// offset from the edge is at most `rounding` edge lengths.
struct Edge {
  double ax, ay, bx, by, ux, uy, rounding;
};

/// kBlock points and a disk around them.
struct alignas(64) Block {
  double x[kBlock], y[kBlock], center_x, center_y, radius;
};

/// For each point of a block, one root of a curve (see segment.h) and the factor for the moments of
/// this root: 1, or 1 / c' for derivatives.
struct alignas(64) Roots {
  double s_re[kBlock], s_im[kBlock], q_re[kBlock], q_im[kBlock], factor_re[kBlock],
      factor_im[kBlock];
};

/// The coordinates of a segment's control points at kBlock points. on_edge is 1 for points that
/// EdgeMoments marks.
struct alignas(64) Moments {
  double re[kMaxDegree + 1][kBlock], im[kMaxDegree + 1][kBlock], on_edge[kBlock];
};

/// Fills `out` for the points of a block, for a basis of degree 1 to kMaxDegree and order 0 or 1.
/// Returns whether some points may be on the edge or next to its ends. If so, on_edge marks them
/// with 1, and their moments may be meaningless.
using EdgeMoments = bool (*)(const Edge& edge, const Block& block, int degree, int order,
                             Moments& out);

/// Adds the contribution of one root to the coordinates of a curved segment. No root may lie on the
/// segment.
using RootMoments = void (*)(const Roots& roots, int degree, int order, Moments& sum);

/// Adds two rows and writes the first `count` sums to a column. The second row may be null.
template <class T>
using Join = void (*)(const double* re, const double* im, const double* more_re,
                      const double* more_im, long count, T* out_re, T* out_im);

/// out += matrix * factors for a block of rows. The matrix is `rows` x `inner` and column-major
/// with leading dimension `stride`. The factors are `inner` complex numbers.
template <class T>
using BlockProduct = void (*)(const T* re, const T* im, long stride, long rows, long inner,
                              const T* factor_re, const T* factor_im, T* out_re, T* out_im);

struct Table {
  EdgeMoments edge_moments;
  RootMoments root_moments;
  Join<float> join_float;
  Join<double> join_double;
  BlockProduct<float> product_float;
  BlockProduct<double> product_double;
};

extern const Table kPortable;
extern const Table kAvx2;
extern const Table kAvx512;

}  // namespace holomorph::kernel
