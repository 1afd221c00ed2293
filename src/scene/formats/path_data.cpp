// Reads commands one after another. Each command appends segments to the current subpath.
#include "scene/formats/path_data.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace holomorph {
namespace {

class PathReader {
 public:
  explicit PathReader(const std::string& text) : text_(text) {}

  PathData read() {
    try {
      while (skip_blanks()) read_command();
      if (path_.subpaths.empty()) fail("the path is empty");
    } catch (const Mistake& mistake) {
      path_.problem = mistake.what();
    }
    return std::move(path_);
  }

 private:
  struct Mistake : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  [[noreturn]] void fail(const std::string& what) const {
    throw Mistake("path data, character " + std::to_string(at_ + 1) + ": " + what);
  }

  bool skip_blanks() {
    while (at_ < text_.size() &&
           (std::isspace(static_cast<unsigned char>(text_[at_])) || text_[at_] == ','))
      ++at_;
    return at_ < text_.size();
  }

  bool number_follows() {
    if (!skip_blanks()) return false;
    const auto begins = [](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) || c == '.';
    };
    const bool is_signed = text_[at_] == '-' || text_[at_] == '+';
    return begins(text_[at_]) || (is_signed && at_ + 1 < text_.size() && begins(text_[at_ + 1]));
  }

  double number() {
    if (!number_follows()) fail("expected a number");
    const char* from = text_.data() + at_ + (text_[at_] == '+');
    double x = 0;
    const auto [end, wrong] = std::from_chars(from, text_.data() + text_.size(), x);
    if (wrong == std::errc::result_out_of_range) fail("the number is too large or too small");
    if (wrong != std::errc{}) fail("not a number");
    at_ = static_cast<size_t>(end - text_.data());
    return x;
  }

  /// A single digit, which needs nothing between it and the next number.
  bool flag() {
    if (!skip_blanks() || (text_[at_] != '0' && text_[at_] != '1')) fail("expected 0 or 1");
    return text_[at_++] == '1';
  }

  /// Reads a point. Lower-case commands give points relative to the current point.
  Complex point(bool relative) {
    const double x = number(), y = number();
    return (relative ? here_ : Complex(0)) + Complex(x, y);
  }

  void read_command() {
    const char letter = text_[at_++];
    const bool relative = std::islower(static_cast<unsigned char>(letter));
    const char command = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (command == 'M') {
      here_ = point(relative);
      start_subpath();
      last_ = command;
      while (number_follows()) add({here_, point(relative)});
      return;
    }
    if (path_.subpaths.empty()) {
      --at_;
      fail("a path must begin with M");
    }
    if (command == 'Z') {
      close();
      last_ = command;
      return;
    }
    do {
      read_segment(command, relative);
      last_ = command;
    } while (number_follows());
  }

  void start_subpath() { path_.subpaths.push_back({here_}); }

  void close() {
    path_.subpaths.back().closed = true;
    here_ = path_.subpaths.back().start;
  }

  void read_segment(char command, bool relative) {
    const Complex from = here_;
    switch (command) {
      case 'L':
        return add({from, point(relative)});
      case 'H':
        return add({from, {number() + (relative ? from.real() : 0), from.imag()}});
      case 'V':
        return add({from, {from.real(), number() + (relative ? from.imag() : 0)}});
      case 'C':
      case 'S': {
        const bool follows = last_ == 'C' || last_ == 'S';
        const Complex a = command == 'C' ? point(relative) : follows ? 2.0 * from - control_ : from;
        control_ = point(relative);
        return add({from, a, control_, point(relative)});
      }
      case 'Q':
      case 'T': {
        const bool follows = last_ == 'Q' || last_ == 'T';
        control_ = command == 'Q' ? point(relative) : follows ? 2.0 * from - control_ : from;
        return add({from, control_, point(relative)});
      }
      case 'A': {
        const double rx = number(), ry = number(), rotation = number();
        const bool large = flag(), sweep = flag();
        for (Points& cubic : arc_cubics(from, point(relative), rx, ry, rotation, large, sweep))
          add(std::move(cubic));
        return;
      }
      default:
        --at_;
        fail(std::string("'") + text_[at_] + "' is not a path command");
    }
  }

  /// Adds a segment. After Z, it belongs to a new subpath that starts where the last one did.
  void add(Points segment) {
    if (path_.subpaths.back().closed) start_subpath();
    here_ = segment.back();
    path_.subpaths.back().segments.push_back(std::move(segment));
  }

  const std::string& text_;
  size_t at_ = 0;
  Complex here_, control_;  ///< the current point, and the last control point
  char last_ = ' ';         ///< the last command
  PathData path_;
};

}  // namespace

PathData path_data_of(const std::string& text) {
  return PathReader(text).read();
}

std::vector<Points> arc_cubics(Complex from, Complex to, double rx, double ry, double rotation,
                               bool large, bool sweep) {
  if (from == to) return {};
  rx = std::abs(rx);
  ry = std::abs(ry);
  if (!(rx > 0) || !(ry > 0)) return {{from, to}};
  // In these coordinates, the ellipse is a unit circle.
  const Complex axis = std::polar(1.0, rotation * kPi / 180);
  const auto onto_circle = [&](Complex z) {
    z *= std::conj(axis);
    return Complex(z.real() / rx, z.imag() / ry);
  };
  const auto onto_ellipse = [&](Complex z) { return Complex(z.real() * rx, z.imag() * ry) * axis; };
  const Complex half = onto_circle(0.5 * (to - from));
  const double length = std::abs(half);
  if (!std::isfinite(length) || !(length > 0)) return {{from, to}};
  const double reach = std::max(length, 1.0);  // radii that are too small grow
  const double height = std::sqrt(std::max(0.0, reach * reach - length * length));
  const Complex middle = (large == sweep ? kI : -kI) * (half / length) * height;  // from the center
  const Complex center = 0.5 * (from + to) - onto_ellipse(middle);
  const Complex start = middle - half, end = middle + half;
  double angle = std::arg(end / start);
  if (sweep && angle < 0) angle += 2 * kPi;
  if (!sweep && angle > 0) angle -= 2 * kPi;
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (kPi / 4) - 1e-9)));
  const Complex step = std::polar(1.0, angle / count);
  const double arm = 4.0 / 3 * std::tan(angle / count / 4);
  std::vector<Points> cubics;
  Complex at = start;
  for (int k = 0; k < count; ++k) {
    const Complex next = k + 1 < count ? at * step : end;
    cubics.push_back({center + onto_ellipse(at), center + onto_ellipse(at + kI * arm * at),
                      center + onto_ellipse(next - kI * arm * next), center + onto_ellipse(next)});
    at = next;
  }
  cubics.front().front() = from;
  cubics.back().back() = to;
  return cubics;
}

}  // namespace holomorph
