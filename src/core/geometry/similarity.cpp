// The similarity maps one centroid to the other, and the factor is a quotient of sums of products.
#include "core/geometry/similarity.h"

#include "core/error.h"

namespace holomorph {

Similarity similarity_between(std::span<const Complex> from, std::span<const Complex> to) {
  check(!from.empty() && from.size() == to.size(), "similarity_between: equal numbers of points");
  Similarity s{1, 0, 0};
  for (size_t i = 0; i < from.size(); ++i) s.from += from[i], s.to += to[i];
  s.from /= static_cast<double>(from.size());
  s.to /= static_cast<double>(from.size());
  Complex together = 0;
  double extent = 0;
  for (size_t i = 0; i < from.size(); ++i) {
    together += std::conj(from[i] - s.from) * (to[i] - s.to);
    extent += std::norm(from[i] - s.from);
  }
  if (std::abs(together) > 1e-12 * extent) s.factor = together / extent;
  return s;
}

}  // namespace holomorph
