// OpenGL state is always set right before it is used, because the user interface draws in the same
// context and changes it.
#include "render/renderer.h"

#include <array>

#include "core/error.h"
#include "render/gl.h"
#include "render/program.h"

namespace holomorph {
namespace {

std::vector<float> pairs(std::span<const Complex> points) {
  std::vector<float> flat;
  flat.reserve(2 * points.size());
  for (const Complex& z : points) {
    flat.push_back(static_cast<float>(z.real()));
    flat.push_back(static_cast<float>(z.imag()));
  }
  return flat;
}

void upload(GLuint buffer, GLenum target, const void* data, size_t bytes, GLenum use) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, use);
}

constexpr int kPicture = 0, kColors = 1, kMatrix = 2, kControls = 3;  // texture units

}  // namespace

namespace {

int mode_of(Placement placement) {
  return placement == Placement::at_rest ? 0 : placement == Placement::positions ? 1 : 2;
}

/// The numbers match the fragment shader.
enum class Coloring { picture, heat, checker, flat, ghost, page, shadow };
constexpr size_t kColorings = static_cast<size_t>(Coloring::shadow) + 1;

void clear_canvas(const RenderFrame& frame) {
  const int left = static_cast<int>(frame.canvas_left),
            width = static_cast<int>(frame.canvas_width),
            height = static_cast<int>(frame.canvas_height),
            bottom = frame.window_height - static_cast<int>(frame.canvas_top) - height;
  glViewport(left, bottom, width, height);
  const int from = static_cast<int>(std::lround(frame.from * width)),
            to = static_cast<int>(std::lround(frame.to * width));
  glScissor(left + from, bottom, to - from, height);
  glEnable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glStencilMask(0xff);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(frame.background[0], frame.background[1], frame.background[2],
               frame.map_alone ? 0 : 1);
  glClearStencil(0);
  glClear(frame.over ? GL_STENCIL_BUFFER_BIT : GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void finish(const RenderFrame& frame) {
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, frame.window_width, frame.window_height);
}

}  // namespace

struct Renderer::Objects {
  /// A program for each coloring, compiled at its first use. Software drivers compute all branches
  /// of a condition at each pixel, even if it depends only on a uniform.
  std::array<std::unique_ptr<const Program>, kColorings> programs;
  const Program* program = nullptr;  ///< in use
  std::array<float, 9> to_clip{};    ///< from the plane, by columns
  GLuint vertex_array = 0, quad_array = 0, page_array = 0, ghost_array = 0, fringe_array = 0;
  GLuint rest = 0, position = 0, value = 0, triangles = 0, quad = 0, page_quad = 0, matrix = 0,
         controls = 0, feedback = 0, ghost = 0, fringe_rest = 0, fringe_position = 0,
         fringe_triangles = 0;
  GLuint picture = 0, sequential = 0, diverging = 0, matrix_texture = 0, controls_texture = 0;
  GLsizei index_count = 0, vertex_count = 0, fringe_index_count = 0, fringe_vertex_count = 0;
  double width = 0, height = 0;                 ///< size of the picture; 0: there is none
  Box place, page;                              ///< of the picture, in the plane
  std::shared_ptr<const TextureLevels> levels;  ///< kept until all of them are uploaded
  bool stored = false;                          ///< storage for all levels is allocated
  int level = 0, row = 0;                       ///< progress of the upload
  int columns = 0;

  GLint at(const char* name) const { return program->at(name); }

  /// Binds the textures, and sets the transformation for the colorings that follow.
  void use(const std::array<float, 9>& plane_to_clip, bool is_diverging) {
    to_clip = plane_to_clip;
    const auto bind = [](int unit, GLenum target, GLuint texture) {
      glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
      glBindTexture(target, texture);
    };
    bind(kMatrix, GL_TEXTURE_BUFFER, columns > 0 ? matrix_texture : 0);
    bind(kControls, GL_TEXTURE_BUFFER, columns > 0 ? controls_texture : 0);
    bind(kColors, GL_TEXTURE_1D, is_diverging ? diverging : sequential);
    bind(kPicture, GL_TEXTURE_2D, picture);
  }
  /// Activates the program of a coloring.
  void color(Coloring coloring, const Color& flat = {}, float alpha = 1) {
    const auto number = static_cast<size_t>(coloring);
    if (!programs[number])
      programs[number].reset(new Program(warp_program(static_cast<int>(coloring))));
    program = programs[number].get();
    glUseProgram(program->id());
    glUniform1f(at("margin"), 0);
    glUniformMatrix3fv(at("to_clip"), 1, GL_FALSE, to_clip.data());
    set_rectangle(width > 0 ? place : Box{0, 0, 1, 1});
    glUniform1i(at("picture"), kPicture);
    glUniform1i(at("colors"), kColors);
    glUniform1i(at("operator_matrix"), kMatrix);
    glUniform1i(at("operator_controls"), kControls);
    glUniform1i(at("column_count"), columns);
    glUniform1i(at("row_count"), vertex_count);
    glUniform4f(at("flat_color"), flat[0], flat[1], flat[2], alpha);
  }
  void set_rectangle(const Box& box) const {
    glUniform2f(at("rectangle_corner"), static_cast<float>(box.left),
                static_cast<float>(box.bottom));
    glUniform2f(at("rectangle_size"), static_cast<float>(box.width()),
                static_cast<float>(box.height()));
  }
  /// Draws the mesh in the coloring that was set by color().
  void draw_mesh(Placement placement) const {
    if (placement == Placement::by_operator && columns == 0) placement = Placement::positions;
    glUniform1i(at("mode"), mode_of(placement));
    glBindVertexArray(vertex_array);
    glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, nullptr);
  }
  void draw_ghosts(const std::vector<Ghost>& ghosts) {
    constexpr float kStrength = 0.4f;
    for (const Ghost& each : ghosts) {
      check(static_cast<GLsizei>(each.positions.size()) == vertex_count,
            "ghosts: the numbers of positions and mesh vertices differ");
      const std::vector<float> flat = pairs(each.positions);
      upload(ghost, GL_ARRAY_BUFFER, flat.data(), flat.size() * sizeof(float), GL_STREAM_DRAW);
      color(Coloring::ghost, each.tint, kStrength);
      glUniform1i(at("mode"), mode_of(Placement::positions));
      glBindVertexArray(ghost_array);
      glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, nullptr);
    }
  }
  /// Draws the picture's rectangle, or that of its page.
  void draw_quad() const { draw_rectangle(quad_array); }
  void draw_page_quad() const {
    set_rectangle(page);
    draw_rectangle(page_array);
  }
  void draw_rectangle(GLuint array) const {
    glUniform1i(at("mode"), mode_of(Placement::at_rest));
    glBindVertexArray(array);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }

  /// Draws the checkerboard behind the picture, and a soft shadow around it.
  void draw_page(const RenderFrame& frame) {
    if (frame.shadow > 0) {
      const double softness = frame.shadow / frame.zoom;
      color(Coloring::shadow, {}, frame.shadow_alpha);
      glUniform1f(at("softness"), static_cast<float>(softness));
      glUniform1f(at("margin"), static_cast<float>(4 * softness));
      draw_page_quad();
    }
    color(Coloring::page, frame.backdrop);
    const Color& other = frame.other_backdrop;
    glUniform4f(at("other_color"), other[0], other[1], other[2], 1);
    glUniform1f(at("cell_size"), static_cast<float>(frame.cell / frame.zoom));
    draw_page_quad();
  }
  /// Draws the picture outside the rest cage.
  void draw_surroundings(Placement placement) {
    if (index_count > 0 && fringe_index_count > 0) {
      color(Coloring::picture);
      glUniform1i(at("mode"),
                  mode_of(placement == Placement::at_rest ? placement : Placement::positions));
      glBindVertexArray(fringe_array);
      glDrawElements(GL_TRIANGLES, fringe_index_count, GL_UNSIGNED_INT, nullptr);
      return;
    }
    if (index_count > 0) {
      glEnable(GL_STENCIL_TEST);
      glStencilFunc(GL_ALWAYS, 1, 0xff);
      glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      color(Coloring::flat);
      draw_mesh(Placement::at_rest);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      glStencilFunc(GL_EQUAL, 0, 0xff);
      glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    }
    color(Coloring::picture);
    draw_quad();
    glDisable(GL_STENCIL_TEST);
  }
};

Renderer::Renderer() {
  if (epoxy_gl_version() < 33)
    throw Error(ErrorKind::failed, "OpenGL 3.3 is needed; this display offers " +
                                       std::to_string(epoxy_gl_version() / 10) + "." +
                                       std::to_string(epoxy_gl_version() % 10));
  gl_ = std::make_unique<Objects>();
  Objects& gl = *gl_;
  for (GLuint* buffer : {&gl.rest, &gl.position, &gl.value, &gl.triangles, &gl.quad, &gl.page_quad,
                         &gl.matrix, &gl.controls, &gl.feedback, &gl.ghost, &gl.fringe_rest,
                         &gl.fringe_position, &gl.fringe_triangles})
    glGenBuffers(1, buffer);
  for (GLuint* texture :
       {&gl.picture, &gl.sequential, &gl.diverging, &gl.matrix_texture, &gl.controls_texture})
    glGenTextures(1, texture);
  glGenVertexArrays(1, &gl.vertex_array);
  glGenVertexArrays(1, &gl.quad_array);
  glGenVertexArrays(1, &gl.page_array);
  glGenVertexArrays(1, &gl.ghost_array);
  glGenVertexArrays(1, &gl.fringe_array);

  const auto attribute = [](GLuint buffer, GLuint location, GLint size) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, 0, nullptr);
  };
  for (const auto& [array, position] :
       {std::pair(gl.vertex_array, gl.position), {gl.ghost_array, gl.ghost}}) {
    glBindVertexArray(array);
    attribute(gl.rest, 0, 2);
    attribute(position, 1, 2);
    attribute(gl.value, 2, 1);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gl.triangles);
  }
  glBindVertexArray(gl.fringe_array);
  attribute(gl.fringe_rest, 0, 2);
  attribute(gl.fringe_position, 1, 2);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gl.fringe_triangles);
  glBindVertexArray(gl.quad_array);
  attribute(gl.quad, 0, 2);
  glBindVertexArray(gl.page_array);
  attribute(gl.page_quad, 0, 2);
  glBindVertexArray(0);

  for (const bool diverging : {false, true}) {
    std::vector<float> colors;
    for (int i = 0; i < 256; ++i)
      for (const float channel : heat_color(i / 255.0, diverging)) colors.push_back(channel);
    glBindTexture(GL_TEXTURE_1D, diverging ? gl.diverging : gl.sequential);
    glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB8, 256, 0, GL_RGB, GL_FLOAT, colors.data());
    glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  }
}

Renderer::~Renderer() {
  Objects& gl = *gl_;
  for (const GLuint buffer :
       {gl.rest, gl.position, gl.value, gl.triangles, gl.quad, gl.matrix, gl.controls, gl.feedback,
        gl.ghost, gl.fringe_rest, gl.fringe_position, gl.fringe_triangles})
    glDeleteBuffers(1, &buffer);
  for (const GLuint texture :
       {gl.picture, gl.sequential, gl.diverging, gl.matrix_texture, gl.controls_texture})
    glDeleteTextures(1, &texture);
  glDeleteVertexArrays(1, &gl.vertex_array);
  glDeleteVertexArrays(1, &gl.quad_array);
  glDeleteVertexArrays(1, &gl.page_array);
  glDeleteVertexArrays(1, &gl.ghost_array);
  glDeleteVertexArrays(1, &gl.fringe_array);
}

int Renderer::largest_side() {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return largest;
}

int Renderer::set_picture(int width, int height, const std::uint8_t* pixels) {
  if (width <= 0 || height <= 0) {
    begin_picture(nullptr);
    return 1;
  }
  const auto levels =
      std::make_shared<const TextureLevels>(texture_levels(width, height, pixels, largest_side()));
  begin_picture(levels);
  while (upload_more(levels->levels[0].pixels.size())) {
  }
  return levels->factor;
}

// Uploads no pixels yet, because allocating the texture already takes enough time for one frame.
void Renderer::begin_picture(std::shared_ptr<const TextureLevels> levels) {
  Objects& gl = *gl_;
  gl.levels = std::move(levels);
  gl.width = gl.levels ? gl.levels->width : 0;
  gl.height = gl.levels ? gl.levels->height : 0;
  if (!gl.levels) return;
  // Create a new texture, because the levels of the old one have different sizes.
  glDeleteTextures(1, &gl.picture);
  glGenTextures(1, &gl.picture);
  glActiveTexture(GL_TEXTURE0 + kPicture);
  glBindTexture(GL_TEXTURE_2D, gl.picture);
  gl.level = static_cast<int>(gl.levels->levels.size());
  gl.row = 0;
  // If the storage of all levels is allocated together, the driver does not have to move them
  // later.
  gl.stored = epoxy_has_gl_extension("GL_ARB_texture_storage");
  if (gl.stored)
    glTexStorage2D(GL_TEXTURE_2D, gl.level, GL_RGBA8, gl.levels->levels[0].width,
                   gl.levels->levels[0].height);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, gl.level - 1);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  if (!is_software_driver() && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, 8.0f));
  }
  const Box place{0, 0, gl.width, gl.height};
  place_picture(place, place);
}

void Renderer::place_picture(const Box& picture, const Box& page) {
  Objects& gl = *gl_;
  gl.place = picture;
  gl.page = page;
  for (const auto& [buffer, box] : {std::pair(gl.quad, picture), {gl.page_quad, page}}) {
    const auto single = [](double x) { return static_cast<float>(x); };
    const float left = single(box.left), right = single(box.right), bottom = single(box.bottom),
                top = single(box.top);
    const float corners[] = {left, bottom, right, bottom, left, top, right, top};
    upload(buffer, GL_ARRAY_BUFFER, corners, sizeof corners, GL_STATIC_DRAW);
  }
}

bool Renderer::upload_more(size_t bytes) {
  Objects& gl = *gl_;
  if (!gl.levels) return false;
  glActiveTexture(GL_TEXTURE0 + kPicture);
  glBindTexture(GL_TEXTURE_2D, gl.picture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  for (size_t sent = 0; sent < bytes && gl.levels;) {
    if (gl.row == 0) {
      --gl.level;
      const TextureLevel& next = gl.levels->levels[static_cast<size_t>(gl.level)];
      if (!gl.stored)
        glTexImage2D(GL_TEXTURE_2D, gl.level, GL_RGBA8, next.width, next.height, 0, GL_RGBA,
                     GL_UNSIGNED_BYTE, nullptr);
    }
    const TextureLevel& level = gl.levels->levels[static_cast<size_t>(gl.level)];
    const size_t row_bytes = 4 * static_cast<size_t>(level.width);
    const int rows =
        std::min(level.height - gl.row, static_cast<int>((bytes - sent) / row_bytes) + 1);
    glTexSubImage2D(GL_TEXTURE_2D, gl.level, 0, gl.row, level.width, rows, GL_RGBA,
                    GL_UNSIGNED_BYTE,
                    level.pixels.data() + static_cast<size_t>(gl.row) * row_bytes);
    sent += static_cast<size_t>(rows) * row_bytes;
    gl.row += rows;
    if (gl.row < level.height) continue;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, gl.level);
    gl.row = 0;
    if (gl.level == 0) gl.levels.reset();
  }
  return gl.levels != nullptr;
}

void Renderer::set_mesh(const Mesh* mesh) {
  Objects& gl = *gl_;
  gl.columns = 0;
  gl.index_count = gl.vertex_count = 0;
  set_fringe(nullptr);
  if (!mesh) return;
  gl.vertex_count = static_cast<GLsizei>(mesh->vertices.size());
  gl.index_count = static_cast<GLsizei>(3 * mesh->triangles.size());
  const std::vector<float> rest = pairs(mesh->vertices);
  const std::vector<float> values(mesh->vertices.size(), 0.0f);
  glBindVertexArray(0);
  upload(gl.rest, GL_ARRAY_BUFFER, rest.data(), rest.size() * sizeof(float), GL_STATIC_DRAW);
  upload(gl.position, GL_ARRAY_BUFFER, rest.data(), rest.size() * sizeof(float), GL_STREAM_DRAW);
  upload(gl.value, GL_ARRAY_BUFFER, values.data(), values.size() * sizeof(float), GL_STREAM_DRAW);
  set_triangles(mesh->triangles);
}

void Renderer::set_triangles(const std::vector<Triangle>& triangles) {
  check(static_cast<GLsizei>(3 * triangles.size()) == gl_->index_count,
        "set_triangles: the number of triangles differs from the mesh's");
  glBindVertexArray(gl_->vertex_array);
  upload(gl_->triangles, GL_ELEMENT_ARRAY_BUFFER, triangles.data(),
         triangles.size() * sizeof(Triangle), GL_STATIC_DRAW);
  glBindVertexArray(0);
}

void Renderer::set_positions(std::span<const Complex> positions) {
  check(static_cast<GLsizei>(positions.size()) == gl_->vertex_count,
        "set_positions: the numbers of positions and mesh vertices differ");
  const std::vector<float> flat = pairs(positions);
  upload(gl_->position, GL_ARRAY_BUFFER, flat.data(), flat.size() * sizeof(float), GL_STREAM_DRAW);
}

void Renderer::set_fringe(const Mesh* mesh) {
  Objects& gl = *gl_;
  gl.fringe_index_count = gl.fringe_vertex_count = 0;
  if (!mesh) return;
  gl.fringe_vertex_count = static_cast<GLsizei>(mesh->vertices.size());
  gl.fringe_index_count = static_cast<GLsizei>(3 * mesh->triangles.size());
  const std::vector<float> rest = pairs(mesh->vertices);
  glBindVertexArray(gl.fringe_array);
  upload(gl.fringe_rest, GL_ARRAY_BUFFER, rest.data(), rest.size() * sizeof(float), GL_STATIC_DRAW);
  upload(gl.fringe_triangles, GL_ELEMENT_ARRAY_BUFFER, mesh->triangles.data(),
         mesh->triangles.size() * sizeof(Triangle), GL_STATIC_DRAW);
  glBindVertexArray(0);
  set_fringe_positions(mesh->vertices);
}

void Renderer::set_fringe_positions(std::span<const Complex> positions) {
  check(static_cast<GLsizei>(positions.size()) == gl_->fringe_vertex_count,
        "set_fringe_positions: the numbers of positions and vertices differ");
  const std::vector<float> flat = pairs(positions);
  upload(gl_->fringe_position, GL_ARRAY_BUFFER, flat.data(), flat.size() * sizeof(float),
         GL_STREAM_DRAW);
}

void Renderer::set_heat(const Eigen::VectorXf& positions) {
  check(positions.size() == gl_->vertex_count,
        "set_heat: the numbers of values and mesh vertices differ");
  upload(gl_->value, GL_ARRAY_BUFFER, positions.data(),
         static_cast<size_t>(positions.size()) * sizeof(float), GL_STREAM_DRAW);
}

bool Renderer::set_operator(const PlanarMatrix<float>* matrix) {
  Objects& gl = *gl_;
  gl.columns = 0;
  if (!matrix) return false;
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  const Index texels = matrix->rows() * matrix->cols();
  if (texels > most || matrix->rows() != gl.vertex_count) return false;
  std::vector<float> flat(2 * static_cast<size_t>(texels));
  for (Index i = 0; i < texels; ++i) {
    flat[2 * i] = matrix->re.data()[i];
    flat[2 * i + 1] = matrix->im.data()[i];
  }
  upload(gl.matrix, GL_TEXTURE_BUFFER, flat.data(), flat.size() * sizeof(float), GL_STATIC_DRAW);
  glActiveTexture(GL_TEXTURE0 + kMatrix);
  glBindTexture(GL_TEXTURE_BUFFER, gl.matrix_texture);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RG32F, gl.matrix);
  gl.columns = static_cast<int>(matrix->cols());
  return true;
}

void Renderer::set_controls(const VectorXc& controls) {
  Objects& gl = *gl_;
  check(controls.size() == gl.columns, "set_controls: the numbers of controls and columns differ");
  const std::vector<float> flat = pairs(as_span(controls));
  upload(gl.controls, GL_TEXTURE_BUFFER, flat.data(), flat.size() * sizeof(float), GL_STREAM_DRAW);
  glActiveTexture(GL_TEXTURE0 + kControls);
  glBindTexture(GL_TEXTURE_BUFFER, gl.controls_texture);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RG32F, gl.controls);
}

void Renderer::draw(const RenderFrame& frame) {
  Objects& gl = *gl_;
  clear_canvas(frame);
  const double sx = 2 * frame.zoom / std::floor(frame.canvas_width),
               sy = 2 * frame.zoom / std::floor(frame.canvas_height);
  const auto single = [](double x) { return static_cast<float>(x); };
  const double cosine = frame.turn.real(), sine = frame.turn.imag();
  const Complex origin = -frame.turn * frame.center;
  gl.use({single(sx * cosine), single(sy * sine), 0, single(-sx * sine), single(sy * cosine), 0,
          single(sx * origin.real()), single(sy * origin.imag()), 1},
         frame.diverging);
  const bool picture = gl.width > 0;
  // The backdrop, which is visible where the picture is transparent.
  if (frame.map_alone) {
    gl.color(Coloring::flat, frame.backdrop);
    gl.draw_mesh(frame.placement);
  } else if (picture && !frame.over) {
    gl.draw_page(frame);
  }
  if (frame.content != Content::map) {
    if (picture && frame.content == Content::original) {
      gl.color(Coloring::picture);
      gl.draw_quad();
    }
    return finish(frame);
  }
  if (picture && frame.view == View::image && !frame.map_alone)
    gl.draw_surroundings(frame.placement);
  if (picture) gl.draw_ghosts(frame.ghosts);
  if (gl.index_count > 0 && (picture || frame.view != View::image)) {
    gl.color(frame.view == View::image     ? Coloring::picture
             : frame.view == View::checker ? Coloring::checker
                                           : Coloring::heat);
    gl.draw_mesh(frame.placement);
  }
  if (gl.index_count > 0 && frame.wireframe) {
    gl.color(Coloring::flat, {0.05f, 0.15f, 0.35f}, 0.35f);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl.draw_mesh(frame.placement);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
  finish(frame);
}

std::vector<Complex> Renderer::placed_vertices(Placement placement) {
  Objects& gl = *gl_;
  std::vector<float> flat(2 * static_cast<size_t>(gl.vertex_count));
  gl.use({1, 0, 0, 0, 1, 0, 0, 0, 1}, false);
  gl.color(Coloring::flat);
  glUniform1i(gl.at("mode"), mode_of(placement));
  upload(gl.feedback, GL_TRANSFORM_FEEDBACK_BUFFER, nullptr, flat.size() * sizeof(float),
         GL_STREAM_READ);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, gl.feedback);
  glEnable(GL_RASTERIZER_DISCARD);
  glBindVertexArray(gl.vertex_array);
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, gl.vertex_count);
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, gl.feedback);
  glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0,
                     static_cast<GLsizeiptr>(flat.size() * sizeof(float)), flat.data());
  glBindVertexArray(0);
  glUseProgram(0);
  std::vector<Complex> placed;
  for (GLsizei i = 0; i < gl.vertex_count; ++i) placed.push_back({flat[2 * i], flat[2 * i + 1]});
  return placed;
}

std::string driver_name() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name ? name : "unknown";
}

bool is_software_driver() {
  const std::string name = driver_name();
  for (const char* software : {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software"})
    if (name.find(software) != std::string::npos) return true;
  return false;
}

}  // namespace holomorph
