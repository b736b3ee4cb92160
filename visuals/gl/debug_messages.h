#pragma once

#include "visuals/gl/functions.h"

namespace octant::visuals::gl {

/// Whether this build asks the driver for a debug context and prints its messages (KHR_debug). Only debug builds do:
/// the functions below do nothing in others.
#ifdef OCTANT_GL_DEBUG
inline constexpr bool prints_debug_messages = true;
#else
inline constexpr bool prints_debug_messages = false;
#endif

/// Has the driver's messages printed to standard error from now on, each "OpenGL KIND: text"; mere notifications are
/// left out. For the current context.
void print_debug_messages(const Functions& gl);

/// Gives an object the name by which the driver's messages call it. `kind`: GL_BUFFER, GL_TEXTURE, GL_PROGRAM, ...
void label_object(const Functions& gl, GLenum kind, GLuint name, const char* label);

} // namespace octant::visuals::gl
