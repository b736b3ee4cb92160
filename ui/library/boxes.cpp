// What a picture shows of each aircraft. Visible pixels are those of the truth; what an aircraft would show alone comes
// from a second picture of it, without anything else: for a pinhole in the same pixels, a window around its whole box,
// which may lie outside of the picture. With a distorted lens or a rolling shutter the second picture is the camera's,
// and what lies outside it is measured in a pinhole picture of the aircraft: each of its pixels counts by the area that
// the lens gives it.
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
#include <utility>

namespace octant::ui::library {

namespace camera = visuals::camera;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

/// What is nearer to the plane through the eye is cut off before it is projected.
constexpr double near_m = 0.05;
/// A window reaches at most so many pictures beyond the picture's edges.
constexpr int most_pictures_beyond = 2;
/// Larger windows are drawn with larger pixels.
constexpr int most_window_px = 2048;
/// Parts of an edge of a box, which a lens bends: the middle of a part is off by less than 1/1000 of its bend.
constexpr int parts_of_edge = 32;
/// The side of the picture in which what lies outside is measured, and of each of six where the aircraft is all around.
constexpr int measured_px = 128;
constexpr int measured_cube_px = 512;

constexpr std::array<std::array<std::size_t, 2>, 12> edges_of_box{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// The axes of lenses (right, down, ahead) from those of views (right, up, behind), and back.
glm::dvec3 turned_over(const glm::dvec3& v) { return {v.x, -v.y, -v.z}; }

/// Pinholes at an eye that together see a box all around.
std::vector<scene::Camera> measuring_cameras(const glm::dvec3& eye_m, const Box& box) {
    glm::dvec3 middle_m(0.0);
    for (const Vec3& corner : box.corners_m) { middle_m += glm::dvec3(corner.x, corner.y, corner.z) / 8.0; }
    const glm::dvec3 ahead = middle_m - eye_m;
    double least_cos = 1.0;
    for (const Vec3& corner : box.corners_m) {
        const glm::dvec3 at = glm::dvec3(corner.x, corner.y, corner.z) - eye_m;
        least_cos = std::min(least_cos, glm::dot(at, ahead) / (glm::length(at) * glm::length(ahead)));
    }
    constexpr double widest_cos = 0.5;
    if (least_cos > widest_cos) {
        scene::Camera one = scene::camera_looking_at(eye_m, middle_m);
        one.vertical_fov_rad = 2.02 * std::acos(least_cos) + 1e-6;
        return {one};
    }
    std::vector<scene::Camera> six;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 at(0.0);
            at[axis] = sign;
            six.push_back(scene::camera_looking_at(eye_m, eye_m + at));
            six.back().vertical_fov_rad = std::acos(0.0);
        }
    }
    return six;
}

} // namespace

BoxFinder::BoxFinder(
    const Camera& camera, std::span<const planning::AxisAlignedBox> bounds, const CameraPictures* pictures)
    : size_px_(camera.width, camera.height), matrix_(camera.matrix()),
      pictures_(pictures == nullptr || pictures->shows_pose_by_pinhole() ? nullptr : pictures),
      projector_(lens_model(camera)), bounds_(bounds), visible_(bounds.size()) {}

std::vector<Box> BoxFinder::boxes_in(const CameraPicture& picture, const PictureRequest& request, DrawingLane& lane) {
    find_visible(picture, request, lane);
    std::vector<Box> boxes;
    for (std::uint32_t id = 1; id <= bounds_.size(); ++id) {
        if (!request.states[id - 1].is_present) { continue; }
        std::optional<Box> box = projected(request, id, lane.earth_radius_m());
        if (!box) { continue; }
        const Box& seen = visible_[id - 1];
        const Alone alone =
            pictures_ == nullptr ? count_alone(request, *box, lane) : count_alone_by_lens(picture, request, *box, lane);
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
void BoxFinder::find_visible(const CameraPicture& picture, const PictureRequest& request, DrawingLane& lane) {
    shown_.resize(static_cast<std::size_t>(size_px_.x) * static_cast<std::size_t>(size_px_.y));
    if (pictures_ != nullptr) {
        CameraPicture whole = picture;
        bands_ = whole.bands = pictures_->bands_of(lane, picture);
        FrameArrays to;
        to.object_id = shown_.data();
        pictures_->draw(lane, whole, to);
    } else {
        lane.plan(request);
        lane.prepare_truth();
        scene::TruthArrays to;
        to.object_id = shown_.data();
        lane.draw_truth(to);
    }
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
    std::array<glm::dvec2, 2> ends_px{glm::dvec2(infinite), glm::dvec2(-infinite)};
    for (const auto& edge : edges_of_box) { add_edge(in_view_m[edge[0]], in_view_m[edge[1]], ends_px); }
    const auto& [min_px, max_px] = ends_px;
    if (min_px.x > max_px.x) { return std::nullopt; }
    box.whole_px[0] = min_px.x;
    box.whole_px[1] = min_px.y;
    box.whole_px[2] = max_px.x;
    box.whole_px[3] = max_px.y;
    return box;
}

/// Extends a rectangle of pixels (its least and greatest) by an edge of a box in view axes, as far as the lens shows
/// it.
void BoxFinder::add_edge(const glm::dvec3& from, const glm::dvec3& to, std::array<glm::dvec2, 2>& ends_px) const {
    const camera::Distortion distortion = projector_.lens().distortion;
    glm::dvec3 first = from;
    glm::dvec3 last = to;
    if (distortion != camera::Distortion::Fisheye) {
        if (-first.z < near_m && -last.z < near_m) { return; }
        if (-first.z < near_m) { std::swap(first, last); }
        if (-last.z < near_m) { last = glm::mix(first, last, (first.z + near_m) / (first.z - last.z)); }
    }
    const auto pixel_at = [&](double share) { return projector_.project(turned_over(glm::mix(first, last, share))); };
    const auto add = [&](const glm::dvec2& at_px) { // from the picture's corner, half a pixel from the first's middle
        ends_px = {glm::min(ends_px[0], at_px + 0.5), glm::max(ends_px[1], at_px + 0.5)};
    };
    const int parts = distortion == camera::Distortion::None ? 1 : parts_of_edge;
    std::optional<glm::dvec2> before;
    for (int i = 0; i <= parts; ++i) {
        const std::optional<glm::dvec2> at_px = pixel_at(static_cast<double>(i) / parts);
        if (at_px) { add(*at_px); }
        if (i > 0 && before.has_value() != at_px.has_value()) {
            double shown = static_cast<double>(before ? i - 1 : i) / parts;
            double hidden = static_cast<double>(before ? i : i - 1) / parts;
            for (int halving = 0; halving < 30; ++halving) {
                const double middle = 0.5 * (shown + hidden);
                (pixel_at(middle) ? shown : hidden) = middle;
            }
            add(*pixel_at(shown));
        }
        before = at_px;
    }
}

/// Fills in one_present_: the states, with one object alone.
void BoxFinder::only_present(std::span<const sim::AircraftState> states, std::uint32_t object_id) {
    one_present_.assign(states.begin(), states.end());
    for (std::size_t i = 0; i < one_present_.size(); ++i) { one_present_[i].is_present = i + 1 == object_id; }
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
    only_present(request.states, box.object_id);
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

BoxFinder::Alone BoxFinder::count_alone_by_lens(
    const CameraPicture& picture, const PictureRequest& request, const Box& box, DrawingLane& lane) {
    CameraPicture alone = picture;
    only_present(picture.states, box.object_id);
    alone.states = one_present_;
    alone.is_alone = true;
    alone.bands = bands_;
    window_.resize(shown_.size());
    FrameArrays to;
    to.object_id = window_.data();
    pictures_->draw(lane, alone, to);
    Alone count;
    count.inside_px = static_cast<double>(std::ranges::count(window_, box.object_id));
    count.all_px = count.inside_px;
    const bool is_inside = box.whole_px[0] >= 0.0 && box.whole_px[1] >= 0.0 && box.whole_px[2] <= size_px_.x &&
                           box.whole_px[3] <= size_px_.y;
    if (is_inside || count.inside_px == 0.0) { return count; }
    const std::vector<scene::Camera> cameras = measuring_cameras(request.camera.eye_m, box);
    const int side_px = cameras.size() == 1 ? measured_px : measured_cube_px;
    for (const scene::Camera& drawn : cameras) {
        lane.plan_alone({drawn, glm::ivec2(side_px), 1, one_present_});
        lane.prepare_truth();
        window_.resize(static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px));
        scene::TruthArrays truth;
        truth.object_id = window_.data();
        lane.draw_truth(truth);
        count.all_px += pixels_outside(drawn, request, side_px, [&](int column, int row) {
            return window_[static_cast<std::size_t>(row * side_px + column)] == box.object_id;
        });
    }
    return count;
}

/// The area, in pixels of the camera's picture and outside of it, of a mask in a square picture of a pinhole.
double BoxFinder::pixels_outside(
    const scene::Camera& drawn, const PictureRequest& request, int side_px, const IsInMask& is_in_mask) const {
    const glm::dquat to_view = glm::conjugate(request.camera.view_to_world) * drawn.view_to_world;
    const double pixel = 2.0 * std::tan(0.5 * drawn.vertical_fov_rad) / side_px;
    const auto shown_at = [&](int column, int row) {
        const glm::dvec3 ray((column - 0.5 * side_px) * pixel, (0.5 * side_px - row) * pixel, -1.0);
        return projector_.project(turned_over(to_view * ray));
    };
    const glm::dvec2 beyond(most_pictures_beyond * size_px_);
    const glm::dvec2 end(size_px_ * (1 + most_pictures_beyond));
    double area = 0.0;
    for (int row = 0; row < side_px; ++row) {
        for (int column = 0; column < side_px; ++column) {
            if (!is_in_mask(column, row)) { continue; }
            const std::array corners{shown_at(column, row), shown_at(column + 1, row), shown_at(column + 1, row + 1),
                shown_at(column, row + 1)};
            if (!std::ranges::all_of(corners, [](const auto& at) { return at.has_value(); })) { continue; }
            const glm::dvec2 middle = 0.25 * (*corners[0] + *corners[1] + *corners[2] + *corners[3]) + 0.5;
            const bool is_inside = glm::all(glm::greaterThanEqual(middle, glm::dvec2(0.0))) &&
                                   glm::all(glm::lessThan(middle, glm::dvec2(size_px_)));
            const bool is_too_far = glm::any(glm::lessThan(middle, -beyond)) || glm::any(glm::greaterThan(middle, end));
            if (is_inside || is_too_far) { continue; }
            const glm::dvec2 one = *corners[2] - *corners[0];
            const glm::dvec2 other = *corners[3] - *corners[1];
            area += 0.5 * std::abs(one.x * other.y - one.y * other.x);
        }
    }
    return area;
}

} // namespace octant::ui::library
