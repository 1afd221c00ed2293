// First, the elements are copied, and the curves that must be bent are collected. Then the map is
// evaluated for all of them together, and the paths are written into the copies.
#include "scene/formats/bent_drawing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/geometry/curve.h"
#include "scene/formats/drawing_frames.h"
#include "scene/formats/path_writer.h"
#include "scene/formats/svg_cleaning.h"
#include "scene/formats/svg_document.h"
#include "scene/formats/svg_paint.h"
#include "scene/formats/svg_styles.h"

namespace holomorph {
namespace {

constexpr size_t kMostElements = 200'000, kMostCurves = 500'000;
constexpr int kDeepestUse = 32;

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
    add_root(root);
    cut_off_overhang();
    const auto values = [this](std::span<const Complex> points) { return values_at(points); };
    frames_.place(values);
    if (frames_.should_bend_gradients())
      losses_.insert("some gradients are moved and turned, but not bent");
    write_paths(values);
    frames_.write_transforms();
    write_mask_regions();
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
  struct CopyContext {
    Affine to_picture;  ///< from its parent's user units to the picture's pixels, y down
    size_t frame = 0;   ///< of the copied parent
    Viewport viewport;
    bool clips = false;  ///< it is part of a clipping path, where there are no strokes
    int uses = 0;        ///< levels of `use`
  };

  /// A copied shape: some of the curves.
  struct CopiedShape {
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

  void add_children(const pugi::xml_node& from, pugi::xml_node to, const CopyContext& context) {
    for (const pugi::xml_node& child : from.children()) add(child, to, context);
  }

  void add(const pugi::xml_node& node, pugi::xml_node to, const CopyContext& context) {
    if (node.type() != pugi::node_element) {
      if (node.type() == pugi::node_pcdata) to.append_copy(node);
      return;
    }
    count_element();
    const std::string kind = local_name(node);
    if (kind == "symbol" || !is_kept(node, losses_)) return;
    if (kind == "defs") return add_definitions(node, to);
    if (kind == "use") return add_use(node, to, context);
    if (kind == "svg") return add_viewport(node, to, context, {}, {});
    if (kind == "switch") return add_switch(node, to, context);
    if (is_shape(node)) return add_shape(node, to, context);
    if (kind == "g" || kind == "a") {
      const auto [copy, inside] = add_group(node, to, context);
      return add_children(node, copy, inside);
    }
    if (kind == "text" || kind == "image") return add_whole(node, to, context);
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

  /// Clips a copied element by a rectangle in the user units of `context`.
  void clip(pugi::xml_node copy, const Box& box, const CopyContext& context) {
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
    CopyContext inside = context;
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
  pugi::xml_node copy_of(const pugi::xml_node& node, pugi::xml_node to,
                         const CopyContext& context) {
    pugi::xml_node copy = to.append_child(node.name());
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string name = attribute.name();
      const bool stays = !name.starts_with("sodipodi:") && name != "inkscape:path-effect" &&
                         name != "inkscape:original-d" && name != "transform" && name != "xmlns" &&
                         (name != "id" || context.uses == 0);
      if (stays) copy.append_copy(attribute);
    }
    clean_attributes(copy, losses_);
    resolve_percentages(copy, context.viewport);
    if (!property_of(copy, "transform").empty()) set_property(copy, "transform", "");
    return copy;
  }

  Affine inside(const pugi::xml_node& node, const CopyContext& context) const {
    return composed(context.to_picture, transform_of(node));
  }

  /// Copies a group without its children. `viewbox` is what its own content is mapped by.
  std::pair<pugi::xml_node, CopyContext> add_group(const pugi::xml_node& node, pugi::xml_node to,
                                                   const CopyContext& context,
                                                   const Affine& viewbox = {}) {
    pugi::xml_node copy = copy_of(node, to, context);
    copy.set_name(local_name(node) == "a" ? "a" : "g");
    CopyContext within = context;
    within.to_picture = composed(inside(node, context), viewbox);
    const std::string filter = property_of(node, "filter");
    if (!filter.empty() && filter != "none" && !context.clips)
      within.frame = frames_.add(copy, within.to_picture, context.frame);
    bend_clipping(node, copy, within);
    return {copy, within};
  }

  /// Takes the first child that is not for other languages or programs. Texts in several languages
  /// end with one for all others.
  void add_switch(const pugi::xml_node& node, pugi::xml_node to, const CopyContext& context) {
    const auto [group, within] = add_group(node, to, context);
    for (const pugi::xml_node& child : node.children())
      if (child.type() == pugi::node_element && local_name(child) != "foreignObject" &&
          !child.attribute("requiredExtensions") && !child.attribute("systemLanguage"))
        return add(child, group, within);
  }

  /// An inner svg, or a symbol that is used with a size.
  void add_viewport(const pugi::xml_node& node, pugi::xml_node to, const CopyContext& context,
                    const std::optional<double>& used_width,
                    const std::optional<double>& used_height) {
    const Viewport& outer = context.viewport;
    const bool is_symbol = local_name(node) == "symbol";
    const auto length = [&](const char* name, double whole, double otherwise) {
      return is_symbol ? otherwise
                       : length_of(node.attribute(name).as_string(), whole).value_or(otherwise);
    };
    const Complex corner(length("x", outer.width, 0), length("y", outer.height, 0));
    const Viewport size{used_width.value_or(length("width", outer.width, outer.width)),
                        used_height.value_or(length("height", outer.height, outer.height))};
    const std::string overflow = property_of(node, "overflow");
    if (!is_symbol && !context.clips && overflow != "visible" && overflow != "auto") {
      to = to.append_child("g");
      const Box box{corner.real(), corner.imag(), corner.real() + size.width,
                    corner.imag() + size.height};
      CopyContext around = context;
      around.to_picture = inside(node, context);
      clip(to, box, around);
    }
    const auto box = viewbox_of(node);
    add_viewport_content(node, to, context, viewbox_map(node, corner, size),
                         box ? Viewport{box->width(), box->height()} : size);
  }

  void add_viewport_content(const pugi::xml_node& node, pugi::xml_node to,
                            const CopyContext& context, const Affine& viewbox,
                            const Viewport& viewport) {
    auto [copy, within] = add_group(node, to, context, viewbox);
    for (const char* name : {"x", "y", "width", "height", "viewBox", "preserveAspectRatio",
                             "version", "baseProfile", "overflow"})
      copy.remove_attribute(name);
    within.viewport = viewport;
    add_children(node, copy, within);
  }

  void add_use(const pugi::xml_node& node, pugi::xml_node to, const CopyContext& context) {
    const std::string target = href_of(node);
    const pugi::xml_node original =
        target.starts_with("#") ? element(target.substr(1)) : pugi::xml_node();
    if (!original || context.uses >= kDeepestUse) return;
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole);
    };
    const Complex by{length("x", context.viewport.width).value_or(0),
                     length("y", context.viewport.height).value_or(0)};
    if (context.clips) return add_clipping_use(node, original, to, context, by);
    auto [copy, within] = add_group(node, to, context);
    for (const char* name : {"x", "y", "width", "height", "href", "xlink:href"})
      copy.remove_attribute(name);
    within.to_picture = composed(within.to_picture, {.shift = by});
    ++within.uses;
    const std::string kind = local_name(original);
    if (kind == "symbol" || kind == "svg")
      add_viewport(original, copy, within, length("width", context.viewport.width),
                   length("height", context.viewport.height));
    else
      add(original, copy, within);
  }

  /// A copy within a clipping path, where there are no groups.
  void add_clipping_use(const pugi::xml_node& node, const pugi::xml_node& original,
                        pugi::xml_node to, const CopyContext& context, Complex by) {
    if (!is_shape(original) && local_name(original) != "text") return;
    CopyContext within = context;
    within.to_picture = composed(inside(node, context), {.shift = by});
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
  /// Whether what is drawn on a shape depends on its user units.
  static bool depends_on_units(const pugi::xml_node& node) {
    const std::string filter = property_of(node, "filter");
    return has_stroke(node) || has_markers(node) ||
           inherited_property(node, "fill").starts_with("url(") ||
           (!filter.empty() && filter != "none");
  }

  void add_shape(const pugi::xml_node& node, pugi::xml_node to, const CopyContext& context) {
    pugi::xml_node copy = copy_of(node, to, context);
    CopyContext within = context;
    within.to_picture = inside(node, context);
    std::vector<Subpath> path = path_of_shape(node, context.viewport);
    // What fills and clips is closed in any case. It must be before it is bent.
    if (!has_area(path))
      set_property(copy, "fill", "none");
    else if (context.clips || (!has_stroke(copy) && !has_markers(copy)))
      for (Subpath& subpath : path) subpath.closed = true;
    else if (inherited_property(copy, "fill") != "none" &&
             std::ranges::any_of(path, [](const Subpath& subpath) {
               return !subpath.closed && subpath.end() != subpath.start;
             }))
      losses_.insert("the closing edges of filled, open lines stay straight");
    if (!context.clips && depends_on_units(copy)) {
      within.frame = frames_.add(copy, within.to_picture, context.frame);
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

  void add_curves(pugi::xml_node copy, const std::vector<Subpath>& path,
                  const CopyContext& context) {
    constexpr size_t kMostSamples = 64;
    CopiedShape shape{copy, context.frame, {}, curves_.size()};
    Points all;
    for (const Subpath& subpath : path) {
      Subpath& kept = shape.path.emplace_back();
      kept.closed = subpath.closed;
      kept.start = context.to_picture(subpath.start);
      std::vector<Points> segments = subpath.segments;
      if (subpath.closed && subpath.end() != subpath.start)
        segments.push_back({subpath.end(), subpath.start});
      // A subpath that is only a point is kept as a line of length zero, which may have a cap.
      if (segments.empty()) segments.push_back({subpath.start, subpath.start});
      for (Points& segment : segments) {
        for (Complex& z : segment) z = context.to_picture(z);
        if (!std::ranges::all_of(segment, is_finite) || !std::ranges::all_of(segment, is_moderate))
          throw Error(ErrorKind::bad_input, drawing_.name + ": a shape is infinitely large");
        for (const double t : {0.0, 0.5}) all.push_back(bezier_point(segment, t));
        if (&segment == &segments.back()) all.push_back(segment.back());
        if (!context.clips)
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
    for (size_t i = 0; i < all.size() && !context.clips; i += step)
      frames_.sample(context.frame, all[i]);
    shapes_.push_back(std::move(shape));
  }

  /// Texts and pictures move as a whole.
  void add_whole(const pugi::xml_node& node, pugi::xml_node to, const CopyContext& context) {
    const bool is_text = local_name(node) == "text";
    if (!is_text && !href_of(node).starts_with("data:")) {
      losses_.insert("its linked pictures are left out");
      return;
    }
    losses_.insert(is_text ? "its texts are moved and turned, but not bent"
                           : "its embedded pictures are moved and turned, but not bent");
    CopyContext within = context;
    within.to_picture = inside(node, context);
    pugi::xml_node copy = copy_of(node, to, context);
    for (const pugi::xml_node& child : node.children()) copy.append_copy(child);
    add_definition(copy);
    within.frame = frames_.add(copy, within.to_picture, context.frame);
    const auto length = [&](const char* name, double whole) {
      return length_of(node.attribute(name).as_string(), whole).value_or(0);
    };
    Box box;
    if (is_text) {
      box = extent_of_text(node, context.viewport);
    } else {
      const Viewport& whole = context.viewport;
      const Complex corner(length("x", whole.width), length("y", whole.height));
      box.include(corner);
      box.include(corner + Complex(length("width", whole.width), length("height", whole.height)));
    }
    for (const double u : {0.0, 0.5, 1.0})
      for (const double v : {0.0, 0.5, 1.0})
        frames_.sample(within.frame, within.to_picture(Complex(box.left + u * box.width(),
                                                               box.bottom + v * box.height())));
    bend_clipping(node, copy, within);
  }

  /// Gives an element copies of its clipping path and mask that are bent like the element.
  /// `within` is the context of what the element contains.
  void bend_clipping(const pugi::xml_node& node, pugi::xml_node copy, const CopyContext& within) {
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
      CopyContext context = within;
      context.clips = clips;
      context.uses = within.uses + 1;
      const std::string units =
          original.attribute(clips ? "clipPathUnits" : "maskContentUnits").as_string();
      if (units == "objectBoundingBox") {
        const Box box = extent_of(node, within.viewport);
        if (!box.empty())
          context.to_picture =
              composed(context.to_picture,
                       affine_of_matrix(box.width(), 0, 0, box.height(), box.left, box.bottom));
      }
      context.to_picture = composed(context.to_picture, transform_of(original));
      bend_clipping(original, bent, context);
      if (clips)
        add_children(original, bent, context);
      else
        add_mask_content(node, original, bent, within, context);
      set_property(copy, property, "url(#" + id + ")");
    }
  }

  /// A mask shows nothing outside its region.
  void add_mask_content(const pugi::xml_node& node, const pugi::xml_node& original,
                        pugi::xml_node bent, const CopyContext& within,
                        const CopyContext& context) {
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
    add_children(original, bent, context);
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

  void write_paths(const PointValues& values) {
    constexpr double kFlat = 0.2, kPrecision = 0.02;  // in tolerances
    const double tolerance = options_.tolerance;
    const auto images = curve_images(curves_, values, (1 - kFlat) * tolerance);
    for (CopiedShape& shape : shapes_) {
      PathWriter writer(inverse(frames_.placement(shape.frame)), kPrecision * tolerance);
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

  /// Masks must not cut off anything that they do not cut off at rest.
  void write_mask_regions() {
    for (auto& [mask, frame] : masks_) {
      const Affine to_frame = inverse(frames_.placement(frame));
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
  DrawingFrames frames_;
  std::vector<CopiedShape> shapes_;
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
