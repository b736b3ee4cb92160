#include "sim/base/error.h"
#include "sim/base/random_generator.h"
#include "tests/scratch.h"
#include "visuals/camera/lens.h"
#include "visuals/camera/lens_model.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace octant::visuals::camera {

namespace {

LensModel random_lens(Distortion distortion, RandomGenerator& dice) {
    for (;;) {
        LensModel lens;
        lens.size_px = {
            40 + static_cast<int>(dice.between(0.0, 600.0)), 30 + static_cast<int>(dice.between(0.0, 400.0))};
        const bool is_fisheye = distortion == Distortion::Fisheye;
        const double focal = lens.size_px.x * dice.between(is_fisheye ? 0.25 : 0.4, 2.0);
        lens.focal_px = {focal, focal * dice.between(0.9, 1.1)};
        lens.centre_px = glm::dvec2(lens.size_px) * glm::dvec2(dice.between(0.4, 0.6), dice.between(0.4, 0.6));
        lens.distortion = distortion;
        if (distortion == Distortion::BrownConrady) {
            lens.coefficients = {dice.between(-0.4, 0.3), dice.between(-0.2, 0.2), dice.between(-0.01, 0.01),
                dice.between(-0.01, 0.01), dice.between(-0.05, 0.05)};
        } else if (is_fisheye) {
            lens.coefficients = {dice.between(-0.1, 0.1), dice.between(-0.03, 0.03), dice.between(-0.01, 0.01),
                dice.between(-3e-3, 3e-3)};
        }
        try {
            const Lens checked(lens, 16);
            return lens;
        } catch (const Error&) { // it folds
        }
    }
}

glm::dvec2 random_pixel(const LensModel& lens, RandomGenerator& dice) {
    return {dice.between(-0.5, lens.size_px.x - 0.5), dice.between(-0.5, lens.size_px.y - 0.5)};
}

constexpr std::array all_models{Distortion::None, Distortion::BrownConrady, Distortion::Fisheye};

bool has_opencv() { return std::system("/usr/bin/python3 -c 'import cv2' >/dev/null 2>&1") == 0; }

LensModel brown_conrady(double k1) {
    LensModel lens = LensModel::of_vertical_fov({200, 100}, 1.0);
    lens.distortion = Distortion::BrownConrady;
    lens.coefficients[0] = k1;
    return lens;
}

} // namespace

TEST_CASE("projection and its inverse agree with OpenCV for random cameras of each model") {
    if (!has_opencv()) {
        std::cout << "SKIPPED: python3-opencv is not installed\n";
        return;
    }
    RandomGenerator dice(3);
    const std::filesystem::path folder = octant::tests::empty_folder("opencv");
    std::vector<std::pair<LensModel, glm::dvec3>> cases;
    std::vector<glm::dvec2> seen_at;
    std::ofstream questions(folder / "questions");
    for (const Distortion distortion : all_models) {
        for (int camera = 0; camera < 20; ++camera) {
            const LensModel lens = random_lens(distortion, dice);
            for (int i = 0; i < 20; ++i) {
                const glm::dvec2 pixel = random_pixel(lens, dice);
                const std::optional<glm::dvec3> ray = lens.ray(pixel);
                REQUIRE(ray);
                if (ray->z <= 0.02) { continue; } // OpenCV divides by z
                const glm::dvec3 point = *ray * dice.between(0.1, 1000.0);
                const auto& k = lens.coefficients;
                questions << fmt::format("{} {} {} {} {} {} {} {} {} {},{} {} {}\n",
                    distortion == Distortion::Fisheye ? "fisheye" : "plain", lens.focal_px.x, lens.focal_px.y,
                    lens.centre_px.x, lens.centre_px.y, k[0], k[1], k[2], k[3], k[4], point.x, point.y, point.z);
                cases.emplace_back(lens, point);
                seen_at.push_back(pixel);
            }
        }
    }
    questions.close();
    REQUIRE(cases.size() > 1000);
    const std::string run = fmt::format("/usr/bin/python3 {}/tests/visuals/camera/opencv_points.py < {} > {}",
        OCTANT_SOURCE_DIR, (folder / "questions").string(), (folder / "answers").string());
    REQUIRE(std::system(run.c_str()) == 0);
    std::ifstream answers(folder / "answers");
    double worst_forward_px = 0.0;
    double worst_inverse_px = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        glm::dvec2 theirs;
        REQUIRE(answers >> theirs.x >> theirs.y);
        const std::optional<glm::dvec2> ours = cases[i].first.project(cases[i].second);
        REQUIRE(ours);
        worst_forward_px = std::max(worst_forward_px, glm::distance(*ours, theirs));
        worst_inverse_px = std::max(worst_inverse_px, glm::distance(seen_at[i], theirs));
    }
    CAPTURE(worst_forward_px, worst_inverse_px);
    CHECK(worst_forward_px < 1e-6);
    CHECK(worst_inverse_px < 1e-6);
}

TEST_CASE("the ray of each pixel is projected to that pixel, behind a fisheye, too") {
    RandomGenerator dice(4);
    int behind = 0;
    for (const Distortion distortion : all_models) {
        for (int camera = 0; camera < 20; ++camera) {
            const LensModel lens = random_lens(distortion, dice);
            for (int i = 0; i < 50; ++i) {
                const glm::dvec2 pixel = random_pixel(lens, dice);
                const std::optional<glm::dvec3> ray = lens.ray(pixel);
                REQUIRE(ray);
                behind += ray->z < 0.0 ? 1 : 0;
                const std::optional<glm::dvec2> back = lens.project(*ray * 3.0);
                REQUIRE(back);
                CHECK(glm::distance(*back, pixel) < 1e-9);
            }
        }
    }
    CHECK(behind > 10);
}

TEST_CASE("an equidistant fisheye sees in each pixel the angle that its radius is in focal lengths") {
    LensModel lens;
    lens.size_px = {300, 300};
    lens.focal_px = {50.0, 50.0};
    lens.centre_px = {149.5, 149.5};
    lens.distortion = Distortion::Fisheye;
    for (const double angle_rad : {0.0, 0.3, 1.2, 1.6, 2.9}) {
        const auto ray = lens.ray({149.5 + 50.0 * angle_rad, 149.5});
        REQUIRE(ray);
        CHECK(std::atan2(ray->x, ray->z) == Approx(angle_rad).margin(1e-12));
    }
    CHECK_FALSE(lens.ray({149.5 + 50.0 * 3.2, 149.5}));
    CHECK_FALSE(lens.project({0.0, 0.0, -1.0}));
}

TEST_CASE("a point beyond the radius at which a distortion folds has no pixel") {
    // x - 0.3 x^3 is greatest at x = 1.054.
    LensModel lens = brown_conrady(-0.3);
    REQUIRE(lens.project({1.0, 0.0, 1.0}));
    CHECK_FALSE(lens.project({1.1, 0.0, 1.0}));
    CHECK_FALSE(lens.project({1.6, 0.0, 1.0}));
    CHECK_FALSE(lens.project({0.1, 0.0, -1.0}));
    const double greatest_px = lens.centre_px.x + lens.focal_px.x * (1.0540925 - 0.3 * std::pow(1.0540925, 3));
    CHECK(lens.ray({greatest_px - 0.01, lens.centre_px.y}));
    CHECK_FALSE(lens.ray({greatest_px + 0.01, lens.centre_px.y}));
}

TEST_CASE("a distortion that folds inside the picture is refused with the radius of the fold") {
    const LensModel lens = brown_conrady(-0.9);
    const double fold_px = lens.focal_px.x * 2.0 / 3.0 / std::sqrt(2.7);
    std::string message;
    try {
        const Lens folds(lens, 16);
    } catch (const Error& error) { message = error.what(); }
    CHECK(
        message == fmt::format("camera: expected a distortion that is one to one over the picture, up to 111.8 pixels "
                               "from its centre, got one that folds, or sees straight back, at {:.1f} pixels",
                       fold_px));
}

TEST_CASE("numbers out of range are refused") {
    const auto message_of = [](const LensModel& lens, int samples) {
        try {
            const Lens refused(lens, samples);
        } catch (const Error& error) { return std::string(error.what()); }
        return std::string("nothing");
    };
    LensModel lens = LensModel::of_vertical_fov({200, 100}, 1.0);
    CHECK(message_of(lens, 16) == "nothing");
    CHECK(message_of(lens, 2) == "camera: expected 1, 4 or 16 samples a pixel, got 2");
    LensModel large = lens;
    large.size_px = {8193, 10};
    CHECK(message_of(large, 16) == "camera: expected a size from 1 x 1 to 8192 x 8192 pixels, got 8193 x 10");
    LensModel flat = lens;
    flat.focal_px.y = std::nan("");
    CHECK(message_of(flat, 1).find("camera: expected focal lengths") == 0);
    LensModel odd = lens;
    odd.coefficients[3] = std::nan("");
    CHECK(message_of(odd, 1).find("camera: expected coefficients") == 0);
}

} // namespace octant::visuals::camera
