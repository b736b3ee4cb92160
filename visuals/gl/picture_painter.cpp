#include "visuals/gl/picture_painter.h"

#include <utility>

namespace octant::visuals::gl {

PicturePainter::PicturePainter(std::shared_ptr<Context> context)
    : context_(std::move(context))
    , gl_(context_->current_functions()) {}

PicturePainter::~PicturePainter() {
    context_->make_current();
}

void PicturePainter::make_target(const glm::ivec2& size_px) {
    texture_ = make_texture(gl_, "picture for the window");
    gl_.texture_storage_2d(texture_.name(), 1, GL_RGBA8, size_px.x, size_px.y);
    target_ = make_framebuffer(gl_, "picture for the window");
    gl_.named_framebuffer_texture(target_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
    held_px_ = size_px;
}

void PicturePainter::show(const scene::Picture& picture, const glm::ivec2& size_px) {
    context_->make_current();
    const glm::ivec2 from_px(picture.width, picture.height);
    if (held_px_ != from_px) {
        make_target(from_px);
    }
    gl_.disable(GL_SCISSOR_TEST);
    gl_.texture_sub_image_2d(
        texture_.name(),
        0,
        0,
        0,
        from_px.x,
        from_px.y,
        GL_RGBA,
        GL_UNSIGNED_BYTE,
        picture.rgba.data());
    gl_.blit_named_framebuffer(
        target_.name(),
        0,
        0,
        0,
        from_px.x,
        from_px.y,
        0,
        size_px.y,
        size_px.x,
        0,
        GL_COLOR_BUFFER_BIT,
        size_px == from_px ? GL_NEAREST : GL_LINEAR);
}

} // namespace octant::visuals::gl
