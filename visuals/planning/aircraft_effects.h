#pragma once

#include "models/colour_vertex.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "visuals/planning/placed_aircraft.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/transparent_geometry.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// How much of an aircraft's effects is seen in a state, each 0..1.
struct EffectStrength {
    /// Hot air behind the nozzles.
    double exhaust = 0.0;
    /// Afterburners: the motion needs more thrust than there is without them (sim::reheat_fraction).
    double burner = 0.0;
    /// Vapour at the wingtips, under load.
    double vapour = 0.0;
};

/// `kind`: the row of the aircraft; null for one of which only the shape is known.
EffectStrength strength_of(const sim::AircraftKind* kind, const sim::AircraftState& state);

/// What is seen through around an aircraft: discs of quick rotors and propellers, plumes behind nozzles, vapour behind
/// wingtips. Each lies on one side of a plane that has all the rest of the aircraft on its other side, so that it is
/// painted after the aircraft for eyes on its own side and before it for all others. A rotor without such a plane has
/// no disc.
class AircraftEffects {
public:
    /// Of a model in body axes: its pivots that turn fast, its parts named as nozzles and burners, and the ends of its
    /// span, of models with a nozzle.
    explicit AircraftEffects(const models::polygons::PolygonModel& model);

    bool empty() const { return effects_.empty(); }

    /// Corners of a box in body axes that holds them all, at any strength.
    const AxisAlignedBox& extent() const { return extent_; }

    struct TransparentRanges {
        /// What is painted before the aircraft, and what after it.
        TransparentRange before;
        TransparentRange after;
    };

    /// Adds what is seen to a frame's veils. A rotor that somebody else moves, as `articulated_parts` says of the
    /// scene's aircraft `number`, has no disc.
    TransparentRanges add(const glm::dmat4& body_to_eye_world, const EffectStrength& strength,
        std::span<const ArticulatedPart> articulated_parts, std::uint32_t number, TransparentGeometry& transparents);

private:
    enum class Kind : std::uint8_t { Disc, Plume, Vapour };

    /// `outward` is the unit vector from the plane through `position_m` to the effect's side.
    struct Effect {
        Kind kind = Kind::Disc;
        glm::dvec3 position_m{0.0};
        glm::dvec3 outward{0.0, 0.0, -1.0};
        double radius_m = 1.0;
        /// The pivot whose blades a disc shows.
        std::uint32_t pivot = models::invalid_index;
    };

    void find_discs(const models::polygons::PolygonModel& model);
    void find_plumes(const models::polygons::PolygonModel& model);
    void find_vapour(const models::polygons::PolygonModel& model);
    void add_effect(const Effect& effect, const glm::dvec3& reach_m);

    std::vector<Effect> effects_;
    AxisAlignedBox extent_;
    /// The corners and triangles of one effect in the frame at hand.
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

} // namespace octant::visuals::planning
