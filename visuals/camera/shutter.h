#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace octant::visuals::camera {

class Lens;

/// When the rows of a picture see. The pose of a camera is that at the middle of the time in which the row in the
/// middle of the picture is exposed (of an even number of rows, between the two in the middle).
struct Shutter {
    double open_s = 0.0;     ///< how long each row is exposed
    int blur_frames = 1;     ///< pictures whose mean, in linear light, is the picture of that time
    double row_time_s = 0.0; ///< from one row to the next one below; negative: from below

    bool is_instant() const { return (open_s == 0.0 || blur_frames == 1) && row_time_s == 0.0; }
};

/// A picture that is drawn for some rows of a camera's picture.
struct Drawing {
    double time_s = 0.0; ///< after the pose
    int first_row = 0;
    int end_row = 0;
    bool adds_light = true;
    bool is_truth = false; ///< at the middle of the rows' exposure
};

/// Most bands of rows that a rolling shutter is made of.
inline constexpr int max_bands = 128;

/// The bands of rows, each seen at one time, in which no row's time differs from its band's by more than half a pixel
/// of motion: as many as the picture's fastest motion in the time from its first row to its last one has pixels, but
/// not more than its rows nor than max_bands.
int band_count(int rows, double motion_px);

/// What is drawn for a picture, from above, for each band first what is earlier.
std::vector<Drawing> drawings_of(const Shutter& shutter, int rows, int bands);

/// How far the farthest things move in the picture, at most, pixels, while the camera turns by that much about its body
/// axes (x forward, y right, z down), radians.
double turn_px(const Lens& lens, const glm::dvec3& turn_rad);

/// A pose that moves: that after `time_s`.
struct MovingPose {
    glm::dvec3 eye_m{0.0};
    glm::dquat body_to_world{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 velocity_mps{0.0};    ///< world axes
    glm::dvec3 turn_rate_radps{0.0}; ///< about body axes

    MovingPose after(double time_s) const;
};

} // namespace octant::visuals::camera
