// Compares OpenGL with the CPU: the operator in the shader, and the picture on the screen.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "raster/picture.h"
#include "render/framebuffer.h"
#include "render/gl.h"
#include "render/renderer.h"
#include "render/surface_renderer.h"
#include "render/texture.h"
#include "scene/document.h"
#include "scene/fringe.h"
#include "scene/live_map.h"
#include "support/catch.h"
#include "support/seeds.h"
#include "support/shapes.h"

namespace holomorph::render_test {

namespace {

/// A hidden window with a context; needs a display.
struct Context {
  GLFWwindow* window = nullptr;
  Context(int width, int height) {
    // Once per program, because a virtual display resets when its last client disconnects.
    static const int ready = glfwInit();
    REQUIRE(ready);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_STENCIL_BITS, 8);
    glfwWindowHint(GLFW_SAMPLES, 0);
    window = glfwCreateWindow(width, height, "test", nullptr, nullptr);
    REQUIRE(window);
    glfwMakeContextCurrent(window);
  }
  ~Context() { glfwDestroyWindow(window); }
};

}  // namespace

TEST_CASE("The shader's operator positions vertices like the CPU, to 1e-4 px") {
  const Context context(64, 64);
  Renderer renderer;
  for (const Method& method : methods()) {
    Points small = shapes::l_shape();
    Deformation deformation;
    deformation.rest = deformation.pose = polygon_cage(small);
    deformation.pose.segments[2][0] += Complex(20, -12);
    deformation.pose.segments[5][0] += Complex(-9, 14);
    deformation.method = method.id;
    if (method.uses_pins)
      deformation.pins = {{{40, 40}, {44, 46}, 0.3, {}}, {{150, 50}, {140, 60}, {}, {}}};
    const auto prepared = prepared_map(deformation, Precision::single, {3000});
    SampledMap map = prepared->deformer->deform(pose_of(deformation), {});
    if (!prepared->deformer->operator_matrix()) continue;
    renderer.set_mesh(prepared->mesh.get());
    REQUIRE(renderer.set_operator(prepared->deformer->operator_matrix()));
    renderer.set_controls(prepared->deformer->controls(pose_of(deformation)));
    const std::vector<Complex> placed = renderer.placed_vertices(Placement::by_operator);
    double worst = 0;
    for (size_t i = 0; i < placed.size(); ++i)
      worst = std::max(worst, std::abs(placed[i] - map.f[static_cast<Index>(i)]));
    INFO(method.id << ", worst " << worst << ", " << driver_name());
    CHECK(worst <= 1e-4);
    renderer.set_positions(as_span(map.f));
    const std::vector<Complex> given = renderer.placed_vertices(Placement::positions);
    CHECK(std::abs(given[7] - map.f[7]) <= 1e-4);
  }
}

TEST_CASE("The canvas at 100 % shows the exported pixels") {
  for (const char* name : first_of<const char*>({"giraffe", "fish", "gecko", "sunflower"}, 2)) {
    const LoadedScene loaded =
        load_scene(std::string(HOLOMORPH_SOURCE) + "/assets/" + name + ".json");
    PictureOptions options;
    options.crop = true;
    const Image exported = picture_of(loaded.scene, loaded.image(), options).image;
    const int width = exported.width, height = exported.height;
    const Context context(width, height);
    Renderer renderer;
    CHECK(renderer.set_picture(loaded.image()->width, loaded.image()->height,
                               loaded.image()->pixels.data()) == 1);
    const auto prepared =
        prepared_map(loaded.scene.deformation(), Precision::single, MeshOptions{});
    SampledMap map = prepared->deformer->deform(pose_of(loaded.scene.deformation()), {});
    renderer.set_mesh(prepared->mesh.get());
    renderer.set_positions(as_span(map.f));
    RenderFrame frame;
    frame.window_width = width;
    frame.window_height = height;
    frame.canvas_width = width;
    frame.canvas_height = height;
    frame.center = {width / 2.0, height / 2.0};
    frame.background = frame.backdrop = frame.other_backdrop = {0.5f, 0.5f, 0.5f};
    renderer.draw(frame);
    Image shown(width, height);
    read_framebuffer(width, height, shown.pixels.data());
    double sum = 0;
    int outliers = 0;
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c) {
        const std::uint8_t* e = exported.at(c, r);
        for (int k = 0; k < 3; ++k) {
          const double over_gray = (e[k] * e[3] + 127.5 * (255 - e[3])) / 255;
          const double difference = std::abs(over_gray - shown.at(c, r)[k]);
          sum += difference;
          outliers += difference > 40;
        }
      }
    const double mean = sum / (3.0 * width * height);
    INFO(name << ", mean difference " << mean << ", far " << outliers << ", " << driver_name());
    CHECK(mean < 0.8);                             // of 255
    CHECK(outliers < 0.002 * 3 * width * height);  // only silhouettes and small details
  }
}

TEST_CASE("Ghosts of the picture are tinted, half transparent, and drawn behind it") {
  constexpr int kSide = 60;
  const Context context(kSide, kSide);
  Renderer renderer;
  Image white(20, 20);
  for (std::uint8_t& value : white.pixels) value = 255;
  renderer.set_picture(20, 20, white.pixels.data());
  const Mesh mesh = domain_mesh(polygon_cage(Points{{0, 0}, {20, 0}, {20, 20}, {0, 20}}), {100});
  renderer.set_mesh(&mesh);
  std::vector<Complex> moved = mesh.vertices;
  for (Complex& z : moved) z += 20.0;
  RenderFrame frame;
  frame.window_width = frame.window_height = kSide;
  frame.canvas_width = frame.canvas_height = kSide;
  frame.center = {30, 30};
  frame.background = frame.backdrop = frame.other_backdrop = {0, 0, 0};
  frame.ghosts = {{mesh.vertices, {1, 0, 0}}, {moved, {1, 0, 0}}};
  renderer.draw(frame);
  Image shown(kSide, kSide);
  read_framebuffer(kSide, kSide, shown.pixels.data());
  const std::uint8_t *drawn = shown.at(10, 49), *ghost = shown.at(30, 49),
                     *outside = shown.at(50, 49);
  CHECK((drawn[0] == 255 && drawn[1] == 255));
  CHECK(static_cast<int>(ghost[0]) == Approx(0.4 * 255).margin(2));
  CHECK(static_cast<int>(ghost[1]) == Approx(0.2 * 255).margin(2));
  CHECK((outside[0] == 0 && outside[1] == 0));
}

TEST_CASE("A picture too large for the driver is reduced, but keeps its position and size") {
  const Context context(64, 64);
  Renderer renderer;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  Image wide(largest + 2, 4);  // red on the left, blue on the right
  for (int r = 0; r < wide.height; ++r)
    for (int c = 0; c < wide.width; ++c) {
      wide.at(c, r)[c < wide.width / 2 ? 0 : 2] = 255;
      wide.at(c, r)[3] = 255;
    }
  CHECK(renderer.set_picture(wide.width, wide.height, wide.pixels.data()) == 2);
  RenderFrame frame;
  frame.window_width = frame.window_height = 64;
  frame.canvas_width = frame.canvas_height = 64;
  frame.center = {wide.width / 2.0, 2};
  frame.zoom = 8;
  renderer.draw(frame);
  Image shown(64, 64);
  read_framebuffer(64, 64, shown.pixels.data());
  CHECK(shown.at(10, 32)[0] > 200);
  CHECK(shown.at(10, 32)[2] < 50);
  CHECK(shown.at(54, 32)[2] > 200);
  CHECK(shown.at(54, 32)[0] < 50);
}

TEST_CASE("A removed mesh or operator is not drawn") {
  const Context context(32, 32);
  Renderer renderer;
  renderer.set_mesh(nullptr);
  CHECK_FALSE(renderer.set_operator(nullptr));
  RenderFrame frame;
  frame.window_width = frame.window_height = 32;
  frame.canvas_width = frame.canvas_height = 32;
  frame.background = {1, 0, 0};
  frame.view = View::checker;
  renderer.draw(frame);
  Image shown(32, 32);
  read_framebuffer(32, 32, shown.pixels.data());
  CHECK(shown.at(5, 5)[0] == 255);
  CHECK(shown.at(5, 5)[1] == 0);
}

TEST_CASE("A heat map on the canvas has the colors of the exported one") {
  Deformation deformation = with_cage(Deformation{}, shapes::l_shape());
  deformation.pose.segments[2][0] += Complex(40, -25);
  const auto prepared = prepared_map(deformation, Precision::single, {3000});
  SampledMap map = prepared->deformer->deform(pose_of(deformation), {true});
  for (const View view : {View::area, View::stretch, View::checker}) {
    const Eigen::VectorXd values =
        is_heat(view) ? heat_values(view, distortion_of(map)) : Eigen::VectorXd();
    const HeatScale scale = heat_scale(view, values, false);
    RasterJob job;
    job.mesh = prepared->mesh.get();
    job.positions = as_span(map.f);
    job.view = view;
    job.heat = values;
    job.scale = scale;
    const RasterResult exported = rasterized(job);
    const int width = exported.image.width, height = exported.image.height;
    const Context context(width, height);
    Renderer renderer;
    renderer.set_mesh(prepared->mesh.get());
    renderer.set_positions(job.positions);
    if (is_heat(view)) {
      Eigen::VectorXf shades(values.size());
      for (Index i = 0; i < values.size(); ++i)
        shades[i] = static_cast<float>(heat_position(scale, values[i]));
      renderer.set_heat(shades);
    }
    RenderFrame frame;
    frame.window_width = width, frame.window_height = height;
    frame.canvas_width = width, frame.canvas_height = height;
    frame.center = exported.corner + Complex(width, height) / 2.0;
    frame.view = view;
    frame.diverging = scale.diverging;
    renderer.draw(frame);
    Image shown(width, height);
    read_framebuffer(width, height, shown.pixels.data());
    int compared = 0, outliers = 0;
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c) {
        const std::uint8_t* e = exported.image.at(c, r);
        if (e[3] != 255) continue;  // the silhouette
        ++compared;
        for (int k = 0; k < 3; ++k) outliers += std::abs(e[k] - shown.at(c, r)[k]) > 6;
      }
    INFO("view " << static_cast<int>(view) << ", far " << outliers << " of " << compared);
    CHECK(compared > 20000);
    CHECK(outliers < compared / 50);  // only at edges of the checker
  }
}

TEST_CASE("A surface in space shows its texture upright, its clay, its back and its nearest part") {
  const Context context(64, 64);
  Framebuffer flat, space;
  // A texture with four colors: red and green at the bottom, blue and transparent at the top.
  const int n = 256;
  flat.bind(n, n);
  glEnable(GL_SCISSOR_TEST);
  const auto fill = [](int x, int y, float r, float g, float b, float a) {
    glScissor(x, y, n / 2, n / 2);
    glClearColor(r, g, b, a);
    glClear(GL_COLOR_BUFFER_BIT);
  };
  fill(0, 0, 1, 0, 0, 1);
  fill(n / 2, 0, 0, 1, 0, 1);
  fill(0, n / 2, 0, 0, 1, 1);
  fill(n / 2, n / 2, 0, 0, 0, 0);
  flat.release();

  Surface square;
  square.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  SurfaceFrame frame{100,
                     100,
                     Eigen::Matrix4d::Identity(),
                     Eigen::Matrix4d::Identity(),
                     flat.texture(),
                     {0.1f, 0.1f, 0.1f},
                     {1, 1, 1}};
  frame.to_view(2, 3) = -2;  // in front of the camera
  frame.to_clip.diagonal() << 0.8, 0.8, -0.1, 1;
  SurfaceRenderer renderer;
  const auto pixel = [&](int x, int y) {  // y up
    space.bind(100, 100);
    renderer.draw(frame);
    std::array<std::uint8_t, 4> color{};
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, color.data());
    space.release();
    return color;
  };
  renderer.set_surface(square);
  renderer.set_coordinates({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const auto red = pixel(30, 30), green = pixel(70, 30), blue = pixel(30, 70), clay = pixel(70, 70);
  CHECK((red[0] > 200 && red[1] < 10 && red[2] < 10));
  CHECK((green[1] > 200 && green[0] < 10));
  CHECK((blue[2] > 200 && blue[0] < 10));
  CHECK((clay[0] > 200 && clay[0] == clay[1] && clay[1] == clay[2]));
  CHECK(pixel(2, 2)[0] == 26);  // the background next to it
  frame.texture = 0;
  CHECK(pixel(30, 30) == clay);
  frame.texture = flat.texture();
  // Just outside the picture, its nearest color is still visible.
  renderer.set_coordinates({{0.505, 0}, {0.51, 0}, {0.51, 0.49}, {0.505, 0.49}});
  CHECK(pixel(50, 50)[1] > 200);
  renderer.set_coordinates({{0.2, 0.505}, {0.21, 0.505}, {0.21, 0.51}, {0.2, 0.51}});
  CHECK(pixel(50, 50)[2] > 200);
  renderer.set_coordinates({{0.505, 0.7}, {0.505, 0.7}, {0.505, 0.7}, {0.505, 0.7}});
  const auto bled = pixel(50, 50);
  CHECK((bled[2] > 200 && bled[0] < 10));
  // The back is darker.
  renderer.set_coordinates({{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.1, 0.2}});
  const auto front = pixel(50, 50);
  std::swap(square.triangles[0][1], square.triangles[0][2]);
  std::swap(square.triangles[1][1], square.triangles[1][2]);
  renderer.set_surface(square);
  renderer.set_coordinates({{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.1, 0.2}});
  const auto back = pixel(50, 50);
  CHECK((back[0] < 0.7 * front[0] && back[0] > 0));
  // Far from the origin the result is the same.
  Surface outliers = square;
  const Eigen::Vector3d away(3e7, -2e7, 1e7);
  for (Eigen::Vector3d& p : outliers.vertices) p += away;
  renderer.set_surface(outliers);
  renderer.set_coordinates({{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.1, 0.2}});
  frame.to_view.topRightCorner<3, 1>() -= away;
  CHECK(pixel(50, 50) == back);
  frame.to_view.topRightCorner<3, 1>() += away;
  // Nearer parts hide those behind them, regardless of the order of the triangles.
  Surface two = square;
  for (int k = 0; k < 4; ++k)
    two.vertices.push_back(square.vertices[static_cast<size_t>(k)] + Eigen::Vector3d(0, 0, 0.5));
  const std::array<int, 3> first{4, 5, 6}, second{4, 6, 7};
  two.triangles.insert(two.triangles.begin(), {first, second});
  renderer.set_surface(two);
  renderer.set_coordinates({{0.1, 0.1},
                            {0.1, 0.1},
                            {0.1, 0.1},
                            {0.1, 0.1},
                            {0.9, 0.1},
                            {0.9, 0.1},
                            {0.9, 0.1},
                            {0.9, 0.1}});
  CHECK(pixel(50, 50)[1] > 200);
}

TEST_CASE("The map alone is opaque on its image and transparent elsewhere") {
  const Context context(64, 64);
  const LoadedScene loaded = load_scene(std::string(HOLOMORPH_SOURCE) + "/assets/gecko.json");
  const auto prepared = prepared_map(loaded.scene.deformation(), Precision::single, {1000});
  SampledMap map = prepared->deformer->deform(pose_of(loaded.scene.deformation()), {});
  Renderer renderer;
  renderer.set_picture(loaded.image()->width, loaded.image()->height,
                       loaded.image()->pixels.data());
  renderer.set_mesh(prepared->mesh.get());
  const std::span<const Complex> positions(map.f.data(), static_cast<size_t>(map.f.size()));
  renderer.set_positions(positions);
  const Box box = box_of(positions);
  RenderFrame frame;
  frame.zoom = 300 / std::max(box.width(), box.height());
  frame.window_width = static_cast<int>(std::ceil(frame.zoom * box.width()));
  frame.window_height = static_cast<int>(std::ceil(frame.zoom * box.height()));
  frame.canvas_width = frame.window_width;
  frame.canvas_height = frame.window_height;
  frame.center = box.center();
  frame.map_alone = true;
  frame.background = {0, 0, 0};
  Framebuffer into;
  into.bind(frame.window_width, frame.window_height);
  renderer.draw(frame);
  double opaque = 0, half = 0;
  for (int y = 0; y < frame.window_height; ++y)
    for (int x = 0; x < frame.window_width; ++x) {
      std::array<std::uint8_t, 4> color{};
      glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, color.data());
      opaque += color[3] == 255;
      half += color[3] > 0 && color[3] < 255;
    }
  into.release();
  double area = 0;
  for (const auto& [a, b, c] : prepared->mesh->triangles)
    area += std::abs(cross(map.f[b] - map.f[a], map.f[c] - map.f[a])) / 2;
  CHECK(half == 0);
  CHECK(opaque == Approx(area * frame.zoom * frame.zoom).epsilon(0.03));
}

TEST_CASE("A fringe and a rotated view are drawn like the exported pixels") {
  // A soft disk, whose cage leaves out the faint part.
  constexpr int kSide = 100;
  Image image(kSide, kSide);
  for (int r = 0; r < kSide; ++r)
    for (int c = 0; c < kSide; ++c) {
      const double d = std::hypot(c + 0.5 - 50, r + 0.5 - 50);
      std::uint8_t* pixel = image.at(c, r);
      pixel[0] = static_cast<std::uint8_t>(2 * c), pixel[1] = static_cast<std::uint8_t>(2 * r);
      pixel[3] = static_cast<std::uint8_t>(d < 20 ? 255 : std::max(0.0, 110 - 4 * (d - 20)));
    }
  Points polygon;
  for (int i = 0; i < 16; ++i) polygon.push_back(Complex(50, 50) + std::polar(24.0, kPi * i / 8));
  const Mesh mesh = domain_mesh(polygon_cage(polygon), {400});
  const auto fringe = fringe_of(mesh, image);
  REQUIRE(fringe);
  Points positions;
  for (const Complex& z : mesh.vertices)
    positions.push_back(z + 4e-3 * (z - Complex(50, 50)) * (z - Complex(50, 50)));
  const Points around = fringe->positions(positions);
  const Similarity placement{std::polar(1.0, 0.5), {50, 50}, {60, 40}};

  RasterJob job;
  job.mesh = &mesh;
  job.positions = positions;
  job.fringe = &fringe->mesh;
  job.fringe_positions = around;
  job.source = &image;
  job.placement = placement;
  job.region = Box{0, 0, kSide, kSide};
  const Image exported = rasterized(job).image;

  const Context context(kSide, kSide);
  Renderer renderer;
  renderer.set_picture(kSide, kSide, image.pixels.data());
  renderer.set_mesh(&mesh);
  renderer.set_fringe(&fringe->mesh);
  renderer.set_positions(positions);
  renderer.set_fringe_positions(around);
  RenderFrame frame;
  frame.window_width = frame.window_height = kSide;
  frame.canvas_width = frame.canvas_height = kSide;
  frame.center = inverse(placement)({50, 50});
  frame.turn = placement.factor;
  frame.over = true;  // without a page
  frame.background = {0, 0, 0};
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  renderer.draw(frame);
  Image shown(kSide, kSide);
  read_framebuffer(kSide, kSide, shown.pixels.data());
  double sum = 0;
  int visible = 0;
  for (int r = 0; r < kSide; ++r)
    for (int c = 0; c < kSide; ++c) {
      const std::uint8_t* e = exported.at(c, r);
      visible += e[3] > 0;
      for (int k = 0; k < 3; ++k) sum += std::abs(e[k] * e[3] / 255.0 - shown.at(c, r)[k]);
    }
  INFO("mean difference " << sum / (3.0 * visible));
  CHECK(visible > 3000);
  CHECK(sum / (3.0 * visible) < 1.0);  // of 255
}

}  // namespace holomorph::render_test
