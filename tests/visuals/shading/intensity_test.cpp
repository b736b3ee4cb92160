#include "visuals/shading/intensity.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace octant::visuals::shading;

namespace {

const ShadingLight from_above{
    .to_light = {0.0F, 0.0F, 1.0F}, .ambient = 0.25F, .diffuse = 0.5F, .specular = 0.125F, .shininess = 2};
constexpr glm::vec3 here(0.0F);
constexpr glm::vec3 up(0.0F, 0.0F, 1.0F);

} // namespace

TEST_CASE("seen from the light, a surface across it has all three parts") {
    // 2 x (0.25 + 0.5) + 3 x 0.125
    CHECK(intensity(here, up, 2.0F, from_above, {0.0F, 0.0F, 5.0F}) == Approx(1.875));
}

TEST_CASE("at 60 degrees from the mirrored light a quarter of the highlight is left") {
    const glm::vec3 eye_m(std::sqrt(3.0F), 0.0F, 1.0F);
    CHECK(intensity(here, up, 2.0F, from_above, eye_m) == Approx(1.5 + 3.0 * 0.125 / 4.0));
}

TEST_CASE("behind the mirrored light there is no highlight") {
    CHECK(intensity(here, up, 2.0F, from_above, {1.0F, 0.0F, -1.0F}) == Approx(1.5));
}

TEST_CASE("a surface that faces away from the light has ambient light only") {
    CHECK(intensity(here, -up, 2.0F, from_above, {0.0F, 0.0F, 5.0F}) == Approx(0.5));
}
