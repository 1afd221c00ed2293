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
#include "scene/formats/svg_cleaning.h"
#include "scene/formats/svg_document.h"
#include "scene/formats/svg_paint.h"
#include "scene/formats/svg_styles.h"

namespace holomorph {
namespace {

constexpr size_t kMostElements = 200'000, kMostCurves = 500'000;
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
    definitions_ = group_.append_child("defs");
    frames_.push_back({});  // the result's own
    add_root(root);
    cut_off_overhang();
    place_frames();
    write_paths();
    write_transforms();
    remove_unused_clipping(group_);
    if (!definitions_.first_child()) group_.remove_child(definitions_);
    if (!options_.prefix.empty()) prefix_ids(group_, options_.prefix);
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
    pugi::xml_node node = {};      ///< gets the transform
    Affine to_picture = {};        ///< from its user units
    Points samples = {};           ///< points of the picture, y down, at which the map is averaged
    Affine placement = {};         ///< from its user units to the result
    size_t offered = 0, step = 1;  ///< every step-th point that is offered becomes a sample
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
      throw Error(ErrorKind::bad_input,
                  drawing_.name + ": with all copies, the drawing has more than 200,000 elements");
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
    if (kind == "symbol" || !is_kept(node, losses_)) return;
    if (kind == "defs") return add_definitions(node, to);
    if (kind == "use") return add_use(node, to, place);
    if (kind == "svg") return add_viewport(node, to, place, {}, {});
    if (kind == "switch") return add_switch(node, to, place);
    if (is_shape(node)) return add_shape(node, to, place);
    if (kind == "g" || kind == "a") {
      const auto [copy, inside] = add_group(node, to, place);
      return add_children(node, copy, inside);
    }
    if (kind == "text" || kind == "image") return add_whole(node, to, place);
    add_definition(to.append_copy(node));  // gradients, titles and such
  }

  /// The root becomes a group within that of the drawing.
  void add_root(const pugi::xml_node& root) {
    // The root's own transform acts on its own size, before that becomes the size of the picture.
    const Affine enlarged{drawing_.columns / drawing_.width, 0, 0};
    const Affine own = composed(inverse(enlarged), drawing_.placement);
    add_viewport_content(root, group_, {enlarged, 0, drawing_.viewport, false, 0}, own,
                         drawing_.viewport);
  }

  /// Clips the drawing if it extends beyond its page, like the picture that stands for it.
  void cut_off_overhang() {
    constexpr double kSlack = 0.5;  // pixels
    const Box page{0, 0, double(drawing_.columns), double(drawing_.rows)};
    const bool overhangs = drawn_.left < page.left - kSlack ||
                           drawn_.bottom < page.bottom - kSlack ||
                           drawn_.right > page.right + kSlack || drawn_.top > page.top + kSlack;
    if (!drawn_.empty() && overhangs) clip(group_, page, {Affine{}, 0, drawing_.viewport, true, 0});
  }

  /// Clips a copied element by a rectangle in the user units of `place`.
  void clip(pugi::xml_node copy, const Box& box, const Place& place) {
    const std::string id = new_id();
    pugi::xml_node clip = definitions_.append_child("clipPath");
    clip.append_attribute("id").set_value(id.c_str());
    Subpath rectangle{Complex(box.left, box.bottom)};
    Complex from = rectangle.start;
    for (const Complex to : {Complex(box.right, box.bottom), Complex(box.right, box.top),
                             Complex(box.left, box.top)}) {
      rectangle.segments.push_back({from, to});
      from = to;
    }
    rectangle.closed = true;
    Place inside = place;
    inside.clips = true;
    add_curves(clip.append_child("path"), {rectangle}, inside);
    set_property(copy, "clip-path", "url(#" + id + ")");
  }

  std::string new_id() {
    std::string id;
    do id = "bent-" + std::to_string(++made_ids_);
    while (by_id_.contains(id));
    return id;
  }

  /// Definitions stay as they are. Those that are bent are copied by what refers to them.
  void add_definitions(const pugi::xml_node& node, pugi::xml_node to) {
    add_definition(to.append_copy(node));
  }
  void add_definition(pugi::xml_node copy) {
    clean(copy, losses_);
    const auto resolve = [&](const auto& self, pugi::xml_node node) -> void {
      resolve_percentages(node, drawing_.viewport);
      for (const pugi::xml_node& child : node.children()) self(self, child);
    };
    resolve(resolve, copy);
  }

  /// Copies an element without its children. What edits it as another kind of shape is left out.
  pugi::xml_node copy_of(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    pugi::xml_node copy = to.append_child(node.name());
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string name = attribute.name();
      const bool stays = !name.starts_with("sodipodi:") && name != "inkscape:path-effect" &&
                         name != "inkscape:original-d" && name != "transform" && name != "xmlns" &&
                         (name != "id" || place.uses == 0);
      if (stays) copy.append_copy(attribute);
    }
    clean_attributes(copy, losses_);
    resolve_percentages(copy, place.viewport);
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
  /// Offers a sample to a frame and to those around it.
  void sample(size_t frame, Complex at) {
    constexpr size_t kMostSamples = 1024;
    for (; frame != 0; frame = frames_[frame].parent) {
      Frame& it = frames_[frame];
      if (it.offered++ % it.step != 0) continue;
      it.samples.push_back(at);
      if (it.samples.size() < kMostSamples) continue;
      for (size_t i = 0; 2 * i < it.samples.size(); ++i) it.samples[i] = it.samples[2 * i];
      it.samples.resize(kMostSamples / 2);
      it.step *= 2;
    }
  }

  /// Copies a group without its children. `viewbox` is what its own content is mapped by.
  std::pair<pugi::xml_node, Place> add_group(const pugi::xml_node& node, pugi::xml_node to,
                                             const Place& place, const Affine& viewbox = {}) {
    pugi::xml_node copy = copy_of(node, to, place);
    copy.set_name(local_name(node) == "a" ? "a" : "g");
    Place within = place;
    within.to_picture = composed(inside(node, place), viewbox);
    const std::string filter = property_of(node, "filter");
    if (!filter.empty() && filter != "none" && !place.clips)
      within.frame = new_frame(copy, within.to_picture, place.frame);
    bend_clipping(node, copy, within);
    return {copy, within};
  }

  /// Takes the first child that is not for other languages or programs. Texts in several languages
  /// end with one for all others.
  void add_switch(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    const auto [group, within] = add_group(node, to, place);
    for (const pugi::xml_node& child : node.children())
      if (child.type() == pugi::node_element && local_name(child) != "foreignObject" &&
          !child.attribute("requiredExtensions") && !child.attribute("systemLanguage"))
        return add(child, group, within);
  }

  /// An inner svg, or a symbol that is used with a size.
  void add_viewport(const pugi::xml_node& node, pugi::xml_node to, const Place& place,
                    const std::optional<double>& used_width,
                    const std::optional<double>& used_height) {
    const Viewport& outer = place.viewport;
    const bool is_symbol = local_name(node) == "symbol";
    const auto length = [&](const char* name, double whole, double otherwise) {
      return is_symbol ? otherwise
                       : length_of(node.attribute(name).as_string(), whole).value_or(otherwise);
    };
    const Complex corner(length("x", outer.width, 0), length("y", outer.height, 0));
    const Viewport size{used_width.value_or(length("width", outer.width, outer.width)),
                        used_height.value_or(length("height", outer.height, outer.height))};
    const std::string overflow = property_of(node, "overflow");
    if (!is_symbol && !place.clips && overflow != "visible" && overflow != "auto") {
      to = to.append_child("g");
      const Box box{corner.real(), corner.imag(), corner.real() + size.width,
                    corner.imag() + size.height};
      Place around = place;
      around.to_picture = inside(node, place);
      clip(to, box, around);
    }
    const auto box = viewbox_of(node);
    add_viewport_content(node, to, place, viewbox_map(node, corner, size),
                         box ? Viewport{box->width(), box->height()} : size);
  }

  void add_viewport_content(const pugi::xml_node& node, pugi::xml_node to, const Place& place,
                            const Affine& viewbox, const Viewport& viewport) {
    auto [copy, within] = add_group(node, to, place, viewbox);
    for (const char* name : {"x", "y", "width", "height", "viewBox", "preserveAspectRatio",
                             "version", "baseProfile", "overflow"})
      copy.remove_attribute(name);
    within.viewport = viewport;
    add_children(node, copy, within);
  }

  void add_use(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    const std::string target = href_of(node);
    const pugi::xml_node original =
        target.starts_with("#") ? element(target.substr(1)) : pugi::xml_node();
    if (!original || place.uses >= kDeepestUse) return;
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole);
    };
    const Complex by{length("x", place.viewport.width).value_or(0),
                     length("y", place.viewport.height).value_or(0)};
    if (place.clips) return add_clipping_use(node, original, to, place, by);
    auto [copy, within] = add_group(node, to, place);
    for (const char* name : {"x", "y", "width", "height", "href", "xlink:href"})
      copy.remove_attribute(name);
    within.to_picture = composed(within.to_picture, {.shift = by});
    ++within.uses;
    const std::string kind = local_name(original);
    if (kind == "symbol" || kind == "svg")
      add_viewport(original, copy, within, length("width", place.viewport.width),
                   length("height", place.viewport.height));
    else
      add(original, copy, within);
  }

  /// A copy within a clipping path, where there are no groups.
  void add_clipping_use(const pugi::xml_node& node, const pugi::xml_node& original,
                        pugi::xml_node to, const Place& place, Complex by) {
    if (!is_shape(original) && local_name(original) != "text") return;
    Place within = place;
    within.to_picture = composed(inside(node, place), {.shift = by});
    ++within.uses;
    add(original, to, within);
    pugi::xml_node copy = to.last_child();
    for (const char* property : {"clip-rule", "display", "visibility"})
      if (property_of(copy, property).empty() && !property_of(node, property).empty())
        set_property(copy, property, property_of(node, property));
  }

  static bool has_markers(const pugi::xml_node& node) {
    return std::ranges::any_of(std::array{"marker-start", "marker-mid", "marker-end", "marker"},
                               [&](const char* property) {
                                 const std::string value = inherited_property(node, property);
                                 return !value.empty() && value != "none";
                               });
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
    return has_stroke(node) || has_markers(node) ||
           inherited_property(node, "fill").starts_with("url(") ||
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
    else if (place.clips || (!has_stroke(copy) && !has_markers(copy)))
      for (Subpath& subpath : path) subpath.closed = true;
    else if (inherited_property(copy, "fill") != "none" &&
             std::ranges::any_of(path, [](const Subpath& subpath) {
               return !subpath.closed && subpath.end() != subpath.start;
             }))
      losses_.insert("the closing edges of filled, open lines stay straight");
    if (!place.clips && depends_on_units(copy)) {
      within.frame = new_frame(copy, within.to_picture, place.frame);
      Box box;
      include(box, path);
      for (const char* paint : {"fill", "stroke"}) use_own_units(copy, paint, box);
      if (has_markers(copy)) losses_.insert("the number of its markers may differ");
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
        if (!place.clips)
          for (const Complex& z : segment) drawn_.include(z);
        kept.segments.emplace_back();
        curves_.push_back(std::move(segment));
        if (curves_.size() > kMostCurves)
          throw Error(
              ErrorKind::bad_input,
              drawing_.name + ": with all copies, the drawing has more than 500,000 curves");
      }
    }
    const size_t step = all.size() / kMostSamples + 1;
    for (size_t i = 0; i < all.size() && !place.clips; i += step) sample(place.frame, all[i]);
    shapes_.push_back(std::move(shape));
  }

  /// Texts and pictures move as a whole.
  void add_whole(const pugi::xml_node& node, pugi::xml_node to, const Place& place) {
    const bool is_text = local_name(node) == "text";
    if (!is_text && !href_of(node).starts_with("data:")) {
      losses_.insert("its linked pictures are left out");
      return;
    }
    losses_.insert(is_text ? "its texts are moved and turned, but not bent"
                           : "its embedded pictures are moved and turned, but not bent");
    Place within = place;
    within.to_picture = inside(node, place);
    pugi::xml_node copy = copy_of(node, to, place);
    for (const pugi::xml_node& child : node.children()) copy.append_copy(child);
    add_definition(copy);
    within.frame = new_frame(copy, within.to_picture, place.frame);
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole).value_or(0);
    };
    const double x = is_text ? first_place(node, "x", place.viewport.width)
                             : length("x", place.viewport.width),
                 y = is_text ? first_place(node, "y", place.viewport.height)
                             : length("y", place.viewport.height);
    const double width = is_text ? 0 : length("width", place.viewport.width),
                 height = is_text ? 0 : length("height", place.viewport.height);
    for (const double u : {0.0, 0.5, 1.0})
      for (const double v : {0.0, 0.5, 1.0})
        sample(within.frame, within.to_picture(Complex(x + u * width, y + v * height)));
    bend_clipping(node, copy, within);
  }

  /// Where a text starts: its parts may have positions of their own, for each letter.
  static double first_place(const pugi::xml_node& text, const char* name, double whole) {
    pugi::xml_node part = text;
    while (part && !part.attribute(name)) part = part.first_child();
    const std::string all = part.attribute(name).as_string();
    return length_of(all.substr(0, all.find_first_of(" ,")), whole).value_or(0);
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
      const std::string id = new_id();
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
      bend_clipping(original, bent, place);
      if (clips)
        add_children(original, bent, place);
      else
        add_mask_content(node, original, bent, within, place);
      set_property(copy, property, "url(#" + id + ")");
    }
  }

  /// A mask shows nothing outside its region.
  void add_mask_content(const pugi::xml_node& node, const pugi::xml_node& original,
                        pugi::xml_node bent, const Place& within, const Place& place) {
    masks_.emplace_back(bent, within.frame);
    const bool in_box =
        std::string(original.attribute("maskUnits").as_string()) != "userSpaceOnUse";
    const Box box = in_box ? extent_of(node, within.viewport)
                           : Box{0, 0, within.viewport.width, within.viewport.height};
    const auto length = [&](const char* name, double whole, const char* otherwise) {
      const std::string text = original.attribute(name).as_string(otherwise);
      if (!in_box) return length_of(text, whole).value_or(0);
      return whole * length_of(text, 1).value_or(0);
    };
    if (!box.empty()) {
      bent = bent.append_child("g");
      Box region;
      region.include({(in_box ? box.left : 0) + length("x", box.width(), "-10%"),
                      (in_box ? box.bottom : 0) + length("y", box.height(), "-10%")});
      region.include({region.left + length("width", box.width(), "120%"),
                      region.bottom + length("height", box.height(), "120%")});
      clip(bent, region, within);
    }
    add_children(original, bent, place);
  }

  /// If a shape's paint refers to its bounding box, gives it a copy of the paint in the shape's
  /// user units, because the bent shape has another box.
  void use_own_units(pugi::xml_node copy, const char* property, const Box& box) {
    const PaintServer paint(inherited_property(copy, property), find_);
    if ((!paint.is_gradient() && !paint.is_pattern()) || !paint.uses_bounding_box()) return;
    if (paint.is_pattern() && paint.has_content_in_box())
      losses_.insert("some patterns depend on the sizes of the bent shapes");
    if (box.empty() || !(box.width() > 0) || !(box.height() > 0))
      return set_property(copy, property, paint.fallback());
    const std::string id = new_id();
    paint.append_in_user_units(definitions_, id, box);
    set_property(copy, property, "url(#" + id + ")");
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
      const double size = std::abs(frame.placement.linear) + std::abs(frame.placement.anti);
      if (!(std::abs(frame.placement.determinant()) > 1e-9 * size * size))
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
  const ElementById find_ = [this](const std::string& id) { return element(id); };
  Box drawn_;  ///< of all curves in the picture, y down
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
