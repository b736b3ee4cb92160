#include "tests/visuals/gl/small_scene.h"
#include "visuals/gl/bare_grid.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant;
using namespace octant::tests;

TEST_CASE("the bare grid covers the whole picture and has the triangles asked for") {
    scene::Camera camera;
    const int width = 160;
    const int height = 90;
    const glm::mat4 view_to_clip = scene::view_to_clip(camera, 16.0 / 9.0);
    for (const int triangles : {2, 3, 1000, 20000, 200000}) {
        const gl::BareGrid grid = gl::bare_grid(triangles, view_to_clip);
        CHECK(grid.indices.size() / 3 >= static_cast<std::size_t>(triangles));
        CHECK(static_cast<double>(grid.indices.size()) / 3 <= triangles + 2.0 + 2.0 * std::sqrt(triangles / 2.0));
        scene::FramePlan plan;
        plan.view_to_clip = view_to_clip;
        plan.background = red;
        plan.ground = {grid.vertices, grid.indices};
        Studio studio(gl::make_osmesa_context(), 1, width, height);
        const scene::Picture picture = studio.picture(plan);
        CHECK(count_of(picture, red_px) == 0);
    }
    CHECK(gl::bare_grid(20000, view_to_clip).indices.size() == 60000);
}
