#pragma once

#include "ui/library/camera_pictures.h"
#include "ui/library/drawing_lanes.h"
#include "visuals/camera/lens_model.h"
#include "visuals/planning/bounding_box.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <octant/octant.h>
#include <optional>
#include <span>
#include <vector>

namespace octant::ui::library {

/// Finds the boxes of the objects of pictures of one camera. For one thread; keeps its memory.
class BoxFinder {
public:
    /// `camera` has been checked; `bounds`: of each object in body axes. `pictures` draws the camera's pictures; null
    /// for one that is a pinhole and nothing else.
    BoxFinder(const Camera& camera, std::span<const visuals::planning::AxisAlignedBox> bounds,
        const CameraPictures* pictures);

    /// The boxes in a picture, by ascending object id: of the objects that it shows, and of those that it would show
    /// if nothing were in front of them. `picture` and `request` are the same picture, by the camera and by a pinhole.
    std::vector<Box> boxes_in(const CameraPicture& picture, const PictureRequest& request, DrawingLane& lane);

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

    /// Asked for each pixel of a mask: column and row.
    using IsInMask = std::function<bool(int, int)>;

    void find_visible(const CameraPicture& picture, const PictureRequest& request, DrawingLane& lane);
    std::optional<Box> projected(const PictureRequest& request, std::uint32_t object_id, double earth_radius_m) const;
    void add_edge(const glm::dvec3& from, const glm::dvec3& to, std::array<glm::dvec2, 2>& ends_px) const;
    void only_present(std::span<const sim::AircraftState> states, std::uint32_t object_id);
    Window window_of(const Box& box) const;
    Alone count_alone(const PictureRequest& request, const Box& box, DrawingLane& lane);
    Alone count_alone_by_lens(
        const CameraPicture& picture, const PictureRequest& request, const Box& box, DrawingLane& lane);
    double pixels_outside(const visuals::scene::Camera& drawn, const PictureRequest& request, int side_px,
        const IsInMask& is_in_mask) const;

    glm::ivec2 size_px_;
    Intrinsics matrix_;
    const CameraPictures* pictures_; ///< null where a pinhole picture at the pose is the same
    int bands_ = 0;                  ///< of the picture's rows
    visuals::camera::PointProjector projector_;
    std::span<const visuals::planning::AxisAlignedBox> bounds_;
    std::vector<Box> visible_;          ///< one for each object: visible_px and pixels
    std::vector<std::uint32_t> shown_;  ///< object ids of the picture
    std::vector<std::uint32_t> window_; ///< and of a window
    std::vector<sim::AircraftState> one_present_;
};

} // namespace octant::ui::library
