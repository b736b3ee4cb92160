#include "visuals/nature/low_poly_models.h"

#include <algorithm>
#include <cstddef>

namespace octant::visuals::nature {

namespace {

/// How a tree is built: heights and radii of rings over its height and radius, from below.
struct Outline {
    std::array<glm::vec2, 3> rings; ///< radius, height
    int count;
};

constexpr Outline cone{{glm::vec2(1.0F, 0.10F), {}, {}}, 1};
constexpr Outline crown{{glm::vec2(0.7F, 0.18F), {1.0F, 0.50F}, {}}, 2};
constexpr Outline round_crown{{glm::vec2(0.45F, 0.12F), {1.0F, 0.42F}, {0.74F, 0.80F}}, 3};

const Outline& outline_of(TreeShape shape, TreeLod detail) {
    if (shape == TreeShape::Conical || detail == TreeLod::Far) {
        return cone;
    }
    return detail == TreeLod::Near ? round_crown : crown;
}

} // namespace

void add_tree(
    LowPolyBuilder& to,
    const GroundAnchor& anchor,
    const glm::vec2& size_m,
    TreeShape shape,
    TreeLod detail,
    const TreeColours& light) {
    const Outline& outline = outline_of(shape, detail);
    const std::uint32_t step = detail == TreeLod::Far ? 2 : 1;
    const std::uint32_t sides = 8 / step;
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    for (int ring = 0; ring < outline.count; ++ring) {
        const glm::vec2& at = outline.rings[static_cast<std::size_t>(ring)];
        const float darker = 0.62F + 0.38F * at.y;
        for (std::uint32_t side = 0; side < 8; side += step) {
            const glm::vec2 out = size_m.x * at.x * compass_directions[side];
            const float height_m = size_m.y * at.y + anchor.height_at_offset_m(out);
            to.add(anchor.at_m + glm::vec3(out, height_m), light.sides[side] * darker);
        }
    }
    const std::uint32_t top = to.add(anchor.at_m + glm::vec3(0.0F, 0.0F, size_m.y), light.top);
    for (std::uint32_t ring = 0; ring < static_cast<std::uint32_t>(outline.count); ++ring) {
        const std::uint32_t own = first + ring * sides;
        const bool last = ring + 1 == static_cast<std::uint32_t>(outline.count);
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t next = (side + 1) % sides;
            if (last) {
                to.triangle(own + side, own + next, top);
            } else {
                to.triangle(own + side, own + next, own + sides + next);
                to.triangle(own + side, own + sides + next, own + sides + side);
            }
        }
    }
}

void add_house(
    LowPolyBuilder& to,
    const GroundAnchor& anchor,
    const glm::vec2& along,
    const glm::vec3& size_m,
    float height_share,
    const std::array<glm::vec3, 4>& wall,
    const std::array<glm::vec3, 2>& roof) {
    const glm::vec2 across(-along.y, along.x);
    const auto at = [&](float x, float y, float z) {
        const glm::vec2 level = along * (x * size_m.x) + across * (y * size_m.y);
        const float height_at_offset_m = anchor.height_at_offset_m(level);
        return anchor.at_m + glm::vec3(level, height_at_offset_m + height_share * std::max(z - height_at_offset_m, 0.0F));
    };
    const float eaves_m = 0.58F * size_m.z;
    const auto quad = [&](const std::array<glm::vec3, 4>& corner, const glm::vec3& colour) {
        const std::uint32_t first = to.add(corner[0], colour);
        for (std::size_t i = 1; i < 4; ++i) {
            to.add(corner[i], colour);
        }
        to.triangle(first, first + 1, first + 2);
        to.triangle(first, first + 2, first + 3);
    };
    constexpr float low = -1e3F; // metres: walls end at the ground
    quad({at(1, -1, low), at(1, 1, low), at(1, 1, eaves_m), at(1, -1, eaves_m)}, wall[0]);
    quad({at(1, 1, low), at(-1, 1, low), at(-1, 1, eaves_m), at(1, 1, eaves_m)}, wall[1]);
    quad({at(-1, 1, low), at(-1, -1, low), at(-1, -1, eaves_m), at(-1, 1, eaves_m)}, wall[2]);
    quad({at(-1, -1, low), at(1, -1, low), at(1, -1, eaves_m), at(-1, -1, eaves_m)}, wall[3]);
    quad({at(1, 1, eaves_m), at(-1, 1, eaves_m), at(-1, 0, size_m.z), at(1, 0, size_m.z)}, roof[0]);
    quad(
        {at(-1, -1, eaves_m), at(1, -1, eaves_m), at(1, 0, size_m.z), at(-1, 0, size_m.z)},
        roof[1]);
    for (const float end : {1.0F, -1.0F}) {
        const glm::vec3& colour = wall[end > 0.0F ? 0 : 2];
        const std::uint32_t first = to.add(at(end, -end, eaves_m), colour);
        to.add(at(end, end, eaves_m), colour);
        to.add(at(end, 0, size_m.z), colour);
        to.triangle(first, first + 1, first + 2);
    }
}

} // namespace octant::visuals::nature
