// The outside is meshed like a cage: its outline is a box, and its holes are the parts of the
// cut-out. Each hole of the cut-out is one more mesh, without the parts in it.
#include "scene/fringe.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/mesh/mesher.h"

namespace holomorph {
namespace {

constexpr int kFringeVertices = 3000;  ///< of each mesh
constexpr double kSlack = 0.015;       ///< how far a cage may cut into a cut-out, in diagonals
constexpr double kMargin = 2;          ///< around faint pixels, in pixels

Polygon boundary_of(const Mesh& mesh) {
  Polygon polygon{{}, mesh.starts};
  for (const int v : mesh.boundary) polygon.points.push_back(mesh.vertices[static_cast<size_t>(v)]);
  return polygon;
}

int largest_alpha(const Image& picture) {
  std::uint8_t largest = 0;
  for (size_t i = 3; i < picture.pixels.size(); i += 4)
    largest = std::max(largest, picture.pixels[i]);
  return largest;
}

/// The box of the faint pixels outside a polygon, in the plane. None if there are solid ones, or if
/// `keep_going` returns false.
std::optional<Box> faint_box(PolygonView polygon, const Image& picture,
                             const std::function<bool()>& keep_going) {
  std::vector<std::pair<Complex, Complex>> edges;
  polygon.for_each_edge([&](Index, Complex a, Complex b) { edges.emplace_back(a, b); });
  const int solid = std::max((largest_alpha(picture) + 1) / 2, 1);
  const double reach = kSlack * box_of(polygon.points()).diagonal();
  Box box;
  std::vector<double> crossings;
  for (int row = 0; row < picture.height; ++row) {
    if (!keep_going()) return std::nullopt;
    const double y = picture.top() - row - 0.5;
    crossings.clear();
    for (const auto& [a, b] : edges)
      if ((a.imag() <= y) != (b.imag() <= y))
        crossings.push_back(a.real() +
                            (b.real() - a.real()) * (y - a.imag()) / (b.imag() - a.imag()));
    std::ranges::sort(crossings);
    crossings.push_back(1e300);
    // The outside lies before the first crossing, between the second and the third, and so on.
    const auto column = [&](double x) {
      return static_cast<int>(
          std::clamp(std::ceil(x - picture.left - 0.5), 0.0, double(picture.width)));
    };
    int first = 0;
    for (size_t i = 0; i < crossings.size(); i += 2) {
      for (int c = first, end = column(crossings[i]); c < end; ++c) {
        const int alpha = picture.at(c, row)[3];
        const Complex center(picture.left + c + 0.5, y);
        if (alpha >= solid && nearest_on_polygon(polygon, center).distance > reach)
          return std::nullopt;
        if (alpha > 0) box.include(center);
      }
      first = i + 1 < crossings.size() ? column(crossings[i + 1]) : picture.width;
    }
  }
  return box;
}

/// Adds the mesh inside a polygon to the fringe.
void add_mesh(Fringe& fringe, PolygonView inside, const Mesh& mesh, const Polygon& boundary) {
  const Mesh part = domain_mesh(inside, {kFringeVertices});
  const int base = static_cast<int>(fringe.mesh.vertices.size());
  const Loops loops = mesh.boundary_loops();
  for (const Complex& z : part.vertices) {
    fringe.mesh.vertices.push_back(z);
    const Index edge = nearest_on_polygon(boundary, z).edge;
    const int a = mesh.boundary[static_cast<size_t>(edge)],
              b = mesh.boundary[static_cast<size_t>(loops.next(edge))];
    const Complex from = mesh.vertices[static_cast<size_t>(a)],
                  to = mesh.vertices[static_cast<size_t>(b)];
    // The vertices of the boundary itself follow exactly, so that no gap opens.
    if (z == from || z == to)
      fringe.followers.push_back(z == from ? Fringe::Follower{a, a} : Fringe::Follower{b, b});
    else
      fringe.followers.push_back({a, b, (z - from) / (to - from)});
  }
  for (Triangle t : part.triangles) {
    for (int& corner : t) corner += base;
    fringe.mesh.triangles.push_back(t);
  }
}

/// The inside of a loop without the parts in it, whose outlines are nested this deep.
Polygon surroundings(Points loop, PolygonView boundary, std::span<const int> around, int depth) {
  Polygon result{std::move(loop)};
  const Points outer = result.points;
  for (Index l = 0; l < boundary.loops().count(); ++l) {
    const auto outline = boundary.loop(l);
    if (around[static_cast<size_t>(l)] != depth || winding_number(outer, outline[0]) == 0) continue;
    result.starts.push_back(static_cast<Index>(result.points.size()));
    result.points.insert(result.points.end(), outline.begin(), outline.end());
  }
  return result;
}

/// Removes the triangles between parts that may move apart.
void remove_bridges(Fringe& fringe, const Mesh& mesh) {
  std::vector<int> part(mesh.vertices.size(), -1);
  const Loops loops = mesh.boundary_loops();
  int current = -1;
  for (Index l = 0; l < loops.count(); ++l) {
    Points points;
    for (Index i = loops.first(l); i < loops.end(l); ++i)
      points.push_back(mesh.vertices[static_cast<size_t>(mesh.boundary[static_cast<size_t>(i)])]);
    if (signed_area(points) > 0) ++current;  // an outline; its holes follow it
    for (Index i = loops.first(l); i < loops.end(l); ++i)
      part[static_cast<size_t>(mesh.boundary[static_cast<size_t>(i)])] = current;
  }
  const auto part_of = [&](int v) {
    return part[static_cast<size_t>(fringe.followers[static_cast<size_t>(v)].a)];
  };
  std::erase_if(fringe.mesh.triangles, [&](const Triangle& t) {
    return part_of(t[0]) != part_of(t[1]) || part_of(t[0]) != part_of(t[2]);
  });
}

/// Whether a pixel with some alpha lies in the box of a triangle, or next to it.
bool shows_something(const Image& picture, const std::array<Complex, 3>& corners) {
  Box box;
  for (const Complex& z : corners) box.include(z);
  const auto clamped = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
  };
  const int left = clamped(std::floor(box.left - picture.left) - 1, picture.width),
            right = clamped(std::ceil(box.right - picture.left) + 1, picture.width),
            top = clamped(std::floor(picture.top() - box.top) - 1, picture.height),
            bottom = clamped(std::ceil(picture.top() - box.bottom) + 1, picture.height);
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column)
      if (picture.at(column, row)[3] > 0) return true;
  return false;
}

/// Removes the triangles that show nothing, and their vertices. Where the cage moves far, they
/// would be drawn out far.
void remove_empty(Fringe& fringe, const Image& picture) {
  const auto at = [&](int vertex) { return fringe.mesh.vertices[static_cast<size_t>(vertex)]; };
  std::erase_if(fringe.mesh.triangles, [&](const Triangle& t) {
    return !shows_something(picture, {at(t[0]), at(t[1]), at(t[2])});
  });
  std::vector<int> number(fringe.mesh.vertices.size(), -1);
  Points vertices;
  std::vector<Fringe::Follower> followers;
  for (Triangle& t : fringe.mesh.triangles)
    for (int& corner : t) {
      int& there = number[static_cast<size_t>(corner)];
      if (there < 0) {
        there = static_cast<int>(vertices.size());
        vertices.push_back(at(corner));
        followers.push_back(fringe.followers[static_cast<size_t>(corner)]);
      }
      corner = there;
    }
  fringe.mesh.vertices = std::move(vertices);
  fringe.followers = std::move(followers);
}

}  // namespace

Points Fringe::positions(std::span<const Complex> f) const {
  Points at;
  at.reserve(followers.size());
  for (const auto& [a, b, t] : followers) {
    const Complex from = f[static_cast<size_t>(a)];
    at.push_back(a == b ? from : from + t * (f[static_cast<size_t>(b)] - from));
  }
  return at;
}

bool has_solid_surroundings(const Mesh& mesh, const Image& picture) {
  return !faint_box(boundary_of(mesh), picture, [] { return true; });
}

std::shared_ptr<const Fringe> fringe_of(const Mesh& mesh, const Image& picture,
                                        const std::function<bool()>& keep_going) {
  const Polygon boundary = boundary_of(mesh);
  const std::optional<Box> faint = faint_box(boundary, picture, keep_going);
  if (!faint || faint->empty()) return nullptr;
  Box outer = box_of(boundary.points);
  outer.include({faint->left, faint->bottom});
  outer.include({faint->right, faint->top});
  const Points frame{{outer.left - kMargin, outer.bottom - kMargin},
                     {outer.right + kMargin, outer.bottom - kMargin},
                     {outer.right + kMargin, outer.top + kMargin},
                     {outer.left - kMargin, outer.top + kMargin}};
  auto fringe = std::make_shared<Fringe>();
  try {
    const PolygonView loops(boundary);
    const std::vector<int> around = nesting_of(loops);
    add_mesh(*fringe, surroundings(frame, loops, around, 0), mesh, boundary);
    for (Index l = 0; l < loops.loops().count() && keep_going(); ++l)
      if (const int depth = around[static_cast<size_t>(l)]; depth % 2 == 1) {
        const auto hole = loops.loop(l);
        add_mesh(*fringe, surroundings({hole.begin(), hole.end()}, loops, around, depth + 1), mesh,
                 boundary);
      }
    remove_bridges(*fringe, mesh);
  } catch (const Error&) {
    return nullptr;  // such a boundary has no mesh around it
  }
  remove_empty(*fringe, picture);
  return keep_going() ? fringe : nullptr;
}

}  // namespace holomorph
