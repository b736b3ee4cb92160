#include "visuals/nature/scenery_shadows.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace octant;
using namespace octant::visuals::nature;
using models::ColourVertex;

TEST_CASE("a shadow goes on over the side of two triangles, however they slope") {
    constexpr float eye_m = 30.0F;
    constexpr std::uint32_t grey = 0xff808080U;
    DaylightOptions day;
    day.sun_elevation_rad = 0.6;
    day.sun_azimuth_rad = 4.4; // the shadow crosses the line x = 0
    const ShadowCaster caster{{-4.0F, 0.0F, 0.2F - eye_m}, {0.05F, -0.1F}, 2.0F, 9.0F, 1.0F, GENERATE(0.0F, 0.3F),
        GENERATE(0.0F, 1.0F), 0x2d9bU};
    SceneryShadows shadows{Daylight(day)};

    // Where the shadow, with its rim, crosses that line on a triangle beside it.
    const auto crossing_m = [&](float third_x_m, float third_z_m) {
        const glm::vec3 south(0.0F, -40.0F, -eye_m);
        const glm::vec3 north(0.0F, 40.0F, -eye_m);
        const glm::vec3 third(third_x_m, 0.0F, third_z_m - eye_m);
        REQUIRE(shadows.begin(third_x_m < 0.0F
                                  ? std::array<ColourVertex, 3>{{{south, grey}, {north, grey}, {third, grey}}}
                                  : std::array<ColourVertex, 3>{{{north, grey}, {south, grey}, {third, grey}}}));
        std::vector<ColourVertex> vertices;
        std::vector<std::uint32_t> indices;
        std::vector<models::VertexRun> runs;
        shadows.add(caster, 1.0F, {vertices, indices, runs});
        shadows.add_rim(caster, 1.0F, {vertices, indices, runs});
        glm::vec2 ends_m(1e9F, -1e9F);
        for (const ColourVertex& vertex : vertices) {
            if (std::abs(vertex.position_m.x) > 1e-4F) { continue; }
            ends_m = {std::min(ends_m.x, vertex.position_m.y), std::max(ends_m.y, vertex.position_m.y)};
        }
        return ends_m;
    };
    const glm::vec2 west_m = crossing_m(-40.0F, 8.0F);
    CHECK(west_m.y - west_m.x > 2.0F);
    for (const float rise_m : {-10.0F, 0.0F, 10.0F}) {
        const glm::vec2 east_m = crossing_m(40.0F, rise_m);
        CHECK(std::abs(east_m.x - west_m.x) < 1e-3F);
        CHECK(std::abs(east_m.y - west_m.y) < 1e-3F);
    }
}
