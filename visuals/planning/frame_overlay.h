#pragma once

#include "visuals/overlay/head_up_display.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/overlay/overlay_layers.h"
#include "visuals/overlay/path_annotations.h"
#include "visuals/overlay/picture_text.h"
#include "visuals/planning/fleet.h"
#include "visuals/planning/scene.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/scene/settings.h"

#include <span>
#include <string>

namespace octant::visuals::planning {

/// What lies over the picture of one view: marks of the path's legs, dials, the head-up display and
/// lines of text. Keeps its memory.
class FrameOverlay {
public:
    /// The scene and the settings must outlive it.
    FrameOverlay(const Scene& scene, const scene::Settings& settings)
        : scene_(scene)
        , settings_(settings) {}

    /// The overlay of a frame, `transparents` first; valid until the next call. `marks_path`: legs of the
    /// first aircraft's path are named, which must be known.
    scene::OverlayDraw draw(
        const scene::OverlayDraw& transparents,
        const scene::Camera& camera,
        std::span<const sim::AircraftState> states,
        bool marks_path,
        std::span<const std::string> overlay_lines);

private:
    scene::OverlayDraw path_marks(const scene::Camera& camera, const glm::dvec3& aircraft_m);
    overlay::InstrumentReadings shown_inputs(const sim::AircraftState& state) const;

    const Scene& scene_;
    const scene::Settings& settings_;
    overlay::InstrumentPanel instruments_;
    overlay::HeadUpDisplay head_up_display_;
    overlay::PathAnnotations marks_;
    overlay::PictureText text_;
    overlay::OverlayLayers layers_;
};

} // namespace octant::visuals::planning
