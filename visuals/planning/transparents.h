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
    /// In painting order, within a group of aircraft that is painted as one.
    enum class Place : std::uint8_t {
        Apart,     ///< has a box of its own: before the group where its middle is farther off, else last
        Behind,    ///< an effect, painted before its aircraft
        Glass,     ///< transparent surfaces of a refined aircraft, by depth; has no range
        InFront,   ///< an effect, painted after its aircraft
        CloudLayer ///< has no box: lies between what is above Transparents::cloud_height_m() and what is below
    };

    Place place = Place::Apart;
    /// The number of its aircraft; of its own box: of Transparents::boxes() after those of the aircraft.
    std::uint32_t box = 0;
    TransparentRange range;
};

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

/// All that one view sees through, as one list: a layer of clouds, the first aircraft's path as a ribbon of dashes,
/// effects around aircraft (discs of quick rotors, plumes, vapour) and glass. Keeps its memory.
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

    /// What holds the effects of each of Scene::aircraft at any strength, body axes; nothing where it has none.
    std::span<const std::optional<AxisAlignedBox>> effect_bounds() const;

    /// Makes the list of a frame, seen by the matrices and through the haze of its plan, which must stay until the next
    /// frame. `fleet`: as it is placed for the same frame.
    void make(const FrameView& view, const PlanRequest& request, const Fleet& fleet, const scene::FramePlan& plan);

    /// All of the frame, by ascending box.
    std::span<const Transparent> list() const;

    /// The boxes of what has a place apart from aircraft; none meets an aircraft.
    std::span<const OrientedBox> boxes() const;

    /// The triangles of all of them. Valid until the next frame.
    scene::OverlayDraw draw() const;

    /// The height of the clouds, which lie above all ground; nothing = there are none.
    std::optional<double> cloud_height_m() const;

    bool has_ribbon() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace octant::visuals::planning
