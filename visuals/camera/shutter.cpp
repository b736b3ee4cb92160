#include "visuals/camera/shutter.h"

#include "visuals/camera/lens.h"
#include "visuals/camera/trigonometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::visuals::camera {

int band_count(int rows, double motion_px) {
    const double most = std::min(rows, max_bands);
    return static_cast<int>(std::clamp(std::ceil(motion_px), 1.0, most));
}

std::vector<Drawing> drawings_of(const Shutter& shutter, int rows, int bands) {
    const int frames = shutter.open_s == 0.0 ? 1 : shutter.blur_frames;
    std::vector<Drawing> drawings;
    for (int band = 0; band < bands; ++band) {
        Drawing drawing;
        drawing.first_row = rows * band / bands;
        drawing.end_row = rows * (band + 1) / bands;
        // From the middle of the picture to the middle of the band, in half rows.
        const int half_rows = drawing.first_row + drawing.end_row - rows;
        const double middle_s = 0.5 * half_rows * shutter.row_time_s;
        for (int frame = 0; frame < frames; ++frame) {
            // An even number of frames has none in the middle of the time.
            if (frames % 2 == 0 && frame == frames / 2) {
                drawings.push_back({middle_s, drawing.first_row, drawing.end_row, false, true});
            }
            const double share = static_cast<double>(2 * frame + 1 - frames) / (2 * frames);
            drawing.time_s = middle_s + share * shutter.open_s;
            drawing.is_truth = 2 * frame + 1 == frames;
            drawings.push_back(drawing);
        }
    }
    return drawings;
}

double turn_px(const Lens& lens, const glm::dvec3& turn_rad) {
    const LensModel& model = lens.model();
    // A small part of the turn, so that points stay in the picture; camera axes from body axes.
    const double whole = glm::length(turn_rad);
    if (whole == 0.0) { return 0.0; }
    const double part = std::min(1.0, 1e-3 / whole);
    const glm::dquat turn = rotation_by(glm::dvec3(turn_rad.y, turn_rad.z, turn_rad.x) * part);
    RayFinder finder(model);
    const PointProjector projector(model);
    double farthest = 0.0;
    constexpr int places = 8;
    for (int row = 0; row <= places; ++row) {
        for (int column = 0; column <= places; ++column) {
            const glm::dvec2 at = (glm::dvec2(model.size_px) - 1.0) * (glm::dvec2(column, row) / double{places});
            const auto ray = finder.ray(at);
            if (!ray) { continue; }
            const auto moved = projector.project(turn * *ray);
            if (moved) { farthest = std::max(farthest, glm::length(*moved - at) / part); }
        }
    }
    return farthest;
}

MovingPose MovingPose::after(double time_s) const {
    MovingPose pose = *this;
    pose.eye_m += velocity_mps * time_s;
    pose.body_to_world = body_to_world * rotation_by(turn_rate_radps * time_s);
    return pose;
}

} // namespace octant::visuals::camera
