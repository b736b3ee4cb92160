#include "truth_rays.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace octant::tests {

namespace scene = visuals::scene;

TruthPicture::TruthPicture(const glm::ivec2& size) : size_px(size) {
    const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    depth_m.resize(pixels);
    class_id.resize(pixels);
    object_id.resize(pixels);
    normal.resize(pixels);
    flow_px.resize(pixels);
    previous_px.resize(pixels);
    coverage.resize(pixels);
}

scene::TruthArrays TruthPicture::arrays() {
    return {depth_m.data(), class_id.data(), object_id.data(), &normal.front().x, &flow_px.front().x,
        &previous_px.front().x, coverage.data()};
}

bool TruthPicture::operator==(const TruthPicture& other) const {
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
    };
    return same(depth_m, other.depth_m) && same(class_id, other.class_id) && same(object_id, other.object_id) &&
           same(normal, other.normal) && same(flow_px, other.flow_px) && same(previous_px, other.previous_px) &&
           same(coverage, other.coverage);
}

namespace {

/// A triangle on the picture.
struct Target {
    glm::dmat3 inwards; ///< columns: distances from the sides at x, y, 1, pixels; greater than zero inside
    glm::dvec3 normal;  ///< towards the eye
    double offset_m = 0.0;
    double min_depth_m = 0.0;
    double max_depth_m = 0.0;
    scene::SurfaceClass surface{};
    std::uint32_t object = 0;
};

/// What may be seen at a pixel.
struct Candidate {
    const Target* target;
    double depth_m;
    double inside_px;
    /// Of the places within reach.
    double nearest_m;
    double farthest_m;
};

/// Takes places to column * w, row * w, w.
glm::dmat3 to_pixels(const scene::FramePlan& plan, const glm::ivec2& size_px) {
    const glm::dmat4 clip = glm::dmat4(plan.view_to_clip) * glm::dmat4(plan.world_to_view);
    glm::dmat3 pixels;
    for (glm::length_t i = 0; i < 3; ++i) {
        const glm::dvec4& from = clip[i];
        pixels[i] = {(from.x + from.w) * 0.5 * size_px.x - 0.5 * from.w,
            (from.w - from.y) * 0.5 * size_px.y - 0.5 * from.w, from.w};
    }
    return pixels;
}

} // namespace

RayCheck check_by_rays(const scene::FramePlan& plan, std::span<const scene::ModelBuffers> models,
    const TruthPicture& truth, double reach_px) {
    const glm::ivec2 size_px = truth.size_px;
    const glm::dmat3 from_world = to_pixels(plan, size_px);
    const glm::dmat3 to_world = glm::inverse(from_world);
    const auto near_m = static_cast<double>(plan.view_to_clip[3][2]);
    std::vector<Target> targets;
    std::vector<std::array<glm::ivec2, 2>> boxes;
    scene::for_each_surface_triangle(plan, models, [&](const scene::SurfaceTriangle& triangle) {
        const auto& m = triangle.corners_m;
        const glm::dvec3 normal = glm::cross(m[1] - m[0], m[2] - m[0]);
        const double offset_m = glm::dot(normal, m[0]);
        glm::dmat3 corners(0.0);
        for (glm::length_t k = 0; k < 3; ++k) { corners[k] = from_world * m[static_cast<std::size_t>(k)]; }
        if (offset_m >= 0.0) { return; } // its back
        Target target{{}, glm::normalize(normal), 0.0,
            std::max(std::min({corners[0].z, corners[1].z, corners[2].z}), near_m),
            std::max(std::max({corners[0].z, corners[1].z, corners[2].z}), near_m), triangle.surface, triangle.object};
        if (target.max_depth_m <= near_m) { return; }
        target.offset_m = glm::dot(target.normal, m[0]);
        const double turn = glm::determinant(corners) < 0.0 ? -1.0 : 1.0;
        for (glm::length_t k = 0; k < 3; ++k) {
            const glm::dvec3 side = glm::cross(corners[(k + 1) % 3], corners[(k + 2) % 3]) * turn;
            target.inwards[k] = side / std::max(std::hypot(side.x, side.y), 1e-300);
        }
        glm::dvec2 least(1e9);
        glm::dvec2 most(-1e9);
        for (glm::length_t k = 0; k < 3; ++k) {
            const glm::dvec3& here = corners[k];
            const glm::dvec3& next = corners[(k + 1) % 3];
            const auto add = [&](const glm::dvec3& at) {
                least = glm::min(least, glm::dvec2(at) / at.z);
                most = glm::max(most, glm::dvec2(at) / at.z);
            };
            if (here.z >= near_m) { add(here); }
            if ((here.z >= near_m) != (next.z >= near_m)) {
                add(glm::mix(here, next, (near_m - here.z) / (next.z - here.z)));
            }
        }
        const glm::dvec2 last(size_px - 1);
        if (most.x < -1.0 || most.y < -1.0 || least.x > last.x + 1.0 || least.y > last.y + 1.0) { return; }
        targets.push_back(target);
        boxes.push_back({glm::ivec2(glm::max(glm::ceil(least - reach_px), glm::dvec2(0.0))),
            glm::ivec2(glm::min(glm::floor(most + reach_px), last))});
    });
    std::vector<std::vector<Candidate>> seen(truth.depth_m.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const Target& target = targets[i];
        for (int row = boxes[i][0].y; row <= boxes[i][1].y; ++row) {
            for (int column = boxes[i][0].x; column <= boxes[i][1].x; ++column) {
                const glm::dvec3 at(column, row, 1.0);
                const double inside = std::min({glm::dot(target.inwards[0], at), glm::dot(target.inwards[1], at),
                    glm::dot(target.inwards[2], at)});
                if (inside < -reach_px) { continue; }
                const double towards = glm::dot(target.normal, to_world * at);
                const double depth_m = towards == 0.0 ? target.max_depth_m : target.offset_m / towards;
                if (inside >= 0.0 && depth_m < near_m) { continue; }
                const auto within = [&](double depth) {
                    return std::clamp(depth, target.min_depth_m, target.max_depth_m);
                };
                const glm::dvec3 per_px = target.normal * to_world / target.offset_m;
                const double slope = reach_px * (std::abs(per_px.x) + std::abs(per_px.y));
                const double least = 1.0 / depth_m - slope;
                seen[truth.at(column, row)].push_back({&target, within(depth_m), inside,
                    within(1.0 / (1.0 / depth_m + slope)), least > 0.0 ? within(1.0 / least) : target.max_depth_m});
            }
        }
    }
    RayCheck check;
    for (int row = 0; row < size_px.y; ++row) {
        for (int column = 0; column < size_px.x; ++column) {
            const std::size_t pixel = truth.at(column, row);
            double certain_m = std::numeric_limits<double>::infinity();
            for (const Candidate& one : seen[pixel]) {
                if (one.inside_px > reach_px) { certain_m = std::min(certain_m, one.farthest_m); }
            }
            const bool is_sky = truth.class_id[pixel] == static_cast<std::uint8_t>(scene::SurfaceClass::Sky);
            const auto depth_m = static_cast<double>(truth.depth_m[pixel]);
            bool is_right = is_sky && std::isinf(certain_m) && std::isinf(depth_m) && truth.object_id[pixel] == 0;
            for (const Candidate& one : seen[pixel]) {
                constexpr double same_depth = 2e-6;
                constexpr double hidden = 1e-4;
                is_right = is_right || (truth.class_id[pixel] == static_cast<std::uint8_t>(one.target->surface) &&
                                           truth.object_id[pixel] == one.target->object &&
                                           std::abs(depth_m - one.depth_m) <= same_depth * one.depth_m &&
                                           glm::distance(glm::dvec3(truth.normal[pixel]), one.target->normal) < 1e-5 &&
                                           one.nearest_m <= certain_m * (1.0 + hidden));
            }
            check.pixels += is_sky ? 0 : 1;
            check.aircraft += truth.object_id[pixel] != 0 ? 1 : 0;
            if (!is_right) {
                ++check.wrong;
                if (check.wrong_at.size() < 20) { check.wrong_at.emplace_back(column, row); }
            }
        }
    }
    return check;
}

} // namespace octant::tests
