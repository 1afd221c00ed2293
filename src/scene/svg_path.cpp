// pugixml reads the file; path data is a little language of its own.
#include "scene/svg_path.h"

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "core/error.h"

namespace holomorph {
namespace {

/// Reads path data command by command and keeps the loop as lists of control points.
class PathReader {
 public:
  PathReader(const std::string& data, std::string name) : data_(data), name_(std::move(name)) {}

  std::vector<Points> segments() {
    while (skip_blanks()) read_command();
    if (!started_) fail("the path is empty");
    close();
    return std::move(segments_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::bad_input,
                name_ + ": path data, character " + std::to_string(at_ + 1) + ": " + what);
  }

  bool skip_blanks() {
    while (at_ < data_.size() &&
           (std::isspace(static_cast<unsigned char>(data_[at_])) || data_[at_] == ','))
      ++at_;
    return at_ < data_.size();
  }

  bool number_follows() {
    return skip_blanks() && (std::isdigit(static_cast<unsigned char>(data_[at_])) ||
                             data_[at_] == '-' || data_[at_] == '+' || data_[at_] == '.');
  }

  double number() {
    if (!number_follows()) fail("a number is wanted here");
    const char* from = data_.c_str() + at_;
    char* end = nullptr;
    const double x = std::strtod(from, &end);
    if (end == from || !std::isfinite(x)) fail("this is no number");
    at_ += static_cast<size_t>(end - from);
    return x;
  }

  /// A point, relative to the current one for small letters.
  Complex point(bool relative) {
    const double x = number(), y = number();
    return (relative ? here_ : Complex(0)) + Complex(x, y);
  }

  void read_command() {
    const char letter = data_[at_++];
    const bool relative = std::islower(static_cast<unsigned char>(letter));
    const char command = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (command == 'Z') {
      closed_ = true;
      return;
    }
    if (closed_) fail("the path has several subpaths; a cage is one closed loop");
    if (command == 'M') {
      if (started_) fail("the path has several subpaths; a cage is one closed loop");
      start_ = here_ = point(relative);
      started_ = true;
      while (number_follows()) line_to(point(relative));
      return;
    }
    if (!started_) fail("a path begins with M");
    do {
      read_segment(command, relative);
      last_ = command;
    } while (number_follows());
  }

  void read_segment(char command, bool relative) {
    const Complex before = here_;
    switch (command) {
      case 'L':
        return line_to(point(relative));
      case 'H':
        return line_to({number() + (relative ? here_.real() : 0), here_.imag()});
      case 'V':
        return line_to({here_.real(), number() + (relative ? here_.imag() : 0)});
      case 'C': {
        const Complex a = point(relative), b = point(relative);
        return curve_to({before, a, b}, point(relative), b);
      }
      case 'S': {
        const Complex a = last_ == 'C' || last_ == 'S' ? 2.0 * here_ - control_ : here_;
        const Complex b = point(relative);
        return curve_to({before, a, b}, point(relative), b);
      }
      case 'Q': {
        const Complex a = point(relative);
        return curve_to({before, a}, point(relative), a);
      }
      case 'T': {
        const Complex a = last_ == 'Q' || last_ == 'T' ? 2.0 * here_ - control_ : here_;
        return curve_to({before, a}, point(relative), a);
      }
      case 'A':
        fail("arcs are not read; convert them to curves in the drawing program");
      default:
        --at_;
        fail(std::string("'") + data_[at_] + "' is no path command");
    }
  }

  void line_to(Complex to) {
    if (to != here_) segments_.push_back({here_});
    here_ = to;
  }

  void curve_to(Points controls, Complex to, Complex control) {
    segments_.push_back(std::move(controls));
    control_ = control;
    here_ = to;
  }

  /// Back to the start: by a line, unless it is there already.
  void close() {
    double size = 0;
    for (const Points& segment : segments_) size = std::max(size, std::abs(segment[0] - start_));
    if (std::abs(here_ - start_) > 1e-9 * size) segments_.push_back({here_});
  }

  const std::string& data_;
  std::string name_;
  size_t at_ = 0;
  Complex start_, here_, control_;
  char last_ = ' ';
  bool started_ = false, closed_ = false;
  std::vector<Points> segments_;
};

/// The first path below a node, in document order.
pugi::xml_node first_path(const pugi::xml_node& node) {
  for (const pugi::xml_node& child : node.children()) {
    const std::string tag = child.name();
    if (tag == "path" || tag == "svg:path") return child;
    if (const pugi::xml_node found = first_path(child)) return found;
  }
  return {};
}

/// Handles on their points are pulled a little along the curve.
void free_handles(Cage& cage) {
  constexpr double kPull = 1e-3;
  for (Index e = 0; e < cage.size(); ++e) {
    Points& c = cage.segments[e];
    const Points all = cage.controls(e);
    const size_t n = all.size() - 1;
    if (n < 2) continue;
    const auto first_other =
        std::find_if(all.begin(), all.end(), [&](Complex z) { return z != all[0]; });
    const auto last_other =
        std::find_if(all.rbegin(), all.rend(), [&](Complex z) { return z != all[n]; });
    if (first_other == all.end()) continue;
    if (all[1] == all[0]) c[1] = all[0] + kPull * (*first_other - all[0]);
    if (all[n - 1] == all[n]) c[n - 1] = all[n] + kPull * (*last_other - all[n]);
  }
}

}  // namespace

Cage cage_of_svg(const std::string& text, const std::string& name, double height, bool for_rest) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result)
    throw Error(ErrorKind::bad_input, name + ": this is no SVG file: " + result.description());
  const pugi::xml_node path = first_path(document);
  if (!path) throw Error(ErrorKind::bad_input, name + ": there is no path in this file");
  for (pugi::xml_node node = path; node; node = node.parent())
    if (node.attribute("transform"))
      throw Error(ErrorKind::bad_input, name +
                                            ": the path or its group has a transform; apply it in "
                                            "the drawing program and save again");
  if (!(height > 0)) {
    const pugi::xml_node root = document.document_element();
    height = root.attribute("height").as_double(0);
  }
  Cage cage;
  cage.segments = PathReader(path.attribute("d").as_string(), name).segments();
  for (Points& segment : cage.segments)
    for (Complex& z : segment) z = {z.real(), height - z.imag()};
  if (cage.size() < 3)
    throw Error(ErrorKind::bad_input, name + ": the path has " + std::to_string(cage.size()) +
                                          " segments; a cage needs at least three");
  if (for_rest) free_handles(cage);
  return cage;
}

}  // namespace holomorph
