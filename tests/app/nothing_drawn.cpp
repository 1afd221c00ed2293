// The interfaces of src/render without OpenGL: they accept everything and draw nothing. Linked in
// place of src/render, so that the editor runs where there is neither a display nor a driver.
#include "render/compositor.h"
#include "render/framebuffer.h"
#include "render/renderer.h"
#include "render/surface_renderer.h"
#include "render/texture.h"

namespace holomorph {

std::string driver_name() {
  return "none";
}
bool is_software_driver() {
  return true;
}

struct Renderer::Objects {};
Renderer::Renderer() = default;
Renderer::~Renderer() = default;
void Renderer::place_picture(const Box&, const Box&) {}
int Renderer::set_picture(int, int, const std::uint8_t*) {
  return 1;
}
void Renderer::begin_picture(std::shared_ptr<const TextureLevels>) {}
bool Renderer::upload_more(size_t) {
  return false;
}
int Renderer::largest_side() {
  return 16384;
}
void Renderer::set_mesh(const Mesh*) {}
void Renderer::set_triangles(const std::vector<Triangle>&) {}
void Renderer::set_positions(std::span<const Complex>) {}
void Renderer::set_fringe(const Mesh*) {}
void Renderer::set_fringe_positions(std::span<const Complex>) {}
void Renderer::set_heat(const Eigen::VectorXf&) {}
bool Renderer::set_operator(const PlanarMatrix<float>*) {
  return false;
}
void Renderer::set_controls(const VectorXc&) {}
void Renderer::draw(const RenderFrame&) {}

Texture::Texture(int width, int height, const std::uint8_t*)
    : id_(1), width_(width), height_(height) {}
Texture::~Texture() = default;
Texture::Texture(Texture&&) noexcept = default;
Texture& Texture::operator=(Texture&&) noexcept = default;

Framebuffer::Framebuffer() = default;
Framebuffer::~Framebuffer() = default;
void Framebuffer::bind(int width, int height) {
  width_ = width;
  height_ = height;
}
void Framebuffer::release() {}

Program::Program(const std::string&, const std::string&, const char*) {}
Program::~Program() = default;
Program surface_program() {
  return {"", ""};
}

Compositor::Compositor() : program_("", "") {}
Compositor::~Compositor() = default;
void Compositor::begin(int, int) {}
void Compositor::begin_layer() {}
void Compositor::end_layer(const Ink&) {}
void Compositor::keep() {}
void Compositor::fill_gaps(int) {}
void Compositor::finish(int, int, int, int) {}

SurfaceRenderer::SurfaceRenderer() = default;
SurfaceRenderer::~SurfaceRenderer() = default;
void SurfaceRenderer::set_surface(const Surface&) {}
void SurfaceRenderer::set_coordinates(const Points&) {}
void SurfaceRenderer::draw(const SurfaceFrame&) {}

}  // namespace holomorph
