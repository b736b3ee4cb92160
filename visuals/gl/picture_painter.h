#pragma once

#include "visuals/gl/context.h"
#include "visuals/gl/object.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>

#include <memory>

namespace octant::visuals::gl {

/// Puts pictures that were made elsewhere into the window of a context: by a texture that keeps its
/// memory while pictures keep their size.
class PicturePainter {
public:
    explicit PicturePainter(std::shared_ptr<Context> context);
    ~PicturePainter();
    PicturePainter(const PicturePainter&) = delete;
    PicturePainter& operator=(const PicturePainter&) = delete;
    PicturePainter(PicturePainter&&) = delete;
    PicturePainter& operator=(PicturePainter&&) = delete;

    /// Stretched to the lower left `size_px` of the window, upright there.
    void show(const scene::Picture& picture, const glm::ivec2& size_px);

private:
    void make_target(const glm::ivec2& size_px);

    std::shared_ptr<Context> context_; ///< goes after all that was made with it
    const Functions& gl_;
    Object texture_;
    Object target_; ///< framebuffer of the texture
    glm::ivec2 held_px_{0};
};

} // namespace octant::visuals::gl
