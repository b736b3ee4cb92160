#pragma once

#include "sim/base/random_generator.h"
#include "visuals/raster/renderer.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace octant::visuals::raster {

/// A triangle at places of the picture, in pixels from its upper left corner.
struct FlatTriangle {
    std::array<glm::vec2, 3> at_px{};
    std::array<float, 3> depth_m{10.0F, 10.0F, 10.0F};
    std::array<std::uint32_t, 3> colour{0xffffffffU, 0xffffffffU, 0xffffffffU};
};

/// A rectangle of ground from the picture's upper left corner on, cut into cells of two triangles each. Its inverse
/// depth, 1/m, is a function of the place in pixels.
std::vector<FlatTriangle> sheet(const glm::ivec2& size_px, const glm::ivec2& cell_px,
    const std::function<double(const glm::dvec2&)>& inverse_depth, std::uint32_t colour = 0xffffffffU);

/// Appends a square that faces +z to a model, two triangles.
void add_square(scene::ModelBuffers& model, float half_m, float z_m, std::uint32_t colour);

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
    const scene::GroundTexture* texture = nullptr, std::span<const scene::ModelBuffers> models = {});

/// A whole number 0 .. most - 1.
std::uint64_t below(RandomGenerator& dice, std::uint64_t most);

/// Red, green and blue of a pixel.
glm::ivec3 pixel(const scene::Picture& picture, int x, int y);

/// How many pixels have a colour.
int count_of(const scene::Picture& picture, const glm::ivec3& colour);

} // namespace octant::visuals::raster
