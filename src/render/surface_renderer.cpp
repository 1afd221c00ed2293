// Uses one vertex array. The fragment shader's light moves with the camera.
#include "render/surface_renderer.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "render/gl.h"

namespace holomorph {
namespace {

void upload(GLuint buffer, GLenum target, const void* data, size_t bytes) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
}

}  // namespace

SurfaceRenderer::SurfaceRenderer() {
  glGenVertexArrays(1, &array_);
  for (GLuint* buffer : {&positions_, &normals_, &coordinates_, &triangles_})
    glGenBuffers(1, buffer);
  glBindVertexArray(array_);
  const auto attribute = [](GLuint buffer, GLuint location, GLint size) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, 0, nullptr);
  };
  attribute(positions_, 0, 3);
  attribute(normals_, 1, 3);
  attribute(coordinates_, 2, 2);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_);
  glBindVertexArray(0);
}

SurfaceRenderer::~SurfaceRenderer() {
  for (const GLuint buffer : {positions_, normals_, coordinates_, triangles_})
    glDeleteBuffers(1, &buffer);
  glDeleteVertexArrays(1, &array_);
}

void SurfaceRenderer::set_surface(const Surface& surface) {
  vertex_count_ = static_cast<int>(surface.vertices.size());
  index_count_ = static_cast<int>(3 * surface.triangles.size());
  Eigen::Matrix3Xf positions(3, vertex_count_), normals = Eigen::Matrix3Xf::Zero(3, vertex_count_);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.vertices) box.extend(p);
  middle_ = vertex_count_ > 0 ? Eigen::Vector3d(box.center()) : Eigen::Vector3d::Zero();
  for (int i = 0; i < vertex_count_; ++i)
    positions.col(i) = (surface.vertices[static_cast<size_t>(i)] - middle_).cast<float>();
  for (const auto& [a, b, c] : surface.triangles) {
    const Eigen::Vector3f area =
        (positions.col(b) - positions.col(a)).cross(positions.col(c) - positions.col(a));
    for (const int v : {a, b, c}) normals.col(v) += area;
  }
  const Eigen::Matrix2Xf nowhere = Eigen::Matrix2Xf::Zero(2, vertex_count_);
  glBindVertexArray(0);
  const auto bytes = [](const auto& matrix) {
    return static_cast<size_t>(matrix.size()) * sizeof(float);
  };
  upload(positions_, GL_ARRAY_BUFFER, positions.data(), bytes(positions));
  upload(normals_, GL_ARRAY_BUFFER, normals.data(), bytes(normals));
  upload(coordinates_, GL_ARRAY_BUFFER, nowhere.data(), bytes(nowhere));
  glBindVertexArray(array_);
  upload(triangles_, GL_ELEMENT_ARRAY_BUFFER, surface.triangles.data(),
         surface.triangles.size() * sizeof(surface.triangles[0]));
  glBindVertexArray(0);
}

void SurfaceRenderer::set_coordinates(const Points& coordinates) {
  check(static_cast<int>(coordinates.size()) == vertex_count_,
        "set_coordinates: the numbers of coordinates and vertices differ");
  Eigen::Matrix2Xf flat(2, vertex_count_);
  for (int i = 0; i < vertex_count_; ++i) {
    const Complex z = coordinates[static_cast<size_t>(i)];
    flat.col(i) << static_cast<float>(z.real()), static_cast<float>(z.imag());
  }
  upload(coordinates_, GL_ARRAY_BUFFER, flat.data(),
         static_cast<size_t>(flat.size()) * sizeof(float));
}

void SurfaceRenderer::draw(const SurfaceFrame& frame) {
  glViewport(0, 0, frame.width, frame.height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glClearColor(frame.background[0], frame.background[1], frame.background[2], 1);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

  glUseProgram(program_.id());
  Eigen::Matrix4d from_middle = frame.to_view;
  from_middle.topRightCorner<3, 1>() += frame.to_view.topLeftCorner<3, 3>() * middle_;
  const Eigen::Matrix4f to_view = from_middle.cast<float>(), to_clip = frame.to_clip.cast<float>();
  glUniformMatrix4fv(program_.at("to_view"), 1, GL_FALSE, to_view.data());
  glUniformMatrix4fv(program_.at("to_clip"), 1, GL_FALSE, to_clip.data());
  glUniform3f(program_.at("clay"), frame.clay[0], frame.clay[1], frame.clay[2]);
  glUniform1i(program_.at("textured"), frame.texture != 0);
  glUniform1i(program_.at("picture"), 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, frame.texture);
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace holomorph
