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

/// One aircraft among which smooth polygons are distributed.
struct SmoothCandidate {
    int polygons = 0;
    /// Its share of the picture, at least 0.
    double weight = 0.0;
};

/// Distributes `smooth` smooth polygons among aircraft in proportion to their weights, to none more than it has. The
/// numbers are written to `assigned`; their sum is `smooth`, or all polygons if these are fewer.
void distribute_smooth(std::span<const SmoothCandidate> aircraft, int smooth, std::span<int> assigned);

/// Chooses in each frame which polygons of which aircraft, and which triangles of refined meshes, are smooth. The
/// choice depends on that of the frame before, so that shading does not flicker.
class SmoothChoice {
public:
    /// Sets ViewedAircraft::first_smooth. `follows_clock`: the share of smooth polygons may change in each frame.
    /// Loading work.
    SmoothChoice(const scene::ShadingSettings& settings, bool follows_clock, std::span<PlacedAircraft> placed);

    /// RefinedDraw::first_smooth of all refined meshes.
    std::uint32_t refined_word_index() const { return static_cast<std::uint32_t>(bits_.size() - 1); }

    /// AircraftDraw::first_smooth of the turning parts of models with a refined mesh.
    std::uint32_t turning_word_index() const { return static_cast<std::uint32_t>(bits_.size() - 2); }

    /// How many polygons could be smooth, and how many are.
    struct Count {
        int polygons = 0;
        int smooth = 0;
    };

    /// Writes FramePlan::smooth of the placed aircraft to `smooth` and shades refined meshes (`refined`: one for each
    /// aircraft, null without). The count has all polygons of models, drawn or not, and the present triangles of
    /// refined meshes. `to_sun`: unit vector, world axes. `light`: the ambient share and that of the sun.
    Count choose(std::span<const PlacedAircraft> placed, std::span<const std::unique_ptr<RefinedAircraft>> refined,
        const SmoothTarget& smooth_target, const glm::dvec3& to_sun, const glm::vec2& light,
        std::vector<std::uint32_t>& smooth);

    /// Forgets the choices of earlier frames for polygons; those for refined meshes are theirs.
    void forget_frames() {
        for (Selectors& selectors : selectors_) {
            for (shading::ShadingSelector& selector : selectors) { selector.forget_choices(); }
        }
    }

private:
    /// Of one aircraft: for each level, for its polygons, and for those of its far model; empty where all polygons are
    /// smooth or all are flat.
    using Selectors = std::vector<shading::ShadingSelector>;

    int smooth_count_for(std::span<const PlacedAircraft> placed, const SmoothTarget& smooth_target);
    shading::ShadingSelector& selector_of(std::size_t aircraft, const PlacedAircraft& placed);
    void write_bits(const PlacedAircraft& aircraft, const shading::ShadingChoice& choice);

    scene::ShadingSettings settings_;
    /// Whether some polygons may be smooth while others are flat.
    bool selects_;
    std::vector<Selectors> selectors_;
    std::vector<std::uint32_t> bits_;
    std::vector<SmoothCandidate> shares_;
    std::vector<int> assigned_;
};

} // namespace octant::visuals::planning
