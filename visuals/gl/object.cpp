#include "visuals/gl/object.h"

#include "sim/base/error.h"
#include "visuals/gl/debug_messages.h"

#include <array>
#include <string>

namespace octant::visuals::gl {

namespace {

/// An object that one function of `Functions` creates and another one deletes; the first arguments of `create` are
/// `target`.
template <auto create, auto destroy, class... Target>
Object make_object(const Functions& gl, GLenum kind, const char* label, Target... target) {
    GLuint name = 0;
    (gl.*create)(target..., 1, &name);
    label_object(gl, kind, name, label);
    return {gl, name, [](const Functions& of, GLuint gone) { (of.*destroy)(1, &gone); }};
}

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
std::string with_definitions(const char* text, std::span<const char* const> defined) {
    std::string whole(text);
    for (const char* const name : defined) {
        whole.insert(whole.find('\n') + 1, std::string("#define ") + name + "\n");
    }
    return whole;
}

} // namespace

Object make_buffer(const Functions& gl, const char* label) {
    return make_object<&Functions::create_buffers, &Functions::delete_buffers>(gl, GL_BUFFER, label);
}

Object make_framebuffer(const Functions& gl, const char* label) {
    return make_object<&Functions::create_framebuffers, &Functions::delete_framebuffers>(gl, GL_FRAMEBUFFER, label);
}

Object make_renderbuffer(const Functions& gl, const char* label) {
    return make_object<&Functions::create_renderbuffers, &Functions::delete_renderbuffers>(gl, GL_RENDERBUFFER, label);
}

Object make_texture(const Functions& gl, const char* label, GLenum target) {
    return make_object<&Functions::create_textures, &Functions::delete_textures>(gl, GL_TEXTURE, label, target);
}

Object make_program(
    const Functions& gl, const char* name, const ProgramText& text, std::span<const char* const> defined) {
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

Object make_vertex_array(const Functions& gl, const char* label, GLuint indices,
    std::initializer_list<VertexBuffer> vertices_and_instances, std::initializer_list<VertexInput> inputs) {
    Object array =
        make_object<&Functions::create_vertex_arrays, &Functions::delete_vertex_arrays>(gl, GL_VERTEX_ARRAY, label);
    const GLuint name = array.name();
    GLuint binding = 0;
    for (const VertexBuffer& buffer : vertices_and_instances) {
        gl.vertex_array_vertex_buffer(name, binding, buffer.name, 0, static_cast<GLsizei>(buffer.element_bytes));
        if (binding > 0) { gl.vertex_array_binding_divisor(name, binding, 1); }
        ++binding;
    }
    gl.vertex_array_element_buffer(name, indices);
    for (const VertexInput& input : inputs) {
        const auto offset = static_cast<GLuint>(input.offset);
        gl.enable_vertex_array_attrib(name, input.place);
        switch (input.kind) {
        case VertexInput::Kind::Float:
        case VertexInput::Kind::Floats2:
        case VertexInput::Kind::Floats3:
            gl.vertex_array_attrib_format(name, input.place,
                1 + static_cast<GLint>(input.kind) - static_cast<GLint>(VertexInput::Kind::Float), GL_FLOAT, GL_FALSE,
                offset);
            break;
        case VertexInput::Kind::Colour:
            gl.vertex_array_attrib_format(name, input.place, 4, GL_UNSIGNED_BYTE, GL_TRUE, offset);
            break;
        case VertexInput::Kind::Number:
            gl.vertex_array_attrib_i_format(name, input.place, 1, GL_UNSIGNED_INT, offset);
            break;
        }
        gl.vertex_array_attrib_binding(name, input.place, input.is_each ? 1 : 0);
    }
    return array;
}

StreamMesh::StreamMesh(const Functions& gl, const std::string& label, std::size_t first_capacity_bytes,
    std::size_t vertex_bytes, std::initializer_list<VertexInput> inputs)
    : vertices(gl, (label + ", vertices").c_str(), first_capacity_bytes),
      indices(gl, (label + ", indices").c_str(), first_capacity_bytes),
      array(make_vertex_array(gl, label.c_str(), indices.name(), {{vertices.name(), vertex_bytes}}, inputs)) {}

} // namespace octant::visuals::gl
