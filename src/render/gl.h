// The OpenGL loader: the only include of it.
#pragma once

#include <epoxy/gl.h>
