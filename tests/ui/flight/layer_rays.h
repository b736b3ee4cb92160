#pragma once

#include "visuals/scene/frame_plan.h"
#include "visuals/scene/picture.h"

#include <span>
#include <string>
#include <vector>

namespace octant::tests {

/// Counts of pixels of a picture that differ from what rays see.
struct LayerCheck {
    int pixels = 0;  ///< that were compared: all rays about them meet the same surfaces
    int layered = 0; ///< of these, with something transparent in front of something that differs
    int deepest = 0; ///< the most transparent surfaces in one of them
    int wrong = 0;
    std::vector<std::string> first_wrong; ///< place, colour, and the layers' colours and opacities, the nearest first

    LayerCheck& operator+=(const LayerCheck& more);
};

/// Makes a plan of aircraft alone, each triangle in one colour without light and haze before a black background.
void keep_only_aircraft(visuals::scene::FramePlan& plan);

/// Compares a picture of such a plan with rays: every triangle of the plan that faces the eye, in double precision,
/// sorted by distance along each ray and blended from the farthest opaque one to the eye. Of surfaces in one place the
/// order is left to the picture. Uses neither the plan's order nor its use of depth.
LayerCheck check_layers(const visuals::scene::FramePlan& plan, std::span<const visuals::scene::ModelBuffers> models,
    const visuals::scene::Picture& picture);

} // namespace octant::tests
