// Compiles and links shaders, and reports the driver's log if that fails.
#include "render/program.h"

#include "core/error.h"
#include "render/gl.h"
#include "shaders.h"  // the files in shaders/, as strings

namespace holomorph {
namespace {

GLuint compiled(GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const std::string text = "#version 330 core\n" + source;
  const char* pointer = text.c_str();
  glShaderSource(shader, 1, &pointer, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char log[2000] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    throw Error(ErrorKind::failed, std::string("a shader does not compile on this driver: ") + log);
  }
  return shader;
}

}  // namespace

Program::Program(const std::string& vertex, const std::string& fragment, const char* read_back)
    : id_(glCreateProgram()) {
  for (const auto& [kind, source] :
       {std::pair(GL_VERTEX_SHADER, &vertex), std::pair(GL_FRAGMENT_SHADER, &fragment)}) {
    const GLuint shader = compiled(static_cast<GLenum>(kind), *source);
    glAttachShader(id_, shader);
    glDeleteShader(shader);  // takes effect when the program is deleted
  }
  if (read_back) glTransformFeedbackVaryings(id_, 1, &read_back, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(id_);
  GLint good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &good);
  if (!good) {
    char log[2000] = "";
    glGetProgramInfoLog(id_, sizeof log, nullptr, log);
    throw Error(ErrorKind::failed, std::string("the shaders do not link on this driver: ") + log);
  }
}

Program::~Program() {
  glDeleteProgram(id_);
}

int Program::at(const char* uniform) const {
  return glGetUniformLocation(id_, uniform);
}

Program warp_program(int coloring) {
  return {kWarpVert, "#define COLORING " + std::to_string(coloring) + "\n" + kImageFrag, "warped"};
}
Program surface_program() {
  return {kSurfaceVert, kSurfaceFrag};
}
Program composite_program() {
  return {kCompositeVert, kCompositeFrag};
}

}  // namespace holomorph
