#include "visuals/gl/program.h"

#include "sim/base/error.h"

#include <array>
#include <string>

namespace octant::visuals::gl {
namespace {

std::string first_line(const std::string& text) {
    return printable(text.substr(0, text.find('\n')));
}

Object make_shader(const Functions& gl, const char* name, GLenum kind, const char* text) {
    Object shader(
        gl, gl.create_shader(kind), [](const Functions& f, GLuint n) { f.delete_shader(n); });
    gl.shader_source(shader.name(), 1, &text, nullptr);
    gl.compile_shader(shader.name());
    GLint compiled = GL_FALSE;
    gl.get_shaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        std::array<char, 1000> log{};
        gl.get_shader_info_log(
            shader.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw Error(
            std::string("shader ") + name + ": expected it to compile, got " +
            first_line(log.data()));
    }
    return shader;
}

/// The text with a definition behind its first line, which is the #version.
std::string with_definition(const char* text, const char* defined) {
    std::string whole(text);
    if (defined != nullptr) {
        whole.insert(whole.find('\n') + 1, std::string("#define ") + defined + "\n");
    }
    return whole;
}

} // namespace

Object make_program(
    const Functions& gl,
    const char* name,
    const char* vertex_text,
    const char* fragment_text,
    const char* defined) {
    const std::string vertex_code = with_definition(vertex_text, defined);
    const Object vertex = make_shader(gl, name, GL_VERTEX_SHADER, vertex_code.c_str());
    const std::string fragment_code = with_definition(fragment_text, defined);
    const Object fragment = make_shader(gl, name, GL_FRAGMENT_SHADER, fragment_code.c_str());
    Object program(
        gl, gl.create_program(), [](const Functions& f, GLuint n) { f.delete_program(n); });
    gl.attach_shader(program.name(), vertex.name());
    gl.attach_shader(program.name(), fragment.name());
    gl.link_program(program.name());
    GLint linked = GL_FALSE;
    gl.get_programiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        std::array<char, 1000> log{};
        gl.get_program_info_log(
            program.name(), static_cast<GLsizei>(log.size()), nullptr, log.data());
        throw Error(
            std::string("shader ") + name + ": expected it to link, got " + first_line(log.data()));
    }
    return program;
}

} // namespace octant::visuals::gl
