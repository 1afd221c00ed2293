// The Python module: scenes, their maps and inverses, coordinates and pictures.
//
// Points are complex numbers. Results are NumPy arrays that own the memory of the library's
// matrices, so most are not copied. Long work runs without Python's lock, so that other threads of
// Python run meanwhile.
#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <optional>
#include <thread>

#include "core/angles/hilbert.h"
#include "core/cauchy/cauchy.h"
#include "core/geometry/orientation.h"
#include "core/methods/real_coordinates.h"
#include "raster/picture.h"
#include "scene/budget.h"
#include "scene/check_scene.h"
#include "scene/formats/scene_json.h"
#include "scene/keyframes.h"
#include "scene/loading.h"
#include "scene/report.h"
#include "scene/with_method.h"
#include "system/new_file.h"

namespace py = pybind11;

namespace holomorph {
namespace {

/// Points from an array of any shape. Real arrays without x and y are refused: [1, 2, 3] would
/// silently be points on the real axis.
struct PointArray {
  Points points;
  std::vector<py::ssize_t> shape;
};

/// An array that owns `values`, of this shape and with these strides in numbers.
template <class Values>
py::array array_of(Values values, const std::vector<py::ssize_t>& shape,
                   std::vector<py::ssize_t> strides = {}) {
  using Number = std::remove_cvref_t<decltype(*values.data())>;
  auto* const kept = new Values(std::move(values));
  const py::capsule owner(kept, [](void* memory) { delete static_cast<Values*>(memory); });
  for (py::ssize_t& stride : strides) stride *= static_cast<py::ssize_t>(sizeof(Number));
  if (strides.empty()) return py::array_t<Number>(shape, kept->data(), owner);
  return py::array_t<Number>(shape, strides, kept->data(), owner);
}

template <class Matrix>
py::array matrix_array(Matrix matrix) {
  const py::ssize_t rows = matrix.rows(), columns = matrix.cols();
  return array_of(std::move(matrix), {rows, columns}, {1, rows});
}

py::array vector_array(Points points) {
  const auto count = static_cast<py::ssize_t>(points.size());
  return array_of(std::move(points), {count});
}

/// Lets Python handle an interrupt, which throws KeyboardInterrupt. Without Python's lock.
void handle_interrupts() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

Points controls(const Cage& cage) {
  const VectorXc all = controls_of(cage);
  return {all.begin(), all.end()};
}

/// Divides a loop of control points into segments of one degree.
void add_loop(Cage& cage, const Points& loop, int degree) {
  if (degree < 1 || loop.size() % static_cast<size_t>(degree) != 0)
    throw Error(ErrorKind::bad_input, "a loop of segments of degree " + std::to_string(degree) +
                                          " needs a multiple of as many control points, not " +
                                          std::to_string(loop.size()));
  for (auto first = loop.begin(); first != loop.end(); first += degree)
    cage.segments.emplace_back(first, first + degree);
}

/// Holes belong to the part that contains them.
Cage cage_of(const PointArray& outer, const std::vector<PointArray>& holes, int degree,
             const std::vector<PointArray>& parts = {}) {
  const auto loop_of = [degree](const PointArray& loop) {
    Cage cage;
    add_loop(cage, loop.points, degree);
    return cage;
  };
  Cage cage = loop_of(outer);
  for (const PointArray& part : parts) add_part(cage, loop_of(part));
  const PartFinder finder(cage);
  for (const PointArray& hole : holes) {
    const Cage loop = loop_of(hole);
    add_hole(cage, loop.segments, loop.size() > 0 ? finder.at(loop.vertex(0)) : 0);
  }
  check_rest_cage(cage);
  return cage;
}

/// A mutex that knows which thread holds it.
struct TurnMutex {
  std::mutex mutex;
  std::atomic<std::thread::id> owner;
};

/// Lets one thread at a time work. A thread that waits for its turn, or works, does not hold
/// Python's lock; otherwise, two threads could wait for each other. Throws Error if the thread has
/// its turn already, which happens in signal handlers that use the scene at work.
class Turn {
 public:
  explicit Turn(TurnMutex& mutex) : mutex_(mutex) {
    if (mutex.owner == std::this_thread::get_id())
      throw Error(ErrorKind::bad_input,
                  "the scene is at work; a signal handler cannot use it until that is done");
    mutex.mutex.lock();
    mutex.owner = std::this_thread::get_id();
  }
  ~Turn() {
    mutex_.owner = std::thread::id();
    mutex_.mutex.unlock();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  py::gil_scoped_release unlocked_;
  TurnMutex& mutex_;
};

/// What is proved about a map.
struct Proof {
  std::string status, note;
  std::optional<Extremes> extremes;
};

/// An edited scene with what was prepared from it. Each call holds a lock, so threads may share it.
class PythonScene {
 public:
  explicit PythonScene(LoadedScene loaded)
      : scene_(std::move(loaded.scene)),
        pictures_(std::move(loaded.pictures)),
        warning_(loaded.message()) {}

  static std::unique_ptr<PythonScene> load(const std::filesystem::path& path, bool outside) {
    const py::gil_scoped_release unlocked;
    return std::make_unique<PythonScene>(load_scene(path, {false, {outside}}));
  }
  static std::unique_ptr<PythonScene> make(const std::optional<std::filesystem::path>& picture) {
    const py::gil_scoped_release unlocked;
    return std::make_unique<PythonScene>(picture ? scene_of_image(absolute_path(*picture))
                                                 : LoadedScene{});
  }
  void save(const std::filesystem::path& path) {
    const Turn turn(mutex_);
    const Path target = absolute_path(path);
    check_may_write(target, sources_of(scene_, {}));
    write_file(target, json_of(portable(scene_, target.parent_path())));
  }

  /// A copy of the edited layer's deformation.
  Deformation deformation() const {
    const Turn turn(mutex_);
    return scene_.deformation();
  }
  Scene scene() const {
    const Turn turn(mutex_);
    return scene_;
  }
  const std::string& warning() const { return warning_; }

  /// Replaces the scene by an edited one. Throws Error, and changes nothing, if a scene file could
  /// not contain it.
  template <class Edit>
  void edit_scene(const Edit& edit) {
    const Turn turn(mutex_);
    Scene edited = scene_;
    edit(edited);
    const size_t layer = edited.edited;
    check_scene(edited);
    edited = scene_from_json(json_of(edited), "scene");
    edited.edited = layer;
    scene_ = std::move(edited);
    timed_.reset();
    maker_.reset();
  }
  template <class Edit>
  void edit(const Edit& edit) {
    edit_scene([&](Scene& scene) {
      Deformation deformation = scene.deformation();
      edit(deformation);
      scene = with_deformation(std::move(scene), std::move(deformation));
    });
  }

  SampledMap map(const Points& points, std::optional<double> time) {
    const Turn turn(mutex_);
    TimedMap& map = timed();
    return map.values_in_cage(map.frame(time), points, handle_interrupts);
  }

  std::vector<std::vector<Preimage>> preimages(const Points& points, std::optional<double> time) {
    const Turn turn(mutex_);
    TimedMap& map = timed();
    const auto inverse = map.inverse(map.frame(time));
    if (!inverse)
      throw Error(ErrorKind::bad_input,
                  "method '" + scene_.deformation().method + "' has no inverse");
    return inverse->at(points, [](size_t) { handle_interrupts(); });
  }

  SceneReport report(std::optional<double> time) {
    const Turn turn(mutex_);
    TimedMap& map = timed();
    SceneReport report = report_of(map, map.frame(time));
    report.time = time;
    return report;
  }

  RasterResult picture(const PictureOptions& options) {
    const Turn turn(mutex_);
    if (!maker_)
      maker_ = std::make_unique<PictureMaker>(scene_, pictures_.of(scene_.layer()), pictures_);
    return maker_->picture(options);
  }

  /// The mesh, and where its vertices go.
  std::pair<Mesh, VectorXc> mesh(std::optional<double> time) {
    const Turn turn(mutex_);
    TimedMap& map = timed();
    return {map.mesh(), map.on_mesh(map.frame(time)).f};
  }

 private:
  TimedMap& timed() {
    if (!scene_.deformation().has_cage())
      throw Error(ErrorKind::bad_input, "the scene has no cage yet; use set_cage");
    if (!timed_) timed_ = std::make_unique<TimedMap>(scene_);
    return *timed_;
  }

  mutable TurnMutex mutex_;
  Scene scene_;
  Pictures pictures_;
  std::string warning_;
  std::unique_ptr<TimedMap> timed_;      ///< null until needed after an edit
  std::unique_ptr<PictureMaker> maker_;  ///< the same
};

/// Coordinates by name; real ones are returned as real matrices.
py::array coordinates(const PointArray& cage_points, const PointArray& points,
                      const std::string& kind, int order, int degree,
                      const std::vector<PointArray>& holes) {
  const Cage cage = cage_of(cage_points, holes, degree);
  if (kind == "cauchy") {
    if (order < 0 || order > 12)
      throw Error(ErrorKind::bad_input, "Cauchy coordinates have order 0 to 12");
    MatrixXc values;
    {
      const py::gil_scoped_release unlocked;
      values = cauchy_coordinates(cage, points.points, order);
    }
    return matrix_array(std::move(values));
  }
  if (order != 0 && order != 1)
    throw Error(ErrorKind::bad_input, "these coordinates have order 0 or 1");
  const Orientation orientation(cage);
  if (kind == "hilbert") {
    if (!orientation.is_oriented() || cage.loops().count() > 1)
      throw Error(ErrorKind::bad_input,
                  "Hilbert coordinates need a counter-clockwise cage without holes");
    std::vector<Index> corners;
    for (Index j = 0; j < cage.size(); ++j) corners.push_back(j);
    MatrixXc values;
    {
      const py::gil_scoped_release unlocked;
      values = HilbertCoordinates(cage, corner_values(cage, corners)).at(points.points, order);
    }
    return matrix_array(std::move(values));
  }
  if (kind != "mean_value" && kind != "harmonic")
    throw Error(ErrorKind::bad_input, "there are no coordinates '" + kind +
                                          "'; the kinds are cauchy, mean_value, harmonic and "
                                          "hilbert");
  const std::vector<Index> columns = orientation.columns(cage);
  MatrixXd values;
  MatrixXc slopes;
  {
    const py::gil_scoped_release unlocked;
    const Cage turned = orientation.turned(cage);
    const auto made =
        kind == "harmonic" ? harmonic_coordinates(turned) : mean_value_coordinates(turned);
    if (order == 0)
      values = made->values(points.points)(kAll, columns);
    else
      slopes = made->slopes(points.points)(kAll, columns);
  }
  if (order == 0) return matrix_array(std::move(values));
  return matrix_array(std::move(slopes));
}

void set_limit(const std::string& name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    throw Error(ErrorKind::bad_input, "a limit is a number above 0");
  Budget limits = budget();
  std::string names;
  for (const BudgetOption& option : budget_options()) {
    const std::string known = std::string(option.name).substr(2);
    if (known == name) {
      limits.*option.limit = value * option.per_unit;
      return set_budget(limits);
    }
    names += (names.empty() ? "" : ", ") + known;
  }
  throw Error(ErrorKind::bad_input, "there is no limit '" + name + "'; the limits are " + names);
}

}  // namespace
}  // namespace holomorph

namespace pybind11::detail {

/// Accepts arrays of complex numbers, and of real numbers whose last axis holds x and y.
template <>
struct type_caster<holomorph::PointArray> {
  PYBIND11_TYPE_CASTER(holomorph::PointArray, const_name("numpy.typing.ArrayLike"));

  bool load(handle source, bool) {
    const array given = array::ensure(source);
    if (!given) {
      PyErr_Clear();
      return false;
    }
    const bool is_complex = given.dtype().kind() == 'c';
    const bool is_pairs = !is_complex && given.ndim() > 0 && given.shape(given.ndim() - 1) == 2 &&
                          std::string("fiu").find(given.dtype().kind()) != std::string::npos;
    const bool is_empty_list = given.ndim() == 1 && given.size() == 0;
    if (!is_complex && !is_pairs && !is_empty_list) return false;
    const ssize_t axes = given.ndim() - is_pairs;
    value.shape.assign(given.shape(), given.shape() + axes);
    const auto copy = [&](const auto* numbers, ssize_t count) {
      const auto* const first = reinterpret_cast<const std::complex<double>*>(numbers);
      value.points.assign(first, first + count);
    };
    if (is_complex) {
      const auto plain = array_t<std::complex<double>, array::c_style | array::forcecast>(given);
      copy(plain.data(), plain.size());
    } else {
      const auto plain = array_t<double, array::c_style | array::forcecast>(given);
      copy(plain.data(), plain.size() / 2);
    }
    return true;
  }
};

}  // namespace pybind11::detail

namespace holomorph {
namespace {

using Time = std::optional<double>;

void add_errors(py::module_& module) {
  static PyObject *error, *invalid;
  error = PyErr_NewExceptionWithDoc("holomorph.Error", "The work failed, or the input is unusable.",
                                    nullptr, nullptr);
  const py::tuple bases = py::make_tuple(py::handle(error), py::handle(PyExc_ValueError));
  invalid = PyErr_NewExceptionWithDoc("holomorph.InvalidInput",
                                      "The input cannot be used. The message says what to change.",
                                      bases.ptr(), nullptr);
  module.attr("Error") = py::handle(error);
  module.attr("InvalidInput") = py::handle(invalid);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& e) {
      PyErr_SetString(e.kind() == ErrorKind::bad_input ? invalid : error, e.what());
    }
  });
}

void add_pin(py::module_& module) {
  py::class_<Pin>(module, "Pin", "A point of the picture, and where it goes.")
      .def(py::init([](Complex position, std::optional<Complex> target, std::optional<double> angle,
                       double scale) {
             Pin pin{position, target.value_or(position), angle, {}, scale};
             return pin;
           }),
           py::arg("position"), py::arg("target") = std::nullopt, py::arg("angle") = std::nullopt,
           py::arg("scale") = 1.0)
      .def_readwrite("position", &Pin::rest, "Where the pin is at rest.")
      .def_readwrite("target", &Pin::pose, "Where the pin is in the pose.")
      .def_readwrite("angle", &Pin::angle,
                     "Radians by which the picture turns around the pin, or None if it is free.")
      .def_readwrite("scale", &Pin::scale, "The picture's scale at the pin, if it has an angle.")
      .def_readwrite("depth", &Pin::depth,
                     "The picture near pins with greater depth is drawn on top.");
}

void add_proof(py::module_& module) {
  py::class_<Proof>(module, "Certificate", "What is proved about a map.")
      .def_property_readonly(
          "proved",
          [](const Proof& proof) { return proof.status == name_of(SampledMap::Status::certified); },
          "Whether it is proved that the map folds nowhere and stays within the extremes, if there "
          "are some.")
      .def_readonly("status", &Proof::status, "exact, iterating, certified or infeasible.")
      .def_readonly("note", &Proof::note, "Remarks of the method.")
      .def_property_readonly(
          "shear",
          [](const Proof& proof) {
            return proof.extremes ? proof.extremes->shear : std::optional<double>();
          },
          "An upper bound of abs(f_zbar / f_z), or None.")
      .def_property_readonly(
          "smallest",
          [](const Proof& proof) {
            return proof.extremes ? proof.extremes->smallest : std::optional<double>();
          },
          "A lower bound of all stretches, or None.")
      .def_property_readonly(
          "largest",
          [](const Proof& proof) {
            return proof.extremes ? proof.extremes->largest : std::optional<double>();
          },
          "An upper bound of all stretches, or None.");
}

/// The arrays of a mesh and of the positions of its vertices.
struct MeshArrays {
  py::array vertices, triangles, positions;
};

void add_mesh(py::module_& module) {
  py::class_<MeshArrays>(module, "Mesh", "A triangle mesh of the inside of a cage.")
      .def_readonly("vertices", &MeshArrays::vertices, "The vertices at rest, complex.")
      .def_readonly("triangles", &MeshArrays::triangles,
                    "Three vertex indices per row, counter-clockwise.")
      .def_readonly("positions", &MeshArrays::positions, "Where the vertices go, complex.");
}

/// Everything about a scene that is not its map.
void add_content(py::class_<PythonScene>& scene) {
  scene
      .def(py::init(&PythonScene::make), py::arg("picture") = std::nullopt,
           "A new scene, with a picture or without.")
      .def("save", &PythonScene::save, py::arg("path"),
           "Writes a scene file, as a whole or not at all.")
      .def_property_readonly("warning", &PythonScene::warning,
                             "What was unusual when the scene was read.")
      .def_property_readonly(
          "picture",
          [](const PythonScene& self) {
            const auto image = self.scene().layer().image;
            return image ? image->file : std::optional<std::string>();
          },
          "The file of the edited layer's picture, or None.")
      .def_property(
          "layer", [](const PythonScene& self) { return self.scene().edited; },
          [](PythonScene& self, size_t layer) {
            self.edit_scene([layer](Scene& edited) {
              if (layer >= edited.layers.size())
                throw Error(ErrorKind::bad_input,
                            "the scene has " + std::to_string(edited.layers.size()) + " layers");
              edited.edited = layer;
            });
          },
          "The number of the layer that everything else is about, from 0 at the bottom.")
      .def_property_readonly(
          "layer_names",
          [](const PythonScene& self) {
            std::vector<std::string> names;
            for (const SharedLayer& layer : self.scene().layers) names.push_back(layer->name);
            return names;
          },
          "The names of all layers, from the bottom to the top.")
      .def_property(
          "background",
          [](const PythonScene& self) -> std::string {
            const Background background = self.scene().background;
            if (background.fill == Background::Fill::transparent) return "transparent";
            if (background.fill == Background::Fill::original) return "original";
            char color[8];
            std::snprintf(color, sizeof color, "#%02x%02x%02x", background.color[0],
                          background.color[1], background.color[2]);
            return color;
          },
          [](PythonScene& self, const std::string& name) {
            Background background;
            unsigned color = 0;
            int end = 0;
            if (name == "original")
              background.fill = Background::Fill::original;
            else if (name.size() == 7 &&
                     std::all_of(
                         name.begin() + 1, name.end(),
                         [](char c) { return std::isxdigit(static_cast<unsigned char>(c)); }) &&
                     std::sscanf(name.c_str(), "#%6x%n", &color, &end) == 1 && end == 7)
              background = {
                  Background::Fill::color,
                  {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8),
                   static_cast<std::uint8_t>(color)}};
            else if (name != "transparent")
              throw Error(ErrorKind::bad_input, "'" + name +
                                                    "' is not a background; use transparent, "
                                                    "original or #rrggbb");
            self.edit_scene([&](Scene& scene) { scene.background = background; });
          },
          "What is behind the layers. It is transparent, original or a color #rrggbb. The original "
          "pictures fill gaps; they are the default for pictures without transparency.")
      .def_property(
          "method", [](const PythonScene& self) { return self.deformation().method; },
          [](PythonScene& self, const std::string& id) {
            self.edit([&](Deformation& deformation) {
              deformation = with_method(std::move(deformation), id);
            });
          },
          "The id of the method that makes the map; see methods().")
      .def_property(
          "parameters", [](const PythonScene& self) { return self.deformation().parameters; },
          [](PythonScene& self, const Parameters& parameters) {
            self.edit([&](Deformation& deformation) { deformation.parameters = parameters; });
          },
          "The parameters of the method that differ from the defaults.");
}

/// The handles: cage, pins and keyframes.
void add_handles(py::class_<PythonScene>& scene) {
  scene
      .def(
          "set_cage",
          [](PythonScene& self, const PointArray& points, int degree,
             const std::vector<PointArray>& holes, const std::vector<PointArray>& parts) {
            const Cage cage = cage_of(points, holes, degree, parts);
            self.edit([&](Deformation& deformation) {
              deformation = with_cage(std::move(deformation), cage);
              if (!cage.parts.empty() && !method_named(deformation.method).allows_parts)
                deformation =
                    with_method(std::move(deformation), usual_method(MethodUse::puppet).id);
            });
          },
          py::arg("points"), py::arg("degree") = 1, py::arg("holes") = py::list(),
          py::arg("parts") = py::list(),
          "Draws a new cage at rest. Segments of a degree above 1 are Bezier curves: each begins "
          "with a vertex, and degree - 1 control points follow. `parts` are further outlines of "
          "the picture; with them, the method becomes 'sheet' if it needs one outline.")
      .def_property_readonly(
          "cage",
          [](const PythonScene& self) { return vector_array(controls(self.deformation().rest)); },
          "The control points of the cage at rest, complex. A copy.")
      .def_property(
          "pose",
          [](const PythonScene& self) { return vector_array(controls(self.deformation().pose)); },
          [](PythonScene& self, const PointArray& points) {
            self.edit([&](Deformation& deformation) {
              const Index count = deformation.pose.control_count();
              if (static_cast<Index>(points.points.size()) != count)
                throw Error(ErrorKind::bad_input, "the cage has " + std::to_string(count) +
                                                      " control points, not " +
                                                      std::to_string(points.points.size()));
              size_t next = 0;
              for (Points& segment : deformation.pose.segments)
                for (Complex& z : segment) z = points.points[next++];
            });
          },
          "The control points of the posed cage, complex. A copy; assign to move them.")
      .def_property(
          "pins", [](const PythonScene& self) { return self.deformation().pins; },
          [](PythonScene& self, const std::vector<Pin>& pins) {
            self.edit([&](Deformation& deformation) { deformation.pins = pins; });
          },
          "A list of copies of the pins; assign a list to change them.")
      .def_property_readonly(
          "keys",
          [](const PythonScene& self) {
            std::vector<double> times;
            for (const Keyframe& key : self.deformation().keyframes) times.push_back(key.time);
            return times;
          },
          "The times of the keyframes, in seconds.")
      .def(
          "set_key",
          [](PythonScene& self, double time) {
            self.edit([&](Deformation& deformation) {
              deformation = with_key(std::move(deformation), time);
            });
          },
          py::arg("time"), "Keeps the present pose as the keyframe at a time.")
      .def(
          "remove_key",
          [](PythonScene& self, double time) {
            self.edit([&](Deformation& deformation) {
              const size_t key = key_at(deformation, time);
              if (key == deformation.keyframes.size())
                throw Error(ErrorKind::bad_input, "there is no keyframe at this time");
              deformation = without_key(std::move(deformation), key);
            });
          },
          py::arg("time"), "Removes the keyframe at a time.");
}

/// The map, in the pose or at a time.
void add_map(py::class_<PythonScene>& scene) {
  scene
      .def(
          "map",
          [](PythonScene& self, const PointArray& points, Time time) {
            return array_of(self.map(points.points, time).f, points.shape);
          },
          py::arg("points"), py::arg("time") = std::nullopt,
          "Where points of the picture go, complex; NaN outside of the cage.")
      .def(
          "derivatives",
          [](PythonScene& self, const PointArray& points, Time time) {
            SampledMap map = self.map(points.points, time);
            return py::make_tuple(array_of(std::move(map.fz), points.shape),
                                  array_of(std::move(map.fzbar), points.shape));
          },
          py::arg("points"), py::arg("time") = std::nullopt,
          "The complex derivatives f_z and f_zbar of the map.")
      .def(
          "jacobians",
          [](PythonScene& self, const PointArray& points, Time time) {
            const SampledMap map = self.map(points.points, time);
            std::vector<double> jacobians;
            jacobians.reserve(4 * points.points.size());
            for (Index i = 0; i < map.fz.size(); ++i) {
              const Complex fz = map.fz[i], fzbar = map.fzbar[i];
              const Complex x = fz + fzbar, y = kI * (fz - fzbar);
              jacobians.insert(jacobians.end(), {x.real(), y.real(), x.imag(), y.imag()});
            }
            std::vector<py::ssize_t> shape = points.shape;
            shape.insert(shape.end(), {2, 2});
            return array_of(std::move(jacobians), shape);
          },
          py::arg("points"), py::arg("time") = std::nullopt,
          "The matrices of first derivatives, in the last two axes.")
      .def(
          "inverse",
          [](PythonScene& self, const PointArray& points, Time time) {
            Points topmost;
            for (const auto& found : self.preimages(points.points, time))
              topmost.push_back(found.empty() ? Complex(NAN, NAN) : found.front().z);
            return array_of(std::move(topmost), points.shape);
          },
          py::arg("points"), py::arg("time") = std::nullopt,
          "The point of the picture that is mapped to each point: the topmost one, or NaN.")
      .def(
          "preimages",
          [](PythonScene& self, const PointArray& points, Time time) {
            py::list all;
            for (const auto& found : self.preimages(points.points, time)) {
              Points some;
              for (const Preimage& preimage : found) some.push_back(preimage.z);
              all.append(vector_array(std::move(some)));
            }
            return all;
          },
          py::arg("points"), py::arg("time") = std::nullopt,
          "All points of the picture that come to each point, the topmost first.")
      .def(
          "certificate",
          [](PythonScene& self, Time time) {
            const SceneReport report = self.report(time);
            return Proof{report.status, report.note, report.proved};
          },
          py::arg("time") = std::nullopt, "What is proved about the map.")
      .def(
          "info",
          [](PythonScene& self, Time time) -> py::dict {
            const std::string json = json_of(std::vector<SceneReport>{self.report(time)});
            return py::module_::import("json").attr("loads")(json);
          },
          py::arg("time") = std::nullopt,
          "What the command `holomorph info --json` prints: folds, stretches and more.")
      .def(
          "mesh",
          [](PythonScene& self, Time time) {
            auto [mesh, f] = self.mesh(time);
            const py::ssize_t vertices = f.size(), count = std::ssize(mesh.triangles);
            std::vector<int> corners;
            for (const Triangle& t : mesh.triangles)
              corners.insert(corners.end(), t.begin(), t.end());
            return MeshArrays{vector_array(std::move(mesh.vertices)),
                              array_of(std::move(corners), {count, 3}),
                              array_of(std::move(f), {vertices})};
          },
          py::arg("time") = std::nullopt, "The mesh of the cage, and where its vertices go.")
      .def(
          "render",
          [](PythonScene& self, Time time, double scale, bool crop,
             const std::optional<std::tuple<double, double, double, double>>& region,
             const std::string& view) {
            PictureOptions options;
            options.view = view_named(view);
            options.scale = scale;
            options.crop = crop;
            options.time = time;
            if (region) {
              const auto& [left, bottom, right, top] = *region;
              if (!(left < right) || !(bottom < top))
                throw Error(ErrorKind::bad_input,
                            "the region is empty; give left, bottom, right and top");
              options.region = Box{left, bottom, right, top};
            }
            Image image = self.picture(options).image;
            return array_of(std::move(image.pixels), {image.height, image.width, 4});
          },
          py::arg("time") = std::nullopt, py::arg("scale") = 1.0, py::arg("crop") = false,
          py::arg("region") = std::nullopt, py::arg("view") = "image",
          "The picture of the whole scene: rows x columns x (red, green, blue, alpha), 8 bits. It "
          "is enlarged to contain the deformed picture, unless it is cropped to the picture's own "
          "rectangle or to a "
          "region (left, bottom, right, top) of the plane.");
}

}  // namespace
}  // namespace holomorph

PYBIND11_MODULE(_core, module) {
  using namespace holomorph;
  module.doc() = "Deforms pictures by conformal, bounded-distortion and other maps.";
  module.attr("__version__") = HOLOMORPH_VERSION;
  add_errors(module);
  add_pin(module);
  add_proof(module);
  add_mesh(module);
  py::class_<PythonScene> scene(
      module, "Scene",
      "A scene: its layers with their pictures, cages, pins and keyframes. Points are complex "
      "numbers in the picture's pixels, with y upward. They may also be given as real arrays whose "
      "last axis holds x and y.");
  add_content(scene);
  add_handles(scene);
  add_map(scene);
  module.def(
      "coordinates", &coordinates, py::arg("cage"), py::arg("points"), py::arg("kind") = "cauchy",
      py::arg("order") = 0, py::arg("degree") = 1, py::arg("holes") = py::list(),
      "Coordinates of points in a cage: points x control points. The kinds are cauchy "
      "(complex), mean_value and harmonic (real), and hilbert (complex, two per vertex). "
      "Order 1 gives the complex derivatives, and for real coordinates h the numbers h_x - i h_y; "
      "cauchy has orders up to 12. The control points are in the order of the cage, then of "
      "the holes. Outside of the cage, hilbert coordinates have no meaning.");
  module.def("load", &PythonScene::load, py::arg("path"), py::arg("allow_outside") = false,
             "Reads a scene file and its pictures. Pictures outside of the scene's folder are read "
             "only if that is allowed.");
  module.def(
      "methods",
      [] {
        std::vector<std::string> ids;
        for (const Method& method : methods()) ids.push_back(method.id);
        return ids;
      },
      "The ids of all methods.");
  module.def("set_limit", &set_limit, py::arg("name"), py::arg("value"),
             "Sets a limit on what files may cost. set_limit(\"max-pixels\", 300) does what the "
             "program's option --max-pixels 300 does.");
}
