#include "ui/studies/draw_order/ray_renderer.h"
#include "ui/studies/draw_order/study_hidden_surface.h"
#include "visuals/scene/camera.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

using namespace octant;
using namespace octant::visuals;
using ui::studies::draw_order::RayRenderer;

namespace {

constexpr int side_px = 8;
constexpr glm::ivec2 cut_px{4, 4}; ///< The pixel of the cut.
constexpr double reach_px = 0.01;
constexpr std::uint32_t far_one = 1;
constexpr std::uint32_t occluder = 2;

/// A rectangle that fills the picture from one column to another, counted from the middle of cut_px.
struct Piece {
    std::uint32_t number = 0;
    float ahead_m = 1.0F;
    float left_px = -4.5F;
    float right_px = 3.5F;
};

/// What the rays find of pieces that are painted in this order, seen as from the origin along -z.
void draw(RayRenderer& rays, const std::vector<Piece>& pieces) {
    scene::ModelBuffers model;
    for (const Piece& piece : pieces) {
        const auto first = static_cast<std::uint32_t>(model.vertices.size());
        const auto add = [&](float column_px, float row) {
            const float share = (4.5F + column_px) / (0.5F * side_px) - 1.0F;
            scene::ModelVertex vertex;
            vertex.position_m = piece.ahead_m * glm::vec3(share, row, -1.0F);
            vertex.face_colour = piece.number;
            vertex.polygon = first;
            model.vertices.push_back(vertex);
        };
        add(piece.left_px, -1.0F);
        add(piece.right_px, -1.0F);
        add(piece.right_px, 1.0F);
        add(piece.left_px, 1.0F);
        for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) { model.indices.push_back(first + corner); }
    }
    rays.load_models({&model, 1});
    scene::Camera camera;
    camera.vertical_fov_rad = 2.0 * std::atan(1.0);
    scene::FramePlan plan;
    plan.view_to_clip = scene::view_to_clip(camera, 1.0);
    plan.parts = {glm::mat4(1.0F)};
    plan.aircraft = {{.index_count = static_cast<std::uint32_t>(model.indices.size())}};
    plan.steps = {{scene::PaintStep::Content::Aircraft, 0, 1}};
    rays.draw(plan);
}

bool is_rounding(const std::vector<Piece>& pieces) {
    RayRenderer rays({side_px, side_px});
    draw(rays, pieces);
    return rays.is_rounding(cut_px, far_one, occluder, reach_px);
}

} // namespace

TEST_CASE("where one plane cuts two polygons rounding may show the farther one") {
    // The part on the right is painted last, and begins 0.001 px right of the pixel's middle: rounded, that of the far
    // polygon may cover it, that of the near one not.
    constexpr float cut = 0.001F;
    const Piece far_left{far_one, 20.0F, -4.5F, cut};
    const Piece near_left{occluder, 10.0F, -4.5F, cut};
    const Piece far_right{far_one, 20.0F, cut, 3.5F};
    const Piece near_right{occluder, 10.0F, cut, 3.5F};
    CHECK(is_rounding({far_left, near_left, far_right, near_right}));
    // Not where the order is wrong,
    CHECK_FALSE(is_rounding({near_left, far_left, near_right, far_right}));
    // nor where the near polygon is one piece, so that the cut is no excuse,
    CHECK_FALSE(is_rounding({far_left, far_right, {occluder, 10.0F}}));
    // nor where the far one is seen through a crack that should be closed,
    CHECK_FALSE(is_rounding({{far_one, 20.0F}, near_left, near_right}));
    // nor where the cut is out of reach.
    constexpr float away = 0.02F;
    CHECK_FALSE(is_rounding({{far_one, 20.0F, -4.5F, away}, {occluder, 10.0F, -4.5F, away},
        {far_one, 20.0F, away, 3.5F}, {occluder, 10.0F, away, 3.5F}}));
}
