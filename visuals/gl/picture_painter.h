#pragma once

#include "visuals/gl/object.h"
#include "visuals/gl/shared_picture.h"
#include "visuals/gl/window_context.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>

#include <memory>

namespace octant::visuals::gl {

/// Puts pictures that were made elsewhere into a context's window: straight by memory shared with the display where a
/// processor draws, else by a texture.
class PicturePainter final : public scene::WindowPicture {
public:
    explicit PicturePainter(std::shared_ptr<WindowContext> context);
    ~PicturePainter() override;
    PicturePainter(const PicturePainter&) = delete;
    PicturePainter& operator=(const PicturePainter&) = delete;
    PicturePainter(PicturePainter&&) = delete;
    PicturePainter& operator=(PicturePainter&&) = delete;

    std::uint8_t* begin(const glm::ivec2& size_px) override;
    void show(const glm::ivec2& window_px) override;

    /// Whether show() puts the picture into a window of this size without OpenGL: nothing is to be drawn over it and no
    /// buffers are to be swapped then.
    bool presents_directly(const glm::ivec2& window_px) const { return shared_ && window_px == size_px_; }

    /// Of the picture at hand, as begin() gave them.
    std::uint8_t* pixels() { return shared_ ? shared_->pixels() : own_.data(); }

private:
    void make_target();
    void blit(const glm::ivec2& window_px);

    std::shared_ptr<WindowContext> context_; ///< declared first, so that it is destroyed last
    const Functions& gl_;
    std::unique_ptr<SharedPicture> shared_;
    scene::PictureBytes own_; ///< where the display shares no memory
    Object texture_;
    Object target_; ///< framebuffer of the texture
    glm::ivec2 size_px_{0};
    glm::ivec2 target_px_{0};
};

} // namespace octant::visuals::gl
