// A small texture for the user interface.
#pragma once

#include <cstdint>

namespace holomorph {

/// Owns an OpenGL texture of straight-alpha RGBA pixels, rows from the top. Movable.
class Texture {
 public:
  Texture() = default;
  Texture(int width, int height, const std::uint8_t* pixels);
  ~Texture();
  Texture(Texture&& other) noexcept;
  Texture& operator=(Texture&& other) noexcept;

  unsigned id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  unsigned id_ = 0;
  int width_ = 0, height_ = 0;
};

/// Reads the lower left `width` x `height` pixels of the current framebuffer: RGBA, rows from the
/// top.
void read_framebuffer(int width, int height, std::uint8_t* pixels);

}  // namespace holomorph
