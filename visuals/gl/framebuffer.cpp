#include "visuals/gl/framebuffer.h"

#include "sim/base/error.h"

#include <cassert>
#include <cstddef>
#include <fmt/format.h>

namespace octant::visuals::gl {

namespace {

void check_size(const Functions& gl, int width, int height, int samples) {
    GLint largest = 0;
    gl.get_integerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw Error(
            fmt::format("expected a picture of 1 x 1 to {0} x {0} pixels, got {1} x {2}", largest, width, height));
    }
    GLint max_samples = 0;
    gl.get_integerv(GL_MAX_SAMPLES, &max_samples);
    if ((samples != 1 && samples != 4) || samples > max_samples) {
        throw Error(
            fmt::format("expected 1 or 4 samples a pixel (the driver has up to {}), got {}", max_samples, samples));
    }
}

} // namespace

Framebuffer::Framebuffer(const Functions& gl, int width, int height, int samples)
    : gl_(&gl), width_(width), height_(height), samples_(samples) {
    check_size(gl, width, height, samples);
    colour_ = make_storage("picture's colour", samples, GL_RGBA8);
    depth_ = make_storage("picture's depth", samples, GL_DEPTH_COMPONENT32F);
    with_depth_ = make_target("picture", colour_, &depth_);
    without_depth_ = make_target("picture without depth", colour_, nullptr);
    if (samples > 1) {
        averaged_colour_ = make_storage("averaged picture's colour", 1, GL_RGBA8);
        averaged_ = make_target("averaged picture", averaged_colour_, nullptr);
    }
}

Object Framebuffer::make_storage(const char* label, int samples, GLenum format) const {
    Object storage = make_renderbuffer(*gl_, label);
    gl_->named_renderbuffer_storage_multisample(storage.name(), samples > 1 ? samples : 0, format, width_, height_);
    return storage;
}

Object Framebuffer::make_target(const char* label, const Object& colour, const Object* depth) const {
    Object target = make_framebuffer(*gl_, label);
    const auto attach = [&](GLenum place, const Object& storage) {
        gl_->named_framebuffer_renderbuffer(target.name(), place, GL_RENDERBUFFER, storage.name());
    };
    attach(GL_COLOR_ATTACHMENT0, colour);
    if (depth != nullptr) { attach(GL_DEPTH_ATTACHMENT, *depth); }
    const GLenum status = gl_->check_named_framebuffer_status(target.name(), GL_DRAW_FRAMEBUFFER);
    if (gl_->get_error() != GL_NO_ERROR || status != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(fmt::format("expected memory for a picture of {} x {} pixels with {} samples, got a refusal by the "
                                "driver",
            width_, height_, samples_));
    }
    return target;
}

/// The framebuffer object to copy from: of several samples a pixel their average, made now.
GLuint Framebuffer::averaged() const {
    if (averaged_.name() == 0) { return with_depth_.name(); }
    gl_->blit_named_framebuffer(with_depth_.name(), averaged_.name(), 0, 0, width_, height_, 0, 0, width_, height_,
        GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return averaged_.name();
}

void Framebuffer::read(std::span<std::uint8_t> rgba) const {
    assert(rgba.size() == std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    gl_->bind_framebuffer(GL_FRAMEBUFFER, averaged());
    gl_->read_pixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
}

void Framebuffer::copy_to(GLuint target, const glm::ivec2& size_px) const {
    const bool same_size = size_px == glm::ivec2(width_, height_);
    gl_->blit_named_framebuffer(averaged(), target, 0, 0, width_, height_, 0, size_px.y, size_px.x, 0,
        GL_COLOR_BUFFER_BIT, same_size ? GL_NEAREST : GL_LINEAR);
}

} // namespace octant::visuals::gl
