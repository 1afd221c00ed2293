// Compositing of layers: opaque pixels and pixels of a single layer are exact, and the order is
// that of the stack.

#include "core/error.h"
#include "raster/compose.h"
#include "raster/layered_picture.h"
#include "raster/picture.h"
#include "scene/attachments.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "scene/original.h"
#include "scene/prepared_map.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::layers_raster_test {

namespace {

using Pixel = std::array<std::uint8_t, 4>;

Image filled(int width, int height, Pixel pixel) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = pixel[i % 4];
  return image;
}

Pixel pixel_at(const Image& image, int column, int row) {
  const std::uint8_t* p = image.at(column, row);
  return {p[0], p[1], p[2], p[3]};
}

ImageReference reference(const char* file) {
  ImageReference named;
  named.file = file;
  return named;
}

/// One picture over another.
RasterResult composed(const RasterResult& under, const RasterResult& over, double pixels_per_unit,
                      const LayerInk& ink = {}) {
  Composition all(pixels_per_unit);
  all.add(under);
  all.add(over, ink);
  return std::move(all).result();
}

constexpr Pixel kRed{255, 0, 0, 255}, kBlue{0, 0, 255, 255}, kNothing{0, 0, 0, 0};

/// A red picture of 60 x 40 below a blue one of 30 x 20, which is the edited layer. Both have a
/// cage.
struct TwoLayers {
  Image blue = filled(30, 20, kBlue);
  Pictures pictures;
  Scene scene;

  TwoLayers() {
    const auto named = [](const char* file, double width, double height) {
      Layer layer;
      layer.image = reference(file);
      layer.deformation = with_cage({}, shapes::rectangle(width, height));
      return scene_of(std::move(layer));
    };
    pictures.put(reference("red"), {std::make_shared<const Image>(filled(60, 40, kRed)), ""});
    scene = with_layers_added(named("red", 60, 40), named("blue", 30, 20));
  }
  RasterResult drawn(const PictureOptions& options = {}) const {
    return picture_of(scene, &blue, options, pictures);
  }
};

Scene moved(Scene scene, Complex by) {
  Deformation deformation = scene.deformation();
  for (Points& segment : deformation.pose.segments)
    for (Complex& z : segment) z += by;
  return with_deformation(std::move(scene), std::move(deformation));
}

/// The largest difference of what can be seen of two pictures, but for a few pixels.
int farthest_apart(const Image& a, const Image& b, size_t but_for = 0) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  std::vector<int> differences(a.pixels.size() / 4);
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const int difference = std::abs(a.pixels[i] * (i % 4 == 3 ? 255 : a.pixels[i | 3]) -
                                    b.pixels[i] * (i % 4 == 3 ? 255 : b.pixels[i | 3])) /
                           255;
    differences[i / 4] = std::max(differences[i / 4], difference);
  }
  std::ranges::sort(differences, std::greater());
  return differences[but_for];
}

}  // namespace

TEST_CASE("The upper layer covers the lower one in its own rectangle, and nothing else changes") {
  TwoLayers two;
  const Image image = two.drawn().image;
  REQUIRE(image.width == 60);
  REQUIRE(image.height == 40);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 60; ++column)
      REQUIRE(pixel_at(image, column, row) == (column < 30 && row >= 20 ? kBlue : kRed));
  two.scene = with_layer_moved(two.scene, 0);
  CHECK(two.drawn().image == filled(60, 40, kRed));
}

TEST_CASE("A layer outside the lowest picture's rectangle enlarges the result, except with crop") {
  TwoLayers two;
  two.scene = moved(two.scene, {-10, 30});
  const RasterResult result = two.drawn();
  CHECK(result.image.width == 70);
  CHECK(result.image.height == 50);
  CHECK(result.corner == Complex(-10, 0));
  CHECK(pixel_at(result.image, 0, 0) == kBlue);
  CHECK(pixel_at(result.image, 0, 49) == kNothing);
  CHECK(pixel_at(result.image, 69, 49) == kRed);
  PictureOptions crop;
  crop.crop = true;
  const Image cropped = two.drawn(crop).image;
  CHECK(cropped.width == 60);
  CHECK(cropped.height == 40);
  CHECK(pixel_at(cropped, 0, 0) == kBlue);
  CHECK(pixel_at(cropped, 30, 0) == kRed);
}

TEST_CASE("Hidden layers are not drawn, and a scene with only hidden layers is an error") {
  TwoLayers two;
  change_layer(two.scene, [](Layer& layer) { layer.visible = false; });
  CHECK(two.drawn().image == filled(60, 40, kRed));
  Layer state = *two.scene.layers[0];
  state.visible = false;
  two.scene = with_layer_at(two.scene, 0, state);
  CHECK_THROWS_AS(two.drawn(), Error);
  change_layer(two.scene, [](Layer& layer) { layer.visible = true; });
  CHECK(two.drawn().image == two.blue);
}

TEST_CASE("The background shows through where no layer is") {
  TwoLayers two;
  Layer state = *two.scene.layers[0];
  state.visible = false;
  two.scene = moved(with_layer_at(two.scene, 0, state), {40, 0});
  CHECK(pixel_at(two.drawn().image, 0, 0) == kNothing);
  two.scene.background = {Background::Fill::color, {9, 8, 7}};
  CHECK(pixel_at(two.drawn().image, 0, 0) == Pixel{9, 8, 7, 255});
  CHECK(pixel_at(two.drawn().image, 69, 0) == kBlue);
  two.scene.background.fill = Background::Fill::original;
  // Also above a hidden layer, a picture that is moved leaves nothing behind.
  CHECK(pixel_at(two.drawn().image, 0, 0) == kNothing);
  // The same holds in a scene with one layer.
  Scene alone = moved(scene_of(with_cage({}, shapes::rectangle(30, 20))), {40, 0});
  alone.background = {Background::Fill::original};
  const Image both = picture_of(alone, &two.blue).image;
  CHECK(pixel_at(both, 0, 0) == kBlue);
  CHECK(pixel_at(both, 69, 0) == kBlue);
  CHECK(pixel_at(both, 35, 0) == kNothing);
}

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

TEST_CASE("The original behind layers that are not bent changes nothing, wherever they lie") {
  for (const unsigned seed : seeds_of("unbent layers", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    NoisyLayers layers(random, 0);
    const RasterResult plain = layers.drawn(Background::Fill::transparent),
                       behind = layers.drawn(Background::Fill::original);
    CHECK(std::abs(plain.corner - behind.corner) < 1e-9);
    // Pixels whose centers are on an edge may be drawn or not.
    CHECK(farthest_apart(plain.image, behind.image, 2) <= 2);
    CHECK(farthest_apart(plain.image, behind.image) <= 30);
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

TEST_CASE("Views of the map show only the edited layer") {
  const TwoLayers two;
  PictureOptions options;
  options.view = View::checker;
  CHECK(two.drawn(options).image.width == 30);
}

TEST_CASE("Blended pixels are the mean of their colors, weighted by their visible parts") {
  RasterResult under{filled(2, 1, {200, 100, 0, 255}), 0}, over{filled(2, 1, {0, 100, 200, 51}), 0};
  const Image opaque = composed(under, over, 1).image;
  CHECK(pixel_at(opaque, 0, 0) == Pixel{160, 100, 40, 255});
  under.image = filled(2, 1, {200, 100, 0, 102});
  const Pixel half = pixel_at(composed(under, over, 1).image, 1, 0);
  CHECK(half[3] == 133);  // 51 + 102 * 0.8
  CHECK(half[0] == 123);  // 200 * 81.6 / 132.6
  under.image = filled(2, 1, {1, 2, 3, 0});
  CHECK(composed(under, over, 1).image == over.image);
  over.image = filled(2, 1, {1, 2, 3, 0});
  under.image = filled(2, 1, {200, 100, 0, 102});
  CHECK(composed(under, over, 1).image == under.image);
}

TEST_CASE("Layers with different heights share one pixel grid at any scale") {
  const TwoLayers two;
  PictureOptions options;
  options.scale = 0.37;
  const Image image = two.drawn(options).image;
  CHECK(image.width == 23);  // 22.2
  CHECK(image.height == 15);
  CHECK(pixel_at(image, 1, 12) == kBlue);
  CHECK(pixel_at(image, 20, 2) == kRed);
}

TEST_CASE("Where a picture overlaps itself, the part of the higher pin is on top") {
  // A bar, red on the left and blue on the right, whose pins fold it back onto itself.
  Image bar = filled(300, 40, kRed);
  for (int row = 0; row < 40; ++row)
    for (int column = 150; column < 300; ++column)
      std::copy(kBlue.begin(), kBlue.end(), bar.at(column, row));
  Deformation deformation = with_cage({}, shapes::rectangle(300, 40));
  deformation.method = "arap";
  deformation.pins = {{{10, 20}, {10, 20}, {}, {}},
                      {{120, 20}, {120, 20}, {}, {}},
                      {{180, 20}, {120, 80}, {}, {}},
                      {{290, 20}, {60, 20}, {}, {}}};
  const auto seen = [&](int left, int right) {
    deformation.pins[0].depth = deformation.pins[1].depth = left;
    deformation.pins[2].depth = deformation.pins[3].depth = right;
    const RasterResult result = picture_of(scene_of(deformation), &bar);
    const int row = result.image.height - 1 - static_cast<int>(20 - result.corner.imag());
    return pixel_at(result.image, static_cast<int>(60 - result.corner.real()), row);
  };
  CHECK(seen(0, 5) == kBlue);
  CHECK(seen(5, 0) == kRed);
  CHECK(seen(0, -5) == kRed);
}

TEST_CASE("Cropping to the filled area keeps every pixel and its place in the plane") {
  for (const unsigned seed : seeds_of("filled area", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    RasterResult result{Image(30, 20), Complex(3, -2)};
    const double scale = 0.5 + static_cast<double>(random() % 4);
    for (int i = 0; i < 4; ++i)
      result.image.at(static_cast<int>(random() % 30), static_cast<int>(random() % 20))[3] =
          static_cast<std::uint8_t>(1 + random() % 255);
    const RasterResult cropped = cropped_to_filled(result, scale);
    const Box box = filled_box(result, scale);
    CHECK(std::abs(cropped.corner - Complex(box.left, box.bottom)) < 1e-9);
    CHECK(cropped.image.width == Approx(box.width() * scale));
    CHECK(cropped.image.height == Approx(box.height() * scale));
    const RasterResult again = composed({Image(30, 20), result.corner}, cropped, scale);
    CHECK(again.image == result.image);
    const Box same = filled_box(cropped, scale);
    CHECK(std::abs(same.left - box.left) + std::abs(same.top - box.top) < 1e-9);
  }
  CHECK(cropped_to_filled({Image(4, 3), 0}, 1).image == Image(4, 3));
}

namespace {

/// The mode's result for colors from 0 to 1, in floating point.
double mixed(Blending mode, double over, double under) {
  switch (mode) {
    case Blending::multiply:
      return over * under;
    case Blending::screen:
      return 1 - (1 - over) * (1 - under);
    case Blending::overlay:
      return under < 0.5 ? 2 * over * under : 1 - 2 * (1 - over) * (1 - under);
    case Blending::add:
      return std::min(1.0, over + under);
    case Blending::normal:
      break;
  }
  return over;
}

}  // namespace

TEST_CASE("Opacity and blending modes agree with the formulas of the W3C") {
  for (const unsigned seed : seeds_of("blending", {1, 2})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto byte = [&] { return static_cast<std::uint8_t>(random() % 256); };
    for (int mode = 0; mode < 5; ++mode) {
      INFO(kBlendingNames[static_cast<size_t>(mode)]);
      Layer layer;
      layer.blending = static_cast<Blending>(mode);
      layer.opacity = static_cast<double>(random() % 256) / 255;
      Image over(40, 10), under(40, 10);
      for (std::uint8_t& value : over.pixels) value = byte();
      for (std::uint8_t& value : under.pixels) value = byte();
      const Image result = composed({under, 0}, {over, 0}, 1, ink_of(scene_of(layer), 0)).image;
      double farthest = 0;
      for (int i = 0; i < 400; ++i) {
        const Pixel o = pixel_at(over, i % 40, i / 40), u = pixel_at(under, i % 40, i / 40),
                    r = pixel_at(result, i % 40, i / 40);
        const double a = layer.opacity * o[3] / 255, b = u[3] / 255.0, all = a + b - a * b;
        farthest = std::max(farthest, std::abs(r[3] / 255.0 - all));
        for (size_t k = 0; k < 3 && all > 0; ++k) {
          const double cs = o[k] / 255.0, cb = u[k] / 255.0,
                       wanted = (a * (1 - b) * cs + b * (1 - a) * cb +
                                 a * b * mixed(layer.blending, cs, cb)) /
                                all;
          // Premultiplied, because colors of nearly transparent pixels cannot be seen.
          farthest = std::max(farthest, all * std::abs(r[k] / 255.0 - wanted));
        }
      }
      CHECK(farthest <= 0.5001 / 255);  // rounded once
    }
  }
}

TEST_CASE("Many faint layers add up as they do without rounding") {
  for (const unsigned seed : seeds_of("faint layers", {1, 2})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Composition all(1);
    std::array<double, 4> exact{};  // premultiplied
    for (int i = 0; i < 60; ++i) {
      Pixel pixel;
      for (std::uint8_t& value : pixel) value = static_cast<std::uint8_t>(random() % 256);
      const LayerInk ink{static_cast<unsigned>(1 + random() % 12)};
      all.add({filled(3, 2, pixel), 0}, ink);
      const double a = pixel[3] / 255.0 * ink.opacity / 255;
      for (size_t k = 0; k < 4; ++k)
        exact[k] = (k < 3 ? pixel[k] / 255.0 : 1) * a + (1 - a) * exact[k];
    }
    const Pixel seen = pixel_at(std::move(all).result().image, 1, 1);
    CHECK(std::abs(seen[3] - 255 * exact[3]) <= 0.51);
    for (size_t k = 0; k < 3; ++k) CHECK(std::abs(seen[k] - 255 * exact[k] / exact[3]) <= 0.51);
  }
}

TEST_CASE("A clipped layer is drawn only where its base is, and does not show through it") {
  for (const unsigned seed : seeds_of("clipping", {1, 2, 3, 4, 5, 6})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    Image images[4] = {Image(20, 10), Image(20, 10), Image(20, 10), Image(30, 30)};
    for (Image& image : images)
      for (std::uint8_t& value : image.pixels) value = static_cast<std::uint8_t>(random() % 256);
    const auto mode = static_cast<Blending>(random() % kBlendingNames.size());
    INFO(kBlendingNames[static_cast<size_t>(mode)]);
    const LayerInk base{200, Blending::multiply}, clipped{150, mode, true};
    Composition all(1);
    all.add({images[0], 0});
    all.add({images[1], 0}, base);
    all.add({images[3], Complex(-4, -9)}, clipped);
    // The same with the base and what is clipped to it as one layer.
    Composition group(1);
    Image atop = images[1];
    for (int r = 0; r < 10; ++r)
      for (int c = 0; c < 20; ++c) {
        const std::uint8_t* over = images[3].at(c + 4, r + 11);
        std::uint8_t* pixel = atop.at(c, r);
        const double a = over[3] / 255.0 * 150 / 255;
        for (int k = 0; k < 3; ++k) {
          const double cs = over[k] / 255.0, cb = pixel[k] / 255.0;
          pixel[k] = static_cast<std::uint8_t>(
              std::lround(255 * (a * mixed(mode, cs, cb) + (1 - a) * cb)));
        }
      }
    group.add({images[0], 0});
    group.add({atop, 0}, base);
    const Image seen = std::move(all).result().image, wanted = std::move(group).result().image;
    REQUIRE(seen.width == 20);
    REQUIRE(seen.height == 10);
    int farthest = 0;
    for (size_t i = 0; i < seen.pixels.size(); ++i)
      if (seen.pixels[i | 3] > 64)
        farthest = std::max(farthest, std::abs(seen.pixels[i] - wanted.pixels[i]));
    CHECK(farthest <= 1);
  }
}

TEST_CASE("Clipped layers draw no fringes: the colors do not depend on how soft the base is") {
  for (const unsigned seed : seeds_of("soft bases", {1, 2, 3})) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (size_t mode = 0; mode < kBlendingNames.size(); ++mode) {
      INFO(kBlendingNames[mode]);
      // A column for each alpha of a base of one color, with two layers of one color atop.
      Pixel ground, lower, upper;
      for (Pixel* pixel : {&ground, &lower, &upper})
        for (std::uint8_t& value : *pixel) value = static_cast<std::uint8_t>(random() % 256);
      Image base(256, 1);
      for (int alpha = 0; alpha < 256; ++alpha) {
        std::copy(ground.begin(), ground.end(), base.at(alpha, 0));
        base.at(alpha, 0)[3] = static_cast<std::uint8_t>(alpha);
      }
      Composition all(1);
      all.add({base, 0});
      for (const Pixel& pixel : {lower, upper})
        all.add({filled(256, 1, pixel), 0},
                {static_cast<unsigned>(random() % 256), static_cast<Blending>(mode), true});
      const Image seen = std::move(all).result().image;
      const Pixel opaque = pixel_at(seen, 255, 0);
      for (int alpha = 1; alpha < 255; ++alpha) {
        const Pixel here = pixel_at(seen, alpha, 0);
        REQUIRE(here[3] == alpha);
        for (size_t k = 0; k < 3; ++k) REQUIRE(std::abs(here[k] - opaque[k]) <= 1);
      }
    }
  }
}

TEST_CASE("A layer clipped to a hidden one is hidden, and the lowest layer cannot be clipped") {
  TwoLayers two;
  Layer upper = *two.scene.layers[1], lower = *two.scene.layers[0];
  upper.clipped = lower.clipped = true;
  Scene scene = with_layer_at(with_layer_at(two.scene, 0, lower), 1, upper);
  const Image plain = two.drawn().image;
  two.scene = scene;
  CHECK(two.drawn().image == plain);  // both have nothing to be clipped to
  lower.clipped = false;
  two.scene = moved(with_layer_at(scene, 0, lower), {-10, 0});
  const Image clipped = two.drawn().image;
  CHECK(clipped.width == 60);
  CHECK(pixel_at(clipped, 0, 39) == kBlue);
  CHECK(pixel_at(clipped, 20, 39) == kRed);
  lower.visible = false;
  two.scene = with_layer_at(two.scene, 0, lower);
  CHECK_THROWS_AS(two.drawn(), Error);
}

TEST_CASE("The layers of a posed scene make its picture") {
  TwoLayers two;
  two.scene = moved(two.scene, {-10, 30});
  change_layer(two.scene, [](Layer& layer) {
    layer.opacity = 0.5;
    layer.name = "upper";
  });
  two.scene.background = {Background::Fill::color, {9, 8, 7}};
  const LayeredPicture layered = layered_picture_of(two.scene, &two.blue, {}, two.pictures);
  CHECK(layered.merged == two.drawn().image);
  CHECK(layered.background == two.scene.background.color);
  REQUIRE(layered.layers.size() == 2);
  CHECK(layered.layers[0].image == filled(60, 40, kRed));
  CHECK(layered.layers[0].left == 10);
  CHECK(layered.layers[0].top == 10);
  CHECK(layered.layers[1].image == two.blue);
  CHECK(layered.layers[1].left == 0);
  CHECK(layered.layers[1].top == 0);
  CHECK(layered.layers[1].opacity == 0.5);
  CHECK(layered.layers[1].name == "upper");
}

TEST_CASE("Drawing layers stops when keep_going throws, even while a drawing is being bent") {
  TwoLayers two;
  std::string circles;
  for (int i = 0; i < 30; ++i)
    circles += "<circle r='5' cx='" + std::to_string(2 * i) + "' cy='" + std::to_string(i) + "'/>";
  const auto drawing = std::make_shared<const std::string>(
      "<svg xmlns='http://www.w3.org/2000/svg' width='60' height='40'>" + circles + "</svg>");
  two.pictures.put(reference("red"),
                   {std::make_shared<const Image>(filled(60, 40, kRed)), "", {}, {}, drawing});
  change_layer(two.scene, [](Layer& layer) { layer.visible = false; });
  struct Run {
    int calls = 0;
    bool stopped = false;
  };
  const auto run_until = [&](int most) {
    struct Stopped {};
    Run run;
    try {
      layered_picture_of(two.scene, &two.blue, {}, two.pictures, true, [&] {
        if (++run.calls == most) throw Stopped{};
      });
    } catch (Stopped) {
      run.stopped = true;
    }
    return run;
  };
  const int all = run_until(0).calls;
  constexpr int kBetweenLayers = 3;
  CHECK(all > kBetweenLayers);
  int while_bent = 0;
  for (int most = 1; most < all; ++most) {
    // Other threads may take some of the blocks of points; keep_going is then called less often.
    const Run run = run_until(most);
    CHECK(run.calls <= most);
    CHECK(run.stopped == (run.calls == most));
    while_bent += run.stopped && most > kBetweenLayers;
  }
  CHECK(while_bent > 0);
}

TEST_CASE("The same layer pixels give the same bits, and a faint lowest layer stays faint") {
  const Image red = filled(4, 4, kRed), blue = filled(4, 4, kBlue);
  const LayerInk half{128, Blending::normal};
  const Image once = composed({blue, 0}, {red, 0}, 1, half).image;
  CHECK(composed({blue, 0}, {red, 0}, 1, half).image == once);
  CHECK(pixel_at(once, 1, 1) == Pixel{128, 0, 127, 255});
  Composition lowest(1);
  lowest.add({red, 0}, half);
  const Image faint = std::move(lowest).result().image;
  CHECK(pixel_at(faint, 0, 0) == Pixel{255, 0, 0, 128});
  CHECK(composed({Image(4, 4), 0}, {red, 0}, 1, half).image == faint);
}

namespace {

/// The blue layer attached to the middle of the red one.
TwoLayers attached_layers() {
  TwoLayers two;
  auto [attachment, scene] = attachment_to(two.scene, {0, Attachment::To::place, 0, {30, 20}});
  two.scene = with_attachment(std::move(scene), 1, attachment);
  return two;
}

Scene with_lower_pose(Scene scene, Complex factor, Complex shift) {
  Layer lower = *scene.layers[0];
  for (Points& segment : lower.deformation.pose.segments)
    for (Complex& z : segment) z = factor * z + shift;
  return with_layer_at(std::move(scene), 0, std::move(lower));
}

}  // namespace

TEST_CASE("An attached layer is drawn where its parent takes it") {
  const TwoLayers still = attached_layers();
  const Image at_rest = still.drawn().image;
  CHECK(at_rest == TwoLayers().drawn().image);

  TwoLayers shifted = still;
  shifted.scene = with_lower_pose(still.scene, 1, {7, 11});
  const RasterResult there = shifted.drawn({.region = Box{7, 11, 67, 51}});
  CHECK(there.image == at_rest);

  // A quarter turn exchanges rows and columns.
  TwoLayers turned = still;
  turned.scene = with_lower_pose(still.scene, {0, 1}, {40, 0});
  const Image picture = turned.drawn({.region = Box{0, 0, 40, 60}}).image;
  REQUIRE(picture.width == 40);
  REQUIRE(picture.height == 60);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 60; ++column)
      CHECK(pixel_at(picture, row, 59 - column) == pixel_at(at_rest, column, row));
}

TEST_CASE("A hidden parent still moves what is attached to it") {
  TwoLayers two = attached_layers();
  two.scene = with_lower_pose(two.scene, 1, {5, 3});
  Layer lower = *two.scene.layers[0];
  lower.visible = false;
  two.scene = with_layer_at(two.scene, 0, lower);
  const RasterResult drawn = two.drawn();
  CHECK(drawn.corner == Complex(5, 3));
  CHECK(drawn.image == filled(30, 20, kBlue));
}

TEST_CASE("An attached layer without a cage is carried as a whole, and films have room for it") {
  TwoLayers two = attached_layers();
  Layer upper = *two.scene.layers[1];
  upper.deformation = {};
  two.scene = with_layer_at(two.scene, 1, upper);
  CHECK(two.drawn().image == TwoLayers().drawn().image);

  // The parent turns by a quarter; the layer with it.
  Layer lower = *two.scene.layers[0];
  Deformation& deformation = lower.deformation;
  const Pose rest = whole_pose_of(deformation);
  Pose turned = rest;
  for (Points& segment : turned.cage.segments)
    for (Complex& z : segment) z = Complex(0, 1) * (z - Complex(30, 20)) + Complex(30, 20);
  deformation.keyframes = {{0, rest, Ease::linear}, {1, turned, Ease::linear}};
  two.scene = with_layer_at(two.scene, 0, lower);
  const Box box = *PictureMaker(two.scene, &two.blue, two.pictures).motion_region();
  for (const double time : {0.0, 0.3, 0.5, 0.8, 1.0}) {
    const RasterResult frame = two.drawn({.time = time});
    const RasterResult cut = two.drawn({.region = box, .time = time});
    CHECK(frame.image.width <= cut.image.width);
    CHECK(frame.image.height <= cut.image.height);
    int filled_whole = 0, filled_cut = 0;
    for (const auto& [image, count] :
         {std::pair(&frame.image, &filled_whole), {&cut.image, &filled_cut}})
      for (int r = 0; r < image->height; ++r)
        for (int c = 0; c < image->width; ++c) *count += image->at(c, r)[3] > 0;
    CHECK(std::abs(filled_whole - filled_cut) < 8);  // partly filled pixels at the edges
  }
}

}  // namespace holomorph::layers_raster_test
