#pragma once

#include "visuals/gl/object.h"

#include <initializer_list>

namespace octant::visuals::gl {

/// The texts of a program's shaders.
struct ProgramText {
    const char* vertex = nullptr;
    const char* fragment = nullptr;
    const char* geometry = nullptr; ///< null = none
};

/// A linked program of a vertex and a fragment shader. Throws Error with the first line of what the driver complains
/// about; `name` says which program. `defined` are defined for the preprocessor of all.
Object make_program(
    const Functions& gl, const char* name, const ProgramText& text, std::initializer_list<const char*> defined = {});

} // namespace octant::visuals::gl
