#pragma once

#include "visuals/gl/object.h"

#include <cstdint>
#include <span>

namespace octant::visuals::gl {

/// Colour (8 bits a part) and depth (32-bit float) to draw into, with 1 or 4 samples a pixel.
/// Rows come out from the top when it was drawn with the clip origin at the upper left.
class Framebuffer {
public:
    /// Throws Error when the driver cannot hold that size or `samples` is neither 1 nor 4.
    Framebuffer(const Functions& gl, int width, int height, int samples);

    int width() const { return width_; }

    int height() const { return height_; }

    GLuint name() const { return drawn_.framebuffer.name(); }

    /// Waits for the drawing and copies it, 4 * width * height bytes (asserted). Several samples
    /// are averaged. Leaves another framebuffer bound.
    void read(std::span<std::uint8_t> rgba) const;

private:
    struct Target {
        Object colour;
        Object depth;
        Object framebuffer;
    };

    Target make_target(int samples, bool with_depth) const;

    const Functions& gl_;
    int width_;
    int height_;
    Target drawn_;
    Target averaged_; ///< empty with 1 sample
};

} // namespace octant::visuals::gl
