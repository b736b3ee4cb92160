#include "visuals/gl/draw_state.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

namespace octant::visuals::gl {
namespace {

using scene::Clip;
using scene::DepthUse;

constexpr GLint planes_uniform = 0; ///< place in the shaders, where CUT is defined

// Shadow pieces lie in the plane of ground triangles, yet their depths differ by rounding: of the corners to 1/256
// pixel, which one pixel's change of depth covers, and of the depth itself.
constexpr float towards_eye_px = 1.0F;
constexpr float towards_eye_steps = 16.0F; ///< of the float nearest to the triangle's depths

// What is edge-on has depths without meaning and closes holes between triangles that have: it is pushed back by one to
// two per cent of its distance, so that these are before it.
constexpr float edge_on_steps = -0x1p23F * 0.02F;

} // namespace

ProgramPair make_program_pair(
    const Functions& gl, const char* name, const ProgramText& text, const std::vector<const char*>& defined) {
    const std::string clipped = std::string(name) + ", cut";
    std::vector<const char*> both = defined;
    both.push_back("CUT");
    return {make_program(gl, name, text, defined), make_program(gl, clipped.c_str(), text, both)};
}

void DrawState::begin_picture(RowOrder row_order) {
    // The upper left origin brings the rows out from the top. Which side of a triangle is its front does not change
    // with it: OpenGL turns the sign of the area along with the origin.
    gl_.clip_control(row_order == RowOrder::TopDown ? GL_UPPER_LEFT : GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl_.front_face(GL_CCW);
    gl_.cull_face(GL_BACK);
    gl_.provoking_vertex(GL_FIRST_VERTEX_CONVENTION);
    gl_.disable(GL_DITHER);
    gl_.disable(GL_BLEND);
    gl_.disable(GL_SCISSOR_TEST);
    gl_.depth_mask(GL_TRUE);
    draw_calls_ = 0;
}

void DrawState::use_depth(DepthUse use) {
    gl_.disable(GL_POLYGON_OFFSET_FILL);
    if (use == DepthUse::None) {
        gl_.disable(GL_DEPTH_TEST);
        return;
    }
    const bool where_equal = use == DepthUse::OnGround || use == DepthUse::InfinitelyFar;
    gl_.enable(GL_DEPTH_TEST);
    gl_.depth_func(where_equal ? GL_GEQUAL : GL_GREATER);
    gl_.depth_mask(use == DepthUse::InfinitelyFar ? GL_FALSE : GL_TRUE);
    if (use == DepthUse::OnGround) {
        gl_.enable(GL_POLYGON_OFFSET_FILL);
        gl_.polygon_offset(towards_eye_px, towards_eye_steps);
    } else if (use == DepthUse::EdgeOn) {
        gl_.enable(GL_POLYGON_OFFSET_FILL);
        gl_.polygon_offset(0.0F, edge_on_steps);
    }
}

void DrawState::cull_back_faces(bool cull) {
    if (cull) {
        gl_.enable(GL_CULL_FACE);
    } else {
        gl_.disable(GL_CULL_FACE);
    }
}

void DrawState::blend(bool by_alpha) {
    if (by_alpha) {
        gl_.enable(GL_BLEND);
        gl_.blend_func_separate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    } else {
        gl_.disable(GL_BLEND);
    }
}

void DrawState::blend_by(float opacity, bool by_alpha) {
    if (opacity >= 1.0F) {
        gl_.disable(GL_BLEND);
        gl_.depth_mask(GL_TRUE);
        return;
    }
    gl_.enable(GL_BLEND);
    gl_.blend_color(0.0F, 0.0F, 0.0F, opacity);
    gl_.blend_func_separate(by_alpha ? GL_SRC_ALPHA : GL_CONSTANT_ALPHA,
        by_alpha ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE_MINUS_CONSTANT_ALPHA, GL_ZERO, GL_ONE);
    gl_.depth_mask(GL_FALSE);
}

void DrawState::use_program(const ProgramPair& programs, const Clip* clip) {
    const bool clipped = clip != nullptr;
    const Object& program = clipped ? programs.clipped : programs.unclipped;
    gl_.use_program(program.name());
    if (clipped) {
        assert(clip->count >= 0 && clip->count <= Clip::max_planes);
        std::array<glm::vec4, Clip::max_planes> planes;
        planes.fill(glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)); // cuts nothing
        std::copy_n(clip->planes.begin(), clip->count, planes.begin());
        gl_.program_uniform_4fv(program.name(), planes_uniform, Clip::max_planes, glm::value_ptr(planes.front()));
    }
}

} // namespace octant::visuals::gl
