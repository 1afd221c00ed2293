// Scan-converts triangles by computing where their edges cross pixel rows. A pixel that a
// silhouette crosses has 4 x 4 coverage samples, but its color is always taken at its center.
#include "raster/drawing.h"

#include "core/parallel.h"
#include "raster/picture_rows.h"
#include "raster/scan.h"

namespace holomorph {
namespace {

constexpr int kSub = 4;      ///< coverage samples per pixel in each direction
constexpr int kBand = 16;    ///< rows that one task draws
constexpr int kBlock = 16;   ///< columns that are known to have coverage samples or none
constexpr int kMaxTaps = 8;  ///< limit of color samples per pixel in each direction

/// An output triangle and the affine map from output pixels to its source coordinates (u, v): a
/// position in the source picture or, for heat maps, the heat value in u.
struct Piece {
  double x[3], y[3];  ///< output pixels, y down
  SourceMap map;
  double low, high;  ///< range of u over the corners: heat is never extrapolated
  bool outside;      ///< shows the undeformed picture, and is drawn only outside the rest cage
};

/// The mean over `width` units around x of a square wave with cells of 16 units: 1 in the first
/// cell, -1 in the next. image.frag has the same formula.
double wave(double x, double width) {
  const auto folded = [](double cell) {
    const double half = 0.5 * cell;
    return std::abs(half - std::floor(half) - 0.5);
  };
  const double cell = std::clamp(x / 16, -1e6, 1e6), w = std::max(width / 16, 1e-6);
  return 2 * (folded(cell - 0.5 * w) - folded(cell + 0.5 * w)) / w;
}

/// Sorted crossings of closed polygons with the line at height y. The inside lies between the
/// first and second crossing, between the third and fourth, and so on.
void row_crossings(const std::vector<std::array<double, 4>>& edges,
                   const std::vector<int>& candidates, double y, std::vector<double>& out) {
  out.clear();
  for (const int e : candidates) {
    const auto& [ax, ay, bx, by] = edges[e];
    if ((ay <= y) != (by <= y)) out.push_back(crossing(ax, ay, bx, by, y));
  }
  std::sort(out.begin(), out.end());
}

class Drawing {
 public:
  Drawing(const RasterJob& job, double left, double top, int width, int height)
      : job_(job),
        box_(job.source_box()),
        left_(left),
        top_(top),
        scale_(job.pixels_per_unit),
        is_placed_(!is_identity(job.placement)),
        output_(width, height) {
    if (job.fine) output_.fine.resize(output_.pixels.size());
    if (job.source && job.view == View::image && job.surroundings) {
      if (job.fringe)
        add_triangles(*job.fringe, job.fringe_positions);
      else
        add_surroundings();
    }
    if (job.mesh) add_mesh();
    bin();
  }

  Image draw() {
    parallel_for(
        static_cast<int>(bands_.size()), [&](int band) { draw_band(band); }, {}, job_.threads);
    round_fine(output_);
    return std::move(output_);
  }

 private:
  struct Band {
    std::vector<int> pieces, silhouette, cage;  ///< indices of those that touch the band
  };
  using Edge = std::array<double, 4>;

  /// The output pixel of a position, as x + iy with y down.
  Complex out(Complex z) const {
    if (is_placed_) z = job_.placement(z);
    return {(z.real() - left_) * scale_, (top_ - z.imag()) * scale_};
  }
  Edge edge_of(Complex a, Complex b) const {
    const Complex p = out(a), q = out(b);
    return {p.real(), p.imag(), q.real(), q.imag()};
  }

  /// Adds a triangle with its corners at `at`, which have the source coordinates (u, v).
  void add_piece(const std::array<Complex, 3>& at, const double u[3], const double v[3],
                 bool outside) {
    Piece piece{};
    for (int k = 0; k < 3; ++k) {
      const Complex p = out(at[k]);
      piece.x[k] = p.real(), piece.y[k] = p.imag();
    }
    const double ax = piece.x[1] - piece.x[0], ay = piece.y[1] - piece.y[0];
    const double bx = piece.x[2] - piece.x[0], by = piece.y[2] - piece.y[0];
    const double area = ax * by - ay * bx;
    if (!(std::abs(area) > 1e-12)) return;
    const auto gradient = [&](const double w[3], double& w0, double& wx, double& wy) {
      const double p = w[1] - w[0], q = w[2] - w[0];
      wx = (p * by - q * ay) / area;
      wy = (q * ax - p * bx) / area;
      w0 = w[0] - wx * piece.x[0] - wy * piece.y[0];
    };
    SourceMap& map = piece.map;
    gradient(u, map.u0, map.ux, map.uy);
    gradient(v, map.v0, map.vx, map.vy);
    const auto taps = [](double du, double dv) {
      return std::clamp(static_cast<int>(std::ceil(std::hypot(du, dv) - 0.05)), 1, kMaxTaps);
    };
    if (job_.view == View::image)
      map.taps_x = taps(map.ux, map.vx), map.taps_y = taps(map.uy, map.vy);
    piece.low = std::min({u[0], u[1], u[2]});
    piece.high = std::max({u[0], u[1], u[2]});
    piece.outside = outside;
    pieces_.push_back(piece);
  }

  /// Calls visit with the vertices of each edge.
  template <class Visit>
  void for_each_boundary_edge(Visit visit) const {
    const std::vector<int>& boundary = job_.mesh->boundary;
    const Loops loops = job_.mesh->boundary_loops();
    for (Index i = 0; i < static_cast<Index>(boundary.size()); ++i)
      visit(static_cast<size_t>(boundary[static_cast<size_t>(i)]),
            static_cast<size_t>(boundary[static_cast<size_t>(loops.next(i))]));
  }

  void add_surroundings() {
    const auto [d, c, b, a] = box_.corners();
    const double right = job_.source->width, bottom = job_.source->height;
    const double u1[3] = {0, right, right}, v1[3] = {0, 0, bottom};
    const double u2[3] = {0, right, 0}, v2[3] = {0, bottom, bottom};
    add_piece({a, b, c}, u1, v1, job_.mesh != nullptr);
    add_piece({a, c, d}, u2, v2, job_.mesh != nullptr);
    if (is_placed_)  // at rest, the rectangle's edges lie between pixels
      for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, d}, {d, a}})
        silhouette_.push_back(edge_of(from, to));
    if (!job_.mesh) return;
    for_each_boundary_edge([&](size_t a, size_t b) {
      cage_.push_back(edge_of(job_.mesh->vertices[a], job_.mesh->vertices[b]));
    });
  }

  void add_triangles(const Mesh& mesh, std::span<const Complex> at) {
    const bool heat = is_heat(job_.view);
    // The checker lies on the plane, and the picture in its rectangle.
    const bool is_picture = job_.view == View::image && job_.source;
    const bool resized = is_picture && job_.box;
    const double across = resized ? job_.source->width / box_.width() : 1,
                 down = resized ? job_.source->height / box_.height() : 1;
    const double left = is_picture ? box_.left : 0;
    for (const Triangle& t : mesh.triangles) {
      double u[3], v[3];
      for (int k = 0; k < 3; ++k) {
        u[k] = heat ? heat_position(job_.scale, job_.heat[t[k]])
                    : across * (mesh.vertices[t[k]].real() - left);
        v[k] = heat ? 0 : down * (box_.top - mesh.vertices[t[k]].imag());
      }
      add_piece({at[t[0]], at[t[1]], at[t[2]]}, u, v, false);
    }
  }

  void add_mesh() {
    add_triangles(*job_.mesh, job_.positions);
    for_each_boundary_edge([&](size_t a, size_t b) {
      silhouette_.push_back(edge_of(job_.positions[a], job_.positions[b]));
    });
  }

  void bin() {
    bands_.resize((output_.height + kBand - 1) / kBand);
    const auto add = [&](double low, double high, int number, std::vector<int> Band::*list) {
      const int first = std::max(0, static_cast<int>(std::floor(low / kBand)));
      const int last =
          std::min(static_cast<int>(bands_.size()) - 1, static_cast<int>(std::floor(high / kBand)));
      for (int band = first; band <= last; ++band) (bands_[band].*list).push_back(number);
    };
    for (size_t i = 0; i < pieces_.size(); ++i) {
      const auto [low, high] = std::minmax({pieces_[i].y[0], pieces_[i].y[1], pieces_[i].y[2]});
      add(low, high, static_cast<int>(i), &Band::pieces);
    }
    for (size_t i = 0; i < silhouette_.size(); ++i)
      add(std::min(silhouette_[i][1], silhouette_[i][3]),
          std::max(silhouette_[i][1], silhouette_[i][3]), static_cast<int>(i), &Band::silhouette);
    for (size_t i = 0; i < cage_.size(); ++i)
      add(std::min(cage_[i][1], cage_[i][3]), std::max(cage_[i][1], cage_[i][3]),
          static_cast<int>(i), &Band::cage);
  }

  /// The data of a band's pixels in addition to their colors: whether they are inside the rest
  /// cage, and the coverage samples of pixels that a silhouette crosses.
  struct Canvas {
    int first_row, rows, width;
    std::vector<int> slot;  ///< per pixel: index into samples, kFree or kInCage
    std::vector<std::array<Float4, kSub * kSub>> samples;
    std::vector<std::uint16_t> sample_in_cage;  ///< per slot: one bit per sample
    std::vector<int> slot_pixel;
    std::vector<std::uint8_t> sampled;  ///< per kBlock columns: whether any has samples

    size_t at(int column, int row) const {
      return static_cast<size_t>(row - first_row) * width + column;
    }
    /// Whether any pixel from about one column to another has coverage samples.
    bool has_samples(int from, int to) const {
      return std::find(sampled.begin() + from / kBlock, sampled.begin() + to / kBlock + 1, true) !=
             sampled.begin() + to / kBlock + 1;
    }
  };

  void mark(Canvas& canvas, const Edge& edge) const {
    const auto& [ax, ay, bx, by] = edge;
    const int low = std::max(canvas.first_row, static_cast<int>(std::floor(std::min(ay, by))));
    const int high = std::min(canvas.first_row + canvas.rows - 1,
                              static_cast<int>(std::floor(std::max(ay, by))));
    for (int row = low; row <= high; ++row) {
      double x0 = ax, x1 = bx;
      if (ay != by) {  // the part of the edge in this row
        const double t0 = std::clamp((row - ay) / (by - ay), 0.0, 1.0),
                     t1 = std::clamp((row + 1 - ay) / (by - ay), 0.0, 1.0);
        x0 = ax + t0 * (bx - ax);
        x1 = ax + t1 * (bx - ax);
      }
      const int left = std::max(0, static_cast<int>(std::floor(std::min(x0, x1) - 1e-9)));
      const int right =
          std::min(canvas.width - 1, static_cast<int>(std::floor(std::max(x0, x1) + 1e-9)));
      for (int column = left; column <= right; ++column) {
        int& slot = canvas.slot[canvas.at(column, row)];
        if (slot >= 0) continue;
        slot = static_cast<int>(canvas.samples.size());
        canvas.sampled[static_cast<size_t>(column / kBlock)] = true;
        canvas.samples.push_back({});
        canvas.sample_in_cage.push_back(0);
        canvas.slot_pixel.push_back(static_cast<int>(canvas.at(column, row)));
      }
    }
  }

  void find_cage(Canvas& canvas, const std::vector<int>& edges) const {
    std::vector<double> at;
    for (int row = canvas.first_row; row < canvas.first_row + canvas.rows; ++row) {
      row_crossings(cage_, edges, row + 0.5, at);
      for (size_t i = 0; i + 1 < at.size(); i += 2) {
        const int left = std::max(0, first_center(at[i])),
                  right = std::min(canvas.width, first_center(at[i + 1]));
        for (int c = left; c < right; ++c)
          if (int& slot = canvas.slot[canvas.at(c, row)]; slot == kFree) slot = kInCage;
      }
    }
    std::vector<std::vector<double>> lines(static_cast<size_t>(canvas.rows) * kSub);
    for (size_t i = 0; i < lines.size() && !canvas.samples.empty(); ++i)
      row_crossings(cage_, edges, canvas.first_row + (static_cast<double>(i) + 0.5) / kSub,
                    lines[i]);
    for (size_t slot = 0; slot < canvas.samples.size(); ++slot) {
      const int pixel = canvas.slot_pixel[slot], column = pixel % canvas.width,
                row = pixel / canvas.width;
      for (int sy = 0; sy < kSub; ++sy) {
        const std::vector<double>& line = lines[static_cast<size_t>(row * kSub + sy)];
        for (int sx = 0; sx < kSub; ++sx) {
          const double x = column + (sx + 0.5) / kSub;
          const auto before = std::upper_bound(line.begin(), line.end(), x) - line.begin();
          if (before % 2)
            canvas.sample_in_cage[slot] |= static_cast<std::uint16_t>(1u << (sy * kSub + sx));
        }
      }
    }
  }

  Float4 color_at(const Piece& piece, int column, int row) const {
    const SourceMap& map = piece.map;
    if (job_.view == View::image)
      return job_.fine ? fine_source_color(*job_.source, map, column, row)
                       : source_color(*job_.source, map, column, row);
    const double x = column + 0.5, y = row + 0.5;
    const double u = map.u0 + map.ux * x + map.uy * y, v = map.v0 + map.vx * x + map.vy * y;
    if (job_.view == View::checker) {
      const double up = box_.top - v;  // y up, as on the canvas
      const double light = 0.5 - 0.5 * wave(u, std::abs(map.ux) + std::abs(map.uy)) *
                                     wave(up, std::abs(map.vx) + std::abs(map.vy));
      const Float4 dark{70, 90, 120, 255}, bright{235, 235, 235, 255};
      return dark + static_cast<float>(light) * (bright - dark);
    }
    const Color color = heat_color(std::clamp(u, piece.low, piece.high), job_.scale.diverging);
    return Float4{color[0] * 255, color[1] * 255, color[2] * 255, 255};
  }

  void draw_row(const Piece& piece, const PixelSpan& span) {
    if (job_.view == View::image && !job_.fine)
      return draw_span_fast(*job_.source, piece.map, span);
    for (int column = span.begin; column < span.end; ++column) {
      if (!span.draws(column)) continue;
      const Float4 color = color_at(piece, column, span.row);
      if (job_.fine)
        draw_pixel(color, &output_.fine[output_.index(column, span.row)]);
      else
        draw_pixel(color, span.pixels + 4 * static_cast<size_t>(column));
    }
  }

  void draw_piece(const Piece& piece, Canvas& canvas) {
    const auto [low, high] = std::minmax({piece.y[0], piece.y[1], piece.y[2]});
    const int first = std::max(canvas.first_row, static_cast<int>(std::floor(low)));
    const int last =
        std::min(canvas.first_row + canvas.rows - 1, static_cast<int>(std::floor(high)));
    const double step_x = 1.0 / kSub;
    const auto [least_x, most_x] = std::minmax({piece.x[0], piece.x[1], piece.x[2]});
    const int from = static_cast<int>(std::clamp(std::floor(least_x), 0.0, canvas.width - 1.0)),
              to = static_cast<int>(std::clamp(std::floor(most_x), 0.0, canvas.width - 1.0));
    const bool has_samples = canvas.has_samples(from, to);
    for (int row = first; row <= last; ++row) {
      double left = 0, right = 0;
      if (span_at(piece.x, piece.y, row + 0.5, left, right))
        draw_row(piece, {row, std::max(0, first_center(left)),
                         std::min(canvas.width, first_center(right)), canvas.width,
                         output_.at(0, row), &canvas.slot[canvas.at(0, row)], piece.outside});
      if (!has_samples) continue;
      // The coverage samples of silhouette pixels in this row, one line of samples at a time.
      double lefts[kSub], rights[kSub], least = 1e300, most = -1e300;
      bool any = false;
      for (int sy = 0; sy < kSub; ++sy) {
        lefts[sy] = rights[sy] = 0;
        if (!span_at(piece.x, piece.y, row + (sy + 0.5) * step_x, lefts[sy], rights[sy])) continue;
        any = true;
        least = std::min(least, lefts[sy]);
        most = std::max(most, rights[sy]);
      }
      if (!any) continue;
      const int begin = std::max(0, static_cast<int>(std::floor(least))),
                end = std::min(canvas.width - 1, static_cast<int>(std::floor(most)));
      for (int column = begin; column <= end; ++column) {
        const int slot = canvas.slot[canvas.at(column, row)];
        if (slot < 0) continue;
        unsigned covered = 0;
        for (int sy = 0; sy < kSub; ++sy)
          for (int sx = 0; sx < kSub; ++sx) {
            const double x = column + (sx + 0.5) * step_x;
            if (lefts[sy] <= x && x < rights[sy]) covered |= 1u << (sy * kSub + sx);
          }
        if (piece.outside) covered &= ~static_cast<unsigned>(canvas.sample_in_cage[slot]);
        if (covered == 0) continue;
        const Float4 color = color_at(piece, column, row);
        for (int s = 0; s < kSub * kSub; ++s)
          if (covered >> s & 1) canvas.samples[slot][s] = over(color, canvas.samples[slot][s]);
      }
    }
  }

  void draw_band(int number) {
    const Band& band = bands_[number];
    Canvas canvas{number * kBand,
                  std::min(kBand, output_.height - number * kBand),
                  output_.width,
                  {},
                  {},
                  {},
                  {},
                  std::vector<std::uint8_t>(static_cast<size_t>(output_.width / kBlock + 1))};
    canvas.slot.assign(static_cast<size_t>(canvas.rows) * canvas.width, kFree);
    for (const int e : band.silhouette) mark(canvas, silhouette_[e]);
    for (const int e : band.cage) mark(canvas, cage_[e]);
    find_cage(canvas, band.cage);
    for (const int p : band.pieces) draw_piece(pieces_[p], canvas);
    for (size_t slot = 0; slot < canvas.samples.size(); ++slot) {
      const auto& samples = canvas.samples[slot];
      const bool alike = std::all_of(samples.begin(), samples.end(),
                                     [&](Float4 s) { return same(s, samples[0]); });
      Float4 sum{};
      for (Float4 sample : samples) {
        const float alpha = sample[3];
        sample[3] = 1;
        sum += alpha * sample;
      }
      const Float4 color = alike ? samples[0] : Sampler::straight(sum / float{kSub * kSub});
      const int pixel = canvas.slot_pixel[slot], column = pixel % canvas.width,
                row = canvas.first_row + pixel / canvas.width;
      if (job_.fine)
        store(color, &output_.fine[output_.index(column, row)]);
      else
        store(color, output_.at(column, row));
    }
  }

  const RasterJob& job_;
  Box box_;  ///< of the source
  double left_, top_, scale_;
  bool is_placed_;
  Image output_;
  std::vector<Piece> pieces_;
  std::vector<Edge> silhouette_, cage_;
  std::vector<Band> bands_;
};

}  // namespace

Image drawn(const RasterJob& job, double left, double top, int width, int height) {
  return Drawing(job, left, top, width, height).draw();
}

}  // namespace holomorph
