#include "tests/visuals/gl/small_scene.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

using namespace octant;
using namespace octant::tests;

namespace {

/// Own colour and haze mixed as frame_plan.h says, 0..255.
double hazy(double own, double haze, double distance_m, double visibility_m) {
    return 255.0 * (haze + (own - haze) * std::exp(-distance_m / visibility_m));
}

} // namespace

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
                {-edge, -edge, edge, edge}, distance_m / std::sqrt(1.0F + 2.0F * edge * edge), {0.2F, 0.4F, 0.9F});
            scene::FramePlan plan = empty_plan();
            plan.haze = {{0.8F, 0.7F, 0.1F}, visibility_m};
            plan.ground = ground.draw();
            const Pixel on_ground = middle(studio.picture(plan));
            plan.ground = {};
            add_square(plan, 0, ahead(std::sqrt(distance_m * distance_m - 2.0F)));
            plan.parts[0][3].x = 0.5F;                     // its middle on a pixel
            plan.view_to_clip[0][0] *= distance_m / 10.0F; // large enough to be seen
            plan.view_to_clip[1][1] *= distance_m / 10.0F;
            const Pixel on_aircraft = middle(studio.picture(plan));
            for (int part = 0; part < 3; ++part) {
                const auto i = static_cast<std::size_t>(part);
                const double expected = hazy(own[i], static_cast<double>(plan.haze.colour[part]),
                    static_cast<double>(distance_m), static_cast<double>(visibility_m));
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
    add_square(plan, 0, ahead(5.0F));
    const auto lit_from = [&](const glm::vec3& sun) {
        plan.to_sun = sun;
        return middle(studio.picture(plan));
    };
    CHECK(lit_from({0.0F, 0.0F, -1.0F}) == Pixel{13, 51, 64, 255});
    CHECK(lit_from({1.0F, 0.0F, 0.0F}) == Pixel{13, 51, 64, 255});
    CHECK(lit_from({0.0F, 0.8F, 0.6F}) == Pixel{28, 112, 217, 255});
    CHECK(lit_from({0.0F, 0.0F, 1.0F}) == Pixel{38, 153, 255, 255});
    // Turned by 90 degrees about the line of sight, a sun from the left is one from above.
    plan.parts[0] = glm::rotate(plan.parts[0], 1.57079633F, glm::vec3(0.0F, 0.0F, 1.0F));
    CHECK(lit_from({-0.8F, 0.0F, 0.6F}) == Pixel{28, 112, 217, 255});
    // Turned by 60 degrees to the right, its normal is half way from the eye's.
    plan.parts[0] = glm::rotate(ahead(5.0F), 1.04719755F, glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(lit_from({0.0F, 0.0F, 1.0F}) == Pixel{26, 102, 191, 255});
}

TEST_CASE("light beyond white is cut before the haze is mixed in") {
    Studio studio;
    const scene::ModelBuffers model = square_model(glm::vec3(1.0F));
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    plan.ambient = glm::vec3(1.5F);
    add_square(plan, 0, ahead(100.0F));
    plan.haze = {glm::vec3(0.0F), 100.0F};
    plan.view_to_clip[0][0] = 100.0F; // large enough to be seen
    plan.view_to_clip[1][1] = 100.0F;
    CHECK(middle(studio.picture(plan)) == Pixel{94, 94, 94, 255}); // 255 / e
}

TEST_CASE("glass mirrors what lies where its mirror image is seen, more of it the flatter the view") {
    Studio studio;
    for (const float opacity : {1.0F, 0.5F}) {
        scene::ModelBuffers model = square_model({0.2F, 0.3F, 0.4F});
        for (scene::ModelVertex& vertex : model.vertices) {
            const auto alpha = static_cast<std::uint32_t>(std::lround(254.0F * opacity));
            vertex.colour = vertex.face_colour = (vertex.colour & 0x00ffffffU) | alpha << 24U;
        }
        studio.renderer().load_models({&model, 1});
        for (const double turn_deg : {0.0, 30.0, 60.0, 75.0, -75.0}) {
            scene::FramePlan plan = empty_plan();
            plan.haze.colour = {0.6F, 0.7F, 0.8F};
            plan.mirrored_sky = {{0.1F, 0.3F, 0.7F}, {0.3F, 0.2F, 0.1F}};
            // Seen along y in world axes; the square's normal turns from the eye upwards.
            const double turn = glm::radians(turn_deg);
            plan.world_to_view = glm::mat4(glm::dmat4(glm::dmat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0})));
            glm::dmat4 place(
                glm::dmat3({1, 0, 0}, {0, std::sin(turn), std::cos(turn)}, {0, -std::cos(turn), std::sin(turn)}));
            place[3] = glm::dvec4(0.0, 1000.0, 0.0, 1.0); // so far that all of it is seen in one direction
            add_square(plan, 0, glm::mat4(place));
            for (int axis = 0; axis < 2; ++axis) { plan.view_to_clip[axis][axis] = 3000.0F; }
            const double flat = std::pow(1.0 - std::cos(turn), 5.0);
            const double share = 0.08 + 0.92 * flat;
            const double up = std::sin(2.0 * turn); // of the mirrored line of sight
            for (int smooth = 0; smooth < 2; ++smooth) {
                plan.smooth = {smooth == 0 ? 0U : ~0U};
                const Pixel seen = middle(studio.picture(plan));
                for (int part = 0; part < 3; ++part) {
                    const auto haze = static_cast<double>(plan.haze.colour[part]);
                    const auto other = static_cast<double>(
                        up > 0.0 ? plan.mirrored_sky->overhead[part] : plan.mirrored_sky->below[part]);
                    const double weight = up > 0.0 ? up * (2.0 - up) : std::min(-4.0 * up, 1.0);
                    const double mirrored = haze + (other - haze) * weight;
                    const std::array own{0.2, 0.3, 0.4};
                    const double expected = std::min((1.0 - share) * own[static_cast<std::size_t>(part)] +
                                                         share / static_cast<double>(opacity) * mirrored,
                        1.0);
                    CHECK(seen[static_cast<std::size_t>(part)] == Approx(255.0 * expected).margin(1.5));
                }
            }
        }
    }
}

TEST_CASE("a flat polygon has one colour, the face colour of the corner its fan starts from") {
    Studio studio;
    scene::ModelBuffers model = square_model(red);
    for (std::size_t corner : {1U, 2U, 3U}) { model.vertices[corner].face_colour = models::packed_colour(green); }
    studio.renderer().load_models({&model, 1});
    scene::FramePlan plan = empty_plan();
    add_square(plan, 0, ahead(1.0F));
    const scene::Picture picture = studio.picture(plan);
    CHECK(pixel(picture, 5, 20) == red_px);
    CHECK(pixel(picture, 60, 50) == red_px);
}
