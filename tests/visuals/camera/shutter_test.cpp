#include "sim/base/units.h"
#include "visuals/camera/lens.h"
#include "visuals/camera/shutter.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace octant::visuals::camera {

TEST_CASE("a picture without shutter and row times is drawn once, with its truth") {
    const std::vector<Drawing> drawings = drawings_of({}, 90, 1);
    REQUIRE(drawings.size() == 1);
    CHECK(drawings[0].time_s == 0.0);
    CHECK(drawings[0].first_row == 0);
    CHECK(drawings[0].end_row == 90);
    CHECK(drawings[0].adds_light);
    CHECK(drawings[0].is_truth);
}

TEST_CASE("the bands of a rolling shutter show each row once, within half a pixel of its own time") {
    for (const double row_time_s : {1e-4, -3e-5}) {
        for (const int rows : {1, 7, 128, 479}) {
            for (const double motion_px : {0.0, 0.4, 5.5, 60.0, 1000.0}) {
                const int bands = band_count(rows, motion_px);
                CHECK(bands <= std::min(rows, max_bands));
                const Shutter shutter{.row_time_s = row_time_s};
                int next_row = 0;
                double worst_px = 0.0;
                for (const Drawing& drawing : drawings_of(shutter, rows, bands)) {
                    CHECK(drawing.first_row == next_row);
                    next_row = drawing.end_row;
                    CHECK(drawing.adds_light);
                    CHECK(drawing.is_truth);
                    for (int row = drawing.first_row; row < drawing.end_row; ++row) {
                        const double own_s = (row - 0.5 * (rows - 1)) * row_time_s;
                        const double speed_px = motion_px / (std::abs(row_time_s) * rows);
                        worst_px = std::max(worst_px, std::abs(own_s - drawing.time_s) * speed_px);
                    }
                }
                CHECK(next_row == rows);
                CAPTURE(rows, motion_px, bands);
                if (bands < max_bands) { CHECK(worst_px <= 0.5); }
            }
        }
    }
}

TEST_CASE("motion blur is spread evenly over the shutter time, its truth is in the middle") {
    for (const int frames : {1, 2, 3, 8}) {
        const std::vector<Drawing> drawings = drawings_of({.open_s = 0.02, .blur_frames = frames}, 10, 1);
        double sum_s = 0.0;
        int lights = 0;
        int truths = 0;
        for (const Drawing& drawing : drawings) {
            CHECK(std::abs(drawing.time_s) < 0.01);
            sum_s += drawing.adds_light ? drawing.time_s : 0.0;
            lights += drawing.adds_light ? 1 : 0;
            truths += drawing.is_truth ? 1 : 0;
            if (drawing.is_truth) { CHECK(drawing.time_s == 0.0); }
        }
        CHECK(std::abs(sum_s) < 1e-12);
        CHECK(lights == frames);
        CHECK(truths == 1);
        CHECK(std::is_sorted(
            drawings.begin(), drawings.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; }));
    }
}

TEST_CASE("a pose moves by its velocity and turns about its body's axes") {
    MovingPose pose;
    pose.eye_m = {1.0, 2.0, 3.0};
    pose.body_to_world = glm::dquat(0.5, 0.5, 0.5, 0.5);
    pose.velocity_mps = {10.0, 0.0, -2.0};
    pose.turn_rate_radps = {0.0, 0.0, pi / 2.0}; // to the right
    const MovingPose later = pose.after(0.5);
    CHECK(glm::distance(later.eye_m, glm::dvec3(6.0, 2.0, 2.0)) < 1e-12);
    const glm::dvec3 ahead = glm::conjugate(pose.body_to_world) * (later.body_to_world * glm::dvec3(1.0, 0.0, 0.0));
    CHECK(glm::distance(ahead, glm::dvec3(std::sqrt(0.5), std::sqrt(0.5), 0.0)) < 1e-12);
    const MovingPose back = later.after(-0.5);
    CHECK(glm::distance(
              back.body_to_world * glm::dvec3(1.0, 2.0, 3.0), pose.body_to_world * glm::dvec3(1.0, 2.0, 3.0)) < 1e-12);
}

TEST_CASE("a turn moves the middle of the picture by focal lengths, and a roll its corners") {
    LensModel model = LensModel::of_vertical_fov({101, 101}, 0.2);
    const Lens lens(model, 16);
    const double half_px = 50.0;
    // The edge moves the farthest: by 1 + tan^2 times the middle's motion; both ways in the corners.
    const double edge = 1.0 + std::pow(half_px / model.focal_px.x, 2);
    CHECK(turn_px(lens, {0.0, 0.0, 0.01}) >= model.focal_px.x * 0.01 * edge);
    CHECK(turn_px(lens, {0.0, 0.0, 0.01}) < model.focal_px.x * 0.01 * edge * 1.02);
    CHECK(turn_px(lens, {0.3, 0.0, 0.0}) == Approx(0.3 * half_px * std::sqrt(2.0)).epsilon(1e-3));
    CHECK(turn_px(lens, glm::dvec3(0.0)) == 0.0);
}

} // namespace octant::visuals::camera
