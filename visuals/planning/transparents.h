#pragma once

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "visuals/nature/daylight.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace octant::visuals::planning {

/// A range of the indices of Transparents::draw().
struct TransparentRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// One transparent thing of a frame and its place in the painting order.
struct Transparent {
    /// The enumerators have the painting order within a group of aircraft that is painted as one.
    enum class Place : std::uint8_t {
        Apart,     ///< Has a box of its own: before the group if the centre of that box is farther away, else last.
        Behind,    ///< An effect, painted before its aircraft.
        Glass,     ///< Transparent surfaces of an aircraft that is painted by depth; has no range.
        Disc,      ///< One of PlacedAircraft::discs, in their order; in painting order it comes between polygons.
        InFront,   ///< An effect, painted after its aircraft.
        CloudLayer ///< The layer of clouds at Transparents::cloud_height_m(); has no box.
    };

    Place place = Place::Apart;
    /// The number of its aircraft. With a box of its own: the number of aircraft plus the index in
    /// Transparents::boxes().
    std::uint32_t box = 0;
    TransparentRange range;
};

/// The strength of an aircraft's effects in one state, each 0..1.
struct EffectStrength {
    /// Of hot air behind the nozzles.
    double exhaust = 0.0;
    /// Of afterburners: above 0 where the motion needs more thrust than the engines have without them
    /// (sim::reheat_fraction).
    double burner = 0.0;
    /// Of vapour at the wingtips, which depends on the load factor.
    double vapour = 0.0;
};

/// `kind`: the aircraft's row in the table of kinds; null for an aircraft of unknown kind.
EffectStrength strength_of(const sim::AircraftKind* kind, const sim::AircraftState& state);

/// All transparent things of one view, as one list: a layer of clouds, the first aircraft's path as a ribbon of dashes,
/// discs of fast rotors and propellers, effects around aircraft (plumes and vapour, if the settings say so) and glass.
class Transparents {
public:
    /// The scene must outlive it. Loading work.
    Transparents(const Scene& scene, const scene::Settings& settings, const nature::Daylight& day);
    Transparents(const Transparents&) = delete;
    Transparents& operator=(const Transparents&) = delete;
    Transparents(Transparents&&) = delete;
    Transparents& operator=(Transparents&&) = delete;
    ~Transparents();

    /// Lights the clouds by another daylight.
    void set_daylight(const nature::Daylight& day);

    /// The bounds of the effects of each of Scene::aircraft at any strength, body axes; nothing for one without
    /// effects.
    std::span<const std::optional<AxisAlignedBox>> effect_bounds() const;

    /// Makes the list of a frame. `fleet` must be placed for this frame. `plan` gives the matrices, the light and the
    /// haze; it and `fleet` must stay until the next frame.
    void make(const FrameView& view, const PlanRequest& request, const Fleet& fleet, const scene::FramePlan& plan);

    /// The transparent things of the frame, by ascending `box`.
    std::span<const Transparent> list() const;

    /// The boxes of things with Place::Apart; none intersects the box of an aircraft.
    std::span<const OrientedBox> boxes() const;

    /// The triangles of the whole list. Valid until the next frame.
    scene::OverlayDraw draw() const;

    /// The triangles of the clouds; none = there are none.
    TransparentRange clouds() const;

    /// The height of the clouds, which lie above all ground; nothing = there are none.
    std::optional<double> cloud_height_m() const;

    bool has_ribbon() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace octant::visuals::planning
