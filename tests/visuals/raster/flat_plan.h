#pragma once

#include "sim/base/random_generator.h"
#include "visuals/raster/renderer.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/ground_texture.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace octant::visuals::raster {

/// A triangle at places of the picture, in pixels from its upper left corner.
struct FlatTriangle {
    std::array<glm::vec2, 3> at_px{};
    std::array<float, 3> depth_m{10.0F, 10.0F, 10.0F};
    std::array<std::uint32_t, 3> colour{0xffffffffU, 0xffffffffU, 0xffffffffU};
};

/// A plan that paints triangles of ground, in their order, before a black background. It owns what the plan's spans
/// point at: it stays where it is.
class FlatPlan {
public:
    explicit FlatPlan(const glm::ivec2& size_px);
    FlatPlan(const FlatPlan&) = delete;
    FlatPlan& operator=(const FlatPlan&) = delete;
    FlatPlan(FlatPlan&&) = delete;
    FlatPlan& operator=(FlatPlan&&) = delete;
    ~FlatPlan() = default;

    /// One step of these triangles.
    void paint(const std::vector<FlatTriangle>& triangles, scene::DepthUse depth = scene::DepthUse::None,
        std::uint32_t clip = scene::PaintStep::no_clip);

    scene::FramePlan& plan();

private:
    glm::ivec2 size_px_;
    scene::FramePlan plan_;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

/// A fine pattern of covers that differ much, for any alpha.
scene::DetailTexture strong_detail();

/// The plan's picture.
scene::Picture drawn(const scene::FramePlan& plan, const glm::ivec2& size_px, int samples, int threads = 1,
    const scene::GroundTexture* texture = nullptr);

/// A whole number 0 .. most - 1.
std::uint64_t below(RandomGenerator& dice, std::uint64_t most);

/// Red, green and blue of a pixel.
glm::ivec3 pixel(const scene::Picture& picture, int x, int y);

} // namespace octant::visuals::raster
