#pragma once

#include "visuals/gl/picture.h"
#include "visuals/scene/settings.h"

#include <functional>
#include <string>

namespace octant::ui {

/// How two pictures of polygon numbers differ. A pixel is wrong when its number does not occur in
/// the 3 x 3 pixels of the reference around it; it differs when the one below it is another.
struct IdDifference {
    long pixels = 0;
    long differing = 0;
    long wrong = 0;
};

/// Compares two pictures of the same size (asserted).
IdDifference
difference_of(const visuals::gl::Picture& picture, const visuals::gl::Picture& reference);

/// Sums over the frames of a run.
struct IdComparison {
    IdDifference difference;
    int frames = 0;
    int frames_with_cuts = 0; ///< in which something stood in front of an aircraft
    long cuts = 0;
    long unordered = 0;
    int first_wrong_frame = -1; ///< -1: none
};

/// Draws every `every`th frame of a run as polygon numbers, with the settings' way of removing
/// hidden surfaces and with the depth buffer, and compares. Shadows are left out. `seen` is told
/// of each frame that was compared and of how many there are. Throws Error.
IdComparison compare_with_depth_buffer(
    const visuals::scene::Settings& settings,
    int every,
    const std::function<void(int compared, int frames)>& seen);

} // namespace octant::ui
