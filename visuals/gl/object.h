#pragma once

#include "visuals/gl/functions.h"

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
Object make_vertex_array(const Functions& gl, const char* label);
Object make_framebuffer(const Functions& gl, const char* label);
Object make_renderbuffer(const Functions& gl, const char* label);

/// A two-dimensional one.
Object make_texture(const Functions& gl, const char* label);

} // namespace octant::visuals::gl
