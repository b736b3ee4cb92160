#pragma once

#include "visuals/planning/frame_view.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/refined_aircraft.h"
#include "visuals/scene/settings.h"
#include "visuals/shading/shading_rule.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// Polygons of one aircraft, and how much of the picture it takes.
struct SmoothCandidate {
    int polygons = 0;
    /// At least 0.
    double weight = 0.0;
};

/// Shares `smooth` smooth polygons out among aircraft, by weight, none getting more than it has; in all as many as
/// asked for, or all. `assigned`: one an aircraft.
void distribute_smooth(std::span<const SmoothCandidate> aircraft, int smooth, std::span<int> assigned);

/// Chooses in each frame which polygons of which aircraft are lit smoothly, triangles of meshes that are refined
/// included. Keeps the choice, so that shading does not flicker, and its memory.
class SmoothChoice {
public:
    /// Gives each aircraft its place in FramePlan::smooth. `follows_clock`: the share of smooth polygons may be another
    /// one in each frame. Loading work.
    SmoothChoice(const scene::ShadingSettings& settings, bool follows_clock, std::span<PlacedAircraft> placed);

    /// RefinedDraw::first_smooth of all that is refined.
    std::uint32_t refined_word_index() const { return static_cast<std::uint32_t>(bits_.size() - 1); }

    /// AircraftDraw::first_smooth of parts that turn beside what is refined.
    std::uint32_t turning_word_index() const { return static_cast<std::uint32_t>(bits_.size() - 2); }

    /// Of how many polygons, and how many of them.
    struct Count {
        int polygons = 0;
        int smooth = 0;
    };

    /// Fills in the bits of the aircraft as they are placed and shades what is refined (`refined`: one an aircraft,
    /// some null); counts all polygons of models, painted or not, and the triangles that refined meshes have now.
    /// `to_sun`: unit vector, world axes. `light`: share of it from everywhere and from the sun.
    Count choose(std::span<const PlacedAircraft> placed, std::span<const std::unique_ptr<RefinedAircraft>> refined,
        const SmoothTarget& smooth_target, const glm::dvec3& to_sun, const glm::vec2& light,
        std::vector<std::uint32_t>& smooth);

private:
    /// Of one aircraft: its levels, then its polygons, then those of what stands in for it; empty where all polygons
    /// are alike.
    using Selectors = std::vector<shading::ShadingSelector>;

    int smooth_count_for(std::span<const PlacedAircraft> placed, const SmoothTarget& smooth_target);
    shading::ShadingSelector& selector_of(std::size_t aircraft, const PlacedAircraft& placed);
    void write_bits(const PlacedAircraft& aircraft, const shading::ShadingChoice& choice);

    scene::ShadingSettings settings_;
    /// Whether some polygons may be smooth while others are not.
    bool selects_;
    std::vector<Selectors> selectors_;
    std::vector<std::uint32_t> bits_;
    std::vector<SmoothCandidate> shares_;
    std::vector<int> assigned_;
};

} // namespace octant::visuals::planning
