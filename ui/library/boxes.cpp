// What a picture shows of each aircraft. Visible pixels are those of the truth; what an aircraft would show alone comes
// from a second picture of it, without anything else, in the same pixels: a window around its whole box, which may lie
// outside of the picture.
#include "ui/library/boxes.h"

#include "ui/library/conversions.h"
#include "visuals/planning/fleet.h"
#include "visuals/scene/camera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace octant::ui::library {

namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

/// What is nearer to the plane through the eye is cut off before it is projected.
constexpr double near_m = 0.05;
/// A window reaches at most so many pictures beyond the picture's edges.
constexpr int most_pictures_beyond = 2;
/// Larger windows are drawn with larger pixels.
constexpr int most_window_px = 2048;

constexpr std::array<std::array<std::size_t, 2>, 12> edges_of_box{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

} // namespace

BoxFinder::BoxFinder(const Camera& camera, std::span<const planning::AxisAlignedBox> bounds)
    : size_px_(camera.width, camera.height), matrix_(camera.matrix()), bounds_(bounds), visible_(bounds.size()) {}

std::vector<Box> BoxFinder::boxes_in(const PictureRequest& request, DrawingLane& lane) {
    find_visible(request, lane);
    std::vector<Box> boxes;
    for (std::uint32_t id = 1; id <= bounds_.size(); ++id) {
        if (!request.states[id - 1].is_present) { continue; }
        std::optional<Box> box = projected(request, id, lane.earth_radius_m());
        if (!box) { continue; }
        const Box& seen = visible_[id - 1];
        const Alone alone = count_alone(request, *box, lane);
        if (seen.pixels == 0 && alone.inside_px <= 0.0) { continue; }
        std::ranges::copy(seen.visible_px, std::begin(box->visible_px));
        box->pixels = seen.pixels;
        const double all_px = std::max(alone.all_px, static_cast<double>(seen.pixels));
        box->visible_share = seen.pixels / all_px;
        box->truncation = std::clamp(1.0 - alone.inside_px / all_px, 0.0, 1.0);
        boxes.push_back(*box);
    }
    return boxes;
}

/// Draws the picture's object ids and fills in visible_.
void BoxFinder::find_visible(const PictureRequest& request, DrawingLane& lane) {
    shown_.resize(static_cast<std::size_t>(size_px_.x) * static_cast<std::size_t>(size_px_.y));
    lane.plan(request);
    lane.prepare_truth();
    scene::TruthArrays to;
    to.object_id = shown_.data();
    lane.draw_truth(to);
    for (Box& box : visible_) {
        box = {};
        box.visible_px[0] = size_px_.x;
        box.visible_px[1] = size_px_.y;
    }
    const std::uint32_t* id = shown_.data();
    for (int row = 0; row < size_px_.y; ++row) {
        for (int column = 0; column < size_px_.x; ++column, ++id) {
            if (*id == 0) { continue; }
            Box& box = visible_[*id - 1];
            box.visible_px[0] = std::min<double>(box.visible_px[0], column);
            box.visible_px[1] = std::min<double>(box.visible_px[1], row);
            box.visible_px[2] = std::max<double>(box.visible_px[2], column + 1);
            box.visible_px[3] = std::max<double>(box.visible_px[3], row + 1);
            ++box.pixels;
        }
    }
    for (Box& box : visible_) {
        if (box.pixels == 0) { box = {}; }
    }
}

/// The box of an object without what is visible of it; nothing where all of it is behind the eye.
std::optional<Box> BoxFinder::projected(
    const PictureRequest& request, std::uint32_t object_id, double earth_radius_m) const {
    const glm::dvec3& eye_m = request.camera.eye_m;
    const sim::AircraftState state = planning::sunk(request.states[object_id - 1], eye_m, earth_radius_m);
    const planning::AxisAlignedBox& bounds = bounds_[object_id - 1];
    const glm::dquat world_to_view = glm::conjugate(request.camera.view_to_world);
    Box box;
    box.object_id = object_id;
    std::array<glm::dvec3, 8> in_view_m;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3 in_body_m((corner & 1U) != 0 ? bounds.max_m.x : bounds.min_m.x,
            (corner & 2U) != 0 ? bounds.max_m.y : bounds.min_m.y, (corner & 4U) != 0 ? bounds.max_m.z : bounds.min_m.z);
        const glm::dvec3 at_m = state.position_m + state.body_to_world * in_body_m;
        box.corners_m[corner] = vec3_from(at_m);
        in_view_m[corner] = world_to_view * (at_m - eye_m);
    }
    const glm::dvec3 middle_m = state.position_m + state.body_to_world * (0.5 * (bounds.min_m + bounds.max_m));
    box.distance_m = glm::distance(middle_m, eye_m);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    glm::dvec2 min_px(infinite);
    glm::dvec2 max_px(-infinite);
    for (const auto& edge : edges_of_box) {
        glm::dvec3 from = in_view_m[edge[0]];
        glm::dvec3 to = in_view_m[edge[1]];
        if (-from.z < near_m && -to.z < near_m) { continue; }
        if (-from.z < near_m) { std::swap(from, to); }
        if (-to.z < near_m) { to = glm::mix(from, to, (from.z + near_m) / (from.z - to.z)); }
        for (const glm::dvec3& end : {from, to}) {
            // From the picture's upper left corner, half a pixel from the middle of the first one.
            const glm::dvec2 at_px(
                matrix_.cx + 0.5 - matrix_.fx * end.x / end.z, matrix_.cy + 0.5 + matrix_.fy * end.y / end.z);
            min_px = glm::min(min_px, at_px);
            max_px = glm::max(max_px, at_px);
        }
    }
    if (min_px.x > max_px.x) { return std::nullopt; }
    box.whole_px[0] = min_px.x;
    box.whole_px[1] = min_px.y;
    box.whole_px[2] = max_px.x;
    box.whole_px[3] = max_px.y;
    return box;
}

/// The pixels around the whole box, as far as they are counted.
BoxFinder::Window BoxFinder::window_of(const Box& box) const {
    const glm::dvec2 beyond(most_pictures_beyond * size_px_);
    const glm::dvec2 end(size_px_ * (1 + most_pictures_beyond));
    const glm::dvec2 min_px = glm::clamp(glm::dvec2(box.whole_px[0], box.whole_px[1]) - 1.0, -beyond, end);
    const glm::dvec2 max_px = glm::clamp(glm::dvec2(box.whole_px[2], box.whole_px[3]) + 1.0, -beyond, end);
    return {glm::ivec2(glm::floor(min_px)), glm::ivec2(glm::ceil(max_px))};
}

BoxFinder::Alone BoxFinder::count_alone(const PictureRequest& request, const Box& box, DrawingLane& lane) {
    const Window window = window_of(box);
    const glm::ivec2 window_px = window.max - window.min;
    if (window_px.x <= 0 || window_px.y <= 0) { return {}; }
    if (glm::any(glm::lessThanEqual(window.max, glm::ivec2(0))) ||
        glm::any(glm::greaterThanEqual(window.min, size_px_))) {
        return {}; // nothing of it is in the picture
    }
    const int pixel = (std::max(window_px.x, window_px.y) + most_window_px - 1) / most_window_px;
    const glm::ivec2 drawn_px = (window_px + pixel - 1) / pixel;
    PictureRequest alone = request;
    alone.previous.reset();
    alone.size_px = drawn_px;
    alone.samples = 1;
    Camera camera{drawn_px.x, drawn_px.y};
    // The middle of a pixel of the window is that of the pixels that it stands for.
    const double shift_px = 0.5 * (pixel - 1);
    camera.intrinsics = Intrinsics{matrix_.fx / pixel, matrix_.fy / pixel,
        (matrix_.cx - window.min.x - shift_px) / pixel, (matrix_.cy - window.min.y - shift_px) / pixel};
    set_lens(camera, alone.camera);
    one_present_.assign(request.states.begin(), request.states.end());
    for (std::size_t i = 0; i < one_present_.size(); ++i) { one_present_[i].is_present = i + 1 == box.object_id; }
    alone.states = one_present_;
    lane.plan_alone(alone);
    lane.prepare_truth();
    window_.resize(static_cast<std::size_t>(drawn_px.x) * static_cast<std::size_t>(drawn_px.y));
    scene::TruthArrays to;
    to.object_id = window_.data();
    lane.draw_truth(to);
    Alone count;
    const std::uint32_t* id = window_.data();
    for (int row = 0; row < drawn_px.y; ++row) {
        const int at_row = window.min.y + pixel * row;
        for (int column = 0; column < drawn_px.x; ++column, ++id) {
            if (*id != box.object_id) { continue; }
            const int at_column = window.min.x + pixel * column;
            const bool is_inside = at_row >= 0 && at_row < size_px_.y && at_column >= 0 && at_column < size_px_.x;
            count.all_px += pixel * pixel;
            count.inside_px += is_inside ? pixel * pixel : 0;
        }
    }
    return count;
}

} // namespace octant::ui::library
