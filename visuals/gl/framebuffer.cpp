#include "visuals/gl/framebuffer.h"

#include "sim/base/error.h"

#include <cassert>
#include <fmt/format.h>

namespace octant::visuals::gl {
namespace {

void check_size(const Functions& gl, int width, int height, int samples) {
    GLint largest = 0;
    gl.get_integerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw Error(fmt::format(
            "expected a picture of 1 x 1 to {0} x {0} pixels, got {1} x {2}",
            largest,
            width,
            height));
    }
    GLint most_samples = 0;
    gl.get_integerv(GL_MAX_SAMPLES, &most_samples);
    if ((samples != 1 && samples != 4) || samples > most_samples) {
        throw Error(fmt::format(
            "expected 1 or 4 samples a pixel (the driver has up to {}), got {}",
            most_samples,
            samples));
    }
}

} // namespace

Framebuffer::Framebuffer(const Functions& gl, int width, int height, int samples)
    : gl_(gl)
    , width_(width)
    , height_(height) {
    check_size(gl, width, height, samples);
    drawn_ = make_target(samples, true);
    if (samples > 1) {
        averaged_ = make_target(1, false);
    }
}

Framebuffer::Target Framebuffer::make_target(int samples, bool with_depth) const {
    const auto attach = [&](const Object& framebuffer, GLenum place, GLenum format) {
        Object buffer = make_renderbuffer(gl_);
        gl_.named_renderbuffer_storage_multisample(
            buffer.name(), samples > 1 ? samples : 0, format, width_, height_);
        gl_.named_framebuffer_renderbuffer(
            framebuffer.name(), place, GL_RENDERBUFFER, buffer.name());
        return buffer;
    };
    Target target;
    target.framebuffer = make_framebuffer(gl_);
    target.colour = attach(target.framebuffer, GL_COLOR_ATTACHMENT0, GL_RGBA8);
    if (with_depth) {
        target.depth = attach(target.framebuffer, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
    }
    const GLenum status =
        gl_.check_named_framebuffer_status(target.framebuffer.name(), GL_DRAW_FRAMEBUFFER);
    if (gl_.get_error() != GL_NO_ERROR || status != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(fmt::format(
            "expected memory for a picture of {} x {} pixels with {} samples, got a refusal by the "
            "driver",
            width_,
            height_,
            samples));
    }
    return target;
}

void Framebuffer::read(std::span<std::uint8_t> rgba) const {
    assert(
        rgba.size() ==
        std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    GLuint source = drawn_.framebuffer.name();
    if (averaged_.framebuffer.name() != 0) {
        gl_.blit_named_framebuffer(
            source,
            averaged_.framebuffer.name(),
            0,
            0,
            width_,
            height_,
            0,
            0,
            width_,
            height_,
            GL_COLOR_BUFFER_BIT,
            GL_NEAREST);
        source = averaged_.framebuffer.name();
    }
    gl_.bind_framebuffer(GL_FRAMEBUFFER, source);
    gl_.read_pixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

} // namespace octant::visuals::gl
