#pragma once

#include "models/colour_vertex.h"
#include "visuals/nature/cloud_layer.h"
#include "visuals/nature/daylight.h"
#include "visuals/planning/aircraft_effects.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/drawn_path.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/frame_view.h"
#include "visuals/planning/scene.h"
#include "visuals/planning/transparent_geometry.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// What a ribbon is made by.
struct RibbonView {
    glm::dvec3 eye_m{0.0};
    /// What is far sinks by this radius; 0 = the earth is flat.
    double earth_radius_m = 0.0;
    /// What has been flown by then is stronger.
    double time_s = 0.0;
    double half_width_m = 3.0;
    /// The way before and behind the aircraft that is not covered.
    double gap_m = 15.0;
};

/// A path as a ribbon along the wings, in dashes of about equal times with gaps between them, so that each has a place
/// of its own in the painting order. Legs have two colours in turn. Keeps its memory.
class PathRibbon {
public:
    /// The path must outlive the ribbon.
    explicit PathRibbon(const DrawnPath& path);

    struct Dash {
        /// Holds the dash; the eye is at the origin.
        OrientedBox box;
        TransparentRange range;
    };

    /// The dashes of a frame, added to its veils. Valid until the next call.
    std::span<const Dash> dashes(const RibbonView& view, TransparentGeometry& transparents);

private:
    /// Where the aircraft is: past `point`, before the next one.
    struct AircraftPoint {
        /// The time as a number of points.
        double fractional_point;
        /// The last point that it has passed.
        std::size_t point;
        glm::dvec3 place_m;
    };

    AircraftPoint aircraft_point(double time_s) const;
    void add_dash(std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& transparents);
    void add_ribbon_section(
        std::size_t first, std::size_t last, const RibbonView& view, TransparentGeometry& transparents);

    const DrawnPath& path_;
    std::size_t points_per_dash_ = 1;
    std::vector<Dash> dashes_;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

/// All that one view sees through: clouds, the ribbon of the first aircraft's path, effects around aircraft. Each has
/// its range of the frame's veils, so that it can be blended at its place in the painting order. Keeps its memory.
class FrameTransparents {
public:
    /// The scene must outlive it. Loading work.
    FrameTransparents(const Scene& scene, const scene::Settings& settings, const nature::Daylight& day);

    /// Lights the clouds by another daylight.
    void set_daylight(const nature::Daylight& day);

    /// The effects of Scene::aircraft; none at all where the settings want none.
    std::span<const AircraftEffects> effects() const { return effects_; }

    /// Makes the veils of a frame, seen by the matrices and through the haze of its plan, which must stay until the
    /// next frame. `fleet`: as it is placed for the same frame.
    void make(const FrameView& view, const PlanRequest& request, const Fleet& fleet, const scene::FramePlan& plan);

    /// All of them together; valid until the next frame.
    scene::OverlayDraw draw() const { return transparents_.draw(); }

    /// The height of the clouds, which lie above all ground; nothing = there are none.
    std::optional<double> cloud_height_m() const { return clouds_ ? std::optional(cloud_height_m_) : std::nullopt; }

    const TransparentRange& clouds() const { return cloud_range_; }

    /// The effects of one aircraft; empty ranges where it shows none.
    AircraftEffects::TransparentRanges effects_of(std::uint32_t aircraft) const {
        return aircraft < effect_ranges_.size() ? effect_ranges_[aircraft] : AircraftEffects::TransparentRanges();
    }

    bool has_ribbon() const { return ribbon_.has_value(); }

    /// The dashes of the ribbon that meet no aircraft.
    std::span<const PathRibbon::Dash> dashes() const { return dashes_; }

private:
    void add_effects(const FrameView& view, const PlanRequest& request, const Fleet& fleet);
    void add_ribbon(const FrameView& view, double time_s, std::span<const OrientedBox> bounding_boxes);

    const Scene& scene_;
    TransparentGeometry transparents_;
    std::optional<nature::CloudLayer> clouds_;
    double cloud_height_m_ = 0.0;
    TransparentRange cloud_range_;
    std::optional<PathRibbon> ribbon_;
    std::vector<PathRibbon::Dash> dashes_;
    std::vector<AircraftEffects> effects_;
    std::vector<AircraftEffects::TransparentRanges> effect_ranges_;
};

} // namespace octant::visuals::planning
