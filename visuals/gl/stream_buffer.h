#pragma once

#include "visuals/gl/object.h"

#include <cstddef>
#include <span>

namespace octant::visuals::gl {

/// A buffer that is filled anew for each picture. Its old memory is given up first, so that the
/// driver need not wait for the picture before; its size only grows.
class StreamBuffer {
public:
    explicit StreamBuffer(const Functions& gl);

    GLuint name() const { return buffer_.name(); }

    /// Puts `first` and then `second` into the buffer.
    void fill(std::span<const std::byte> first, std::span<const std::byte> second);

private:
    const Functions& gl_;
    Object buffer_;
    std::size_t capacity_bytes_;
};

} // namespace octant::visuals::gl
