#include "ui/library/conversions.h"

#include "models/surface_class.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "ui/settings/setting_rows.h"
#include "visuals/scene/camera.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace octant {

namespace library = ui::library;

namespace {

/// The truth writes the renderer's numbers, which the public header repeats: both have to name the same classes.
constexpr bool is_same_class(SurfaceClass shown, models::SurfaceClass drawn) {
    return static_cast<int>(shown) == static_cast<int>(drawn);
}

static_assert(is_same_class(SurfaceClass::Sky, models::SurfaceClass::Sky) &&
              is_same_class(SurfaceClass::Terrain, models::SurfaceClass::Terrain) &&
              is_same_class(SurfaceClass::Water, models::SurfaceClass::Water) &&
              is_same_class(SurfaceClass::Road, models::SurfaceClass::Road) &&
              is_same_class(SurfaceClass::Runway, models::SurfaceClass::Runway) &&
              is_same_class(SurfaceClass::Building, models::SurfaceClass::Building) &&
              is_same_class(SurfaceClass::Tree, models::SurfaceClass::Tree) &&
              is_same_class(SurfaceClass::Aircraft, models::SurfaceClass::Aircraft) &&
              is_same_class(SurfaceClass::Cloud, models::SurfaceClass::Cloud));

constexpr std::array<std::string_view, surface_class_count> surface_names{
    "sky", "terrain", "water", "road", "runway", "building", "tree", "aircraft", "cloud"};

constexpr int max_size_px = 8192;
constexpr double min_fov_deg = 0.01;
constexpr double max_fov_deg = 170.0;
constexpr double max_focal_px = 1e8;

/// Turns the axes of an OpenCV camera (right, down, ahead) into body axes.
const glm::dquat body_from_opencv(0.5, 0.5, 0.5, 0.5);

} // namespace

std::string_view name_of(SurfaceClass surface) {
    const auto number = static_cast<std::size_t>(surface);
    if (number >= surface_names.size()) {
        throw Error(fmt::format("surface: expected a class below {}, got {}", surface_names.size(), number));
    }
    return surface_names[number];
}

Quaternion attitude(double heading_deg, double pitch_deg, double bank_deg) {
    for (const double angle : {heading_deg, pitch_deg, bank_deg}) {
        if (!std::isfinite(angle)) { throw Error(fmt::format("attitude: expected finite angles, got {}", angle)); }
    }
    return library::quaternion_from(body_to_world_from_euler({.heading_rad = rad_from_deg(heading_deg),
        .pitch_rad = rad_from_deg(pitch_deg),
        .roll_rad = rad_from_deg(bank_deg)}));
}

Quaternion look_at(const Vec3& eye_m, const Vec3& target_m) {
    const glm::dvec3 eye = library::checked_vector("look_at: eye_m", eye_m);
    const glm::dvec3 target = library::checked_vector("look_at: target_m", target_m);
    if (eye == target) { throw Error("look_at: expected a target away from the eye, got the same point"); }
    const glm::dquat view_to_world = visuals::scene::camera_looking_at(eye, target).view_to_world;
    return library::quaternion_from(glm::normalize(view_to_world * glm::conjugate(visuals::scene::body_from_view())));
}

Quaternion to_opencv(const Quaternion& attitude) {
    return library::quaternion_from(library::checked_attitude("to_opencv", attitude) * body_from_opencv);
}

Quaternion to_opengl(const Quaternion& attitude) {
    return library::quaternion_from(
        library::checked_attitude("to_opengl", attitude) * visuals::scene::body_from_view());
}

Quaternion from_opencv(const Quaternion& camera_to_world) {
    return library::quaternion_from(
        library::checked_attitude("from_opencv", camera_to_world) * glm::conjugate(body_from_opencv));
}

Quaternion from_opengl(const Quaternion& camera_to_world) {
    return library::quaternion_from(
        library::checked_attitude("from_opengl", camera_to_world) * glm::conjugate(visuals::scene::body_from_view()));
}

Intrinsics Camera::matrix() const {
    library::check_camera(*this);
    if (intrinsics) { return *intrinsics; }
    const double focal_px = height / (2.0 * std::tan(0.5 * rad_from_deg(fov_deg)));
    return {focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)};
}

} // namespace octant

namespace octant::ui::library {

namespace scene = visuals::scene;

glm::dvec3 checked_vector(std::string_view what, const Vec3& value) {
    if (!std::isfinite(value.x) || !std::isfinite(value.y) || !std::isfinite(value.z)) {
        throw Error(fmt::format("{}: expected three finite numbers, got {}, {}, {}", what, value.x, value.y, value.z));
    }
    return {value.x, value.y, value.z};
}

glm::dvec3 checked_place(std::string_view what, const Vec3& value) {
    const glm::dvec3 place_m = checked_vector(what, value);
    if (std::max({std::abs(place_m.x), std::abs(place_m.y), std::abs(place_m.z)}) > settings::far_away_m) {
        throw Error(fmt::format("{}: expected at most {:.0f} m from the middle of the map, got {}, {}, {}", what,
            settings::far_away_m, value.x, value.y, value.z));
    }
    return place_m;
}

glm::dquat checked_attitude(std::string_view what, const Quaternion& value) {
    const glm::dquat turn(value.w, value.x, value.y, value.z);
    const double length = glm::length(turn);
    if (!std::isfinite(length) || length < 1e-100) {
        throw Error(fmt::format("{}: expected a quaternion w, x, y, z that is finite and not zero, got {}, {}, {}, {}",
            what, value.w, value.x, value.y, value.z));
    }
    return turn / length;
}

namespace {

void check_within(std::string_view what, double value, double min, double max) {
    if (!(value >= min && value <= max)) {
        throw Error(fmt::format("camera: {}: expected {} to {}, got {}", what, min, max, value));
    }
}

void check_intrinsics(const Camera& camera, const Intrinsics& matrix) {
    check_within("fx", matrix.fx, 1e-3, max_focal_px);
    check_within("fy", matrix.fy, 1e-3, max_focal_px);
    constexpr double far_off_px = 1e6;
    check_within("cx", matrix.cx, -far_off_px, far_off_px);
    check_within("cy", matrix.cy, -far_off_px, far_off_px);
    const double fov_deg = deg_from_rad(2.0 * std::atan(camera.height / (2.0 * matrix.fy)));
    if (camera.distortion == Distortion::None && fov_deg > max_fov_deg) {
        throw Error(
            fmt::format("camera: fy: expected a field of view up to {} degrees, got {:.1f}", max_fov_deg, fov_deg));
    }
}

} // namespace

void check_camera(const Camera& camera) {
    if (camera.width < 1 || camera.width > max_size_px || camera.height < 1 || camera.height > max_size_px) {
        throw Error(fmt::format("camera: expected a width and a height of 1 to {} pixels, got {} x {}", max_size_px,
            camera.width, camera.height));
    }
    if (camera.intrinsics) {
        check_intrinsics(camera, *camera.intrinsics);
    } else {
        check_within("fov_deg", camera.fov_deg, min_fov_deg, max_fov_deg);
    }
    if (std::ranges::find(settings::sample_counts, camera.samples) == settings::sample_counts.end()) {
        throw Error(fmt::format("camera: samples: expected 1, 4 or 16, got {}", camera.samples));
    }
    if (camera.bits != 8 && camera.bits != 16) {
        throw Error(fmt::format("camera: bits: expected 8 or 16, got {}", camera.bits));
    }
}

void set_lens(const Camera& camera, scene::Camera& made) {
    if (!camera.intrinsics) {
        made.vertical_fov_rad = rad_from_deg(camera.fov_deg);
        return;
    }
    const Intrinsics& matrix = *camera.intrinsics;
    made.vertical_fov_rad = 2.0 * std::atan(camera.height / (2.0 * matrix.fy));
    made.pixel_aspect = matrix.fy / matrix.fx;
    made.middle = {
        (0.5 * (camera.width - 1) - matrix.cx) / matrix.fx, (matrix.cy - 0.5 * (camera.height - 1)) / matrix.fy};
}

scene::Camera pinhole_camera(const Camera& camera, const Pose& pose) {
    scene::Camera made;
    set_lens(camera, made);
    made.eye_m = checked_place("pose: eye_m", pose.eye_m);
    made.view_to_world = checked_attitude("pose: attitude", pose.attitude) * scene::body_from_view();
    return made;
}

std::optional<scene::Camera> previous_camera(const Camera& camera, const Pose& pose) {
    if (!pose.previous_eye_m && !pose.previous_attitude) { return std::nullopt; }
    scene::Camera made;
    set_lens(camera, made);
    made.eye_m = checked_place("pose: previous_eye_m", pose.previous_eye_m.value_or(pose.eye_m));
    made.view_to_world = checked_attitude("pose: previous_attitude", pose.previous_attitude.value_or(pose.attitude)) *
                         scene::body_from_view();
    return made;
}

sim::AircraftState aircraft_state(const State& state) {
    sim::AircraftState made;
    if (!std::isfinite(state.time_s) || !std::isfinite(state.load_factor)) {
        throw Error(fmt::format(
            "state: expected a finite time_s and load_factor, got {} and {}", state.time_s, state.load_factor));
    }
    made.time_s = state.time_s;
    made.position_m = checked_place("state: position_m", state.position_m);
    made.velocity_mps = checked_vector("state: velocity_mps", state.velocity_mps);
    made.body_to_world = checked_attitude("state: attitude", state.attitude);
    made.load_factor = state.load_factor;
    made.is_present = state.is_present;
    return made;
}

State state_from(const sim::AircraftState& state) {
    return {.position_m = vec3_from(state.position_m),
        .attitude = quaternion_from(state.body_to_world),
        .is_present = state.is_present,
        .time_s = state.time_s,
        .velocity_mps = vec3_from(state.velocity_mps),
        .load_factor = state.load_factor};
}

} // namespace octant::ui::library
