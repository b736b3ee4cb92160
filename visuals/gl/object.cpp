#include "visuals/gl/object.h"

#include "sim/base/error.h"
#include "visuals/gl/debug_messages.h"

#include <array>
#include <string>

namespace octant::visuals::gl {

Object make_buffer(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_buffers(1, &name);
    label_object(gl, GL_BUFFER, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_buffers(1, &n); }};
}

Object make_vertex_array(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_vertex_arrays(1, &name);
    label_object(gl, GL_VERTEX_ARRAY, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_vertex_arrays(1, &n); }};
}

Object make_framebuffer(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_framebuffers(1, &name);
    label_object(gl, GL_FRAMEBUFFER, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_framebuffers(1, &n); }};
}

Object make_renderbuffer(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_renderbuffers(1, &name);
    label_object(gl, GL_RENDERBUFFER, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_renderbuffers(1, &n); }};
}

Object make_texture(const Functions& gl, const char* label) {
    GLuint name = 0;
    gl.create_textures(GL_TEXTURE_2D, 1, &name);
    label_object(gl, GL_TEXTURE, name, label);
    return {gl, name, [](const Functions& f, GLuint n) { f.delete_textures(1, &n); }};
}

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

StreamBuffer::StreamBuffer(const Functions& gl, const char* label, std::size_t first_capacity_bytes)
    : gl_(gl), buffer_(make_buffer(gl, label)), capacity_bytes_(first_capacity_bytes) {}

void StreamBuffer::fill(std::span<const std::span<const std::byte>> pieces) {
    std::size_t size = 0;
    for (const auto& piece : pieces) { size += piece.size(); }
    while (capacity_bytes_ < size) { capacity_bytes_ *= 2; }
    gl_.named_buffer_data(name(), static_cast<GLsizeiptr>(capacity_bytes_), nullptr, GL_STREAM_DRAW);
    std::size_t at = 0;
    for (const auto& piece : pieces) {
        if (!piece.empty()) {
            gl_.named_buffer_sub_data(
                name(), static_cast<GLintptr>(at), static_cast<GLsizeiptr>(piece.size()), piece.data());
        }
        at += piece.size();
    }
}

void add_vector_input(const Functions& gl, const Object& array, GLuint input, std::size_t offset) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_format(array.name(), input, 3, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, 0);
}

void add_place_input(const Functions& gl, const Object& array, GLuint input, std::size_t offset) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_format(array.name(), input, 2, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, 0);
}

void add_colour_input(const Functions& gl, const Object& array, std::size_t offset, GLuint input, GLuint binding) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_format(array.name(), input, 4, GL_UNSIGNED_BYTE, GL_TRUE, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, binding);
}

void add_number_input(const Functions& gl, const Object& array, GLuint input, GLuint binding, std::size_t offset) {
    gl.enable_vertex_array_attrib(array.name(), input);
    gl.vertex_array_attrib_i_format(array.name(), input, 1, GL_UNSIGNED_INT, static_cast<GLuint>(offset));
    gl.vertex_array_attrib_binding(array.name(), input, binding);
}

} // namespace octant::visuals::gl
