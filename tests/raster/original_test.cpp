// The background that shows the pictures as they were: it fills gaps, and changes nothing else.

#include "scene/original.h"
#include "raster/compose.h"
#include "raster/picture.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/pictured_layers.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::original_test {
namespace {

/// Four layers of noise with random ink, placements and attachments. The lowest one is edited.
struct NoisyLayers {
  Image edited;
  Pictures pictures;
  Scene scene;

  /// The cages of placed boxes are moved and turned, and bent if `bend` is not 0, in pixels.
  NoisyLayers(std::mt19937& random, double bend) {
    const auto byte = [&] { return static_cast<std::uint8_t>(random() % 256); };
    const auto chance = [&](unsigned percent) { return random() % 100 < percent; };
    const auto length = [&] { return static_cast<double>(random() % 4000) / 100 - 20; };
    std::vector<Layer> layers;
    for (int i = 0; i < 4; ++i) {
      Image image(20, 16);
      for (std::uint8_t& value : image.pixels) value = byte();
      Layer layer;
      layer.id = i + 1;
      layer.image = reference(("p" + std::to_string(i)).c_str());
      layer.opacity = chance(50) ? 1 : 0.3;
      layer.blending = static_cast<Blending>(random() % kBlendingNames.size());
      layer.clipped = i > 0 && chance(40);
      const double size = chance(50) ? 1 : 1.4, turn = length();
      layer.placement = {std::polar(size, turn), 0, 20.0 * random_complex(random)};
      if (i == 0 && chance(50)) {  // a cage inside the picture, at rest
        layer.deformation = with_cage({}, {{4.3, 3.1}, {15.6, 4.2}, {14.1, 12.7}, {5.2, 13.4}});
      } else if (i > 0 && chance(60)) {
        layer.deformation = with_cage({}, shapes::rectangle(20, 16));
        const Complex factor = std::polar(1.2, length()), by = 20.0 * random_complex(random);
        for (Points& segment : layer.deformation.pose.segments)
          for (Complex& z : segment) z = factor * z + by + bend * random_complex(random);
      }
      if (i > 0 && chance(40)) layer.attachment = Attachment{i, Attachment::To::place, 0, {4, 4}};
      pictures.put(*layer.image, {std::make_shared<const Image>(image), ""});
      if (i == 0) edited = image;
      layers.push_back(std::move(layer));
    }
    scene.layers = shared(std::move(layers));
  }
  RasterResult drawn(Background::Fill background, const PictureOptions& options = {}) {
    scene.background.fill = background;
    return picture_of(scene, &edited, options, pictures);
  }
};

PictureOptions around_the_origin() {
  PictureOptions options;
  options.region = Box{-90, -90, 90, 90};
  return options;
}

}  // namespace

TEST_CASE("The original behind layers that are not bent changes nothing, wherever they lie") {
  for (const unsigned seed : seeds_of("unbent layers", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    NoisyLayers layers(random, 0);
    const RasterResult plain = layers.drawn(Background::Fill::transparent),
                       behind = layers.drawn(Background::Fill::original);
    CHECK(std::abs(plain.corner - behind.corner) < 1e-9);
    // Among many, there is a pixel whose center is on an edge; it may be drawn or not.
    CHECK(farthest_apart(plain.image, behind.image, soaks() ? 2 : 0) <= 2);
    // Where a layer is bent, its original lies where it was placed.
    Layer still = *layers.scene.layers[0], far = still;
    still.deformation = {};
    far.deformation = with_cage({}, shapes::rectangle(20, 16));
    for (Points& segment : far.deformation.pose.segments)
      for (Complex& z : segment) z = {z.real() + 0.2 * z.imag() + 400, z.imag()};
    const auto alone = [&](Layer layer) {
      Scene one = scene_of(std::move(layer));
      one.background.fill = Background::Fill::original;
      return picture_of(one, &layers.edited, around_the_origin(), layers.pictures);
    };
    const Image there = alone(still).image, left = alone(far).image;
    CHECK(farthest_apart(left, there) <= 1);
  }
}

TEST_CASE("The original shows more of itself the more a placed picture is bent, without a jump") {
  const std::vector<unsigned> seeds = seeds_of("bent boxes", {1, 2, 3, 4, 5, 6, 7, 8});
  double near = 0, far = 0;
  for (const unsigned seed : seeds) {
    INFO("seed " << seed);
    const auto filled_by = [&](double bend) {
      std::mt19937 random(seed);
      NoisyLayers layers(random, bend);
      const Image plain = layers.drawn(Background::Fill::transparent, around_the_origin()).image,
                  all = layers.drawn(Background::Fill::original, around_the_origin()).image;
      long sum = 0;
      for (size_t i = 3; i < all.pixels.size(); i += 4) sum += all.pixels[i] - plain.pixels[i];
      return static_cast<double>(sum) / 255;  // in opaque pixels
    };
    CHECK(filled_by(1e-3) < 2);
    // A tenth of a pixel along the edges of three boxes, which are at most 121 pixels long each.
    const double a_little = filled_by(0.1);
    CHECK(a_little < 0.1 * 2 * 3 * 121);
    near += a_little;
    far += filled_by(6);
  }
  if (seeds.size() > 4) CHECK(far > 10 * near);
}

TEST_CASE("Only boxes place pictures, as they lie at their corners") {
  Deformation box = with_cage({}, shapes::rectangle(200, 120));
  const auto placed = [](const Deformation& deformation) {
    const auto prepared = prepared_map(deformation, Precision::single, {});
    const SampledMap map = prepared->deformer->deform(pose_of(deformation), {false});
    return placing_motion(deformation, {0, 0, 200, 120}, *prepared->mesh, as_span(map.f));
  };
  const auto is_near = [](const std::optional<Similarity>& a, const Similarity& b) {
    REQUIRE(a.has_value());
    return std::abs(a->factor - b.factor) < 1e-4 && std::abs((*a)({0, 0}) - b({0, 0})) < 1e-2 * 200;
  };
  const Similarity by{{0.3, 1.1}, 0, {40, -7}};
  Deformation moved = box;
  for (Points& segment : moved.pose.segments)
    for (Complex& z : segment) z = by(z);
  CHECK(is_near(placed(moved), by));
  Deformation mirrored = box;
  for (Points& segment : mirrored.pose.segments)
    for (Complex& z : segment) z = {200 - z.real(), z.imag()};
  CHECK_FALSE(placed(mirrored).has_value());
  // A pin that moves within a held frame bends the picture, and does not move it.
  Deformation held = box;
  held.method = "sheet";
  held.frame = Frame::fixed;
  held.pins = {{{60, 60}, {110, 75}, {}, {}}};
  CHECK(is_near(placed(held), {}));
  Deformation outline = with_cage({}, {{20, 10}, {180, 20}, {150, 110}});
  for (Points& segment : outline.pose.segments)
    for (Complex& z : segment) z = by(z);
  CHECK(is_near(placed(outline), {}));
}

TEST_CASE("The rectangle of a film contains the originals, wherever they move") {
  for (const unsigned seed : seeds_of("rectangles with originals", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    NoisyLayers layers(random, 4);
    for (size_t i = 1; i < 4; ++i) {
      Layer layer = *layers.scene.layers[i];
      if (!layer.deformation.has_cage()) continue;
      layer.deformation = with_key(layer.deformation, 0);
      const Complex factor = std::polar(1.3, 3 * random_complex(random).real()),
                    by = 30.0 * random_complex(random);
      for (Points& segment : layer.deformation.pose.segments)
        for (Complex& z : segment) z = factor * z + by + 5.0 * random_complex(random);
      layer.deformation = with_key(layer.deformation, 1);
      layers.scene = with_layer_at(layers.scene, i, layer);
    }
    layers.scene.background.fill = Background::Fill::original;
    const auto region = PictureMaker(layers.scene, &layers.edited, layers.pictures).motion_region();
    REQUIRE(region.has_value());
    for (const double time : {0.0, 0.21, 0.5, 0.83, 1.0}) {
      PictureOptions options;
      options.time = time;
      const RasterResult drawn = layers.drawn(Background::Fill::original, options);
      const Box box = filled_box(drawn, 1);
      CHECK(box.left > region->left - 1);
      CHECK(box.bottom > region->bottom - 1);
      CHECK(box.right < region->right + 1);
      CHECK(box.top < region->top + 1);
    }
  }
}

TEST_CASE("Opaque originals look the same whole as cut to the gaps") {
  TwoLayers two;
  for (size_t i = 0; i < 2; ++i) {
    Layer layer = *two.scene.layers[i];
    const double size = i == 0 ? 2 : 1;  // of a cage inside the picture
    layer.deformation =
        with_cage({}, {size * Complex(4, 3), size * Complex(26, 4), size * Complex(23, 17)});
    layer.deformation.pose.segments[2][0] += Complex(-9, 5);
    two.scene = with_layer_at(two.scene, i, layer);
  }
  const Scene plain = two.scene;
  two.scene.background.fill = Background::Fill::original;
  PictureOptions options;
  options.region = Box{-5, -5, 75, 55};
  PictureMaker maker(two.scene, &two.blue, two.pictures);
  LayerStack whole(1, Originals::whole), cut(1, Originals::in_gaps);
  for (LayerStack* stack : {&whole, &cut})
    for (size_t i = 0; i < 2; ++i)
      stack->add(*maker.layer(i, options), {}, maker.original(i, options));
  const Image all = std::move(whole).result().image;
  CHECK(maker.has_opaque_originals({}));
  CHECK(farthest_apart(all, std::move(cut).result().image) <= 1);
  CHECK(farthest_apart(all, picture_of(plain, &two.blue, options, two.pictures).image) > 100);
}

TEST_CASE("Layers blend with one another, and not with the original behind them") {
  const std::vector<unsigned> seeds = seeds_of("blended layers", {1, 2, 3, 4, 5, 6, 7, 8});
  int with_gaps = 0;
  for (const unsigned seed : seeds) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    NoisyLayers layers(random, 6);
    const Image plain = layers.drawn(Background::Fill::transparent, around_the_origin()).image,
                all = layers.drawn(Background::Fill::original, around_the_origin()).image;
    int least = 0, most = 0, filled = 0;  // what the original adds, beyond what its alpha allows
    for (size_t i = 0; i < all.pixels.size(); i += 4) {
      const int alpha = all.pixels[i + 3], covered = plain.pixels[i + 3];
      filled += alpha > covered;
      for (size_t k = 0; k < 3; ++k) {
        const int added = (all.pixels[i + k] * alpha - plain.pixels[i + k] * covered) / 255;
        least = std::min(least, added);
        most = std::max(most, added - (alpha - covered));
      }
    }
    CHECK(least >= -2);
    CHECK(most <= 2);
    with_gaps += filled > 100;
  }
  if (seeds.size() > 4) CHECK(with_gaps > 2);
}

TEST_CASE("A faint layer that is not bent lies once on what fills the gaps of the others") {
  for (const unsigned seed : seeds_of("faint layers above gaps", {1, 2, 3, 4, 5, 6})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    NoisyLayers layers(random, 6);
    Layer lowest = *layers.scene.layers[0];
    lowest.placement = {};  // so that all pictures have the same rows of pixels
    layers.scene = with_layer_at(layers.scene, 0, lowest);
    const RasterResult below = layers.drawn(Background::Fill::original, around_the_origin());
    Scene faint = scene_of(Layer{});
    change_layer(faint, [](Layer& layer) {
      layer.id = 9;
      layer.image = reference("p1");
      layer.placement = {2, 0, {-5, -9}};
      layer.opacity = 0.4;
    });
    const RasterResult alone = picture_of(
        faint, layers.pictures.find(*faint.layer().image)->image.get(), around_the_origin());
    layers.scene.layers.push_back(faint.layers[0]);
    CHECK(farthest_apart(layers.drawn(Background::Fill::original, around_the_origin()).image,
                         composed(below, alone, 1).image) <= 2);
  }
}

}  // namespace holomorph::original_test
