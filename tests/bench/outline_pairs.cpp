// How far outlines of many kinds are met, measured apart from what the method says of itself.
//
// outline_pairs random SEED COUNT [upright]: random shapes onto random outlines
// outline_pairs hard FOLDER [NAME]: all combinations of hard shapes, animals out of the folder
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "../support/outlines.h"
#include "core/cauchy_array.h"
#include "core/outline_match.h"
#include "core/outline_start.h"
#include "core/riemann.h"

using namespace holomorph;

namespace {

double diameter(const Points& points) {
  double most = 0;
  for (const Complex a : points)
    for (const Complex b : points) most = std::max(most, std::norm(a - b));
  return std::sqrt(most);
}

Points counter_clockwise(Points points) {
  if (signed_area(points) < 0) std::reverse(points.begin(), points.end());
  return points;
}

/// Values of f or f' along a polygon, more of them until neighbours are near by `far`.
template <class Far>
Points along(const OutlineMatch& match, Points places, int order, const Far& far) {
  const auto values = [&](const Points& at) {
    const VectorXc v = product(planar_coordinates<double>(match.basis, at, order), match.phi);
    return Points(v.begin(), v.end());
  };
  Points f = values(places);
  for (int round = 0; round < 24; ++round) {
    Points middles;
    std::vector<size_t> after;
    for (size_t i = 0; i < f.size(); ++i) {
      const size_t next = (i + 1) % f.size();
      if (!far(f[i], f[next])) continue;
      const Complex middle = 0.5 * (places[i] + places[next]);
      if (middle == places[i] || middle == places[next]) continue;
      middles.push_back(middle);
      after.push_back(i);
    }
    constexpr size_t kMost = 200000;
    if (middles.empty() || f.size() > kMost) break;
    const Points more = values(middles);
    Points all_places, all;
    size_t k = 0;
    for (size_t i = 0; i < f.size(); ++i) {
      all_places.push_back(places[i]), all.push_back(f[i]);
      if (k < after.size() && after[k] == i) {
        all_places.push_back(middles[k]), all.push_back(more[k]);
        ++k;
      }
    }
    places = std::move(all_places), f = std::move(all);
  }
  return f;
}

/// A loop inside a polygon at this distance: mitres at convex corners, arcs at the others.
Points inset(const Points& polygon, double distance) {
  Points inner;
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const Complex a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
    const Complex in = (b - a) / std::abs(b - a), out = (c - b) / std::abs(c - b);
    const double turn = std::arg(out / in);
    if (turn >= 0) {
      inner.push_back(b + distance * kI * (in + out) / (1 + std::cos(turn)));
    } else {
      const int parts = 1 + static_cast<int>(-turn / 0.3);
      for (int k = 0; k <= parts; ++k)
        inner.push_back(b + distance * kI * in * std::polar(1.0, turn * k / parts));
    }
  }
  return inner;
}

double far_from(const Points& a, const Polyline& b) {
  double worst = 0;
  Index hint = 0;
  for (const Complex z : a) {
    const auto nearest = b.nearest(z, hint);
    hint = nearest.segment;
    worst = std::max(worst, nearest.distance);
  }
  return worst;
}

struct Judged {
  double missed = 0;  ///< two-sided, in diameters
  int zeros = 0;
  bool sure = true;  ///< whether the loop is simple
};

Judged judge(const OutlineMatch& match, const Points& source, const Points& target) {
  Judged result;
  const double size = diameter(target);
  Points places;
  const Points basis = vertices_of(match.basis);
  for (size_t i = 0; i < basis.size(); ++i)
    for (int k = 0; k < 8; ++k)
      places.push_back(basis[i] + k / 8.0 * (basis[(i + 1) % basis.size()] - basis[i]));
  const Points image =
      along(match, places, 0, [&](Complex a, Complex b) { return std::abs(a - b) > 2e-3 * size; });
  for (const Complex z : image)
    if (!is_finite(z) || std::abs(z - target[0]) > 10 * size) return {99, 0, true};
  const Polyline wanted(target, true), got(without_repeats(image), true);
  result.missed = std::max(far_from(outlines::with_steps(got, 5e-4 * size), wanted),
                           far_from(outlines::with_steps(wanted, 5e-4 * size), got)) /
                  size;
  const double own = diameter(source);
  const Points loop = inset(source, 1e-3 * own);
  result.sure = !self_crossing(loop);
  const Points start = outlines::with_steps(Polyline(loop, true), 1e-3 * own);
  const Points slopes = along(match, start, 1, [](Complex a, Complex b) {
    return !(std::abs(std::arg(b / a)) < 0.5) || std::abs(b) > 4 * std::abs(a) ||
           std::abs(a) > 4 * std::abs(b);
  });
  double sum = 0;
  for (size_t i = 0; i < slopes.size(); ++i)
    sum += std::arg(slopes[(i + 1) % slopes.size()] / slopes[i]);
  result.zeros = static_cast<int>(std::lround(sum / (2 * kPi)));
  return result;
}

/// The smallest harmonic measure of a hundredth of the boundary, from the deepest point.
double least_measure(const Points& polygon) {
  const Polyline line(polygon, true);
  constexpr int kCount = 3000, kWindow = kCount / 100;
  const Complex middle = middle_point(line);
  const Polyline::Nearest near = line.nearest(middle);
  const double start = line.length_at(near.segment, near.parameter);
  Points points;
  for (int i = 0; i < kCount; ++i) points.push_back(line.at(start + line.length() * i / kCount));
  const RiemannMap map(points, middle);
  double least = 1;
  for (int i = 0; i < kCount; ++i) {
    double measure = 0;
    for (int k = 0; k < kWindow; ++k) measure += map.steps()[(i + k) % kCount] / (2 * kPi);
    least = std::min(least, measure);
  }
  return least;
}

struct Row {
  double missed, ms;
  int zeros;
};

Row report(const std::string& name, const Points& source, const Points& target,
           const OutlineSettings& settings, double measure) {
  using Clock = std::chrono::steady_clock;
  OutlineMatch match;
  double best = 1e300;
  const int repeats = std::getenv("REPEATS") ? std::atoi(std::getenv("REPEATS")) : 1;
  for (int k = 0; k < repeats; ++k) {
    const auto start = Clock::now();
    try {
      match = matched({polygon_cage(source), target, {}, {}}, settings);
    } catch (const Error& error) {
      std::printf("%-28s ERROR %s\n", name.c_str(), error.what());
      return {1, 0, 0};
    }
    best = std::min(best, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  const Judged judged = judge(match, counter_clockwise(source), counter_clockwise(target));
  const bool good = judged.missed < 0.01 && judged.zeros == 0;
  std::printf("%-28s %-4s %7.3f %% zeros %3d%s vertices %4d steps %2d %6.0f ms", name.c_str(),
              good ? "ok" : "MISS", 100 * judged.missed, judged.zeros, judged.sure ? " " : "?",
              static_cast<int>(match.basis.size()), match.iterations, best);
  std::printf("  own: %.3f %% zeros %d", 100 * match.hausdorff / Polyline(target, true).diagonal(),
              match.zeros);
  if (measure < 1) std::printf("  measure %.1e", measure);
  std::printf("\n");
  std::fflush(stdout);
  return {judged.missed, best, judged.zeros};
}

void summary(std::vector<Row> rows) {
  const auto good =
      std::ranges::count_if(rows, [](const Row& r) { return r.missed < 0.01 && r.zeros == 0; });
  const auto near = std::ranges::count_if(rows, [](const Row& r) { return r.missed < 0.01; });
  const auto whole = std::ranges::count_if(rows, [](const Row& r) { return r.zeros == 0; });
  std::ranges::sort(rows, {}, &Row::ms);
  std::printf("%d pairs: %d good, %d within 1 %%, %d without zeros; median %.0f ms, longest %.0f\n",
              static_cast<int>(rows.size()), static_cast<int>(good), static_cast<int>(near),
              static_cast<int>(whole), rows[rows.size() / 2].ms, rows.back().ms);
}

/// The cage of a scene file.
Points cage_in(const std::string& path) {
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const size_t from = text.find("\"rest\""), to = text.find("],\n    \"pose\"", from);
  Points points;
  const char* at = text.c_str() + text.find('[', from);
  const char* end = text.c_str() + (to == std::string::npos ? text.size() : to);
  int depth = 0;
  while (at < end) {
    if (*at == '[') {
      ++depth;
      char* after;
      const double x = std::strtod(at + 1, &after);
      if (after != at + 1 && *after == ',') {
        const double y = std::strtod(after + 1, &after);
        if (depth >= 3) points.emplace_back(x, y);
        at = after;
        continue;
      }
    }
    if (*at == ']' && --depth == 0) break;
    ++at;
  }
  return points;
}

Points circle(double radius, int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(std::polar(radius, 2 * kPi * i / n));
  return points;
}

std::vector<std::pair<std::string, Points>> hard_shapes(const std::string& folder) {
  std::vector<std::pair<std::string, Points>> shapes;
  shapes.push_back({"disk", circle(100, 120)});
  shapes.push_back({"square", {{-100, -100}, {100, -100}, {100, 100}, {-100, 100}}});
  shapes.push_back({"bar", {{-300, -30}, {300, -30}, {300, 30}, {-300, 30}}});
  Points star;
  for (int i = 0; i < 10; ++i)
    star.push_back(std::polar(i % 2 ? 76.4 : 200.0, kPi / 2 + 2 * kPi * i / 10));
  shapes.push_back({"star", star});
  shapes.push_back({"E",
                    {{0, 0},
                     {200, 0},
                     {200, 60},
                     {60, 60},
                     {60, 130},
                     {170, 130},
                     {170, 190},
                     {60, 190},
                     {60, 260},
                     {200, 260},
                     {200, 320},
                     {0, 320}}});
  shapes.push_back({"H",
                    {{0, 0},
                     {60, 0},
                     {60, 130},
                     {160, 130},
                     {160, 0},
                     {220, 0},
                     {220, 320},
                     {160, 320},
                     {160, 190},
                     {60, 190},
                     {60, 320},
                     {0, 320}}});
  shapes.push_back(
      {"hourglass", {{-100, -150}, {100, -150}, {12, 0}, {100, 150}, {-100, 150}, {-12, 0}}});
  Points comb{{0, 0}, {360, 0}};
  for (int tooth = 4; tooth >= 0; --tooth) {
    const double left = 80.0 * tooth, right = left + 40;
    if (tooth < 4) comb.emplace_back(right, 50);
    comb.emplace_back(right, 200);
    comb.emplace_back(left, 200);
    if (tooth > 0) comb.emplace_back(left, 50);
  }
  shapes.push_back({"comb", comb});
  Points spiral;
  for (const int side : {0, 1})
    for (int i = 0; i <= 60; ++i) {
      const double t = (side == 0 ? i : 60 - i) / 60.0, angle = 2 * kPi * 1.25 * t;
      spiral.push_back(std::polar(60 + 130 * t + (side == 0 ? 35 : -35), angle));
    }
  shapes.push_back({"spiral", spiral});
  for (const char* animal : {"gecko", "giraffe", "octopus", "fish", "snake"})
    shapes.push_back({animal, cage_in(folder + "/" + animal + ".json")});
  return shapes;
}

}  // namespace

int main(int count, char** words) {
  const std::string mode = count > 1 ? words[1] : "";
  OutlineSettings settings;
  if (std::getenv("UPRIGHT")) settings.upright = std::atof(std::getenv("UPRIGHT"));
  std::vector<Row> rows;
  if (mode == "random" && count > 3) {
    const unsigned first = static_cast<unsigned>(std::atoi(words[2]));
    for (unsigned seed = first; seed < first + static_cast<unsigned>(std::atoi(words[3])); ++seed) {
      const Points source = outlines::random(seed, seed % 2, 50),
                   target = outlines::random(seed + 100000, seed % 3 == 0, 400);
      rows.push_back(report(std::to_string(seed), source, target, settings, 1));
    }
  } else if (mode == "hard" && count > 2) {
    const auto shapes = hard_shapes(words[2]);
    std::map<std::string, double> measures;
    for (const auto& [name, points] : shapes) {
      measures[name] = least_measure(counter_clockwise(points));
      std::printf("%s: %zu vertices, measure %.1e%s\n", name.c_str(), points.size(), measures[name],
                  self_crossing(points) ? " CROSSES ITSELF" : "");
    }
    for (const auto& [from, source] : shapes)
      for (const auto& [to, target] : shapes) {
        if (from == to || (count > 3 && from != words[3] && from + "-" + to != words[3])) continue;
        rows.push_back(report(from + " to " + to, source, target, settings,
                              std::min(measures[from], measures[to])));
      }
  }
  if (!rows.empty()) summary(rows);
}
