#include "visuals/gl/functions.h"

#include "sim/base/error.h"

#include <charconv>
#include <string>
#include <utility>

namespace octant::visuals::gl {
namespace {

/// Major and minor number at the start of a GL_VERSION text; 0, 0 when it starts otherwise (as "OpenGL ES 3.2" does).
std::pair<int, int> version_numbers(std::string_view version) {
    int major = 0;
    int minor = 0;
    const char* const end = version.data() + version.size();
    const auto [dot, major_fault] = std::from_chars(version.data(), end, major);
    if (major_fault != std::errc() || dot == end || *dot != '.') { return {0, 0}; }
    const auto [rest, minor_fault] = std::from_chars(dot + 1, end, minor);
    return minor_fault == std::errc() ? std::pair(major, minor) : std::pair(0, 0);
}

template <typename Function>
void load(Function& function, const char* name, ProcAddressLookup look_up_address) {
    function = reinterpret_cast<Function>(look_up_address(name));
    if (function == nullptr) { throw Error(std::string("expected the driver to have ") + name + ", got nothing"); }
}

} // namespace

void require_gl_4_5(std::string_view version) {
    if (version_numbers(version) < std::pair(4, 5)) {
        throw Error("expected OpenGL 4.5, got " + printable(std::string(version)));
    }
}

Functions load_functions(ProcAddressLookup look_up_address) {
    Functions gl;
    load(gl.get_string, "glGetString", look_up_address);
    const GLubyte* const version = gl.get_string(GL_VERSION);
    require_gl_4_5(version == nullptr ? "no version" : reinterpret_cast<const char*>(version));
#define OCTANT_GL_LOAD(member, name) load(gl.member, "gl" #name, look_up_address);
    OCTANT_GL_FUNCTIONS(OCTANT_GL_LOAD)
#undef OCTANT_GL_LOAD
    return gl;
}

} // namespace octant::visuals::gl
