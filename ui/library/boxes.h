#pragma once

#include "ui/library/drawing_lanes.h"
#include "visuals/planning/bounding_box.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <octant/octant.h>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::library {

/// Finds the boxes of the objects of pictures of one camera. For one thread; keeps its memory.
class BoxFinder {
public:
    /// `camera` has been checked; `bounds`: of each object in body axes.
    BoxFinder(const Camera& camera, std::span<const visuals::planning::AxisAlignedBox> bounds);

    /// The boxes in a picture, by ascending object id: of the objects that it shows, and of those that it would show
    /// if nothing were in front of them.
    std::vector<Box> boxes_in(const PictureRequest& request, DrawingLane& lane);

private:
    /// A rectangle of whole pixels; right and bottom are exclusive.
    struct Window {
        glm::ivec2 min{0};
        glm::ivec2 max{0};
    };

    /// How many pixels an object fills that nothing hides: within the picture, and in all.
    struct Alone {
        double inside_px = 0.0;
        double all_px = 0.0;
    };

    void find_visible(const PictureRequest& request, DrawingLane& lane);
    std::optional<Box> projected(const PictureRequest& request, std::uint32_t object_id, double earth_radius_m) const;
    Window window_of(const Box& box) const;
    Alone count_alone(const PictureRequest& request, const Box& box, DrawingLane& lane);

    glm::ivec2 size_px_;
    Intrinsics matrix_;
    std::span<const visuals::planning::AxisAlignedBox> bounds_;
    std::vector<Box> visible_;          ///< one for each object: visible_px and pixels
    std::vector<std::uint32_t> shown_;  ///< object ids of the picture
    std::vector<std::uint32_t> window_; ///< and of a window
    std::vector<sim::AircraftState> one_present_;
};

} // namespace octant::ui::library
