#pragma once

#include "visuals/gl/object.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>

namespace octant::visuals::gl {

/// Colour (8 bits a part) and depth (32-bit float) to draw into, with 1 or 4 samples a pixel. Rows come out from the
/// top when it was drawn with the clip origin at the upper left.
class Framebuffer {
public:
    /// Throws Error when the driver cannot hold that size or `samples` is neither 1 nor 4.
    Framebuffer(const Functions& gl, int width, int height, int samples);

    int width() const { return width_; }

    int height() const { return height_; }

    /// The framebuffer object to draw into colour and depth.
    GLuint name() const { return with_depth_.name(); }

    /// The framebuffer object to draw into the same colour, without depth.
    GLuint name_without_depth() const { return without_depth_.name(); }

    /// Waits for the drawing and copies it, 4 * width * height bytes (asserted). Several samples are averaged. Leaves
    /// another framebuffer bound.
    void read(std::span<std::uint8_t> rgba) const;

    bool fits(const glm::ivec2& size_px, int samples) const {
        return size_px == glm::ivec2(width_, height_) && samples == samples_;
    }

    /// Copies it upside down into the lower left corner of another framebuffer, so that rows drawn from the top stand
    /// upright in a window; stretched where `size_px` is another size.
    void copy_to(GLuint target, const glm::ivec2& size_px) const;

private:
    GLuint averaged() const;
    Object make_storage(const char* label, int samples, GLenum format) const;
    Object make_target(const char* label, const Object& colour, const Object* depth) const;

    const Functions* gl_;
    int width_;
    int height_;
    int samples_;
    Object colour_;
    Object depth_;
    Object with_depth_;
    Object without_depth_;
    Object averaged_colour_; ///< empty with 1 sample
    Object averaged_;
};

} // namespace octant::visuals::gl
