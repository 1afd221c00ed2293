// Files with layers: what is written is read again, and nothing that a file claims is believed.
#include <random>

#include "scene/budget.h"
#include "scene/formats/layered.h"
#include "support/catch.h"
#include "support/complaint.h"
#include "support/pictures.h"
#include "support/seeds.h"

namespace holomorph::layered_test {

namespace {

Image random_image(int width, int height, std::mt19937& random) {
  Image image(width, height);
  // Runs of equal values of all lengths, as well as noise.
  std::uint8_t value = 0;
  for (std::uint8_t& each : image.pixels) each = value = random() % 3 ? value : random() % 256;
  return image;
}

LayeredPicture random_picture(std::mt19937& random) {
  const int width = 1 + static_cast<int>(random() % 300),
            height = 1 + static_cast<int>(random() % 60);
  LayeredPicture picture{{}, random_image(width, height, random)};
  const std::string names[] = {"", "sky", "Himmel \u00fc", "\u6f22\u5b57", "a/b \U0001F98E"};
  const size_t count = 1 + random() % 6;
  for (size_t i = 0; i < count; ++i) {
    DrawnLayer layer;
    layer.name = names[random() % 5];
    layer.image = random_image(1 + static_cast<int>(random() % 200),
                               1 + static_cast<int>(random() % 60), random);
    layer.left = static_cast<int>(random() % 200) - 100;
    layer.top = static_cast<int>(random() % 60) - 30;
    layer.visible = random() % 2;
    layer.opacity = static_cast<double>(random() % 256) / 255;
    layer.blending = static_cast<Blending>(random() % 5);
    layer.clipped = i > 0 && random() % 2;
    picture.layers.push_back(std::move(layer));
  }
  return picture;
}

/// The layer's image where it lies on the canvas.
Image on_canvas(const LayeredPicture& picture, const DrawnLayer& layer) {
  Image canvas(picture.merged.width, picture.merged.height);
  for (int r = 0; r < layer.image.height; ++r)
    for (int c = 0; c < layer.image.width; ++c) {
      const int column = c + layer.left, row = r + layer.top;
      if (column < 0 || row < 0 || column >= canvas.width || row >= canvas.height) continue;
      std::copy_n(layer.image.at(c, r), 4, canvas.at(column, row));
    }
  return canvas;
}

/// A decoded layer where it lies on its canvas.
Image on_canvas(const Image& layer) {
  const Box page = layer.page();
  Image canvas(static_cast<int>(page.width()), static_cast<int>(page.height()));
  for (int r = 0; r < layer.height; ++r)
    for (int c = 0; c < layer.width; ++c) {
      const int column = c + layer.left, row = r + canvas.height - layer.top();
      if (column < 0 || row < 0 || column >= canvas.width || row >= canvas.height) continue;
      std::copy_n(layer.at(c, r), 4, canvas.at(column, row));
    }
  return canvas;
}

/// The image without the colors of transparent pixels, which nobody sees.
Image visible_part(Image image) {
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    if (image.pixels[i + 3] == 0) std::fill_n(&image.pixels[i], 3, std::uint8_t{0});
  return image;
}

/// A layer of 2 x 2 pixels in a hand-made PSD file.
struct PsdLayer {
  std::string name, key = "norm";
  std::uint8_t opacity = 255, clipped = 0, flags = 8;
  std::string blocks = {};    ///< tagged blocks
  std::string mask = {};      ///< the mask's data, without its length
  std::string channels = {};  ///< in place of RGBA, raw, all 100
};

std::string block(const std::string& key, const std::string& content) {
  return "8BIM" + key + big(content.size(), 4) + content;
}
std::string section(int kind, const std::string& key) {
  return block("lsct", big(static_cast<size_t>(kind), 4) + "8BIM" + key);
}

constexpr size_t kSide = 2;

std::string channel_list(const std::vector<int>& ids, size_t length) {
  std::string list = big(ids.size(), 2);
  for (const int id : ids) list += big(static_cast<size_t>(id) & 0xffff, 2) + big(length, 4);
  return list;
}

std::string psd_of(const std::vector<PsdLayer>& layers, size_t depth = 8, size_t mode = 3) {
  std::string records, data;
  for (const PsdLayer& layer : layers) {
    std::vector<int> ids{-1, 0, 1, 2};
    if (!layer.mask.empty()) ids.push_back(-2);
    const std::string plane = big(0, 2) + std::string(kSide * kSide, 100);
    std::string extra = big(layer.mask.size(), 4) + layer.mask + big(0, 4) +
                        static_cast<char>(layer.name.size()) + layer.name;
    extra.resize((extra.size() - layer.mask.size() + 3) / 4 * 4 + layer.mask.size());
    extra += layer.blocks;
    records += big(0, 4) + big(0, 4) + big(kSide, 4) + big(kSide, 4) +
               channel_list(ids, plane.size()) + "8BIM" + layer.key +
               static_cast<char>(layer.opacity) + static_cast<char>(layer.clipped) +
               static_cast<char>(layer.flags) + '\0' + big(extra.size(), 4) + extra;
    for (size_t k = 0; k < ids.size(); ++k) data += plane;
  }
  std::string info = big(layers.size(), 2) + records + data;
  if (info.size() % 2) info += '\0';
  const std::string all = big(info.size(), 4) + info + big(0, 4);
  return "8BPS" + big(1, 2) + std::string(6, '\0') + big(4, 2) + big(kSide, 4) + big(kSide, 4) +
         big(depth, 2) + big(mode, 2) + big(0, 4) + big(0, 4) + big(all.size(), 4) + all +
         big(0, 2) + std::string(4 * kSide * kSide, 100);
}

}  // namespace

TEST_CASE("PSD and OpenRaster give back the layers that were written") {
  for (const unsigned seed : seeds_of("layered files", {1, 2, 3})) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 10; ++trial) {
      CAPTURE(seed, trial);
      const LayeredPicture picture = random_picture(random);
      for (const LayeredFormat& format : layered_formats()) {
        CAPTURE(format.extension);
        if (!may_have_layers("a" + format.extension)) continue;  // it is only written
        const bool is_ora = format.extension == ".ora";
        const std::string bytes = format.encode(picture);
        CHECK(format.encode(picture) == bytes);
        const FileLayers read = layers_of_file(bytes, "a");
        CHECK(read.report.notes.empty());
        REQUIRE(read.layers.size() == picture.layers.size());
        for (size_t i = 0; i < read.layers.size(); ++i) {
          const DrawnLayer& wrote = picture.layers[i];
          const FileLayer& layer = read.layers[i];
          CAPTURE(i, wrote.clipped);
          CHECK(layer.name == wrote.name);
          CHECK(layer.blending == wrote.blending);
          PixelBudget pixels;
          const Image image = decode_layer(bytes, layer.entry, "a", pixels);
          if (is_ora) continue;  // applies clipping to pixels; see the next test
          CHECK(layer.visible == wrote.visible);
          CHECK(layer.opacity == Approx(wrote.opacity).margin(1e-9));
          CHECK(layer.clipped == wrote.clipped);
          CHECK(visible_part(on_canvas(image)) == visible_part(on_canvas(picture, wrote)));
        }
        if (is_ora) CHECK(decode_image(bytes, "a") == picture.merged);
      }
    }
  }
}

TEST_CASE("OpenRaster cuts clipped layers to the shape of their base") {
  std::mt19937 random(5);
  LayeredPicture picture{{}, Image(40, 30)};
  DrawnLayer base, upper;
  base.image = random_image(20, 20, random);
  base.left = 7;
  base.top = -3;
  base.opacity = 0.5;
  upper.image = random_image(40, 30, random);
  upper.clipped = true;
  picture.layers = {base, upper};
  const std::string bytes = layered_formats()[1].encode(picture);
  PixelBudget pixels;
  const FileLayer written = layers_of_file(bytes, "a").layers[1];
  CHECK(written.opacity == Approx(0.5));  // of the base
  const Image cut = on_canvas(decode_layer(bytes, written.entry, "a", pixels));
  const Image under = on_canvas(picture, base);
  for (int r = 0; r < 30; ++r)
    for (int c = 0; c < 40; ++c) {
      const double wanted = upper.image.at(c, r)[3] * under.at(c, r)[3] / 255.0;
      REQUIRE(cut.at(c, r)[3] == Approx(wanted).margin(1));
    }
}

TEST_CASE("The merged picture of a PSD file is what other programs show") {
  std::mt19937 random(7);
  LayeredPicture picture = random_picture(random);
  for (size_t i = 3; i < picture.merged.pixels.size(); i += 4) picture.merged.pixels[i] |= 128;
  const Image merged = decode_image(layered_formats()[0].encode(picture), "a.psd");
  int farthest = 0;
  for (size_t i = 0; i < merged.pixels.size(); ++i)
    farthest = std::max(farthest, std::abs(merged.pixels[i] - picture.merged.pixels[i]));
  CHECK(farthest <= 2);  // the colors are stored as they look on white
}

TEST_CASE("Groups pass on their names, opacity and visibility, and what is lost is said") {
  const std::string bytes =
      psd_of({{.name = "ground"},
              {.name = "</Layer group>", .blocks = section(3, "pass")},
              {.name = "eye", .opacity = 128},
              {.name = "pupil", .clipped = 1},
              {.name = "fx", .key = "diff", .blocks = block("lfx2", "1234")},
              {.name = "head", .opacity = 51, .flags = 10, .blocks = section(1, "pass")},
              {.name = "tint", .blocks = block("levl", "12")},
              {.name = "hat", .clipped = 1}});
  const FileLayers read = layers_of_file(bytes, "a.psd");
  REQUIRE(read.layers.size() == 5);
  const char* names[] = {"ground", "head/eye", "head/pupil", "head/fx", "hat"};
  for (size_t i = 0; i < 5; ++i) CHECK(read.layers[i].name == names[i]);
  CHECK(read.layers[1].opacity == Approx(128.0 / 255 * 51 / 255));
  CHECK(!read.layers[1].visible);
  CHECK(read.layers[0].visible);
  CHECK(read.layers[2].clipped);
  CHECK(read.layers[2].opacity == 1);  // the opacity of its base applies to it, too
  CHECK(!read.layers[4].clipped);
  for (const char* said : {"head/fx: left out: its blending mode, its effects",
                           "tint: left out: the whole layer", "hat: left out: its clipping"})
    CHECK_THAT(read.report.text(), Catch::Contains(said));
}

TEST_CASE("A PSD file says whether clipped layers blend with their base alone") {
  // Together, as is usual, is what clipping means here.
  for (const bool together : {true, false}) {
    const std::string how = block("clbl", std::string{together, 0, 0, 0});
    const FileLayers read = layers_of_file(psd_of({{.name = "hat", .blocks = how},
                                                   {.name = "head", .blocks = how},
                                                   {.name = "shade", .key = "mul ", .clipped = 1},
                                                   {.name = "light", .key = "scrn", .clipped = 1}}),
                                           "a.psd");
    REQUIRE(read.layers.size() == 4);
    CHECK(read.layers[3].clipped);
    CHECK(read.report.text() ==
          (together ? "" : "head: converted: layers that are clipped to it blend with it alone"));
  }
  // What we write says it, too.
  LayeredPicture picture;
  picture.merged = Image(2, 2);
  picture.layers.push_back({.name = "base", .image = Image(2, 2)});
  const std::string written = layered_format_named("psd")->encode(picture);
  CHECK_THAT(written, Catch::Contains(std::string("8BIMclbl\0\0\0\4\1\0\0\0", 16)));
}

TEST_CASE("What is clipped to a group or above a clipped group is not clipped to another layer") {
  const PsdLayer divider{.name = "</Layer group>", .blocks = section(3, "pass")};
  const std::string bytes = psd_of({{.name = "A"},
                                    divider,
                                    {.name = "g1"},
                                    {.name = "group", .clipped = 1, .blocks = section(1, "pass")},
                                    {.name = "B", .clipped = 1}});
  const FileLayers read = layers_of_file(bytes, "a.psd");
  REQUIRE(read.layers.size() == 3);
  for (const FileLayer& layer : read.layers) CHECK(!layer.clipped);
  CHECK_THAT(read.report.text(), Catch::Contains("B: left out: its clipping"));
}

TEST_CASE("Layers with the same id in a PSD file, or that of a group, are told apart") {
  const auto id = [](size_t number) { return block("lyid", big(number, 4)); };
  const std::string bytes =
      psd_of({{.name = "</Layer group>", .blocks = section(3, "pass") + id(7)},
              {.name = "a", .blocks = id(7)},
              {.name = "g", .blocks = section(1, "pass") + id(7)},
              {.name = "b", .blocks = id(8)},
              {.name = "c", .blocks = id(8)}});
  const FileLayers read = layers_of_file(bytes, "a.psd");
  REQUIRE(read.layers.size() == 3);
  CHECK(read.layers[1].entry != read.layers[2].entry);
  for (const FileLayer& layer : read.layers) {
    PixelBudget pixels;
    CHECK(decode_layer(bytes, layer.entry, "a.psd", pixels).at(0, 0)[3] == 100);
  }
  CHECK(layers_of_file("\x89PNG not an archive", "a.psd").layers.empty());
}

TEST_CASE("The mask of a PSD layer cuts its pixels, unless it is disabled") {
  const auto alphas = [](std::uint8_t flags) {
    // The mask covers the left column; outside of it, everything is hidden.
    const std::string mask = big(0, 4) + big(0, 4) + big(2, 4) + big(1, 4) + std::string(1, '\0') +
                             static_cast<char>(flags) + std::string(2, '\0');
    const std::string bytes = psd_of({{.name = "a", .mask = mask}});
    PixelBudget pixels;
    const Image image =
        decode_layer(bytes, layers_of_file(bytes, "a").layers[0].entry, "a", pixels);
    return std::pair(image.at(0, 0)[3], image.at(1, 0)[3]);
  };
  CHECK(alphas(0) == std::pair<std::uint8_t, std::uint8_t>(39, 0));  // 100 * 100 / 255
  CHECK(alphas(2) == std::pair<std::uint8_t, std::uint8_t>(100, 100));
}

TEST_CASE("PSD files that cannot be read say why") {
  CHECK_THAT(error_message_of([&] { layers_of_file(psd_of({{.name = "a"}}, 32), "a"); }),
             Catch::Contains("32 bits"));
  CHECK_THAT(error_message_of([&] { layers_of_file(psd_of({{.name = "a"}}, 8, 7), "a"); }),
             Catch::Contains("color mode"));
  std::string large = psd_of({{.name = "a"}});
  large[5] = 2;
  CHECK_THAT(error_message_of([&] { layers_of_file(large, "a"); }), Catch::Contains("PSB"));
  CHECK(layers_of_file(psd_of({}), "a").layers.empty());
  const PsdLayer divider{.name = "d", .blocks = section(3, "pass")},
      group{.name = "g", .blocks = section(1, "pass")};
  CHECK_THAT(error_message_of([&] { layers_of_file(psd_of({divider}), "a"); }),
             Catch::Contains("no end"));
  CHECK_THAT(error_message_of([&] { layers_of_file(psd_of({group}), "a"); }),
             Catch::Contains("no beginning"));
  std::vector<PsdLayer> deep(60, divider);
  CHECK_THAT(error_message_of([&] { layers_of_file(psd_of(deep), "a"); }),
             Catch::Contains("too deeply"));
}

TEST_CASE("Damaged files with layers give an error that says so") {
  for (const unsigned seed : seeds_of("damaged layers", {1, 2})) {
    std::mt19937 random(seed);
    for (int trial = 0; trial < 60; ++trial) {
      const LayeredFormat& format = layered_formats()[random() % 2];
      std::string bytes = format.encode(random_picture(random));
      CAPTURE(seed, trial, format.extension);
      const bool cuts = random() % 2;
      if (cuts) bytes.resize(30 + random() % (bytes.size() - 30));
      for (int k = 0; k < 8 && !cuts; ++k)
        bytes[26 + random() % 300 % (bytes.size() - 26)] = static_cast<char>(random());
      const std::string said = error_message_of([&] {
        PixelBudget pixels;
        for (const FileLayer& layer : layers_of_file(bytes, "name").layers)
          decode_layer(bytes, layer.entry, "name", pixels);
      });
      if (!said.empty()) CHECK_THAT(said, Catch::Contains("name"));
    }
  }
  PixelBudget pixels;
  CHECK_THAT(error_message_of([&] { decode_layer(psd_of({{.name = "a"}}), "id:9", "a", pixels); }),
             Catch::Contains("no longer exists"));
}

}  // namespace holomorph::layered_test
