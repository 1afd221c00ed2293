// Closes POSIX file descriptors.
#pragma once

#include <unistd.h>

namespace holomorph {

/// A file descriptor that is closed when it goes out of scope.
struct Descriptor {
  int fd;
  ~Descriptor() { ::close(fd); }
};

}  // namespace holomorph
