// Compositing of layers: opaque pixels and pixels of a single layer are exact, and the order is
// that of the stack.

#include "core/error.h"
#include "raster/compose.h"
#include "raster/layered_picture.h"
#include "raster/picture.h"
#include "scene/attachments.h"
#include "scene/keyframes.h"
#include "scene/layers.h"
#include "support/catch.h"
#include "support/pictured_layers.h"
#include "support/scenes.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::layers_raster_test {

namespace {

Scene moved(Scene scene, Complex by) {
  Deformation deformation = scene.deformation();
  for (Points& segment : deformation.pose.segments)
    for (Complex& z : segment) z += by;
  return with_deformation(std::move(scene), std::move(deformation));
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
