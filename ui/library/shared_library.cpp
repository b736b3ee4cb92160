// What only the shared library has; all else of it is in the modules that are linked into it.
#include "sim/base/error.h"
#include "visuals/gl/gl_renderer.h"
#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <memory>
#include <octant/octant.h>

namespace octant::visuals::gl {

/// In place of the function of visuals/gl, so that neither OpenGL nor windows are linked: the library draws by the
/// processor.
std::unique_ptr<scene::Renderer> make_gl_renderer(
    OffscreenContext /*context*/, const glm::ivec2& /*size_px*/, int /*samples*/) {
    throw Error("renderer: expected raster in the library, got gl");
}

} // namespace octant::visuals::gl
