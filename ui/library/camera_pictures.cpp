#include "ui/library/camera_pictures.h"

#include "sim/base/error.h"
#include "sim/base/units.h"
#include "ui/library/conversions.h"
#include "visuals/planning/frame_view.h"
#include "visuals/scene/camera.h"
#include "visuals/scene/truth.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant {

void Camera::check() const {
    ui::library::check_camera(*this);
    ui::library::CameraPictures::is_plain(*this);
}

std::optional<std::pair<double, double>> Camera::project(const Vec3& point_m) const {
    const glm::dvec3 point = ui::library::checked_vector("project: point_m", point_m);
    const auto at_px = ui::library::lens_model(*this).project(point);
    if (!at_px) { return std::nullopt; }
    return std::pair(at_px->x, at_px->y);
}

Vec3 Camera::ray(double column, double row) const {
    if (!std::isfinite(column) || !std::isfinite(row)) {
        throw Error(fmt::format("ray: expected a finite column and row, got {}, {}", column, row));
    }
    const visuals::camera::LensModel lens = ui::library::lens_model(*this);
    const auto ray = lens.ray({column, row});
    if (!ray) {
        const glm::dvec2 from_centre = glm::dvec2(column, row) - lens.centre_px;
        throw Error(fmt::format("ray: expected a pixel up to {:.1f} pixels from "
                                "the centre, where the distortion folds, "
                                "got one at {:.1f}",
            glm::length(from_centre) * lens.reach_towards({column, row}), glm::length(from_centre)));
    }
    return ui::library::vec3_from(*ray);
}

} // namespace octant

namespace octant::ui::library {

namespace camera = visuals::camera;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

using States = std::vector<sim::AircraftState>;

void check_between(std::string_view what, double value, double min, double max) {
    if (!(value >= min && value <= max)) {
        throw Error(fmt::format("camera: {}: expected {} to {}, got {}", what, min, max, value));
    }
}

camera::Shutter shutter_of(const Camera& from) {
    constexpr double longest_s = 60.0;
    constexpr int most_frames = 256;
    check_between("shutter_s", from.shutter_s, 0.0, longest_s);
    check_between("blur_frames", from.blur_frames, 1, most_frames);
    check_between("row_time_s", from.row_time_s, -1.0, 1.0);
    return {.open_s = from.shutter_s, .blur_frames = from.blur_frames, .row_time_s = from.row_time_s};
}

camera::Sensor sensor_of(const Camera& from) {
    constexpr double brightest = 1e6;
    check_between("exposure", from.exposure, 0.0, brightest);
    check_between("noise", from.noise, 0.0, 1.0);
    return {.exposure = from.exposure, .noise = from.noise};
}

/// States at another time: on the tangents of their paths.
void move_states(std::span<const sim::AircraftState> states, double by_s, States& moved) {
    moved.assign(states.begin(), states.end());
    for (sim::AircraftState& state : moved) {
        state.position_m += state.velocity_mps * by_s;
        state.time_s += by_s;
    }
}

camera::MovingPose pose_of(const Pose& pose) {
    const glm::dvec3 turn_rate_degps = checked_vector("pose: turn_rate_degps", pose.turn_rate_degps);
    return {.eye_m = checked_place("pose: eye_m", pose.eye_m),
        .body_to_world = checked_attitude("pose: attitude", pose.attitude),
        .velocity_mps = checked_vector("pose: velocity_mps", pose.velocity_mps),
        .turn_rate_radps = turn_rate_degps * rad_from_deg(1.0)};
}

/// The pose of the previous picture, which moves alike.
std::optional<camera::MovingPose> previous_pose_of(const Pose& pose) {
    if (!pose.previous_eye_m && !pose.previous_attitude) { return std::nullopt; }
    camera::MovingPose previous = pose_of(pose);
    if (pose.previous_eye_m) { previous.eye_m = checked_place("pose: previous_eye_m", *pose.previous_eye_m); }
    if (pose.previous_attitude) {
        previous.body_to_world = checked_attitude("pose: previous_attitude", *pose.previous_attitude);
    }
    return previous;
}

scene::Camera camera_at(const camera::Face& face, const camera::MovingPose& pose) {
    return face.at(pose.eye_m, pose.body_to_world * scene::body_from_view());
}

bool wants_truth(const FrameArrays& to) {
    return to.depth_m != nullptr || to.class_id != nullptr || to.object_id != nullptr || to.normal != nullptr ||
           to.flow_px != nullptr || to.coverage != nullptr;
}

/// The arrays from a pixel on.
scene::TruthArrays from_pixel(const FrameArrays& to, std::size_t pixel) {
    const auto at = [&](auto* array, std::size_t values) { return array == nullptr ? array : array + values * pixel; };
    return {.depth_m = at(to.depth_m, 1),
        .class_id = at(to.class_id, 1),
        .object_id = at(to.object_id, 1),
        .normal = at(to.normal, 3),
        .flow_px = at(to.flow_px, 2),
        .coverage = at(to.coverage, 1)};
}

/// The truth of places of a face.
struct PlaceTruth {
    std::vector<float> depth_m;
    std::vector<std::uint8_t> class_id;
    std::vector<std::uint32_t> object_id;
    std::vector<float> normal;
    std::vector<float> previous_px;
    std::vector<float> coverage;

    /// Arrays for what `to` wants, but coverage.
    scene::TruthArrays arrays(const FrameArrays& to, std::size_t places) {
        scene::TruthArrays truth;
        const auto make = [&](bool is_wanted, auto& array, std::size_t values, auto*& at) {
            if (!is_wanted) { return; }
            array.resize(values * places);
            at = array.data();
        };
        make(to.depth_m != nullptr, depth_m, 1, truth.depth_m);
        make(to.class_id != nullptr || to.coverage != nullptr, class_id, 1, truth.class_id);
        make(to.object_id != nullptr || to.coverage != nullptr, object_id, 1, truth.object_id);
        make(to.normal != nullptr, normal, 3, truth.normal);
        make(to.flow_px != nullptr, previous_px, 2, truth.previous_px);
        return truth;
    }
};

/// The share of each pixel that shows the class and the object of its middle:
/// the mean over the places of its colour.
void write_coverage(DrawingLane& lane, std::span<const camera::FootPrint> prints, std::span<const std::uint32_t> pixels,
    const PlaceTruth& middles, float* coverage) {
    std::vector<glm::vec2> places_px;
    std::vector<std::size_t> end;
    for (const camera::FootPrint& print : prints) {
        camera::add_filter_places(print, places_px);
        end.push_back(places_px.size());
    }
    PlaceTruth around;
    around.coverage.resize(places_px.size());
    FrameArrays wanted;
    wanted.coverage = around.coverage.data();
    scene::TruthArrays truth = around.arrays(wanted, places_px.size());
    truth.coverage = around.coverage.data();
    lane.draw_truth(truth, places_px);
    std::size_t place = 0;
    for (std::size_t i = 0; i < prints.size(); ++i) {
        const auto count = static_cast<float>(end[i] - place);
        float sum = 0.0F;
        for (; place < end[i]; ++place) {
            const bool is_same =
                around.class_id[place] == middles.class_id[i] && around.object_id[place] == middles.object_id[i];
            sum += is_same ? around.coverage[place] : 0.0F;
        }
        coverage[pixels[i]] = sum / count;
    }
}

/// The places of the pixels of whole rows in their own picture.
std::vector<glm::vec2> own_places(const glm::ivec2& size_px, int first_row, int end_row) {
    std::vector<glm::vec2> places_px;
    for (int row = first_row; row < end_row; ++row) {
        for (int column = 0; column < size_px.x; ++column) { places_px.emplace_back(column, row); }
    }
    return places_px;
}

} // namespace

camera::LensModel lens_model(const Camera& from) {
    check_camera(from);
    const Intrinsics matrix = from.matrix();
    camera::LensModel lens;
    lens.size_px = {from.width, from.height};
    lens.focal_px = {matrix.fx, matrix.fy};
    lens.centre_px = {matrix.cx, matrix.cy};
    std::size_t most = 0;
    if (from.distortion == Distortion::BrownConrady) {
        lens.distortion = camera::Distortion::BrownConrady;
        most = 5;
    } else if (from.distortion == Distortion::Fisheye) {
        lens.distortion = camera::Distortion::Fisheye;
        most = 4;
    }
    if (from.coefficients.size() > most) {
        throw Error(fmt::format("camera: coefficients: expected at most {}, as many as the distortion has, got {}",
            most, from.coefficients.size()));
    }
    for (const double coefficient : from.coefficients) {
        constexpr double greatest = 1e6;
        check_between("coefficients", coefficient, -greatest, greatest);
    }
    std::ranges::copy(from.coefficients, lens.coefficients.begin());
    return lens;
}

/// When a picture is made of a face: poses and states.
struct CameraPictures::Moment {
    camera::MovingPose pose;
    std::optional<camera::MovingPose> previous_pose;
    States states;
    States previous_states;

    /// At that time after the pose of the picture.
    Moment(const CameraPicture& picture, double by_s) : pose(pose_of(picture.pose).after(by_s)) {
        move_states(picture.states, by_s, states);
        if (const auto previous = previous_pose_of(picture.pose); previous && !picture.previous_states.empty()) {
            previous_pose = previous->after(by_s);
        }
        move_states(picture.previous_states, by_s, previous_states);
    }

    PictureRequest request(const camera::Face& face) const {
        PictureRequest wanted{camera_at(face, pose), face.size_px, face.samples, states};
        if (previous_pose) {
            wanted.previous = planning::PreviousFrame{camera_at(face, *previous_pose), previous_states};
        }
        return wanted;
    }
};

/// A picture's colours, or the sums of its light.
struct CameraPictures::Colours {
    std::vector<std::uint16_t> colours;
    std::vector<float> sums;
    std::vector<std::uint16_t> whole; ///< a face's picture, of which some rows or pixels are taken
};

CameraPictures::CameraPictures(const Camera& from)
    : lens_(lens_model(from), from.samples), shutter_(shutter_of(from)), sensor_(sensor_of(from)),
      sums_light_(
          sensor_.exposure != 1.0 || sensor_.noise != 0.0 || (shutter_.open_s > 0.0 && shutter_.blur_frames > 1)),
      draws_deep_(from.bits == 16 || sums_light_) {}

bool CameraPictures::is_plain(const Camera& from) {
    lens_model(from);
    const camera::Shutter shutter = shutter_of(from);
    const camera::Sensor sensor = sensor_of(from);
    return from.distortion == Distortion::None && from.bits == 8 && shutter.is_instant() && sensor.exposure == 1.0 &&
           sensor.noise == 0.0;
}

void CameraPictures::check_motion(const Pose& pose) { pose_of(pose); }

/// Measured by the flow of all that is seen at the middle of the time, from a
/// half of it before.
int CameraPictures::bands_of(DrawingLane& lane, const CameraPicture& picture) const {
    const int rows = lens_.model().size_px.y;
    if (shutter_.row_time_s == 0.0 || rows == 1) { return 1; }
    const double half_s = 0.5 * std::abs(shutter_.row_time_s) * (rows - 1);
    const Moment now(picture, 0.0);
    const Moment before(picture, -half_s);
    double farthest_px = 2.0 * camera::turn_px(lens_, now.pose.turn_rate_radps * half_s);
    for (const camera::Face& face : lens_.faces()) {
        PictureRequest request{camera_at(face, now.pose), face.size_px, 1, now.states};
        request.previous = planning::PreviousFrame{camera_at(face, before.pose), before.states};
        lane.plan(request);
        lane.prepare_truth();
        std::vector<glm::vec2> places_px;
        for (const camera::FootPrint& print : face.foot_prints) { places_px.push_back(print.at_px); }
        const std::size_t count =
            lens_.is_pinhole() ? static_cast<std::size_t>(face.size_px.x * face.size_px.y) : places_px.size();
        std::vector<glm::vec2> motion_px(count);
        scene::TruthArrays truth;
        (lens_.is_pinhole() ? truth.flow_px : truth.previous_px) = &motion_px.front().x;
        lane.draw_truth(truth, places_px);
        for (std::size_t i = 0; i < count; ++i) {
            if (!lens_.is_pinhole()) { motion_px[i] = lens_.flow(face, face.pixels[i], motion_px[i]); }
            const double way_px = 2.0 * glm::length(glm::dvec2(motion_px[i]));
            if (way_px > farthest_px) { farthest_px = way_px; } // not for NaN
        }
    }
    return camera::band_count(rows, farthest_px);
}

void CameraPictures::draw_colours(
    DrawingLane& lane, const camera::Face& face, const camera::Drawing& rows, Colours& colours) const {
    if (!draws_deep_) {
        lens_.resample(face, lane.draw(), rows.first_row, rows.end_row, colours.colours);
        return;
    }
    if (lens_.is_pinhole() && rows.end_row - rows.first_row == face.size_px.y) {
        lane.draw_deep(colours.colours);
        return;
    }
    colours.whole.resize(3 * static_cast<std::size_t>(face.size_px.x) * static_cast<std::size_t>(face.size_px.y));
    lane.draw_deep(colours.whole);
    lens_.resample(face, colours.whole, rows.first_row, rows.end_row, colours.colours);
}

void CameraPictures::draw_truth(
    DrawingLane& lane, const camera::Face& face, const camera::Drawing& rows, const FrameArrays& to) const {
    if (lens_.is_pinhole()) {
        const glm::ivec2 size_px = face.size_px;
        const scene::TruthArrays truth =
            from_pixel(to, static_cast<std::size_t>(rows.first_row) * static_cast<std::size_t>(size_px.x));
        if (rows.end_row - rows.first_row == size_px.y) {
            lane.draw_truth(truth);
        } else {
            lane.draw_truth(truth, own_places(size_px, rows.first_row, rows.end_row));
        }
        return;
    }
    const auto prints = face.foot_prints_of(rows.first_row, rows.end_row);
    const auto pixels = face.pixels_of(rows.first_row, rows.end_row);
    std::vector<glm::vec2> places_px;
    places_px.reserve(prints.size());
    for (const camera::FootPrint& print : prints) { places_px.push_back(print.at_px); }
    PlaceTruth found;
    lane.draw_truth(found.arrays(to, prints.size()), places_px);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::size_t pixel = pixels[i];
        if (to.depth_m != nullptr) {
            const double scale = lens_.depth_scale(face, places_px[i]);
            to.depth_m[pixel] = static_cast<float>(found.depth_m[i] * scale);
        }
        if (to.class_id != nullptr) { to.class_id[pixel] = found.class_id[i]; }
        if (to.object_id != nullptr) { to.object_id[pixel] = found.object_id[i]; }
        if (to.normal != nullptr) {
            std::copy_n(found.normal.begin() + 3 * static_cast<std::ptrdiff_t>(i), 3, to.normal + 3 * pixel);
        }
        if (to.flow_px != nullptr) {
            const glm::vec2 flow =
                lens_.flow(face, pixels[i], {found.previous_px[2 * i], found.previous_px[2 * i + 1]});
            to.flow_px[2 * pixel] = flow.x;
            to.flow_px[2 * pixel + 1] = flow.y;
        }
    }
    if (to.coverage != nullptr) { write_coverage(lane, prints, pixels, found, to.coverage); }
}

void CameraPictures::draw(DrawingLane& lane, const CameraPicture& picture, const FrameArrays& to) const {
    const glm::ivec2 size_px = lens_.model().size_px;
    const auto row_values = 3 * static_cast<std::size_t>(size_px.x);
    const bool wants_colours = to.rgb != nullptr || to.rgb16 != nullptr;
    Colours colours;
    if (wants_colours) { colours.colours.resize(row_values * static_cast<std::size_t>(size_px.y)); }
    if (wants_colours && sums_light_) { colours.sums.resize(colours.colours.size()); }
    int drawn_frames = 0; // of the first rows
    const int bands = picture.bands > 0 ? picture.bands : bands_of(lane, picture);
    for (const camera::Drawing& rows : camera::drawings_of(shutter_, size_px.y, bands)) {
        const bool draws_colours = wants_colours && rows.adds_light;
        const bool draws_truth = rows.is_truth && wants_truth(to);
        if (!draws_colours && !draws_truth) { continue; }
        const Moment moment(picture, rows.time_s);
        for (const camera::Face& face : lens_.faces()) {
            if (!lens_.is_pinhole() && face.pixels_of(rows.first_row, rows.end_row).empty()) { continue; }
            if (picture.is_alone) {
                lane.plan_alone(moment.request(face));
            } else {
                lane.plan(moment.request(face));
            }
            if (draws_colours) {
                draw_colours(lane, face, rows, colours);
            } else {
                lane.prepare_truth();
            }
            if (draws_truth) { draw_truth(lane, face, rows, to); }
        }
        if (draws_colours && sums_light_) {
            const std::size_t first = row_values * static_cast<std::size_t>(rows.first_row);
            const std::size_t count = row_values * static_cast<std::size_t>(rows.end_row - rows.first_row);
            camera::add_light(
                std::span(colours.colours).subspan(first, count), std::span(colours.sums).subspan(first, count));
        }
        drawn_frames += draws_colours && rows.first_row == 0 ? 1 : 0;
    }
    if (!wants_colours) { return; }
    if (sums_light_) {
        sensor_.develop(colours.sums, drawn_frames, {picture.noise_seed, picture.noise_index}, colours.colours);
    }
    if (to.rgb16 != nullptr) { std::ranges::copy(colours.colours, to.rgb16); }
    if (to.rgb != nullptr) { camera::to_bytes(colours.colours, {to.rgb, colours.colours.size()}); }
}

} // namespace octant::ui::library
