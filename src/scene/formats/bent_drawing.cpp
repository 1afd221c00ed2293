// First, the elements are copied, and the curves that must be bent are collected. Then the map is
// evaluated for all of them together, and the paths are written into the copies.
//
// A frame is where the user units of a copied element lie in the result. Elements with strokes,
// gradients or filters have frames of their own, which are written as their transforms.
#include "scene/formats/bent_drawing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/geometry/curve.h"
#include "scene/formats/path_writer.h"
#include "scene/formats/svg_document.h"
#include "scene/formats/svg_styles.h"

namespace holomorph {
namespace {

constexpr size_t kMostElements = 1'000'000;
constexpr int kDeepestUse = 32;

/// The average of derivatives that preserves orientation: rotations and stretches are averaged
/// separately, so that a stroke that is bent into a circle keeps its width.
Affine average(const std::vector<PointMap::Value>& values, const Points& points) {
  Complex rotation = 0, at = 0, image = 0, anti = 0;
  double linear = 0;
  size_t count = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const auto& [f, fz, fzbar] = values[i];
    if (!is_finite(f) || !is_finite(fz) || !is_finite(fzbar) || !(std::abs(fz) > 0)) continue;
    const Complex direction = fz / std::abs(fz);
    rotation += direction;
    linear += std::abs(fz);
    anti += std::conj(direction) * fzbar;
    at += points[i];
    image += f;
    ++count;
  }
  if (count == 0) return {};
  const double n = static_cast<double>(count);
  Affine map{linear / n, anti / n, 0};
  if (!(std::abs(map.anti) < 0.99 * linear / n)) map.anti = 0;  // the map folds
  const Complex direction = std::abs(rotation) > 0 ? rotation / std::abs(rotation) : 1;
  map.linear *= direction;
  map.anti *= direction;
  map.shift = image / n - map.direction(at / n);
  return map;
}

/// Whether an affine map misses the values of another map by a tenth of their extent, on average.
bool misses(const Affine& map, const Points& points, std::span<const PointMap::Value> values) {
  constexpr double kVisible = 0.1;
  Complex center = 0;
  for (const PointMap::Value& value : values) center += value.f / double(values.size());
  double off = 0, extent = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    off += std::norm(map(points[i]) - values[i].f);
    extent += std::norm(values[i].f - center);
  }
  return off > kVisible * kVisible * extent;
}

/// Whether a path encloses some area if its subpaths are closed.
bool has_area(const std::vector<Subpath>& path) {
  return std::ranges::any_of(path, [](const Subpath& subpath) {
    Complex along = 0;
    double width = 0, length = 0;
    for (const Points& segment : subpath.segments)
      for (const Complex& z : segment)
        if (std::abs(z - subpath.start) > length) {
          along = z - subpath.start;
          length = std::abs(along);
        }
    for (const Points& segment : subpath.segments)
      for (const Complex& z : segment)
        width = std::max(width, std::abs(cross(along, z - subpath.start)));
    return width > 1e-9 * length * length;
  });
}

class Bender {
 public:
  Bender(const std::string& svg, const std::string& name, const PointValues& map,
         const BendingOptions& options)
      : drawing_(svg_document_of(svg, name)), options_(options), map_(map) {
    collect_ids(drawing_.root());
  }

  BentDrawing bent() {
    const pugi::xml_node root = drawing_.root();
    group_ = result_.append_child("g");
    for (const pugi::xml_attribute& attribute : root.attributes())
      if (std::string(attribute.name()).starts_with("xmlns:")) group_.append_copy(attribute);
    for (const char* inherited :
         {"style", "fill", "stroke", "stroke-width", "font-family", "font-size"})
      if (const auto attribute = root.attribute(inherited)) group_.append_copy(attribute);
    definitions_ = group_.append_child("defs");
    frames_.push_back({});  // the result's own
    add_children(root, group_, {drawing_.placement, 0, drawing_.viewport, false, 0});
    place_frames();
    write_paths();
    write_transforms();
    if (!definitions_.first_child()) group_.remove_child(definitions_);
    if (!options_.prefix.empty()) prefix_ids(group_);
    std::ostringstream text;
    group_.print(text, "", pugi::format_raw);
    if (drawing_.ignores_rules) losses_.insert("some of its style rules are ignored");
    return {text.str(),       drawing_.width, drawing_.height,
            drawing_.columns, drawing_.rows,  {losses_.begin(), losses_.end()}};
  }

 private:
  /// Where an element is copied to.
  struct Place {
    Affine to_picture;  ///< from its parent's user units to the picture's pixels, y down
    size_t frame = 0;   ///< of the copied parent
    Viewport viewport;
    bool clips = false;  ///< it is part of a clipping path, where there are no strokes
    int uses = 0;        ///< levels of `use`
  };

  struct Frame {
    size_t parent = 0;
    pugi::xml_node node = {};  ///< gets the transform
    Affine to_picture = {};    ///< from its user units
    Points samples = {};       ///< points of the picture, y down, at which the map is averaged
    Affine placement = {};     ///< from its user units to the result
  };

  /// A copied shape: some of the curves.
  struct Shape {
    pugi::xml_node node;
    size_t frame = 0;
    std::vector<Subpath> path;  ///< without points; only numbers of segments, and closings
    size_t first_curve = 0;
  };

  void collect_ids(const pugi::xml_node& node) {
    if (const auto id = node.attribute("id")) by_id_.emplace(id.as_string(), node);
    for (const pugi::xml_node& child : node.children()) collect_ids(child);
  }
  pugi::xml_node element(const std::string& id) const {
    const auto found = by_id_.find(id);
    return found == by_id_.end() ? pugi::xml_node() : found->second;
  }

  void count_element() {
    if (++elements_ > kMostElements)
      throw Error(
          ErrorKind::bad_input,
          drawing_.name + ": with all copies, the drawing has more than a million elements");
  }

  void add_children(const pugi::xml_node& from, pugi::xml_node to, const Place& place) {
    for (const pugi::xml_node& child : from.children()) add(child, to, place);
  }

  void add(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    if (node.type() != pugi::node_element) {
      if (node.type() == pugi::node_pcdata) to.append_copy(node);
      return;
    }
    count_element();
    const std::string kind = local_name(node);
    static const std::set<std::string> kDropped{"script", "clipPath",  "mask",
                                                "symbol", "namedview", "foreignObject"};
    if (kDropped.contains(kind)) {
      if (kind == "foreignObject") losses_.insert("its embedded pages are left out");
      return;
    }
    if (kind.starts_with("animate") || kind == "set") {
      losses_.insert("its animation is left out");
      return;
    }
    if (kind == "defs") return add_definitions(node, to);
    if (kind == "use") return add_use(node, to, place);
    if (kind == "svg") return add_viewport(node, to, place, {});
    if (kind == "switch") return add_switch(node, to, place);
    if (is_shape(node)) return add_shape(node, to, place);
    if (kind == "g" || kind == "a") {
      const auto [copy, inside] = add_group(node, to, place);
      return add_children(node, copy, inside);
    }
    if (kind == "text" || kind == "image") return add_whole(node, to, place);
    strip(to.append_copy(node));  // gradients, titles, metadata and such
  }

  /// Definitions stay as they are, except those that are bent with what refers to them.
  void add_definitions(const pugi::xml_node& node, pugi::xml_node to) {
    pugi::xml_node copy = to.append_copy(node);
    std::vector<pugi::xml_node> bent;
    for (const pugi::xml_node& child : copy.children())
      if (local_name(child) == "clipPath" || local_name(child) == "mask") bent.push_back(child);
    for (const pugi::xml_node& child : bent) copy.remove_child(child);
    strip(copy);
  }

  /// Removes what could run or change the drawing.
  static void strip(pugi::xml_node node) {
    std::vector<pugi::xml_node> scripts;
    for (pugi::xml_node child : node.children()) {
      const std::string kind = local_name(child);
      if (kind == "script" || kind.starts_with("animate"))
        scripts.push_back(child);
      else
        strip(child);
    }
    for (const pugi::xml_node& child : scripts) node.remove_child(child);
    strip_attributes(node);
  }
  static void strip_attributes(pugi::xml_node node) {
    std::vector<std::string> removed;
    for (const pugi::xml_attribute& attribute : node.attributes())
      if (std::string(attribute.name()).starts_with("on")) removed.push_back(attribute.name());
    for (const std::string& name : removed) node.remove_attribute(name.c_str());
  }

  /// Copies an element without its children. What edits it as another kind of shape is left out.
  pugi::xml_node copy_of(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    pugi::xml_node copy = to.append_child(node.name());
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string name = attribute.name();
      const bool stays = !name.starts_with("sodipodi:") && name != "inkscape:path-effect" &&
                         name != "inkscape:original-d" && !name.starts_with("on") &&
                         name != "transform" && (name != "id" || place.uses == 0);
      if (stays) copy.append_copy(attribute);
    }
    if (!property_of(copy, "transform").empty()) set_property(copy, "transform", "");
    return copy;
  }

  Affine inside(const pugi::xml_node& node, const Place& place) const {
    return composed(place.to_picture, transform_of(node));
  }

  /// A frame for an element whose samples are added later.
  size_t new_frame(pugi::xml_node node, const Affine& to_picture, size_t parent) {
    frames_.push_back({parent, node, to_picture});
    return frames_.size() - 1;
  }
  /// Adds a sample to a frame and to those around it.
  void sample(size_t frame, Complex at) {
    for (; frame != 0; frame = frames_[frame].parent) frames_[frame].samples.push_back(at);
  }

  std::pair<pugi::xml_node, Place> add_group(const pugi::xml_node& node, pugi::xml_node to,
                                             const Place& place) {
    pugi::xml_node copy = copy_of(node, to, place);
    Place within = place;
    within.to_picture = inside(node, place);
    const std::string filter = property_of(node, "filter");
    if (!filter.empty() && filter != "none" && !place.clips)
      within.frame = new_frame(copy, within.to_picture, place.frame);
    bend_clipping(node, copy, within);
    return {copy, within};
  }

  void add_switch(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    pugi::xml_node group = copy_of(node, to, place);
    group.set_name("g");
    Place within = place;
    within.to_picture = inside(node, place);
    for (const pugi::xml_node& child : node.children())
      if (child.type() == pugi::node_element && local_name(child) != "foreignObject" &&
          !child.attribute("requiredExtensions"))
        return add(child, group, within);
  }

  /// An inner svg, or a symbol that is used with a size.
  void add_viewport(const pugi::xml_node& node, pugi::xml_node to, const Place& place,
                    const std::optional<Viewport>& used) {
    const auto length = [&](const char* name, double whole, double otherwise) {
      return length_of(node.attribute(name).as_string(), whole).value_or(otherwise);
    };
    const Viewport& outer = place.viewport;
    const bool is_symbol = local_name(node) == "symbol";
    const Complex corner =
        is_symbol ? 0 : Complex(length("x", outer.width, 0), length("y", outer.height, 0));
    const Viewport size = used.value_or(Viewport{length("width", outer.width, outer.width),
                                                 length("height", outer.height, outer.height)});
    pugi::xml_node copy = copy_of(node, to, place);
    for (const char* name :
         {"x", "y", "width", "height", "viewBox", "preserveAspectRatio", "version"})
      copy.remove_attribute(name);
    copy.set_name("g");
    const auto box = viewbox_of(node);
    Place within = place;
    within.to_picture = composed(inside(node, place), viewbox_map(node, corner, size));
    within.viewport = box ? Viewport{box->width(), box->height()} : size;
    add_children(node, copy, within);
  }

  void add_use(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    std::string target = node.attribute("href").as_string(node.attribute("xlink:href").as_string());
    const pugi::xml_node original =
        target.starts_with("#") ? element(target.substr(1)) : pugi::xml_node();
    if (!original || place.uses >= kDeepestUse) return;
    auto [copy, within] = add_group(node, to, place);
    copy.set_name("g");
    for (const char* name : {"x", "y", "width", "height", "href", "xlink:href"})
      copy.remove_attribute(name);
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole);
    };
    const Complex by{length("x", place.viewport.width).value_or(0),
                     length("y", place.viewport.height).value_or(0)};
    within.to_picture = composed(within.to_picture, {.shift = by});
    ++within.uses;
    const std::string kind = local_name(original);
    if (kind == "symbol" || kind == "svg") {
      const double width = length("width", place.viewport.width).value_or(place.viewport.width),
                   height = length("height", place.viewport.height).value_or(place.viewport.height);
      add_viewport(original, copy, within, Viewport{width, height});
    } else {
      add(original, copy, within);
    }
  }

  static bool has_stroke(const pugi::xml_node& node) {
    const std::string stroke = inherited_property(node, "stroke");
    return !stroke.empty() && stroke != "none";
  }
  static bool paints_gradient(const pugi::xml_node& node) {
    return inherited_property(node, "fill").starts_with("url(") ||
           inherited_property(node, "stroke").starts_with("url(");
  }
  /// Whether what is drawn on a shape depends on its user units.
  static bool depends_on_units(const pugi::xml_node& node) {
    const std::string filter = property_of(node, "filter");
    return has_stroke(node) || inherited_property(node, "fill").starts_with("url(") ||
           (!filter.empty() && filter != "none");
  }

  void add_shape(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    pugi::xml_node copy = copy_of(node, to, place);
    Place within = place;
    within.to_picture = inside(node, place);
    std::vector<Subpath> path = path_of_shape(node, place.viewport);
    // What fills and clips is closed in any case. It must be before it is bent.
    if (!has_area(path))
      set_property(copy, "fill", "none");
    else if (place.clips || !has_stroke(copy))
      for (Subpath& subpath : path) subpath.closed = true;
    if (!place.clips && depends_on_units(copy)) {
      within.frame = new_frame(copy, within.to_picture, place.frame);
      Box box;
      include(box, path);
      for (const char* paint : {"fill", "stroke"}) use_own_units(copy, paint, box);
      if (!inherited_property(copy, "marker-mid").empty() &&
          inherited_property(copy, "marker-mid") != "none")
        losses_.insert("the number of its markers may differ");
    }
    bend_clipping(node, copy, within);
    for (const pugi::xml_node& child : node.children())  // such as <title>
      if (child.type() == pugi::node_element) add(child, copy, within);
    add_curves(copy, path, within);
  }

  void add_curves(pugi::xml_node copy, const std::vector<Subpath>& path, const Place& place) {
    constexpr size_t kMostSamples = 64;
    Shape shape{copy, place.frame, {}, curves_.size()};
    Points all;
    for (const Subpath& subpath : path) {
      Subpath& kept = shape.path.emplace_back();
      kept.closed = subpath.closed;
      kept.start = place.to_picture(subpath.start);
      std::vector<Points> segments = subpath.segments;
      if (subpath.closed && subpath.end() != subpath.start)
        segments.push_back({subpath.end(), subpath.start});
      // A subpath that is only a point is kept as a line of length zero, which may have a cap.
      if (segments.empty()) segments.push_back({subpath.start, subpath.start});
      for (Points& segment : segments) {
        for (Complex& z : segment) z = place.to_picture(z);
        if (!std::ranges::all_of(segment, is_finite) || !std::ranges::all_of(segment, is_moderate))
          throw Error(ErrorKind::bad_input, drawing_.name + ": a shape is infinitely large");
        for (const double t : {0.0, 0.5}) all.push_back(bezier_point(segment, t));
        if (&segment == &segments.back()) all.push_back(segment.back());
        kept.segments.emplace_back();
        curves_.push_back(std::move(segment));
      }
    }
    const size_t step = all.size() / kMostSamples + 1;
    for (size_t i = 0; i < all.size(); i += step) sample(place.frame, all[i]);
    shapes_.push_back(std::move(shape));
  }

  /// Texts and pictures move as a whole.
  void add_whole(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    const bool is_text = local_name(node) == "text";
    losses_.insert(is_text ? "its texts are moved and turned, but not bent"
                           : "its embedded pictures are moved and turned, but not bent");
    Place within = place;
    within.to_picture = inside(node, place);
    pugi::xml_node copy = copy_of(node, to, place);
    for (const pugi::xml_node& child : node.children()) copy.append_copy(child);
    strip(copy);
    within.frame = new_frame(copy, within.to_picture, place.frame);
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole).value_or(0);
    };
    const double x = length("x", place.viewport.width), y = length("y", place.viewport.height);
    const double width = is_text ? 0 : length("width", place.viewport.width),
                 height = is_text ? 0 : length("height", place.viewport.height);
    for (const double u : {0.0, 0.5, 1.0})
      for (const double v : {0.0, 0.5, 1.0})
        sample(within.frame, within.to_picture(Complex(x + u * width, y + v * height)));
    bend_clipping(node, copy, within);
  }

  /// Gives an element copies of its clipping path and mask that are bent like the element.
  /// `within` is the place of what the element contains.
  void bend_clipping(const pugi::xml_node& node, pugi::xml_node copy, const Place& within) {
    for (const char* property : {"clip-path", "mask"}) {
      const std::string value = property_of(node, property);
      const pugi::xml_node original = element(id_in_url(value));
      const std::string kind = original ? local_name(original) : "";
      if (kind != "clipPath" && kind != "mask") continue;
      if (within.uses >= kDeepestUse) continue;
      count_element();
      const bool clips = kind == "clipPath";
      const std::string id = "bent-" + std::to_string(++made_ids_);
      pugi::xml_node bent = definitions_.append_child(kind.c_str());
      for (const pugi::xml_attribute& attribute : original.attributes())
        if (const std::string name = attribute.name();
            name != "id" && name != "transform" && name != "x" && name != "y" && name != "width" &&
            name != "height" && !name.ends_with("Units") && name != "clip-path" && name != "mask")
          bent.append_copy(attribute);
      bent.append_attribute("id").set_value(id.c_str());
      Place place = within;
      place.clips = clips;
      place.uses = within.uses + 1;
      const std::string units =
          original.attribute(clips ? "clipPathUnits" : "maskContentUnits").as_string();
      if (units == "objectBoundingBox") {
        const Box box = extent_of(node, within.viewport);
        if (!box.empty())
          place.to_picture =
              composed(place.to_picture,
                       affine_of_matrix(box.width(), 0, 0, box.height(), box.left, box.bottom));
      }
      place.to_picture = composed(place.to_picture, transform_of(original));
      if (!clips) masks_.emplace_back(bent, within.frame);
      bend_clipping(original, bent, place);
      add_children(original, bent, place);
      set_property(copy, property, "url(#" + id + ")");
    }
  }

  /// If a shape's paint is a gradient that refers to its bounding box, gives it a copy of the
  /// gradient in the shape's user units, because the bent shape has another box.
  void use_own_units(pugi::xml_node copy, const char* paint, const Box& box) {
    const pugi::xml_node gradient = element(id_in_url(inherited_property(copy, paint)));
    const std::string kind = gradient ? local_name(gradient) : "";
    if ((kind != "linearGradient" && kind != "radialGradient") || box.empty()) return;
    const auto attribute = [&](const std::string& name) {
      pugi::xml_node from = gradient;
      for (int k = 0; k < kDeepestUse && from; ++k) {
        if (from.attribute(name.c_str()))
          return std::string(from.attribute(name.c_str()).as_string());
        const std::string next =
            from.attribute("href").as_string(from.attribute("xlink:href").as_string());
        from = next.starts_with("#") ? element(next.substr(1)) : pugi::xml_node();
      }
      return std::string();
    };
    if (attribute("gradientUnits") == "userSpaceOnUse") return;
    const std::string id = "bent-" + std::to_string(++made_ids_);
    pugi::xml_node own = definitions_.append_child(kind.c_str());
    own.append_attribute("id").set_value(id.c_str());
    own.append_attribute("xlink:href")
        .set_value((std::string("#") + gradient.attribute("id").as_string()).c_str());
    own.append_attribute("gradientUnits").set_value("userSpaceOnUse");
    const Affine map =
        composed(affine_of_matrix(std::max(box.width(), 1e-9), 0, 0, std::max(box.height(), 1e-9),
                                  box.left, box.bottom),
                 transform_of(attribute("gradientTransform")));
    own.append_attribute("gradientTransform").set_value(matrix_text(map).c_str());
    const auto set = [&](const char* name, const std::string& otherwise) {
      const std::string text = attribute(name);
      const double x = length_of(text.empty() ? otherwise : text, 1).value_or(0);
      own.append_attribute(name).set_value(number_text(x).c_str());
    };
    if (kind == "linearGradient") {
      for (const char* name : {"x1", "y1", "y2"}) set(name, "0");
      set("x2", "1");
    } else {
      for (const char* name : {"cx", "cy", "r"}) set(name, "0.5");
      for (const auto& [name, otherwise] : {std::pair{"fx", "cx"}, {"fy", "cy"}})
        set(name, attribute(otherwise).empty() ? "0.5" : attribute(otherwise));
    }
    set_property(copy, paint, "url(#" + id + ")");
  }

  /// The map of points of the picture with y down to the result.
  std::vector<PointMap::Value> values_at(std::span<const Complex> points) const {
    Points upright;
    for (const Complex& p : points) upright.push_back(std::conj(p) + Complex(0, drawing_.rows));
    std::vector<PointMap::Value> values = map_(upright);
    for (PointMap::Value& value : values)
      value = {std::conj(value.f - options_.upper_left), std::conj(value.fz),
               std::conj(value.fzbar)};
    return values;
  }

  void place_frames() {
    Points all;
    for (const Frame& frame : frames_)
      all.insert(all.end(), frame.samples.begin(), frame.samples.end());
    const std::vector<PointMap::Value> values =
        all.empty() ? std::vector<PointMap::Value>() : values_at(all);
    auto at = values.begin();
    for (size_t i = 1; i < frames_.size(); ++i) {
      Frame& frame = frames_[i];
      const auto end = at + static_cast<long>(frame.samples.size());
      const Affine map = average({at, end}, frame.samples);
      frame.placement = composed(map, frame.to_picture);
      if (paints_gradient(frame.node) && misses(map, frame.samples, {at, end}))
        losses_.insert("some gradients are moved and turned, but not bent");
      at = end;
      if (!(std::abs(frame.placement.determinant()) > 1e-18))
        frame.placement = frames_[frame.parent].placement;
    }
  }

  void write_paths() {
    constexpr double kFlat = 0.2, kPrecision = 0.02;  // in tolerances
    const double tolerance = options_.tolerance;
    const auto values = [this](std::span<const Complex> points) { return values_at(points); };
    const auto images = curve_images(curves_, values, (1 - kFlat) * tolerance);
    for (Shape& shape : shapes_) {
      PathWriter writer(inverse(frames_[shape.frame].placement), kPrecision * tolerance);
      size_t curve = shape.first_curve;
      for (const Subpath& subpath : shape.path) {
        for (size_t k = 0; k < subpath.segments.size(); ++k, ++curve) {
          if (k == 0) writer.move(images[curve].front()[0]);
          for (const Points& cubic : images[curve]) writer.curve(cubic, kFlat * tolerance);
        }
        if (subpath.closed) writer.close();
      }
      become_path(shape.node, std::move(writer).text());
    }
  }

  void write_transforms() {
    for (size_t i = 1; i < frames_.size(); ++i) {
      Frame& frame = frames_[i];
      const Affine relative = composed(inverse(frames_[frame.parent].placement), frame.placement);
      if (relative != Affine{})
        frame.node.append_attribute("transform").set_value(matrix_text(relative).c_str());
    }
    // Masks must not cut off anything that they do not cut off at rest.
    for (auto& [mask, frame] : masks_) {
      const Affine to_frame = inverse(frames_[frame].placement);
      constexpr double kFar = 1e5;
      Box box;
      for (const Complex corner :
           {Complex(-kFar, -kFar), Complex(kFar, -kFar), Complex(kFar, kFar), Complex(-kFar, kFar)})
        box.include(to_frame(corner));
      mask.append_attribute("maskUnits").set_value("userSpaceOnUse");
      for (const auto& [name, x] : {std::pair{"x", box.left},
                                    {"y", box.bottom},
                                    {"width", box.width()},
                                    {"height", box.height()}})
        mask.append_attribute(name).set_value(number_text(x).c_str());
    }
  }

  void prefix_ids(pugi::xml_node node) const {
    for (pugi::xml_attribute attribute : node.attributes()) {
      const std::string name = attribute.name();
      std::string value = attribute.as_string();
      if (name == "id") {
        value = options_.prefix + value;
      } else if ((name == "href" || name == "xlink:href") && value.starts_with("#")) {
        value = "#" + options_.prefix + value.substr(1);
      } else {
        for (size_t at = 0; (at = value.find("url(", at)) != std::string::npos;) {
          at = value.find_first_not_of("\"' ", at + 4);
          if (at == std::string::npos) break;
          if (value[at] == '#') value.insert(at + 1, options_.prefix);
        }
      }
      if (value != attribute.as_string()) attribute.set_value(value.c_str());
    }
    for (const pugi::xml_node& child : node.children()) prefix_ids(child);
  }

  SvgDocument drawing_;
  BendingOptions options_;
  const PointValues& map_;
  std::map<std::string, pugi::xml_node> by_id_;
  pugi::xml_document result_;
  pugi::xml_node group_, definitions_;
  std::vector<Frame> frames_;  ///< parents come first
  std::vector<Shape> shapes_;
  std::vector<Points> curves_;  ///< in pixels of the picture, y down
  std::vector<std::pair<pugi::xml_node, size_t>> masks_;
  std::set<std::string> losses_;
  size_t elements_ = 0;
  int made_ids_ = 0;
};

}  // namespace

BentDrawing bent_drawing(const std::string& svg, const std::string& name, const PointValues& map,
                         const BendingOptions& options) {
  return Bender(svg, name, map, options).bent();
}

}  // namespace holomorph
