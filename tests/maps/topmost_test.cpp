// What the inverse calls the topmost point is what is drawn there.
#include "core/mesh/locator.h"
#include "scene/keyframes.h"
#include "scene/prepared_map.h"
#include "scene/timed_map.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::topmost_test {
namespace {

/// A bar that its pins bend into a ring, so that its ends lie on each other, with random depths.
Deformation random_ring(const std::string& method, std::mt19937& random) {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(shapes::rectangle(600, 100));
  deformation.method = method;
  const double turn = (random() % 2 ? 1 : -1) * (1.5 + 0.2 * random_complex(random).real());
  for (const double time : {0.0, 1.0}) {
    Complex place(60, 50), step(120, 0);
    for (size_t i = 0; i < 5; ++i, place += step) {
      const Complex rest(60 + 120.0 * static_cast<double>(i), 50);
      if (time == 0) deformation.pins.push_back({rest, rest, {}, {}});
      Pin& pin = deformation.pins[i];
      if (time == 0 && random() % 2) pin.depth = static_cast<int>(random() % 5) - 2;
      pin.pose = place + 8.0 * random_complex(random);
      step *= std::polar(1.0, turn);
    }
    deformation.keyframes.push_back({time, whole_pose_of(deformation), Ease::linear});
  }
  return deformation;
}

void check_topmost(std::initializer_list<const char*> methods) {
  int total = 0;
  for (const unsigned seed : seeds_of("topmost preimages", {1}))
    for (const char* method : methods) {
      INFO(method << ", seed " << seed);
      std::mt19937 random(seed);
      const Deformation deformation = random_ring(method, random);
      TimedMap timed(deformation);
      const std::shared_ptr<const Mesh> drawn =
          drawn_mesh(timed.prepared().mesh, timed.frame(0).deformation);
      int overlaps = 0, others = 0;
      for (const double time : {0.0, 0.4}) {
        const TimedFrame frame = timed.frame(time);
        const VectorXc f = timed.on_mesh(frame).f;
        const auto inverse = timed.inverse(frame);
        REQUIRE(inverse);
        const Box box = box_of(as_span(f));
        Points points;
        for (int k = 0; k < 150; ++k) {
          const Complex z = 0.5 * (random_complex(random) + Complex(1, 1));
          points.emplace_back(box.left + box.width() * z.real(),
                              box.bottom + box.height() * z.imag());
        }
        const auto found = inverse->at(points);
        for (size_t k = 0; k < points.size(); ++k) {
          if (found[k].size() < 2) continue;
          std::optional<Complex> top;  // of the triangle that is drawn last
          for (const Triangle& t : drawn->triangles) {
            const Complex a = f[t[0]] - points[k], b = f[t[1]] - points[k], c = f[t[2]] - points[k];
            const double wa = cross(b, c), wb = cross(c, a), wc = cross(a, b), all = wa + wb + wc;
            if (all == 0 || std::min({wa / all, wb / all, wc / all}) < 0) continue;
            top = (wa * drawn->vertices[static_cast<size_t>(t[0])] +
                   wb * drawn->vertices[static_cast<size_t>(t[1])] +
                   wc * drawn->vertices[static_cast<size_t>(t[2])]) /
                  all;
          }
          if (!top) continue;
          ++overlaps;
          others += std::abs(found[k][0].z - *top) > 20;
        }
      }
      INFO(overlaps << " points on overlaps");
      total += overlaps;
      CHECK(others <= overlaps / 20);  // at the edge of what lies on top
    }
  CHECK(total > 10);
}

}  // namespace

TEST_CASE("The topmost preimage is the one that is drawn, with depths and limbs in front") {
  check_topmost({"sheet", "puppet", "pins"});
}

TEST_CASE("The topmost preimage is the one that is drawn: as rigid as possible") {
  check_topmost({"arap"});
}
}  // namespace holomorph::topmost_test
