// Shader programs.
#pragma once

#include <string>

namespace holomorph {

/// Owns a linked GL program. Needs a current context.
class Program {
 public:
  /// `read_back` is the name of the output that transform feedback records, or null. Throws
  /// Error{failed} with the driver's log if a shader does not compile or link.
  Program(const std::string& vertex, const std::string& fragment, const char* read_back = nullptr);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  unsigned id() const { return id_; }
  /// The location of a uniform; -1, which OpenGL ignores, if the program does not use it.
  int at(const char* uniform) const;

 private:
  unsigned id_ = 0;
};

/// The programs, built from the files in shaders/. They draw a map of the plane with one
/// COLORING of shaders/image.frag, a surface in space, and layers over one another.
Program warp_program(int coloring);
Program surface_program();
Program composite_program();

}  // namespace holomorph
