#include "visuals/gl/debug_messages.h"

#ifdef OCTANT_GL_DEBUG
#include <iostream>
#include <string_view>
#endif

namespace octant::visuals::gl {

#ifdef OCTANT_GL_DEBUG

namespace {

const char* kind_text(GLenum kind) {
    switch (kind) {
    case GL_DEBUG_TYPE_ERROR:
        return "error";
    case GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR:
        return "deprecated behaviour";
    case GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR:
        return "undefined behaviour";
    case GL_DEBUG_TYPE_PERFORMANCE:
        return "performance";
    case GL_DEBUG_TYPE_PORTABILITY:
        return "portability";
    default:
        return "message";
    }
}

void APIENTRY print(GLenum /*source*/, GLenum kind, GLuint /*id*/, GLenum /*severity*/, GLsizei length,
    const GLchar* text, const void* /*user*/) {
    const std::string_view whole =
        length < 0 ? std::string_view(text) : std::string_view(text, static_cast<std::size_t>(length));
    std::cerr << "OpenGL " << kind_text(kind) << ": " << whole << '\n';
}

} // namespace

void print_debug_messages(const Functions& gl) {
    gl.enable(GL_DEBUG_OUTPUT);
    gl.enable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // in the call that a message is about
    gl.debug_message_callback(print, nullptr);
    gl.debug_message_control(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
}

void label_object(const Functions& gl, GLenum kind, GLuint name, const char* label) {
    gl.object_label(kind, name, -1, label);
}

#else

void print_debug_messages(const Functions& /*gl*/) {}

void label_object(const Functions& /*gl*/, GLenum /*kind*/, GLuint /*name*/, const char* /*label*/) {}

#endif

} // namespace octant::visuals::gl
