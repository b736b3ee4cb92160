#pragma once

#include "visuals/gl/object.h"

namespace octant::visuals::gl {

/// A linked program of a vertex and a fragment shader. Throws Error with the first line of what
/// the driver complains about; `name` says which program.
Object make_program(
    const Functions& gl, const char* name, const char* vertex_text, const char* fragment_text);

} // namespace octant::visuals::gl
