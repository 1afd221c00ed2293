// Half-float textures keep the sums of many faint layers exact enough for 8 bits.
#include "render/compositor.h"

#include <utility>

#include "core/error.h"
#include "render/gl.h"

namespace holomorph {

Compositor::Compositor() : program_(composite_program()) {
  glGenVertexArrays(1, &array_);
  glGenRenderbuffers(1, &stencil_);
  for (Target* target : targets()) {
    glGenFramebuffers(1, &target->framebuffer);
    glGenTextures(1, &target->texture);
  }
}

Compositor::~Compositor() {
  for (Target* target : targets()) {
    glDeleteFramebuffers(1, &target->framebuffer);
    glDeleteTextures(1, &target->texture);
  }
  glDeleteRenderbuffers(1, &stencil_);
  glDeleteVertexArrays(1, &array_);
}

void Compositor::resize(int width, int height) {
  width_ = width;
  height_ = height;
  fills_gaps_ = false;
  glBindRenderbuffer(GL_RENDERBUFFER, stencil_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
  for (const Target* target : {&under_, &base_, &over_, &result_}) allocate(*target);
}

void Compositor::allocate(const Target& target) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, target.texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width_, height_, 0, GL_RGBA, GL_HALF_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, stencil_);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  width_ = height_ = 0;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  throw Error(ErrorKind::failed, "this graphics driver cannot draw into a texture");
}

void Compositor::begin(int width, int height) {
  if (width != width_ || height != height_) resize(width, height);
  clear(under_);
  has_behind_ = false;
  base_ink_.reset();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Compositor::clear(const Target& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void Compositor::begin_layer() {
  clear(over_);
}

void Compositor::combine(const Target& into, const Target& under, const Target& over,
                         const Ink& ink) {
  glBindFramebuffer(GL_FRAMEBUFFER, into.framebuffer);
  glUseProgram(program_.id());
  const auto bind = [&](GLenum unit, const char* name, unsigned texture) {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture);
    glUniform1i(program_.at(name), static_cast<GLint>(unit));
  };
  bind(1, "over_layer", over.texture);
  bind(0, "under_layers", under.texture);
  glUniform1i(program_.at("blending"), ink.blending);
  glUniform1f(program_.at("opacity"), static_cast<float>(ink.opacity));
  glUniform1i(program_.at("clipped"), ink.clipped);
  glViewport(0, 0, width_, height_);
  glBindVertexArray(array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glUseProgram(0);
}

void Compositor::blend(Target& under, const Target& over, const Ink& ink) {
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  combine(result_, under, over, ink);
  std::swap(under, result_);
  glEnable(GL_BLEND);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Compositor::end_base() {
  if (base_ink_) blend(under_, base_, *base_ink_);
  base_ink_.reset();
}

void Compositor::end_layer(const Ink& ink) {
  if (ink.clipped) return blend(base_, over_, ink);
  end_base();
  std::swap(base_, over_);
  base_ink_ = ink;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Compositor::keep() {
  end_base();
  if (!std::exchange(fills_gaps_, true)) {
    allocate(kept_);
    allocate(behind_);
  }
  std::swap(kept_, under_);
  clear(under_);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Compositor::fill_gaps(int blending) {
  end_base();
  blend(under_, kept_, {.blending = -2});
  if (!std::exchange(has_behind_, true)) clear(behind_);
  blend(behind_, under_, {.blending = blending});
  clear(under_);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Compositor::finish(int left, int bottom, int width, int height) {
  end_base();
  if (has_behind_) {
    blend(behind_, under_, {});
    std::swap(under_, behind_);
  }
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_SCISSOR_TEST);
  glScissor(left, bottom, width, height);
  combine({0, 0}, under_, under_, {.blending = -1});
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace holomorph
