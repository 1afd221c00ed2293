// Pieces are first halved as the map requires, then as the lengths of their neighbors require.
#include "core/outline/graded_cuts.h"

#include <algorithm>
#include <cmath>

namespace holomorph {
namespace {

constexpr double kBalance = 3;  ///< largest ratio of the lengths of neighboring pieces

class Cutter {
 public:
  Cutter(const std::function<Complex(double)>& image, const std::function<double(double)>& longest,
         const CutRules& rules)
      : image_(image), longest_(longest), rules_(rules) {}

  /// Appends the cuts of the piece between `from` and `to`, excluding both ends.
  void halve(double from, Complex image_from, double to, Complex image_to,
             std::vector<double>& cuts) const {
    const double middle = 0.5 * (from + to);
    const Complex image_middle = image_(middle);
    if (to - from < rules_.least * rules_.length || cuts.size() > rules_.most ||
        is_fine_enough(from, image_from, image_middle, to, image_to))
      return;
    halve(from, image_from, middle, image_middle, cuts);
    cuts.push_back(middle);
    halve(middle, image_middle, to, image_to, cuts);
  }

 private:
  bool is_fine_enough(double from, Complex image_from, Complex middle, double to,
                      Complex image_to) const {
    const double length = (to - from) / rules_.length, chord = std::abs(image_to - image_from),
                 path_length = std::abs(middle - image_from) + std::abs(image_to - middle);
    if (to - from > longest_(0.5 * (from + to)) && length > rules_.shortest) return false;
    if (length > rules_.longest || path_length > rules_.longest * rules_.size) return false;
    const double quarter =
        std::abs(image_(0.75 * from + 0.25 * to) - 0.75 * image_from - 0.25 * image_to);
    const double off = std::max(std::abs(middle - 0.5 * (image_from + image_to)), quarter);
    if (off > rules_.off * rules_.size) return false;
    return length < rules_.shortest || off <= rules_.bent * chord;
  }

  const std::function<Complex(double)>& image_;
  const std::function<double(double)>& longest_;
  const CutRules& rules_;
};

/// Halves pieces that are more than kBalance times as long as a neighbor.
std::vector<double> balanced(std::vector<double> cuts, double period, size_t most) {
  for (bool changed = true; changed && cuts.size() < most;) {
    changed = false;
    const size_t n = cuts.size();
    const auto length = [&](size_t i) {
      return i + 1 < n ? cuts[i + 1] - cuts[i] : cuts[0] + period - cuts[i];
    };
    std::vector<double> finer;
    for (size_t i = 0; i < n; ++i) {
      finer.push_back(cuts[i]);
      const double least = std::min(length((i + 1) % n), length((i + n - 1) % n));
      if (length(i) > kBalance * least && least > 0) {
        finer.push_back(cuts[i] + 0.5 * length(i));
        changed = true;
      }
    }
    cuts = std::move(finer);
  }
  return cuts;
}

}  // namespace

std::vector<double> graded_cuts(const std::vector<double>& kept,
                                const std::function<Complex(double)>& image,
                                const std::function<double(double)>& longest,
                                const CutRules& rules) {
  const Cutter cutter(image, longest, rules);
  std::vector<double> cuts;
  for (size_t i = 0; i < kept.size(); ++i) {
    const double from = kept[i], to = i + 1 < kept.size() ? kept[i + 1] : kept[0] + rules.length;
    cuts.push_back(from);
    cutter.halve(from, image(from), to, image(to), cuts);
  }
  return balanced(std::move(cuts), rules.length, rules.most);
}

}  // namespace holomorph
