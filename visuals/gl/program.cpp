#include "visuals/gl/program.h"

#include "sim/base/error.h"
#include "visuals/gl/debug_messages.h"

#include <array>
#include <string>

namespace octant::visuals::gl {
namespace {

std::string first_line(const std::string& text) { return printable(text.substr(0, text.find('\n'))); }

Object make_shader(const Functions& gl, const char* name, GLenum kind, const char* text) {
    Object shader(gl, gl.create_shader(kind), [](const Functions& f, GLuint n) { f.delete_shader(n); });
    gl.shader_source(shader.name(), 1, &text, nullptr);
    gl.compile_shader(shader.name());
    GLint compiled = GL_FALSE;
    gl.get_shaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        std::array<char, 1000> log{};
        gl.get_shader_info_log(shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw Error(std::string("shader ") + name + ": expected it to compile, got " + first_line(log.data()));
    }
    return shader;
}

/// The text with definitions behind its first line, which is the #version.
std::string with_definitions(const char* text, std::initializer_list<const char*> defined) {
    std::string whole(text);
    for (const char* const name : defined) {
        whole.insert(whole.find('\n') + 1, std::string("#define ") + name + "\n");
    }
    return whole;
}

} // namespace

Object make_program(
    const Functions& gl, const char* name, const ProgramText& text, std::initializer_list<const char*> defined) {
    Object program(gl, gl.create_program(), [](const Functions& f, GLuint n) { f.delete_program(n); });
    label_object(gl, GL_PROGRAM, program.name(), name);
    const auto attach = [&](GLenum kind, const char* stage) {
        if (stage != nullptr) {
            const std::string code = with_definitions(stage, defined);
            gl.attach_shader(program.name(), make_shader(gl, name, kind, code.c_str()).name());
        }
    };
    attach(GL_VERTEX_SHADER, text.vertex);
    attach(GL_GEOMETRY_SHADER, text.geometry);
    attach(GL_FRAGMENT_SHADER, text.fragment);
    gl.link_program(program.name());
    GLint linked = GL_FALSE;
    gl.get_programiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        std::array<char, 1000> log{};
        gl.get_program_info_log(program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw Error(std::string("shader ") + name + ": expected it to link, got " + first_line(log.data()));
    }
    return program;
}

} // namespace octant::visuals::gl
