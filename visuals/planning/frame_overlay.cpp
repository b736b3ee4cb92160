#include "visuals/planning/frame_overlay.h"

namespace octant::visuals::planning {

scene::OverlayDraw FrameOverlay::draw(
    const scene::OverlayDraw& transparents,
    const scene::Camera& camera,
    std::span<const sim::AircraftState> states,
    bool marks_path,
    std::span<const std::string> overlay_lines) {
    const glm::ivec2& size_px = settings_.view.size_px;
    layers_.clear();
    layers_.add(transparents);
    if (marks_path) {
        layers_.add(path_marks(camera, states.front().position_m));
    }
    if (settings_.view.kind == scene::View::Cockpit) {
        const overlay::InstrumentReadings inputs = shown_inputs(states.front());
        layers_.add(instruments_.draw(scene_.dials, inputs, camera, size_px));
        if (settings_.view.head_up_display) {
            layers_.add(head_up_display_.draw(inputs, camera, size_px));
        }
    }
    if (!overlay_lines.empty()) {
        layers_.add(text_.draw(overlay_lines, size_px));
    }
    return layers_.all();
}

/// The names of the legs of the first aircraft's path, where the legs begin.
scene::OverlayDraw
FrameOverlay::path_marks(const scene::Camera& camera, const glm::dvec3& aircraft_m) {
    marks_.begin(camera, settings_.view.size_px, aircraft_m - camera.eye_m);
    for (const DrawnPath::Leg& leg : scene_.path->legs) {
        marks_.add({scene_.path->points[leg.first_point].position_m - camera.eye_m, leg.name});
    }
    return marks_.finish();
}

overlay::InstrumentReadings FrameOverlay::shown_inputs(const sim::AircraftState& state) const {
    overlay::InstrumentReadings inputs{state, state.position_m.z, {}};
    if (const auto ground_m = scene_.ground->height_at(state.position_m.x, state.position_m.y)) {
        inputs.height_above_ground_m = state.position_m.z - *ground_m;
    }
    return inputs;
}

} // namespace octant::visuals::planning
