#pragma once

#include "visuals/gl/object.h"

#include <cstddef>
#include <initializer_list>
#include <span>

namespace octant::visuals::gl {

/// A buffer that is filled anew for each picture. Its old memory is given up first, so that the driver need not wait
/// for the picture before; its size only grows.
class StreamBuffer {
public:
    /// `label`: what debug messages call it.
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

} // namespace octant::visuals::gl
