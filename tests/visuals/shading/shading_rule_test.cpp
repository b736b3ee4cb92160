#include "models/procedural/procedural_models.h"
#include "visuals/shading/shading_rule.h"
#include "visuals/shading/vertex_normals.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

using namespace octant;
using namespace octant::visuals::shading;

namespace {

const ShadingLight from_above{.to_light = {0.0F, 0.0F, 1.0F}, .ambient = 0.0F, .diffuse = 1.0F, .specular = 0.0F};
const glm::dvec3 high_m(0.0, 0.0, 1000.0);

/// Level triangles side by side, each with two sides of `size_m[i]` and its first corner's normal tilted so that its
/// intensity there is 1 - `darker[i]`, of 1 everywhere else.
ShadedPolygons row(const std::vector<double>& size_m, const std::vector<float>& darker) {
    models::TriangleMesh mesh;
    std::vector<glm::vec3> normals;
    for (std::size_t i = 0; i < size_m.size(); ++i) {
        const auto x = static_cast<double>(i);
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        mesh.vertices_m.insert(mesh.vertices_m.end(), {{x, 0, 0}, {x + size_m[i], 0, 0}, {x, size_m[i], 0}});
        mesh.triangles.push_back({first, first + 1, first + 2});
        const float z = 1.0F - darker[i];
        normals.emplace_back(std::sqrt(1.0F - z * z), 0.0F, z);
        normals.insert(normals.end(), 2, glm::vec3(0.0F, 0.0F, 1.0F));
    }
    mesh.colours.assign(mesh.vertices_m.size(), glm::vec3(1.0F, 0.0F, 0.0F));
    return shaded_polygons(mesh, normals);
}

std::vector<int> smooth_ones(std::span<const std::uint8_t> smooth) {
    std::vector<int> ones;
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        if (smooth[i] != 0) { ones.push_back(static_cast<int>(i)); }
    }
    return ones;
}

std::vector<int> chosen(const ShadedPolygons& polygons, ShadingRule rule, int count) {
    ShadingSelector selector(polygons, without_hysteresis(rule));
    return smooth_ones(selector.choose(high_m, from_above, count).smooth);
}

ShadedPolygons shaded_torus() {
    const models::polygons::PolygonModel torus = models::procedural::torus();
    return shaded_polygons(torus, corner_normals(torus, rad_from_deg(60.0)));
}

constexpr std::array all_rules{ShadingRule::Error, ShadingRule::Paper, ShadingRule::Random};

} // namespace

TEST_CASE("of two equal triangles the one with the darker corner is smooth") {
    CHECK(chosen(row({1, 1}, {0.2F, 0.3F}), ShadingRule::Error, 1) == std::vector{1});
}

TEST_CASE("by the paper's rule the longer one is smooth however little its corners differ") {
    const ShadedPolygons polygons = row({1, 1.1}, {0.9F, 0.1F});
    CHECK(chosen(polygons, ShadingRule::Paper, 1) == std::vector{1});
    CHECK(chosen(polygons, ShadingRule::Error, 1) == std::vector{0});
}

TEST_CASE("by the paper's rule corners that differ go before size, large ones before small ones") {
    // Perimeters grow with the size; the mean is between 2 and 3.
    const ShadedPolygons polygons = row({4, 3, 2, 1, 3}, {0.04F, 0.2F, 0.2F, 0.2F, 0.06F});
    CHECK(chosen(polygons, ShadingRule::Paper, 1) == std::vector{1}); // as large as 4, before it
    CHECK(chosen(polygons, ShadingRule::Paper, 2) == std::vector{1, 4});
    CHECK(chosen(polygons, ShadingRule::Paper, 3) == std::vector{1, 2, 4});
    CHECK(chosen(polygons, ShadingRule::Paper, 4) == std::vector{1, 2, 3, 4});
}

TEST_CASE("the error of a triangle is its area times the mean square between its corners") {
    // One corner darker by d: area d^2 / 6. 2 m with 0.1: 2 x 0.01; 1 m with 0.2: 0.5 x 0.04.
    CHECK(chosen(row({2.02, 1}, {0.1F, 0.2F}), ShadingRule::Error, 1) == std::vector{0});
    CHECK(chosen(row({1.98, 1}, {0.1F, 0.2F}), ShadingRule::Error, 1) == std::vector{1});
}

TEST_CASE("polygons of the same worth are taken in the order of their numbers") {
    for (const ShadingRule rule : {ShadingRule::Error, ShadingRule::Paper}) {
        CHECK(chosen(row({1, 1, 1, 1}, {0.5F, 0.5F, 0.5F, 0.5F}), rule, 2) == std::vector{0, 1});
    }
}

TEST_CASE("a polygon that faces away from the eye is smooth only when all others are") {
    ShadedPolygons polygons = row({1, 1}, {0.9F, 0.0F});
    polygons.polygons[0].normal = {0.0F, 0.0F, -1.0F};
    CHECK(chosen(polygons, ShadingRule::Error, 1) == std::vector{1});
    CHECK(chosen(polygons, ShadingRule::Error, 2) == std::vector{0, 1});
}

TEST_CASE("every rule makes exactly as many polygons smooth as it is told") {
    const ShadedPolygons torus = shaded_torus();
    for (const ShadingRule rule : all_rules) {
        for (const int count : {0, 1, 41, 208, 415, 416}) {
            CHECK(chosen(torus, rule, count).size() == static_cast<std::size_t>(count));
        }
    }
}

TEST_CASE("the same eyes and lights give the same choices") {
    const ShadedPolygons torus = shaded_torus();
    for (const ShadingRule rule : all_rules) {
        ShadingSelector one(torus, {.rule = rule});
        ShadingSelector other(torus, {.rule = rule});
        for (int step = 0; step < 20; ++step) {
            const glm::dvec3 eye_m(5.0 * std::cos(0.02 * step), 5.0 * std::sin(0.02 * step), 2.0);
            const auto first = one.choose(eye_m, from_above, 100 + step).smooth;
            const auto second = other.choose(eye_m, from_above, 100 + step).smooth;
            CHECK(std::ranges::equal(first, second));
        }
    }
}

TEST_CASE("more smooth polygons keep those that fewer had") {
    const ShadedPolygons torus = shaded_torus();
    for (const ShadingRule rule : all_rules) {
        const std::vector<int> few = chosen(torus, rule, 100);
        const std::vector<int> more = chosen(torus, rule, 150);
        CHECK(std::ranges::includes(more, few));
    }
}

TEST_CASE("an eye that stays within the stated angle and distance changes nothing") {
    const ShadedPolygons torus = shaded_torus();
    ShadingSelector selector(torus);
    selector.choose({5.0, 0.0, 0.0}, from_above, 100);
    const ShadingChoice near = selector.choose({5.2, 0.14, 0.0}, from_above, 100);
    CHECK_FALSE(near.was_reranked);
    CHECK(near.changed == 0);
    CHECK(near.smooth_count == 100);
    CHECK(selector.choose({5.0, 0.2, 0.0}, from_above, 100).was_reranked);
    CHECK(selector.choose({5.5, 0.2, 0.0}, from_above, 100).was_reranked);
    ShadingLight turned = from_above;
    turned.to_light = {0.05F, 0.0F, 0.99875F};
    CHECK(selector.choose({5.5, 0.2, 0.0}, turned, 100).was_reranked);
    CHECK(selector.choose({5.5, 0.2, 0.0}, turned, 101).changed == 1);
}

TEST_CASE("a smooth polygon gives way only to one that is clearly more wrong") {
    ShadedPolygons polygons = row({1, 1}, {0.30F, 0.29F});
    ShadingSelector selector(polygons, {.hysteresis = 1.5F, .reselect_rad = 0.0});
    CHECK(smooth_ones(selector.choose(high_m, from_above, 1).smooth) == std::vector{0});
    polygons = row({1, 1}, {0.30F, 0.35F}); // 0.35^2 / 0.30^2 = 1.36
    CHECK(selector.choose(high_m + 1.0, from_above, 1).changed == 0);
    polygons = row({1, 1}, {0.30F, 0.40F}); // 1.78
    CHECK(selector.choose(high_m + 2.0, from_above, 1).changed == 2);
    CHECK(smooth_ones(selector.smooth()) == std::vector{1});
}

TEST_CASE("holding on makes fewer changes around the torus") {
    const ShadedPolygons torus = shaded_torus();
    const auto changes = [&](float hysteresis) {
        ShadingSelector selector(torus, {.hysteresis = hysteresis});
        int sum = 0;
        for (int step = 0; step < 200; ++step) {
            const double angle_rad = 0.04 * step;
            sum +=
                selector.choose({6.0 * std::cos(angle_rad), 6.0 * std::sin(angle_rad), 2.0}, from_above, 104).changed;
        }
        return sum;
    };
    CHECK(changes(1.5F) < changes(1.0F));
}

namespace {

std::vector<std::uint8_t> chosen(const std::vector<std::uint32_t>& keys, std::size_t count) {
    std::vector<std::uint8_t> result(keys.size(), 7);
    LargestKeySelector greatest;
    greatest.choose(keys, count, result);
    return result;
}

} // namespace

TEST_CASE("the greatest keys are chosen, of equal ones the first") {
    using Marks = std::vector<std::uint8_t>;
    CHECK(chosen({5, 9, 1, 9}, 1) == Marks{0, 1, 0, 0});
    CHECK(chosen({5, 9, 1, 9}, 3) == Marks{1, 1, 0, 1});
    CHECK(chosen({4, 4, 4}, 2) == Marks{1, 1, 0});
    CHECK(chosen({5, 9, 1}, 0) == Marks{0, 0, 0});
    CHECK(chosen({5, 9, 1}, 3) == Marks{1, 1, 1});
    CHECK(chosen({}, 0).empty());
}

TEST_CASE("keys sort by tier, then by rank") {
    CHECK(sort_key(1, 0.0F) > sort_key(0, 1e30F));
    CHECK(sort_key(0, 2.0F) > sort_key(0, 1.0F));
    CHECK(sort_key(3, 0.5F) > sort_key(3, 1e-30F));
}

TEST_CASE("counting finds what sorting finds") {
    std::mt19937 dice(3);
    LargestKeySelector greatest;
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<std::uint32_t> keys(dice() % 400 + 1);
        const std::uint32_t range = trial % 3 == 0 ? 10U : 0xffffffffU;
        for (std::uint32_t& key : keys) { key = static_cast<std::uint32_t>(dice() % range); }
        const std::size_t count = dice() % (keys.size() + 1);
        std::vector<std::uint32_t> sorted(keys.size());
        std::iota(sorted.begin(), sorted.end(), 0U);
        std::ranges::stable_sort(sorted, [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
        std::vector<std::uint8_t> expected(keys.size(), 0);
        for (std::size_t i = 0; i < count; ++i) { expected[sorted[i]] = 1; }
        std::vector<std::uint8_t> found(keys.size());
        greatest.choose(keys, count, found);
        CHECK(found == expected);
    }
}

TEST_CASE("all polygons are smooth to the near distance, none from the far one, half between") {
    const ShadingRange range{.near_m = 100.0, .far_m = 300.0};
    CHECK(smooth_count(0.0, range, 416) == 416);
    CHECK(smooth_count(100.0, range, 416) == 416);
    CHECK(smooth_count(200.0, range, 416) == 208); // where the printed formula has its pole
    CHECK(smooth_count(250.0, range, 416) == 104);
    CHECK(smooth_count(300.0, range, 416) == 0);
    CHECK(smooth_count(1e9, range, 416) == 0);
}

TEST_CASE("three levels of distance are all, half and none smooth") {
    const ShadingRange range{.near_m = 0.0, .far_m = 100.0, .levels = 3};
    CHECK(smooth_count(24.0, range, 10) == 10);
    CHECK(smooth_count(26.0, range, 10) == 5);
    CHECK(smooth_count(74.0, range, 10) == 5);
    CHECK(smooth_count(76.0, range, 10) == 0);
}

TEST_CASE("the paper's telephone has 9 smooth ones of 415 polygons, its desktop all") {
    CHECK(device_smooth_count(0.028, 415) == 9);
    CHECK(device_smooth_count(1.0, 415) == 415);
    CHECK(device_smooth_count(0.0, 415) == 0);
}

TEST_CASE("a faster device never has fewer smooth polygons") {
    int before = 0;
    for (int percent = 0; percent <= 100; ++percent) {
        const int now = device_smooth_count(percent / 100.0, 416);
        CHECK(now >= before);
        before = now;
    }
}

namespace {

const ShadingLight phong_light{
    .to_light = {0.0F, 0.0F, 1.0F}, .ambient = 0.25F, .diffuse = 0.5F, .specular = 0.125F, .shininess = 2};
constexpr glm::vec3 here(0.0F);
constexpr glm::vec3 up(0.0F, 0.0F, 1.0F);

} // namespace

TEST_CASE("seen from the light, a surface across it has all three parts") {
    // 2 x (0.25 + 0.5) + 3 x 0.125
    CHECK(intensity(here, up, 2.0F, phong_light, {0.0F, 0.0F, 5.0F}) == Approx(1.875));
}

TEST_CASE("at 60 degrees from the mirrored light a quarter of the highlight is left") {
    const glm::vec3 eye_m(std::sqrt(3.0F), 0.0F, 1.0F);
    CHECK(intensity(here, up, 2.0F, phong_light, eye_m) == Approx(1.5 + 3.0 * 0.125 / 4.0));
}

TEST_CASE("behind the mirrored light there is no highlight") {
    CHECK(intensity(here, up, 2.0F, phong_light, {1.0F, 0.0F, -1.0F}) == Approx(1.5));
}

TEST_CASE("a surface that faces away from the light has ambient light only") {
    CHECK(intensity(here, -up, 2.0F, phong_light, {0.0F, 0.0F, 5.0F}) == Approx(0.5));
}
