#pragma once

#include "visuals/gl/functions.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>

namespace octant::visuals::gl {

/// Owns one GL object. Its context must be current when it is destroyed.
class Object {
public:
    using Delete = void (*)(const Functions& gl, GLuint name);

    Object() = default;

    Object(const Functions& gl, GLuint name, Delete deleter) : gl_(&gl), name_(name), delete_(deleter) {}

    ~Object() {
        if (name_ != 0) { delete_(*gl_, name_); }
    }

    Object(Object&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0U)), delete_(other.delete_) {}

    Object& operator=(Object&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(name_, other.name_);
        std::swap(delete_, other.delete_);
        return *this;
    }

    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    GLuint name() const { return name_; }

private:
    const Functions* gl_ = nullptr;
    GLuint name_ = 0;
    Delete delete_ = nullptr;
};

// `label`: what debug messages call the object.

Object make_buffer(const Functions& gl, const char* label);
Object make_framebuffer(const Functions& gl, const char* label);
Object make_renderbuffer(const Functions& gl, const char* label);

/// `target`: GL_TEXTURE_2D or GL_TEXTURE_3D.
Object make_texture(const Functions& gl, const char* label, GLenum target = GL_TEXTURE_2D);

/// The texts of a program's shaders.
struct ProgramText {
    const char* vertex = nullptr;
    const char* fragment = nullptr;
    const char* geometry = nullptr; ///< null = none
};

/// A linked program of a vertex and a fragment shader. Throws Error with the first line of what the driver complains
/// about; `name` says which program. `defined` are defined for the preprocessor of all.
Object make_program(
    const Functions& gl, const char* name, const ProgramText& text, std::span<const char* const> defined = {});

/// A buffer that is filled anew for each picture. Its old memory is given up first, so that the driver need not wait
/// for the picture before; its size only grows.
class StreamBuffer {
public:
    StreamBuffer(const Functions& gl, const char* label, std::size_t first_capacity_bytes);

    GLuint name() const { return buffer_.name(); }

    /// Puts the pieces into the buffer, one behind the other.
    void fill(std::span<const std::span<const std::byte>> pieces);

    void fill(std::initializer_list<std::span<const std::byte>> pieces) {
        fill(std::span(pieces.begin(), pieces.size()));
    }

private:
    const Functions& gl_;
    Object buffer_;
    std::size_t capacity_bytes_;
};

// Places of the inputs in visuals/gl/shaders/*.vert.
constexpr GLuint position_input = 0;
constexpr GLuint colour_input = 1;
constexpr GLuint normal_input = 2;
constexpr GLuint part_input = 3;
constexpr GLuint first_part_input = 4;
constexpr GLuint face_normal_input = 5;
constexpr GLuint polygon_input = 6;
constexpr GLuint first_smooth_input = 7;
constexpr GLuint face_colour_input = 8;
constexpr GLuint smooth_tint_input = 9;
constexpr GLuint flat_tint_input = 10;
constexpr GLuint on_texture_input = 11;
constexpr GLuint texture_input = 12;
constexpr GLuint first_texture_input = 13;
constexpr GLuint depth_input = 2; ///< of the overlay

/// An input of a vertex shader.
struct VertexInput {
    enum class Kind {
        Float,
        Floats2,
        Floats3,
        Colour, ///< four bytes, 255 read as 1
        Number  ///< a 32-bit whole number
    };

    GLuint place;
    Kind kind;
    std::size_t offset;   ///< in each element of the buffer, bytes
    bool is_each = false; ///< read from the array's second buffer, which has an element for each instance
};

/// A buffer that a vertex array reads.
struct VertexBuffer {
    GLuint name;
    std::size_t element_bytes;
};

/// A vertex array that reads vertices, and elements for each instance where there are any.
Object make_vertex_array(const Functions& gl, const char* label, GLuint indices,
    std::initializer_list<VertexBuffer> vertices_and_instances, std::initializer_list<VertexInput> inputs);

/// The place of an index in a buffer of 32-bit indices, as draw calls take it.
inline const void* index_offset(std::size_t first) {
    return reinterpret_cast<const void*>(first * sizeof(std::uint32_t));
}

/// Triangles that are uploaded anew for each picture.
struct StreamMesh {
    StreamBuffer vertices;
    StreamBuffer indices;
    Object array;

    StreamMesh(const Functions& gl, const std::string& label, std::size_t first_capacity_bytes,
        std::size_t vertex_bytes, std::initializer_list<VertexInput> inputs);
};

} // namespace octant::visuals::gl
