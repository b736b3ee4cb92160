#pragma once

#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"
#include "visuals/scene/renderer.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace octant::ui::studies::draw_order {

/// A copy of a plan whose picture, of `size_px` pixels, lies `by_px` further right and down, and
/// has nothing drawn over it.
visuals::scene::FramePlan
shifted_plan(const visuals::scene::FramePlan& plan, const glm::dvec2& by_px, const glm::ivec2& size_px);

/// A picture of 8 x 8 samples a pixel: drawn eight times as large in both directions, in 64 parts,
/// so that textures are filtered for the small pixels, too. The sum of all 64, red, green and blue
/// of each pixel, rows from the top. For plans that use no depth.
class Supersampled {
public:
    static constexpr int side = 8;
    static constexpr int samples_per_pixel = side * side;

    /// `renderer` draws one sample a pixel at pictures of that size.
    void draw(
        visuals::scene::Renderer& renderer,
        const visuals::scene::FramePlan& plan,
        const glm::dvec2& by_px,
        const glm::ivec2& size_px);

    /// A part of a pixel's colour in levels; `part` counts on from three for each pixel.
    double level(std::size_t part) const { return static_cast<double>(sums_[part]) / samples_per_pixel; }

    std::size_t parts() const { return sums_.size(); }

private:
    std::vector<std::uint16_t> sums_;
    visuals::scene::Picture picture_;
};

} // namespace octant::ui::studies::draw_order
