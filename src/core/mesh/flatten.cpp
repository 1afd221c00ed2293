// CGAL computes the flattening; this file rotates, scales and checks the result.
#include "core/mesh/flatten.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Circular_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_conformal_map_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/geometry/curve.h"

namespace holomorph {
namespace {

namespace SMP = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using Net = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Net::Vertex_index;

template <class Parameterizer>
Points parameterized(Net& net) {
  auto uv = net.add_property_map<Vertex, Kernel::Point_2>("v:uv").first;
  const auto border = CGAL::Polygon_mesh_processing::longest_border(net).first;
  const SMP::Error_code code = SMP::parameterize(net, Parameterizer(), border, uv);
  if (code != SMP::OK)
    throw Error(ErrorKind::failed,
                std::string("the surface could not be flattened: ") + SMP::get_error_message(code));
  Points flat;
  for (const Vertex v : net.vertices()) flat.push_back({uv[v].x(), uv[v].y()});
  return flat;
}

/// Catches the exceptions that CGAL throws when thin triangles break its invariants.
template <class Parameterizer>
Points parameterized_or_error(Net& net) {
  static const auto printing =  // the exception has the details
      CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
  static_cast<void>(printing);
  try {
    return parameterized<Parameterizer>(net);
  } catch (const CGAL::Failure_exception&) {
    throw Error(ErrorKind::bad_input,
                "the surface could not be flattened: some of its triangles are too thin");
  }
}

Eigen::Vector3d side(const Surface& surface, int a, int b) {
  return surface.vertices[static_cast<size_t>(b)] - surface.vertices[static_cast<size_t>(a)];
}

/// Throws Error if a triangle is degenerate.
void check_areas(const Surface& surface) {
  constexpr double kThinnest = 1e-12;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    const Eigen::Vector3d a = side(surface, t[0], t[1]), b = side(surface, t[0], t[2]);
    const double longest = std::max(a.squaredNorm(), b.squaredNorm());
    if (!(a.cross(b).norm() > kThinnest * longest))
      throw Error(ErrorKind::bad_input, "triangle " + std::to_string(i + 1) +
                                            " of the surface has no area; remove such triangles "
                                            "in the program that made it");
  }
}

/// The gradient of the surface's y as a function on the plane, integrated over the flattened
/// surface. Correct up to a factor.
Complex upwards(const Surface& surface, const Points& flat) {
  Complex sum = 0;
  for (const auto& t : surface.triangles)
    for (size_t k = 0; k < 3; ++k) {
      // y at a corner times the gradient of its hat function times twice the area.
      const Complex opposite =
          flat[static_cast<size_t>(t[(k + 2) % 3])] - flat[static_cast<size_t>(t[(k + 1) % 3])];
      sum += surface.vertices[static_cast<size_t>(t[k])].y() * kI * opposite;
    }
  return sum;
}

}  // namespace

std::string name_of(Flattening flattening) {
  return flattening == Flattening::circle ? "circle" : "lscm";
}

Flattening flattening_named(const std::string& name) {
  for (const Flattening flattening : {Flattening::lscm, Flattening::circle})
    if (name == name_of(flattening)) return flattening;
  throw Error(ErrorKind::bad_input,
              "flattening '" + name + "' does not exist; choose one of: lscm, circle");
}

Points flattened(const Surface& surface, Flattening how) {
  disk_boundary(surface);
  check_areas(surface);
  Net net;
  for (const Eigen::Vector3d& p : surface.vertices) net.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& t : surface.triangles)
    net.add_face(Vertex(static_cast<unsigned>(t[0])), Vertex(static_cast<unsigned>(t[1])),
                 Vertex(static_cast<unsigned>(t[2])));
  Points flat = how == Flattening::lscm
                    ? parameterized_or_error<SMP::LSCM_parameterizer_3<Net>>(net)
                    : parameterized_or_error<SMP::Discrete_conformal_map_parameterizer_3<
                          Net, SMP::Circular_border_arc_length_parameterizer_3<Net>>>(net);
  double area = 0, flat_area = 0;
  for (const auto& t : surface.triangles) {
    area += side(surface, t[0], t[1]).cross(side(surface, t[0], t[2])).norm();
    flat_area += cross(flat[static_cast<size_t>(t[1])] - flat[static_cast<size_t>(t[0])],
                       flat[static_cast<size_t>(t[2])] - flat[static_cast<size_t>(t[0])]);
  }
  if (flat_area < 0)
    for (Complex& z : flat) z = std::conj(z);
  if (!(std::abs(flat_area) > 0))
    throw Error(ErrorKind::bad_input, "the surface could not be flattened: the result has no area");
  const Complex up = upwards(surface, flat);
  const double scale = std::sqrt(area / std::abs(flat_area));
  const Complex turn = std::abs(up) > 1e-9 * area ? kI * std::abs(up) / up : Complex(1);
  for (Complex& z : flat) z *= scale * turn;
  const Box box = box_of(flat);
  for (Complex& z : flat) z -= Complex(box.left, box.bottom);
  for (const auto& t : surface.triangles)
    if (!(cross(flat[static_cast<size_t>(t[1])] - flat[static_cast<size_t>(t[0])],
                flat[static_cast<size_t>(t[2])] - flat[static_cast<size_t>(t[0])]) > 0))
      throw Error(ErrorKind::bad_input,
                  "the surface folds when it is flattened; cut it open where it is most curved");
  return flat;
}

}  // namespace holomorph
