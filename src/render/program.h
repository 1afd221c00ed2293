// Shaders as programs.
#pragma once

#include <string>

namespace holomorph {

/// Owns a linked GL program. Needs a current context.
class Program {
 public:
  /// `read_back` is what transform feedback records, or null. Throws Error{failed} with the
  /// driver's log for what does not compile or link.
  Program(const std::string& vertex, const std::string& fragment, const char* read_back = nullptr);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  unsigned id() const { return id_; }
  /// A uniform's location.
  int at(const char* uniform) const;

 private:
  unsigned id_ = 0;
};

/// The two programs, from the files of shaders/: a map on the plane, and a surface in space.
Program warp_program();
Program surface_program();

}  // namespace holomorph
