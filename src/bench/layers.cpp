// Benchmarks of scenes with many layers and keyframes.
#include <algorithm>
#include <chrono>
#include <random>
#include <thread>
#include <vector>

#include "bench/measures.h"
#include "bench/wavy.h"
#include "core/clock.h"
#include "core/maps/deformer.h"
#include "core/maps/method.h"
#include "scene/formats/layered.h"
#include "scene/keyframes.h"
#include "scene/layer_maps.h"
#include "scene/loading.h"
#include "scene/posed_map.h"
#include "system/memory.h"
#include "system/new_file.h"

namespace holomorph::bench {
namespace {

constexpr int kKeys = 100;
constexpr double kSecondsPerKey = 0.25;

/// A scene of layers with three pins each, which move from keyframe to keyframe.
Scene moving_layers(size_t count) {
  Deformation deformation;
  deformation.rest = deformation.pose = polygon_cage(wavy(32, {500, 500}, 350));
  deformation.method = usual_method(MethodUse::pins).id;
  for (const Complex z : {Complex(350, 450), Complex(500, 700), Complex(650, 450)})
    deformation.pins.push_back({z, z, {}, {}});
  for (int key = 0; key < kKeys; ++key) {
    for (Pin& pin : deformation.pins) pin.pose = pin.rest + 30.0 * std::polar(1.0, 0.7 * key);
    deformation = with_key(std::move(deformation), kSecondsPerKey * key);
  }
  std::vector<Layer> layers(count);
  for (size_t i = 0; i < count; ++i) {
    layers[i].id = static_cast<int>(i) + 1;
    layers[i].deformation = deformation;
  }
  Scene scene;
  scene.layers.assign(layers.begin(), layers.end());
  return scene;
}

/// Updates the maps as the window does: of the edited layer with this deformation, and of the
/// others.
void update(LayerMaps& maps, const Scene& scene, const Deformation& edited, EvalOptions options,
            const Moment& moment) {
  maps.update_others(scene, moment);
  maps.of(scene.layer().id).update(edited, options, moment);
}

/// Updates the maps until all workers are idle.
void settle(LayerMaps& maps, const Scene& scene, const Moment& moment) {
  const auto busy = [&](const SharedLayer& layer) { return maps.of(layer->id).busy(); };
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    update(maps, scene, scene.layer().deformation, {}, moment);
  } while (std::ranges::any_of(scene.layers, busy));
}

double median(std::vector<double> times) {
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::ranges::nth_element(times, middle);
  return *middle;
}

}  // namespace

double layered_drag_ms(int layers) {
  const Scene scene = moving_layers(static_cast<size_t>(layers));
  LayerMaps maps;
  settle(maps, scene, {});
  Deformation dragged = scene.layer().deformation;
  std::vector<double> times;
  for (int frame = 0; frame < 200; ++frame) {
    dragged.pins[0].pose = dragged.pins[0].rest + 40.0 * std::polar(1.0, 0.05 * frame);
    const double start = now_ms();
    update(maps, scene, dragged, {.draft = true}, {});
    times.push_back(now_ms() - start);
  }
  return median(std::move(times));
}

double layered_scrub_ms(int layers) {
  const Scene scene = moving_layers(static_cast<size_t>(layers));
  LayerMaps maps;
  Moment moment{0.1};
  settle(maps, scene, moment);
  std::vector<double> times;
  for (int frame = 0; frame < 100; ++frame) {  // passes a key in every second frame
    moment.time = 0.1 + 0.5 * kSecondsPerKey * frame;
    const double start = now_ms();
    update(maps, scene, scene.layer().deformation, {}, moment);
    times.push_back(now_ms() - start);
  }
  return median(std::move(times));
}

double drag_page_faults() {
  double most = 0;
  for (const Method& method : methods()) {
    Deformation deformation = moving_layers(1).layer().deformation;
    deformation.method = method.id;
    const Points stroke{{400, 500}, {500, 520}, {600, 500}};
    deformation.strokes.push_back({stroke, stroke, {}});
    const auto prepared = prepared_map(deformation, Precision::single, {});
    std::optional<PosedMap> posed;
    const auto drag = [&](int frames) {
      for (int frame = 0; frame < frames; ++frame) {
        const Complex by = std::polar(30.0, 0.05 * frame);
        deformation.pins[0].pose = deformation.pins[0].rest + by;
        deformation.pose.segments[0][0] = deformation.rest.vertex(0) + by;
        deformation.strokes[0].pose[1] = stroke[1] + by;
        posed = posed_map(*prepared, deformation, {.draft = true}, posed ? &*posed : nullptr);
      }
    };
    constexpr int kFrames = 100;
    drag(kFrames);
    const long before = page_faults();
    drag(kFrames);
    most = std::max(most, static_cast<double>(page_faults() - before) / kFrames);
  }
  return most;
}

double open_psd_ms() {
  constexpr int kSide = 3560;  // four layers of noise have 203 MB
  constexpr int kCount = 4;
  LayeredPicture picture{{}, Image(kSide, kSide)};
  std::mt19937 random(1);
  DrawnLayer layer;
  layer.image = Image(kSide, kSide);
  for (std::uint8_t& value : layer.image.pixels) value = static_cast<std::uint8_t>(random());
  picture.layers.assign(kCount, layer);
  const NewFolder folder(std::filesystem::temp_directory_path() / "bench");
  const Path file = folder.path() / "noise.psd";
  write_file(file, layered_format_of(file)->encode(picture));
  const double start = now_ms();
  const LoadedScene loaded = scene_of_image(file);
  return loaded.scene.layers.size() == kCount ? now_ms() - start : 0;
}

}  // namespace holomorph::bench
