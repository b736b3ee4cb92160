#include "sim/base/random_generator.h"
#include "visuals/camera/lens.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace octant::visuals::camera {

namespace {

/// The colour, 0 to 1, that lies in a direction, in the camera's axes.
using World = std::function<double(const glm::dvec3& ray)>;

LensModel lens_of(
    Distortion distortion, const glm::ivec2& size_px, double focal_px, const std::array<double, 5>& coefficients) {
    LensModel lens;
    lens.size_px = size_px;
    lens.focal_px = glm::dvec2(focal_px, focal_px * 1.05);
    lens.centre_px = glm::dvec2(size_px) * 0.5 + glm::dvec2(1.3, -2.7);
    lens.distortion = distortion;
    lens.coefficients = coefficients;
    return lens;
}

LensModel barrel() { return lens_of(Distortion::BrownConrady, {60, 45}, 40.0, {-0.22, 0.04, 0.003, -0.002, -0.003}); }

LensModel wide_fisheye() { return lens_of(Distortion::Fisheye, {64, 64}, 22.0, {0.02, -0.003, 0.0, 0.0}); }

/// The ray that a place in a face's picture sees, by the same camera's own description of its field of view.
glm::dvec3 ray_of(const Face& face, const glm::dvec2& at_px) {
    const double half_height = std::tan(face.shape.vertical_fov_rad / 2.0);
    const glm::dvec2 share = (at_px + 0.5) / glm::dvec2(face.size_px) * 2.0 - 1.0;
    const double half_width = half_height * face.shape.pixel_aspect * face.size_px.x / face.size_px.y;
    const glm::dvec3 in_view(
        face.shape.middle.x + share.x * half_width, face.shape.middle.y - share.y * half_height, -1.0);
    const glm::dvec3 v = face.to_camera * in_view;
    return {v.x, -v.y, -v.z};
}

/// A face's picture, each pixel with as many samples a side.
scene::Picture drawn(const Face& face, const World& world, int side) {
    scene::Picture picture;
    picture.width = face.size_px.x;
    picture.height = face.size_px.y;
    for (int row = 0; row < face.size_px.y; ++row) {
        for (int column = 0; column < face.size_px.x; ++column) {
            double sum = 0.0;
            for (int i = 0; i < side * side; ++i) {
                const glm::dvec2 at((i % side + 0.5) / side - 0.5, (i / side + 0.5) / side - 0.5);
                sum += world(ray_of(face, glm::dvec2(column, row) + at));
            }
            const auto level = static_cast<std::uint8_t>(sum / (side * side) * 255.0 + 0.5);
            picture.rgba.insert(picture.rgba.end(), {level, static_cast<std::uint8_t>(255 - level), 7, 255});
        }
    }
    return picture;
}

std::vector<std::uint16_t> picture_through(const Lens& lens, const World& world, int side) {
    const glm::ivec2 size = lens.model().size_px;
    std::vector<std::uint16_t> colours(3 * static_cast<std::size_t>(size.x * size.y), 12345);
    for (const Face& face : lens.faces()) {
        const scene::Picture picture = drawn(face, world, side);
        lens.resample(face, picture, 0, size.y / 2, colours);
        lens.resample(face, picture, size.y / 2, size.y, colours);
    }
    return colours;
}

/// The same without faces: the mean over each pixel, by rays.
std::vector<double> picture_by_rays(const LensModel& lens, const World& world, int side) {
    std::vector<double> values;
    for (int row = 0; row < lens.size_px.y; ++row) {
        for (int column = 0; column < lens.size_px.x; ++column) {
            double sum = 0.0;
            for (int i = 0; i < side * side; ++i) {
                const glm::dvec2 at((i % side + 0.5) / side - 0.5, (i / side + 0.5) / side - 0.5);
                sum += world(lens.ray(glm::dvec2(column, row) + at).value());
            }
            values.push_back(sum / (side * side));
        }
    }
    return values;
}

/// Black and white cubes around the camera, with edges everywhere.
double checks(const glm::dvec3& ray) {
    const glm::ivec3 cell(glm::floor(glm::normalize(ray) * 3.5 + 0.31));
    return (cell.x + cell.y + cell.z) % 2 == 0 ? 1.0 : 0.0;
}

double smooth(const glm::dvec3& ray) {
    const glm::dvec3 d = glm::normalize(ray);
    return 0.5 + 0.2 * std::sin(3.0 * d.x) + 0.15 * std::cos(2.0 * d.y) * d.z;
}

} // namespace

TEST_CASE("a camera without distortion has one face: its own picture") {
    const LensModel model = lens_of(Distortion::None, {60, 45}, 40.0, {});
    const Lens lens(model, 16);
    REQUIRE(lens.faces().size() == 1);
    CHECK(lens.is_pinhole());
    const Face& face = lens.faces()[0];
    CHECK(face.size_px == model.size_px);
    CHECK(face.samples == 16);
    for (const glm::dvec2 at : {glm::dvec2(0.0), glm::dvec2(59.0, 0.0), glm::dvec2(13.2, 44.0)}) {
        const glm::dvec3 ray = ray_of(face, at);
        CHECK(glm::distance(ray, model.ray(at).value()) < 1e-12);
    }
    const std::vector<std::uint16_t> colours = picture_through(lens, smooth, 4);
    CHECK(colours[2] == 7 * 257);
}

TEST_CASE("each pixel belongs to one face, which shows its ray at the foot print") {
    for (const LensModel& model : {barrel(), wide_fisheye()}) {
        for (const int samples : {1, 16}) {
            const Lens lens(model, samples);
            std::vector<int> count(static_cast<std::size_t>(model.size_px.x * model.size_px.y));
            double worst = 0.0;
            double worst_side_px = 0.0;
            for (const Face& face : lens.faces()) {
                CHECK(std::is_sorted(face.pixels.begin(), face.pixels.end()));
                const auto pixels = face.pixels_of(0, model.size_px.y);
                const auto prints = face.foot_prints_of(0, model.size_px.y);
                REQUIRE(pixels.size() == face.pixels.size());
                for (std::size_t i = 0; i < pixels.size(); ++i) {
                    ++count[pixels[i]];
                    const int width = model.size_px.x;
                    const glm::dvec2 at(static_cast<int>(pixels[i]) % width, static_cast<int>(pixels[i]) / width);
                    const glm::dvec3 seen = glm::normalize(ray_of(face, glm::dvec2(prints[i].at_px)));
                    worst = std::max(worst, glm::distance(seen, glm::normalize(model.ray(at).value())));
                    const glm::dvec2 right_px = glm::dvec2(prints[i].at_px) + glm::dvec2(prints[i].right) / 512.0;
                    const auto edge = model.project(ray_of(face, right_px));
                    REQUIRE(edge);
                    worst_side_px = std::max(worst_side_px, glm::distance(*edge, at + glm::dvec2(0.5, 0.0)));
                    // All that the filter reads lies in the face.
                    CHECK(prints[i].at_px.x > 1.0F);
                    CHECK(prints[i].at_px.y > 1.0F);
                    CHECK(prints[i].at_px.x < static_cast<float>(face.size_px.x) - 2.0F);
                    CHECK(prints[i].at_px.y < static_cast<float>(face.size_px.y) - 2.0F);
                }
            }
            CHECK(std::all_of(count.begin(), count.end(), [](int n) { return n == 1; }));
            CHECK(worst < 1e-6);
            CHECK(worst_side_px < 0.1);
        }
    }
}

TEST_CASE("a wide fisheye has several faces, a narrow one has one") {
    CHECK(Lens(barrel(), 16).faces().size() == 1);
    CHECK(Lens(wide_fisheye(), 16).faces().size() == 5);
    CHECK(Lens(lens_of(Distortion::Fisheye, {64, 64}, 60.0, {}), 16).faces().size() == 1);
    CHECK(Lens(lens_of(Distortion::Fisheye, {40, 40}, 12.0, {}), 16).faces().size() == 6);
}

TEST_CASE("faces have twice the resolution of the distorted picture, with a quarter of its samples") {
    const Lens lens(barrel(), 16);
    const Face& face = lens.faces()[0];
    CHECK(face.samples == 4);
    double shortest_px = 100.0;
    for (const FootPrint& print : face.foot_prints) {
        shortest_px = std::min(
            {shortest_px, glm::length(glm::dvec2(print.right)) / 256.0, glm::length(glm::dvec2(print.down)) / 256.0});
    }
    CHECK(shortest_px >= 1.98);
    CHECK(shortest_px < 2.2);
    CHECK(Lens(barrel(), 1).faces()[0].samples == 1);
    CHECK(Lens(barrel(), 1).faces()[0].size_px.x < face.size_px.x * 6 / 10);
}

TEST_CASE("faces are bounded") {
    LensModel model = wide_fisheye();
    model.size_px = {900, 900};
    model.focal_px = glm::dvec2(320.0);
    model.centre_px = {450.0, 450.0};
    for (const Face& face : Lens(model, 16).faces()) {
        CHECK(face.size_px.x <= 8192);
        CHECK(face.size_px.y <= 8192);
        CHECK(static_cast<double>(face.size_px.x) * face.size_px.y < 16.5 * 900 * 900);
    }
}

TEST_CASE("a smooth world comes through a lens as it is") {
    for (const LensModel& model : {barrel(), wide_fisheye()}) {
        const Lens lens(model, 16);
        const std::vector<std::uint16_t> seen = picture_through(lens, smooth, 2);
        const std::vector<double> wanted = picture_by_rays(model, smooth, 4);
        double worst = 0.0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            worst = std::max(worst, std::abs(seen[3 * i] / 65535.0 - wanted[i]));
            CHECK(std::abs(seen[3 * i] + seen[3 * i + 1] - 65535) <= 2);
            CHECK(seen[3 * i + 2] == 7 * 257);
        }
        CHECK(worst < 0.004);
    }
}

TEST_CASE("edges stay those of the mean over each pixel") {
    for (const LensModel& model : {barrel(), wide_fisheye()}) {
        const Lens lens(model, 16);
        const std::vector<std::uint16_t> seen = picture_through(lens, checks, 2);
        const std::vector<double> wanted = picture_by_rays(model, checks, 16);
        double squares = 0.0;
        double worst = 0.0;
        double sum = 0.0;
        std::size_t on_edges = 0;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const double error = seen[3 * i] / 65535.0 - wanted[i];
            sum += error;
            worst = std::max(worst, std::abs(error));
            if (wanted[i] > 0.01 && wanted[i] < 0.99) {
                ++on_edges;
                squares += error * error;
            }
        }
        const double deviation = std::sqrt(squares / static_cast<double>(on_edges));
        CAPTURE(deviation, worst, on_edges);
        CHECK(on_edges > 300);
        CHECK(deviation < 0.1);
        CHECK(worst < 0.35);
        CHECK(std::abs(sum) / static_cast<double>(wanted.size()) < 0.002);
    }
}

TEST_CASE("with one sample a pixel shows the nearest pixel of its face") {
    const LensModel model = barrel();
    const Lens lens(model, 1);
    const std::vector<std::uint16_t> seen = picture_through(lens, checks, 1);
    std::set<std::uint16_t> levels;
    for (std::size_t i = 0; i < seen.size(); i += 3) { levels.insert(seen[i]); }
    CHECK(levels == std::set<std::uint16_t>{0, 65535});
}

TEST_CASE("a depth times the pixel's ray is the point that the face shows") {
    for (const LensModel& model : {barrel(), wide_fisheye()}) {
        const Lens lens(model, 16);
        double worst = 0.0;
        for (const Face& face : lens.faces()) {
            for (std::size_t i = 0; i < face.pixels.size(); ++i) {
                const int width = model.size_px.x;
                const glm::dvec2 pixel(
                    static_cast<int>(face.pixels[i]) % width, static_cast<int>(face.pixels[i]) / width);
                const glm::vec2 at_px = face.foot_prints[i].at_px;
                const glm::dvec3 point = model.ray(pixel).value() * lens.depth_scale(face, at_px);
                worst = std::max(worst, glm::distance(point, ray_of(face, glm::dvec2(at_px))));
            }
        }
        CHECK(worst < 1e-4); // places are float
    }
}

TEST_CASE("a motion in a face's picture is that in the distorted picture") {
    RandomGenerator dice(8);
    for (const LensModel& model : {barrel(), wide_fisheye()}) {
        const Lens lens(model, 16);
        double worst_px = 0.0;
        for (const Face& face : lens.faces()) {
            for (std::size_t i = 0; i < face.pixels.size(); i += 7) {
                const glm::vec2 before_px =
                    face.foot_prints[i].at_px + glm::vec2(dice.between(-6.0, 6.0), dice.between(-6.0, 6.0));
                const glm::vec2 found = lens.flow(face, face.pixels[i], before_px);
                const auto before = model.project(ray_of(face, glm::dvec2(before_px)));
                REQUIRE(before);
                const int width = model.size_px.x;
                const glm::dvec2 pixel(
                    static_cast<int>(face.pixels[i]) % width, static_cast<int>(face.pixels[i]) / width);
                worst_px = std::max(worst_px, glm::distance(glm::dvec2(found), pixel - *before));
            }
            const float none = std::numeric_limits<float>::quiet_NaN();
            CHECK(std::isnan(lens.flow(face, face.pixels[0], {none, none}).x));
        }
        CHECK(worst_px < 1e-4);
    }
}

} // namespace octant::visuals::camera
