#pragma once

#include "visuals/gl/object.h"

namespace octant::visuals::gl {

/// A linked program of a vertex and a fragment shader. Throws Error with the first line of what
/// the driver complains about; `name` says which program. `defined`, where given, is defined for
/// the preprocessor of both.
Object make_program(
    const Functions& gl,
    const char* name,
    const char* vertex_text,
    const char* fragment_text,
    const char* defined = nullptr);

} // namespace octant::visuals::gl
