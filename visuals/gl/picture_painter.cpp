#include "visuals/gl/picture_painter.h"

#include <cstddef>
#include <utility>

namespace octant::visuals::gl {

PicturePainter::PicturePainter(std::shared_ptr<WindowContext> context)
    : context_(std::move(context)), gl_(context_->current_functions()) {}

PicturePainter::~PicturePainter() { context_->make_current(); }

std::uint8_t* PicturePainter::begin(const glm::ivec2& size_px) {
    if (size_px != size_px_) {
        size_px_ = size_px;
        shared_ = context_->info().is_software ? make_shared_picture(context_->window(), size_px) : nullptr;
        own_.resize(
            shared_ ? 0 : std::size_t{4} * static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y));
    }
    if (shared_) { shared_->wait(); }
    return pixels();
}

void PicturePainter::show(const glm::ivec2& window_px) {
    if (presents_directly(window_px)) {
        shared_->put();
    } else {
        blit(window_px);
    }
}

/// With pixels in the window's own order: Mesa copies them as they are then.
void PicturePainter::make_target() {
    texture_ = make_texture(gl_, "picture for the window");
    gl_.bind_texture(GL_TEXTURE_2D, texture_.name());
    gl_.tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA8, size_px_.x, size_px_.y, 0, GL_BGRA, GL_UNSIGNED_BYTE, nullptr);
    gl_.bind_texture(GL_TEXTURE_2D, 0);
    target_ = make_framebuffer(gl_, "picture for the window");
    gl_.named_framebuffer_texture(target_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
    target_px_ = size_px_;
}

void PicturePainter::blit(const glm::ivec2& window_px) {
    context_->make_current();
    if (target_px_ != size_px_) { make_target(); }
    gl_.disable(GL_SCISSOR_TEST);
    gl_.texture_sub_image_2d(texture_.name(), 0, 0, 0, size_px_.x, size_px_.y, GL_BGRA, GL_UNSIGNED_BYTE, pixels());
    gl_.blit_named_framebuffer(target_.name(), 0, 0, 0, size_px_.x, size_px_.y, 0, window_px.y, window_px.x, 0,
        GL_COLOR_BUFFER_BIT, window_px == size_px_ ? GL_NEAREST : GL_LINEAR);
}

} // namespace octant::visuals::gl
