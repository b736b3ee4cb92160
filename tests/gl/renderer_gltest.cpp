#include "tests/gl/small_scene.h"
#include "visuals/gl/bare_grid.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <set>

using namespace octant;
using namespace octant::tests;
using scene::HiddenSurface;

namespace {

constexpr std::array<HiddenSurface, 3> all_ways{
    HiddenSurface::Octant, HiddenSurface::DepthBuffer, HiddenSurface::BackFace};

/// Own colour and haze mixed as frame_plan.h says, 0..255.
double hazy(double own, double haze, double distance_m, double visibility_m) {
    return 255.0 * (haze + (own - haze) * std::exp(-distance_m / visibility_m));
}

/// Models 0 red and 1 green.
void load_red_and_green(Studio& studio) {
    const std::array<scene::ModelBuffers, 2> models{square_model(red), square_model(green)};
    studio.renderer().load_models(models);
}

} // namespace

TEST_CASE("an empty plan gives the background everywhere") {
    Studio studio;
    const gl::Picture picture = studio.picture(empty_plan());
    CHECK(picture.width == side_px);
    CHECK(picture.height == side_px);
    REQUIRE(picture.rgba.size() == 4U * side_px * side_px);
    CHECK(pixel(picture, 0, 0) == grey_px);
    CHECK(pixel(picture, side_px - 1, side_px - 1) == grey_px);
}

TEST_CASE("the first row of the picture is its top, the first column its left") {
    Studio studio;
    Triangles ground;
    ground.add({-1.0F, 0.0F, 1.0F, 1.0F}, 100.0F, red)
        .add({-1.0F, -1.0F, 0.0F, 0.0F}, 100.0F, green);
    scene::FramePlan plan = empty_plan();
    plan.ground = ground.draw();
    const gl::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 0, 0) == red_px);
    CHECK(pixel(picture, 63, 31) == red_px);
    CHECK(pixel(picture, 0, 32) == green_px);
    CHECK(pixel(picture, 31, 63) == green_px);
    CHECK(pixel(picture, 32, 32) == grey_px);
}

TEST_CASE("a nearer ground triangle hides a farther one, whichever is drawn first") {
    Studio studio;
    for (const HiddenSurface way : all_ways) {
        for (const bool nearer_first : {true, false}) {
            Triangles ground;
            ground.add({}, nearer_first ? 10.0F : 20.0F, nearer_first ? red : green)
                .add({}, nearer_first ? 20.0F : 10.0F, nearer_first ? green : red);
            scene::FramePlan plan = empty_plan();
            plan.hidden_surface = way;
            plan.ground = ground.draw();
            CHECK(middle(studio.picture(plan)) == red_px);
        }
    }
}

TEST_CASE("ordered ground is painted without depth, except into a depth buffer") {
    Studio studio;
    Triangles ground;
    ground.add({}, 10.0F, red).add({}, 20.0F, green);
    scene::FramePlan plan = empty_plan();
    plan.ground = ground.draw();
    plan.ground_is_ordered = true;
    CHECK(middle(studio.picture(plan)) == green_px);
    plan.hidden_surface = HiddenSurface::BackFace;
    CHECK(middle(studio.picture(plan)) == green_px);
    plan.hidden_surface = HiddenSurface::DepthBuffer;
    CHECK(middle(studio.picture(plan)) == red_px);
}

TEST_CASE("back faces of aircraft are not drawn, those of ground and sky are") {
    Studio studio;
    load_red_and_green(studio);
    Triangles turned_away;
    turned_away.add({}, 10.0F, red, false);
    scene::AircraftDraw flipped = square_ahead(0, 10.0F);
    flipped.body_to_eye_world =
        glm::rotate(flipped.body_to_eye_world, 3.14159265F, glm::vec3(0.0F, 1.0F, 0.0F));
    for (const HiddenSurface way : all_ways) {
        scene::FramePlan plan = empty_plan();
        plan.hidden_surface = way;
        plan.ground = turned_away.draw();
        CHECK(middle(studio.picture(plan)) == red_px);
        plan.ground = {};
        plan.aircraft = {flipped};
        CHECK(middle(studio.picture(plan)) == grey_px);
        plan.aircraft = {square_ahead(0, 10.0F)};
        CHECK(middle(studio.picture(plan)) == red_px);
        plan = empty_plan();
        plan.sky = turned_away.draw();
        CHECK(middle(studio.picture(plan)) == red_px);
    }
}

TEST_CASE("an aircraft behind a wall of ground is hidden and in front of it is seen") {
    Studio studio;
    load_red_and_green(studio);
    Triangles wall;
    wall.add({}, 20.0F, blue);
    for (const HiddenSurface way : all_ways) {
        scene::FramePlan plan = empty_plan();
        plan.hidden_surface = way;
        plan.ground = wall.draw();
        plan.aircraft = {square_ahead(0, 20.5F)};
        CHECK(middle(studio.picture(plan)) == blue_px);
        plan.aircraft = {square_ahead(0, 19.5F)};
        CHECK(middle(studio.picture(plan)) == red_px);
        CHECK(pixel(studio.picture(plan), 0, 0) == blue_px);
    }
}

TEST_CASE("over ordered ground an aircraft is painted whatever its distance") {
    Studio studio;
    load_red_and_green(studio);
    Triangles wall;
    wall.add({}, 20.0F, blue);
    scene::FramePlan plan = empty_plan();
    plan.ground = wall.draw();
    plan.ground_is_ordered = true;
    plan.aircraft = {square_ahead(0, 30.0F)};
    CHECK(middle(studio.picture(plan)) == red_px);
    plan.hidden_surface = HiddenSurface::DepthBuffer;
    CHECK(middle(studio.picture(plan)) == blue_px);
}

TEST_CASE("aircraft leave no depth behind: the last in the list is on top, unless depth decides") {
    Studio studio;
    load_red_and_green(studio);
    Triangles wall;
    wall.add({}, 20.0F, blue);
    scene::FramePlan plan = empty_plan();
    plan.ground = wall.draw();
    plan.aircraft = {square_ahead(0, 10.0F), square_ahead(1, 12.0F)};
    CHECK(middle(studio.picture(plan)) == green_px);
    plan.hidden_surface = HiddenSurface::BackFace;
    CHECK(middle(studio.picture(plan)) == green_px);
    plan.hidden_surface = HiddenSurface::DepthBuffer;
    CHECK(middle(studio.picture(plan)) == red_px);
    std::swap(plan.aircraft[0], plan.aircraft[1]);
    CHECK(middle(studio.picture(plan)) == red_px);
}

TEST_CASE("within an aircraft the last polygon is on top, unless depth decides") {
    Studio studio;
    scene::ModelBuffers model = square_model(red);
    const scene::ModelBuffers behind = square_model(green);
    for (scene::ModelVertex vertex : behind.vertices) {
        vertex.position_m.z = -0.25F;
        model.vertices.push_back(vertex);
    }
    for (const std::uint32_t index : behind.indices) {
        model.indices.push_back(index + 4);
    }
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    plan.aircraft = {square_ahead(0, 10.0F)};
    plan.aircraft[0].index_count = 12;
    CHECK(middle(studio.picture(plan)) == green_px);
    plan.hidden_surface = HiddenSurface::DepthBuffer;
    CHECK(middle(studio.picture(plan)) == red_px);
}

TEST_CASE("an aircraft is drawn from its own model and its own range of indices") {
    Studio studio;
    scene::ModelBuffers two_colours = square_model(red);
    const scene::ModelBuffers other = square_model(blue);
    two_colours.vertices.insert(
        two_colours.vertices.end(), other.vertices.begin(), other.vertices.end());
    two_colours.indices.insert(two_colours.indices.end(), {4, 5, 6, 4, 6, 7});
    const std::array<scene::ModelBuffers, 2> models{square_model(green), two_colours};
    studio.renderer().load_models(models);
    scene::FramePlan plan = empty_plan();
    plan.aircraft = {square_ahead(1, 10.0F)};
    CHECK(middle(studio.picture(plan)) == red_px);
    plan.aircraft[0].first_index = 6;
    CHECK(middle(studio.picture(plan)) == blue_px);
    plan.aircraft = {square_ahead(0, 10.0F)};
    CHECK(middle(studio.picture(plan)) == green_px);
    studio.renderer().load_models({&other, 1});
    CHECK(middle(studio.picture(plan)) == blue_px);
}

// Depth is 0.5 / distance: 1 cm at 5 km changes it by 2e-10, and floats there are 7e-12 apart.
// The distances themselves are known to half a millimetre (floats at 5 km are 0.5 mm apart).
TEST_CASE("reversed depth tells 1 cm apart at 5 km") {
    Studio studio;
    for (const bool nearer_first : {true, false}) {
        Triangles ground;
        ground.add({}, nearer_first ? 5000.0F : 5000.01F, nearer_first ? red : green)
            .add({}, nearer_first ? 5000.01F : 5000.0F, nearer_first ? green : red);
        scene::FramePlan plan = empty_plan();
        plan.ground = ground.draw();
        const gl::Picture picture = studio.picture(plan);
        int wrong = 0;
        for (int row = 0; row < side_px; ++row) {
            for (int column = 0; column < side_px; ++column) {
                wrong += pixel(picture, column, row) == red_px ? 0 : 1;
            }
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("what is nearer than the near plane is cut off, what is a million km away is not") {
    Studio studio;
    Triangles ground;
    ground.add({-1.0F, -1.0F, 0.0F, 1.0F}, 0.4F, red).add({0.0F, -1.0F, 1.0F, 1.0F}, 1e9F, green);
    scene::FramePlan plan = empty_plan();
    plan.ground = ground.draw();
    const gl::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 10, 32) == grey_px);
    CHECK(pixel(picture, 50, 32) == green_px);
}

TEST_CASE("haze at a known distance gives the colour of its formula, on ground and aircraft") {
    Studio studio;
    const scene::ModelBuffers model = square_model({0.2F, 0.4F, 0.9F});
    studio.renderer().load_models({&model, 1});
    const std::array<double, 3> own{51.0 / 255, 102.0 / 255, 230.0 / 255};
    for (const float visibility_m : {500.0F, 4000.0F, 1e6F}) {
        for (const float distance_m : {10.0F, 300.0F, 1000.0F, 8000.0F}) {
            // Corners at one distance give the whole rectangle one colour.
            Triangles ground;
            const float edge = 0.5F;
            ground.add(
                {-edge, -edge, edge, edge},
                distance_m / std::sqrt(1.0F + 2.0F * edge * edge),
                {0.2F, 0.4F, 0.9F});
            scene::FramePlan plan = empty_plan();
            plan.haze = {{0.8F, 0.7F, 0.1F}, visibility_m};
            plan.ground = ground.draw();
            const Pixel on_ground = middle(studio.picture(plan));
            plan.ground = {};
            plan.aircraft = {square_ahead(0, std::sqrt(distance_m * distance_m - 2.0F))};
            plan.aircraft[0].body_to_eye_world[3].x = 0.5F; // its middle on a pixel
            plan.view_to_clip[0][0] *= distance_m / 10.0F;  // large enough to be seen
            plan.view_to_clip[1][1] *= distance_m / 10.0F;
            const Pixel on_aircraft = middle(studio.picture(plan));
            for (int part = 0; part < 3; ++part) {
                const auto i = static_cast<std::size_t>(part);
                const double expected = hazy(
                    own[i],
                    static_cast<double>(plan.haze.colour[part]),
                    static_cast<double>(distance_m),
                    static_cast<double>(visibility_m));
                CHECK(on_ground[i] == Approx(expected).margin(1.0));
                CHECK(on_aircraft[i] == Approx(expected).margin(1.0));
            }
        }
    }
}

TEST_CASE("without visibility there is no haze, and the sky never has any") {
    Studio studio;
    Triangles triangles;
    triangles.add({}, 5000.0F, red);
    scene::FramePlan plan = empty_plan();
    plan.haze = {green, 0.0F};
    plan.ground = triangles.draw();
    CHECK(middle(studio.picture(plan)) == red_px);
    plan.haze.visibility_m = 100.0F;
    CHECK(middle(studio.picture(plan)) == green_px);
    plan.ground = {};
    plan.sky = triangles.draw();
    CHECK(middle(studio.picture(plan)) == red_px);
}

TEST_CASE("an aircraft has light from everywhere and the sun's by the cosine to it") {
    Studio studio;
    const scene::ModelBuffers model = square_model({0.2F, 0.8F, 1.0F});
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    plan.ambient = glm::vec3(0.25F);
    plan.sunlight = glm::vec3(0.5F, 0.5F, 1.0F);
    plan.aircraft = {square_ahead(0, 5.0F)};
    const auto lit_from = [&](const glm::vec3& sun) {
        plan.aircraft[0].sun_in_body = sun;
        return middle(studio.picture(plan));
    };
    CHECK(lit_from({0.0F, 0.0F, -1.0F}) == Pixel{13, 51, 64, 255});
    CHECK(lit_from({1.0F, 0.0F, 0.0F}) == Pixel{13, 51, 64, 255});
    CHECK(lit_from({0.0F, 0.8F, 0.6F}) == Pixel{28, 112, 217, 255});
    CHECK(lit_from({0.0F, 0.0F, 1.0F}) == Pixel{38, 153, 255, 255});
}

TEST_CASE("light beyond white is cut before the haze is mixed in") {
    Studio studio;
    const scene::ModelBuffers model = square_model(glm::vec3(1.0F));
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    plan.ambient = glm::vec3(1.5F);
    plan.aircraft = {square_ahead(0, 100.0F)};
    plan.haze = {glm::vec3(0.0F), 100.0F};
    plan.view_to_clip[0][0] = 100.0F; // large enough to be seen
    plan.view_to_clip[1][1] = 100.0F;
    CHECK(middle(studio.picture(plan)) == Pixel{94, 94, 94, 255}); // 255 / e
}

TEST_CASE("an aircraft's polygon has one colour, that of the corner its fan starts from") {
    Studio studio;
    scene::ModelBuffers model = square_model(red);
    for (std::size_t corner : {1U, 2U, 3U}) {
        model.vertices[corner].colour = models::packed_colour(green);
    }
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    plan.aircraft = {square_ahead(0, 1.0F)};
    const gl::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 5, 20) == red_px);
    CHECK(pixel(picture, 60, 50) == red_px);
}

TEST_CASE("the sky is behind everything, however near its triangles are") {
    Studio studio;
    load_red_and_green(studio);
    Triangles sky;
    Triangles ground;
    sky.add({}, 1.0F, blue);
    ground.add({-1.0F, -1.0F, 1.0F, 0.0F}, 1e6F, green);
    for (const HiddenSurface way : all_ways) {
        for (const bool ordered : {false, true}) {
            scene::FramePlan plan = empty_plan();
            plan.hidden_surface = way;
            plan.ground_is_ordered = ordered;
            plan.sky = sky.draw();
            plan.ground = ground.draw();
            plan.aircraft = {square_ahead(0, 4.0F)};
            const gl::Picture picture = studio.picture(plan);
            CHECK(pixel(picture, 32, 0) == blue_px);
            CHECK(pixel(picture, 32, 63) == green_px);
            CHECK(middle(picture) == red_px);
        }
    }
}

TEST_CASE("four samples a pixel soften an edge, one does not") {
    Triangles ground;
    ground.add({-0.4F, -0.5F, 0.5F, 0.5F}, 10.0F, red);
    ground.vertices[0].position_m.x += 3.0F; // a slanted left edge
    scene::FramePlan plan = empty_plan();
    plan.background = glm::vec3(0.0F);
    plan.ground = ground.draw();
    for (const int samples : {1, 4}) {
        Studio studio(gl::make_osmesa_context(), samples);
        const gl::Picture picture = studio.picture(plan);
        std::set<int> reds;
        for (int row = 0; row < side_px; ++row) {
            for (int column = 0; column < side_px; ++column) {
                reds.insert(pixel(picture, column, row)[0]);
            }
        }
        const std::set<int> shares{0, 64, 128, 191, 255};
        CHECK(std::includes(shares.begin(), shares.end(), reds.begin(), reds.end()));
        CHECK((reds.size() > 2) == (samples == 4));
    }
}

TEST_CASE("the same plan gives the same bytes again, also after warming up") {
    Studio studio;
    const std::uint64_t hash = hash_of_full_scene(studio);
    CHECK(hash_of_full_scene(studio) == hash);
    studio.renderer().warm_up();
    CHECK(hash_of_full_scene(studio) == hash);
    Studio warm;
    warm.renderer().warm_up();
    CHECK(hash_of_full_scene(warm) == hash);
}

TEST_CASE("a picture's memory is kept from frame to frame") {
    Studio studio;
    gl::Picture picture;
    studio.renderer().draw(empty_plan());
    studio.renderer().finish_and_read(picture);
    const auto* const before = picture.rgba.data();
    studio.renderer().draw(empty_plan());
    studio.renderer().finish_and_read(picture);
    CHECK(picture.rgba.data() == before);
}

TEST_CASE("the bare grid covers the whole picture and has the triangles asked for") {
    scene::Camera camera;
    const int width = 160;
    const int height = 90;
    const glm::mat4 view_to_clip = scene::view_to_clip(camera, 16.0 / 9.0);
    for (const int triangles : {2, 3, 1000, 20000, 200000}) {
        const gl::BareGrid grid = gl::bare_grid(triangles, view_to_clip);
        CHECK(grid.indices.size() / 3 >= static_cast<std::size_t>(triangles));
        CHECK(
            static_cast<double>(grid.indices.size()) / 3 <=
            triangles + 2.0 + 2.0 * std::sqrt(triangles / 2.0));
        scene::FramePlan plan;
        plan.view_to_clip = view_to_clip;
        plan.background = red;
        plan.ground = {grid.vertices, grid.indices};
        Studio studio(gl::make_osmesa_context(), 1, width, height);
        const gl::Picture picture = studio.picture(plan);
        int uncovered = 0;
        for (int row = 0; row < height; ++row) {
            for (int column = 0; column < width; ++column) {
                uncovered += pixel(picture, column, row) == red_px ? 1 : 0;
            }
        }
        CHECK(uncovered == 0);
    }
    CHECK(gl::bare_grid(20000, view_to_clip).indices.size() == 60000);
}
