// How well outlines of many kinds are matched, measured independently of the method's own report.
//
//   outline_pairs random SEED COUNT: random smooth shapes onto random outlines, some with limbs
//   outline_pairs stars SEED COUNT: random star-shaped polygons with 4 to 13 corners
//   outline_pairs hard FOLDER [NAME]: all pairs of hard shapes, with animals from the folder
//   outline_pairs check FOLDER: a few random pairs of each kind, as a test
//
// The exit status is 1 when more than one pair in a hundred misses by 1 % of the diameter or folds.
// A pair is exempt if some hundredth of a boundary has a harmonic measure below 1e-12 as seen from
// the deepest point.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "bench/hard_outlines.h"
#include "bench/outlines.h"
#include "core/cauchy/cauchy_array.h"
#include "core/geometry/deepest_point.h"
#include "core/outline/outline_match.h"
#include "core/outline/outline_start.h"
#include "core/outline/riemann.h"
#include "support/seeds.h"

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

/// Values of f or f' along a polygon. Points are added until no two neighboring values are `far`
/// apart.
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
    Points all_points, all;
    size_t k = 0;
    for (size_t i = 0; i < f.size(); ++i) {
      all_points.push_back(places[i]), all.push_back(f[i]);
      if (k < after.size() && after[k] == i) {
        all_points.push_back(middles[k]), all.push_back(more[k]);
        ++k;
      }
    }
    places = std::move(all_points), f = std::move(all);
  }
  return f;
}

/// A loop inside a polygon at this distance, with miters at convex corners and arcs at the others.
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

double farthest_distance(const Points& a, const Polyline& b) {
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
    if (!is_finite(z) || std::abs(z - target[0]) > 10 * size) return {99, 0};
  const Polyline wanted(target, true), got(without_repeats(image), true);
  result.missed = std::max(farthest_distance(outlines::with_steps(got, 5e-4 * size), wanted),
                           farthest_distance(outlines::with_steps(wanted, 5e-4 * size), got)) /
                  size;
  const double own = diameter(source);
  double distance = 1e-3 * own;  // closer to the boundary if the loop crosses itself
  while (self_crossing(inset(source, distance))) distance /= 2;
  const Points loop = inset(source, distance);
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

/// The smallest harmonic measure of a hundredth of the boundary, as seen from the deepest point.
double least_measure(const Points& polygon) {
  const Polyline line(polygon, true);
  constexpr int kCount = 3000, kWindow = kCount / 100;
  const Complex middle = deepest_point(line);
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

constexpr double kExempt = 1e-12;

struct Row {
  bool exempt = false, met = false, whole = false;
  double ms = 0;

  bool good() const { return met && whole; }
};

Row report(const std::string& name, const Points& source, const Points& target, double measure) {
  using Clock = std::chrono::steady_clock;
  Row row;
  row.exempt = measure < kExempt;
  OutlineMatch match;
  try {
    const auto start = Clock::now();
    match = matched({polygon_cage(source), target, {}, {}}, {});
    row.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  } catch (const Error& error) {
    std::printf("%-28s ERROR %s\n", name.c_str(), error.what());
    return row;
  }
  const Judged judged = judge(match, counter_clockwise(source), counter_clockwise(target));
  row.met = judged.missed < 0.01;
  row.whole = judged.zeros == 0;
  std::printf("%-28s %-8s %7.3f %% zeros %3d vertices %4d steps %2d %6.0f ms", name.c_str(),
              row.exempt   ? "exempt"
              : row.good() ? "ok"
                           : "MISS",
              100 * judged.missed, judged.zeros, static_cast<int>(match.basis.size()),
              match.iterations, row.ms);
  std::printf("  own: %.3f %% zeros %d  measure %.1e\n",
              100 * match.hausdorff / Polyline(target, true).diameter(), match.zeros, measure);
  std::fflush(stdout);
  return row;
}

/// Prints a summary. Returns whether 99 of 100 pairs are good.
bool summary(const char* what, std::vector<Row> rows) {
  std::erase_if(rows, [](const Row& row) { return row.exempt; });
  if (rows.empty()) return true;
  const auto count = [&](auto is) { return static_cast<int>(std::ranges::count_if(rows, is)); };
  const int all = static_cast<int>(rows.size()), good = count(&Row::good);
  std::ranges::sort(rows, {}, &Row::ms);
  std::printf(
      "%s: %d pairs, %d good, %d within 1 %%, %d without zeros; median %.0f ms, longest %.0f\n",
      what, all, good, count(&Row::met), count(&Row::whole), rows[rows.size() / 2].ms,
      rows.back().ms);
  return all - good <= std::max(1, all / 100);
}

/// The cage of a scene file.
Points cage_in(const std::string& path) {
  std::ifstream file(path);
  Points points;
  const nlohmann::json scene = nlohmann::json::parse(file);
  for (const auto& segment : scene["cage"]["rest"]) {
    const auto& at = segment[0].is_array() ? segment[0] : segment;
    points.emplace_back(at[0].get<double>(), at[1].get<double>());
  }
  return points;
}

/// A star-shaped polygon with irregular corners.
Points star(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const int corners = 4 + static_cast<int>(random() % 10);
  Points points;
  for (int i = 0; i < corners; ++i)
    points.push_back(std::polar(number(35, 100), 2 * kPi * (i + number(-0.3, 0.3)) / corners));
  return points;
}

/// The hard shapes, and animals from a folder.
std::vector<std::pair<std::string, Points>> shapes_with_animals(const std::string& folder) {
  auto shapes = outlines::hard_shapes();
  for (const char* animal : {"gecko", "giraffe", "octopus", "fish", "snake"})
    shapes.push_back({animal, cage_in(folder + "/" + animal + ".json")});
  return shapes;
}

std::vector<Row> random_pairs(unsigned first, unsigned count) {
  std::vector<Row> rows;
  for (unsigned seed = first; seed < first + count; ++seed)
    rows.push_back(report("random " + std::to_string(seed), outlines::random(seed, seed % 2, 50),
                          outlines::random(seed + 100000, seed % 3 == 0, 400), 1));
  return rows;
}

std::vector<Row> star_pairs(unsigned first, unsigned count) {
  std::vector<Row> rows;
  for (unsigned seed = first; seed < first + count; ++seed)
    rows.push_back(report("stars " + std::to_string(seed), star(2 * seed), star(2 * seed + 1), 1));
  return rows;
}

using Wants = std::function<bool(const std::string& from, const std::string& to)>;

std::vector<Row> hard_pairs(const std::string& folder, const Wants& wants) {
  const auto shapes = shapes_with_animals(folder);
  std::map<std::string, double> measures;
  for (const auto& [name, points] : shapes) {
    measures[name] = least_measure(counter_clockwise(points));
    std::printf("%s: %d vertices, measure %.1e\n", name.c_str(), static_cast<int>(points.size()),
                measures[name]);
  }
  std::vector<Row> rows;
  for (const auto& [from, source] : shapes)
    for (const auto& [to, target] : shapes)
      if (from != to && wants(from, to))
        rows.push_back(
            report(from + " to " + to, source, target, std::min(measures[from], measures[to])));
  return rows;
}

bool check_random(const std::string& folder) {
  const unsigned seed = holomorph::seeds_of("outline_pairs", {1}).front();
  const bool smooth = summary("random", random_pairs(seed % 1000000, few_or_many(6, 30)));
  const bool cornered = summary("stars", star_pairs(seed % 1000000, few_or_many(6, 30)));
  std::mt19937 random(seed);
  const unsigned one_in = static_cast<unsigned>(few_or_many(40, 12));
  const bool hard = summary("hard", hard_pairs(folder, [&](const auto& from, const auto& to) {
                              const bool wanted = random() % one_in == 0;
                              return wanted && from != "spiral" && from != "snake" &&
                                     to != "spiral" && to != "snake";  // exempt, and slow
                            }));
  return smooth && cornered && hard;
}

}  // namespace

int main(int count, char** words) {
  const std::string mode = count > 2 ? words[1] : "";
  const auto number = [&](int i) {
    return static_cast<unsigned>(std::strtoul(words[i], nullptr, 10));
  };
  if (mode == "random" && count > 3) return !summary("random", random_pairs(number(2), number(3)));
  if (mode == "stars" && count > 3) return !summary("stars", star_pairs(number(2), number(3)));
  if (mode == "hard")
    return !summary("hard", hard_pairs(words[2], [&](const auto& from, const auto& to) {
                      return count < 4 || from == words[3] || from + "-" + to == words[3];
                    }));
  if (mode == "check") return !check_random(words[2]);
  std::puts(
      "outline_pairs random SEED COUNT | stars SEED COUNT | hard FOLDER [NAME] | check FOLDER");
  return 2;
}
