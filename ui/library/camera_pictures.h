#pragma once

#include "sim/aircraft_state.h"
#include "ui/library/drawing_lanes.h"
#include "visuals/camera/lens.h"
#include "visuals/camera/sensor.h"
#include "visuals/camera/shutter.h"

#include <cstddef>
#include <cstdint>
#include <octant/octant.h>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::library {

/// Which direction each pixel of a camera sees. Throws Error for more
/// coefficients than the distortion has.
visuals::camera::LensModel lens_model(const Camera& camera);

/// A picture of a camera.
struct CameraPicture {
    Pose pose;
    std::span<const sim::AircraftState> states;
    /// For the flow: empty = there was no previous picture.
    std::span<const sim::AircraftState> previous_states;
    std::uint64_t noise_seed = 0;
    std::uint64_t noise_index = 0; ///< number of the picture
    /// Draws the aircraft alone, as DrawingLane::plan_alone().
    bool is_alone = false;
    int bands = 0; ///< of a rolling shutter; 0 = as many as bands_of() says
};

/// Draws pictures of cameras that are more than a pinhole: with distortion, a
/// shutter, exposure, noise or 16 bits. May be used by several threads at once,
/// each with a lane of its own.
///
/// A rolling shutter's picture is made of bands, each with the poses of its own
/// time: the camera moves by its velocity and turn rate, aircraft by their
/// velocity. Their number is that of the pixels that anything moves in the
/// picture from the time of the first row to that of the last one, measured in
/// a picture without colours; rows and 128 are the most. Then no row's time
/// differs from its band's by more than half a pixel of motion. The previous
/// picture, for the flow, is moved by the same times.
class CameraPictures {
public:
    /// Throws Error for a camera that cannot be.
    explicit CameraPictures(const Camera& camera);

    /// Whether a camera is one pinhole picture as it is drawn, with 8 bits, which
    /// needs none of this.
    /// Throws Error for a camera that cannot be.
    static bool is_plain(const Camera& camera);

    /// Throws Error for a pose with a velocity or a turn rate that is not finite.
    static void check_motion(const Pose& pose);

    /// Whether all rows are seen at the pose's time, through a lens without distortion: where things lie in the picture
    /// is then as without shutter and sensor.
    bool shows_pose_by_pinhole() const { return lens_.is_pinhole() && shutter_.row_time_s == 0.0; }

    /// The bands of a picture's rows.
    int bands_of(DrawingLane& lane, const CameraPicture& picture) const;

    /// Draws a picture into arrays of one picture.
    void draw(DrawingLane& lane, const CameraPicture& picture, const FrameArrays& to) const;

private:
    struct Moment;
    struct Colours;

    void draw_colours(DrawingLane& lane, const visuals::camera::Face& face, const visuals::camera::Drawing& rows,
        Colours& colours) const;
    void draw_truth(DrawingLane& lane, const visuals::camera::Face& face, const visuals::camera::Drawing& rows,
        const FrameArrays& to) const;

    visuals::camera::Lens lens_;
    visuals::camera::Shutter shutter_;
    visuals::camera::Sensor sensor_;
    bool sums_light_ = false; ///< colours are not those that are drawn
    bool draws_deep_ = false;
};

} // namespace octant::ui::library
