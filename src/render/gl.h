// The only include of the OpenGL loader.
#pragma once

#include <epoxy/gl.h>
