#include "ui/dataset/camera_rigs.h"

#include "flightpaths/toml_fields.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace octant::ui::dataset {

namespace {

constexpr double far_m = 1e6;

/// A span of numbers that a key of a mount sets.
struct SpanKey {
    std::string_view name;
    NumberSpan CameraRig::*member;
    NumberSpan bounds;
    NumberSpan value; ///< where the key is missing
};

/// What a mount is called, and its keys besides those that all have.
struct MountKeys {
    std::string_view name;
    Mount mount;
    std::vector<SpanKey> spans;
    bool looks_at_aircraft = true;
};

const std::vector<MountKeys>& mount_table() {
    static const SpanKey heading{"heading", &CameraRig::heading_deg, {-360.0, 360.0}, {}};
    static const SpanKey pitch{"pitch", &CameraRig::pitch_deg, {-90.0, 90.0}, {}};
    static const SpanKey bank{"bank", &CameraRig::bank_deg, {-180.0, 180.0}, {}};
    static const SpanKey distance{"distance", &CameraRig::distance_m, {1.0, far_m}, {40.0, 40.0}};
    static const SpanKey azimuth{"azimuth", &CameraRig::azimuth_deg, {-360.0, 360.0}, {}};
    static const SpanKey elevation{"elevation", &CameraRig::elevation_deg, {-89.0, 89.0}, {10.0, 10.0}};
    static const auto with = [](SpanKey key, double low, double high) {
        key.value = {low, high};
        return key;
    };
    static const std::vector<MountKeys> table{{"aircraft", Mount::Aircraft, {heading, pitch, bank}, false},
        {"chase", Mount::Chase, {distance, azimuth, elevation}}, {"ring", Mount::Chase, {distance, azimuth, elevation}},
        {"orbit", Mount::Orbit, {distance, with(azimuth, 0.0, 360.0), elevation}},
        {"random", Mount::Random, {with(distance, 30.0, 300.0), with(elevation, -30.0, 60.0)}},
        {"ground", Mount::Ground,
            {with(heading, 0.0, 360.0), with(pitch, -30.0, 5.0), bank,
                {"height", &CameraRig::height_m, {min_eye_height_m, 1e5}, {30.0, 300.0}}},
            false}};
    return table;
}

/// The keys of one [[camera]] table.
class RigReader {
public:
    RigReader(const std::filesystem::path& file, const toml::table& table) : file_(file), table_(table) {}

    std::vector<CameraRig> rigs(const octant::Camera& defaults, std::size_t number);

private:
    [[noreturn]] void refuse(const toml::node& node, const std::string& what) const {
        throw_error_at(file_, flightpaths::line_of(node), what);
    }

    const toml::node* take(std::string_view key) {
        taken_.insert(std::string(key));
        return table_.get(key);
    }

    double number_from(const toml::node& node, std::string_view key, const NumberSpan& bounds) const;
    std::optional<double> number(std::string_view key, const NumberSpan& bounds);
    std::optional<int> whole(std::string_view key, int low, int high);
    std::optional<std::string> text(std::string_view key);
    std::optional<std::vector<double>> numbers(
        std::string_view key, std::size_t least, std::size_t most, const NumberSpan& bounds);
    void read_span(const SpanKey& key, CameraRig& rig);
    void read_lens(octant::Camera& camera);
    void read_sensor(octant::Camera& camera);
    const MountKeys& mount();
    void finish() const;

    const std::filesystem::path& file_;
    const toml::table& table_;
    std::set<std::string, std::less<>> taken_;
};

std::string_view kind_of(const toml::node& node) {
    return node.is_string() ? "a text" : node.is_array() ? "a list" : node.is_table() ? "a table" : "another value";
}

double RigReader::number_from(const toml::node& node, std::string_view key, const NumberSpan& bounds) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || *value < bounds.low || *value > bounds.high) {
        refuse(node, fmt::format("{}: expected a number from {} to {}, got {}", key, bounds.low, bounds.high,
                         value ? fmt::format("{}", *value) : std::string(kind_of(node))));
    }
    return *value;
}

std::optional<double> RigReader::number(std::string_view key, const NumberSpan& bounds) {
    const toml::node* const node = take(key);
    return node == nullptr ? std::nullopt : std::optional(number_from(*node, key, bounds));
}

std::optional<int> RigReader::whole(std::string_view key, int low, int high) {
    const toml::node* const node = take(key);
    if (node == nullptr) { return std::nullopt; }
    const std::optional<std::int64_t> value = node->value_exact<std::int64_t>();
    if (!value || *value < low || *value > high) {
        refuse(*node, fmt::format("{}: expected a whole number from {} to {}, got {}", key, low, high,
                          value ? fmt::format("{}", *value) : std::string(kind_of(*node))));
    }
    return static_cast<int>(*value);
}

std::optional<std::string> RigReader::text(std::string_view key) {
    const toml::node* const node = take(key);
    if (node == nullptr) { return std::nullopt; }
    const auto value = node->value_exact<std::string>();
    if (!value) { refuse(*node, fmt::format("{}: expected a text, got {}", key, kind_of(*node))); }
    return value;
}

std::optional<std::vector<double>> RigReader::numbers(
    std::string_view key, std::size_t least, std::size_t most, const NumberSpan& bounds) {
    const toml::node* const node = take(key);
    if (node == nullptr) { return std::nullopt; }
    const toml::array* const list = node->as_array();
    if (list == nullptr || list->size() < least || list->size() > most) {
        refuse(*node, fmt::format("{}: expected a list of {} numbers, got {}", key,
                          least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most),
                          list == nullptr ? std::string(kind_of(*node)) : fmt::format("{}", list->size())));
    }
    std::vector<double> values;
    for (const toml::node& each : *list) { values.push_back(number_from(each, key, bounds)); }
    return values;
}

/// A number, or two from which each sample draws one.
void RigReader::read_span(const SpanKey& key, CameraRig& rig) {
    NumberSpan& span = rig.*key.member;
    span = key.value;
    const toml::node* const node = take(key.name);
    if (node == nullptr) { return; }
    if (!node->is_array()) {
        span.low = number_from(*node, key.name, key.bounds);
        span.high = span.low;
        return;
    }
    const auto ends = numbers(key.name, 2, 2, key.bounds);
    if ((*ends)[0] > (*ends)[1]) {
        refuse(*node, fmt::format("{}: expected the low end first, got [{}, {}]", key.name, (*ends)[0], (*ends)[1]));
    }
    span = {(*ends)[0], (*ends)[1]};
}

void RigReader::read_lens(octant::Camera& camera) {
    if (const auto size = text("size")) {
        const std::size_t cross = size->find('x');
        const auto width = whole_number(std::string_view(*size).substr(0, cross));
        const auto height =
            cross == std::string::npos ? std::nullopt : whole_number(std::string_view(*size).substr(cross + 1));
        if (!width || !height || *width < 1 || *height < 1 || *width > 8192 || *height > 8192) {
            refuse(*table_.get("size"),
                fmt::format("size: expected WIDTHxHEIGHT of 1 to 8192 pixels, got {}", in_quotes(*size)));
        }
        camera.width = static_cast<int>(*width);
        camera.height = static_cast<int>(*height);
    }
    const auto fov = number("fov", {1.0, 170.0});
    const auto matrix = numbers("matrix", 4, 4, {-far_m, far_m});
    if (fov && matrix) { refuse(*table_.get("matrix"), "expected fov or matrix, got both"); }
    camera.fov_deg = fov.value_or(camera.fov_deg);
    if (matrix) {
        if ((*matrix)[0] <= 0.0 || (*matrix)[1] <= 0.0) {
            refuse(*table_.get("matrix"), fmt::format("matrix: expected fx, fy, cx, cy in pixels with fx and fy above "
                                                      "0, got {}, {}",
                                              (*matrix)[0], (*matrix)[1]));
        }
        camera.intrinsics = octant::Intrinsics{(*matrix)[0], (*matrix)[1], (*matrix)[2], (*matrix)[3]};
    }
    constexpr std::array<std::string_view, 3> models{"none", "brown-conrady", "fisheye"};
    if (const auto model = text("distortion")) {
        const auto found = std::ranges::find(models, *model);
        if (found == models.end()) {
            refuse(*table_.get("distortion"),
                fmt::format("distortion: expected {}, got {}", fmt::join(models, ", "), in_quotes(*model)));
        }
        camera.distortion = static_cast<octant::Distortion>(found - models.begin());
    }
    const std::size_t most = camera.distortion == octant::Distortion::BrownConrady ? 5 : 4;
    if (const auto coefficients = numbers("coefficients", 1, most, {-1e3, 1e3})) {
        if (camera.distortion == octant::Distortion::None) {
            refuse(*table_.get("coefficients"), "expected distortion beside coefficients, got none");
        }
        camera.coefficients = *coefficients;
    }
}

void RigReader::read_sensor(octant::Camera& camera) {
    const auto one_of = [&](std::string_view key, std::span<const int> values, int& value) {
        const auto given = whole(key, values.front(), values.back());
        if (given && std::ranges::find(values, *given) == values.end()) {
            refuse(*table_.get(key), fmt::format("{}: expected {}, got {}", key, fmt::join(values, ", "), *given));
        }
        value = given.value_or(value);
    };
    constexpr std::array samples{1, 4, 16};
    constexpr std::array bits{8, 16};
    one_of("samples", samples, camera.samples);
    one_of("bits", bits, camera.bits);
    camera.exposure = number("exposure", {1e-6, 1e6}).value_or(camera.exposure);
    camera.noise = number("noise", {0.0, 1.0}).value_or(camera.noise);
    camera.shutter_s = number("shutter", {0.0, 10.0}).value_or(camera.shutter_s);
    camera.blur_frames = whole("blur-frames", 1, 256).value_or(camera.blur_frames);
    camera.row_time_s = number("row-time", {0.0, 1.0}).value_or(camera.row_time_s);
}

const MountKeys& RigReader::mount() {
    const std::vector<MountKeys>& table = mount_table();
    const std::optional<std::string> name = text("mount");
    if (!name) { throw_error_at(file_, flightpaths::line_of(table_), "expected a mount of the camera, got none"); }
    const auto found = std::ranges::find(table, *name, &MountKeys::name);
    if (found == table.end()) {
        std::vector<std::string_view> names;
        for (const MountKeys& each : table) { names.push_back(each.name); }
        refuse(
            *table_.get("mount"), fmt::format("mount: expected {}, got {}", fmt::join(names, ", "), in_quotes(*name)));
    }
    return *found;
}

void RigReader::finish() const {
    for (const auto& [key, node] : table_) {
        if (!taken_.contains(key.str())) {
            refuse(node, fmt::format("expected a key of a {} camera ({}), got {}",
                             table_["mount"].value_or(std::string()), fmt::join(taken_, ", "), in_quotes(key.str())));
        }
    }
}

std::vector<CameraRig> RigReader::rigs(const octant::Camera& defaults, std::size_t number_in_file) {
    CameraRig rig;
    rig.camera = defaults;
    rig.name = text("name").value_or(fmt::format("camera-{}", number_in_file + 1));
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    if (rig.name.empty() || rig.name.find_first_not_of(letters) != std::string::npos) {
        refuse(
            *table_.get("name"), fmt::format("name: expected letters, digits, - and _, got {}", in_quotes(rig.name)));
    }
    const MountKeys& kind = mount();
    rig.mount = kind.mount;
    for (const SpanKey& key : kind.spans) { read_span(key, rig); }
    if (rig.mount != Mount::Ground) { rig.aircraft = whole("aircraft", 1, 1000).value_or(1); }
    if (kind.looks_at_aircraft) { rig.aim = number("aim", {0.0, 1.0}).value_or(0.0); }
    if (rig.mount == Mount::Aircraft) {
        if (const auto at = numbers("at", 3, 3, {-far_m, far_m})) { rig.at_m = {(*at)[0], (*at)[1], (*at)[2]}; }
    }
    read_lens(rig.camera);
    read_sensor(rig.camera);
    if (kind.name != "ring") {
        finish();
        return {rig};
    }
    const int count = whole("count", 1, 1000).value_or(4);
    finish();
    std::vector<CameraRig> ring;
    for (int i = 0; i < count; ++i) {
        ring.push_back(rig);
        ring.back().name = fmt::format("{}-{}", rig.name, i + 1);
        const double turn_deg = 360.0 * i / count;
        ring.back().azimuth_deg.low += turn_deg;
        ring.back().azimuth_deg.high += turn_deg;
    }
    return ring;
}

} // namespace

std::vector<CameraRig> read_camera_rigs(
    const std::filesystem::path& file, const octant::Camera& defaults, std::string* text) {
    const std::string read = read_text_file(file);
    const toml::table root = flightpaths::parse_toml(file, read);
    if (text != nullptr) { *text = read; }
    for (const auto& [key, node] : root) {
        if (key.str() != "camera" || !node.is_array_of_tables()) {
            throw_error_at(file, flightpaths::line_of(node),
                fmt::format("expected [[camera]] tables, got {}", in_quotes(key.str())));
        }
    }
    const toml::array* const tables = root["camera"].as_array();
    if (tables == nullptr || tables->empty()) { throw_error_at(file, 1, "expected [[camera]] tables, got none"); }
    std::vector<CameraRig> rigs;
    std::set<std::string> names;
    for (std::size_t i = 0; i < tables->size(); ++i) {
        const toml::table& table = *tables->get(i)->as_table();
        for (CameraRig& rig : RigReader(file, table).rigs(defaults, i)) {
            if (!names.insert(rig.name).second) {
                throw_error_at(file, flightpaths::line_of(table),
                    fmt::format("expected a name for each camera, got '{}' again", rig.name));
            }
            rigs.push_back(std::move(rig));
        }
    }
    return rigs;
}

CameraRig default_rig(const octant::Camera& camera) {
    CameraRig rig;
    rig.name = "chase";
    rig.camera = camera;
    rig.distance_m = {30.0, 120.0};
    rig.azimuth_deg = {-180.0, 180.0};
    rig.elevation_deg = {-10.0, 40.0};
    rig.aim = 0.5;
    return rig;
}

namespace {

/// What one sample draws for a rig; the same for its previous picture.
struct Draws {
    glm::dvec2 place{0.0}; ///< of the map, -1 .. 1
    double heading_rad = 0.0;
    double pitch_rad = 0.0;
    double bank_rad = 0.0;
    double distance_m = 0.0;
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;
    double height_m = 0.0;
    glm::dvec2 aim{0.0}; ///< right and up of the picture's middle, tangents
};

double drawn(RandomGenerator& random, const NumberSpan& span) { return random.between(span.low, span.high); }

double drawn_rad(RandomGenerator& random, const NumberSpan& span) { return glm::radians(drawn(random, span)); }

/// All numbers are drawn, whatever the mount needs, so that a changed key changes nothing else.
Draws draws_of(const CameraRig& rig, const SampleKey& key) {
    RandomGenerator random = generator_of(key, "camera " + rig.name);
    Draws draws;
    constexpr double inner_share = 0.8;
    draws.place.x = random.between(-inner_share, inner_share);
    draws.place.y = random.between(-inner_share, inner_share);
    draws.heading_rad = drawn_rad(random, rig.heading_deg);
    draws.pitch_rad = drawn_rad(random, rig.pitch_deg);
    draws.bank_rad = drawn_rad(random, rig.bank_deg);
    draws.distance_m = drawn(random, rig.distance_m);
    draws.azimuth_rad = drawn_rad(random, rig.azimuth_deg);
    const double sine =
        random.between(std::sin(glm::radians(rig.elevation_deg.low)), std::sin(glm::radians(rig.elevation_deg.high)));
    draws.elevation_rad = std::asin(sine); // evenly over the sphere
    draws.height_m = drawn(random, rig.height_m);
    const double half_height = rig.camera.intrinsics ? 0.5 * rig.camera.height / rig.camera.intrinsics->fy
                                                     : std::tan(0.5 * glm::radians(rig.camera.fov_deg));
    const double tangent = half_height * rig.aim;
    draws.aim.x = random.between(-tangent, tangent);
    draws.aim.y = random.between(-tangent, tangent);
    if (rig.mount == Mount::Random) { draws.azimuth_rad = random.between(0.0, 2.0 * std::numbers::pi); }
    return draws;
}

/// An eye and an attitude: body axes of the camera to world axes.
struct Placed {
    glm::dvec3 eye_m{0.0};
    glm::dquat attitude{1.0, 0.0, 0.0, 0.0};
};

glm::dvec3 lifted(glm::dvec3 eye_m, const RigGround& ground) {
    if (const auto height_m = ground.height_at(eye_m.x, eye_m.y)) {
        eye_m.z = std::max(eye_m.z, *height_m + min_eye_height_m);
    }
    return eye_m;
}

glm::dquat turned(double heading_rad, double pitch_rad, double bank_rad) {
    return body_to_world_from_euler({heading_rad, pitch_rad, bank_rad});
}

Placed placed_around(
    const CameraRig& rig, const Draws& draws, const sim::AircraftState& state, const RigGround& ground) {
    double azimuth_rad = draws.azimuth_rad;
    if (rig.mount == Mount::Chase) {
        azimuth_rad += euler_from_body_to_world(state.body_to_world).heading_rad + std::numbers::pi;
    }
    const glm::dvec3 from = std::cos(draws.elevation_rad) * direction_from_heading(azimuth_rad) +
                            glm::dvec3(0.0, 0.0, std::sin(draws.elevation_rad));
    Placed placed;
    placed.eye_m = lifted(state.position_m + draws.distance_m * from, ground);
    const glm::dvec3 to = state.position_m - placed.eye_m;
    // The aircraft lies off the picture's middle by the tangents drawn; the horizon stays level.
    const auto level = [](const glm::dvec3& ahead) {
        const double level_m = std::hypot(ahead.x, ahead.y);
        return turned(level_m > 0.0 ? std::atan2(ahead.x, ahead.y) : 0.0, std::atan2(ahead.z, level_m), 0.0);
    };
    placed.attitude = level(to);
    if (rig.aim > 0.0) { placed.attitude = level(placed.attitude * glm::dvec3(1.0, draws.aim.x, draws.aim.y)); }
    return placed;
}

Placed placed(
    const CameraRig& rig, const Draws& draws, std::span<const sim::AircraftState> states, const RigGround& ground) {
    if (rig.mount == Mount::Ground) {
        const glm::dvec2 at_m = draws.place * ground.half_extent_m;
        const double height_m = ground.height_at(at_m.x, at_m.y).value_or(0.0) + draws.height_m;
        return {{at_m, height_m}, turned(draws.heading_rad, draws.pitch_rad, draws.bank_rad)};
    }
    assert(static_cast<std::size_t>(rig.aircraft) <= states.size());
    const sim::AircraftState& state = states[static_cast<std::size_t>(rig.aircraft - 1)];
    if (rig.mount == Mount::Aircraft) {
        return {lifted(state.position_m + state.body_to_world * rig.at_m, ground),
            state.body_to_world *
                (glm::conjugate(turned(0.0, 0.0, 0.0)) * turned(draws.heading_rad, draws.pitch_rad, draws.bank_rad))};
    }
    return placed_around(rig, draws, state, ground);
}

octant::Vec3 plain(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

octant::Quaternion plain(const glm::dquat& q) { return {q.w, q.x, q.y, q.z}; }

} // namespace

octant::Pose pose_of(const CameraRig& rig, const SampleKey& key, std::span<const sim::AircraftState> states,
    std::span<const sim::AircraftState> previous_states, double previous_s, const RigGround& ground) {
    const Draws draws = draws_of(rig, key);
    const Placed now = placed(rig, draws, states, ground);
    const Placed before = placed(rig, draws, previous_states, ground);
    glm::dquat turn = glm::conjugate(before.attitude) * now.attitude;
    if (turn.w < 0.0) { turn = -turn; }
    const glm::dvec3 axis(turn.x, turn.y, turn.z);
    const double sine = glm::length(axis);
    const double angle_deg = glm::degrees(2.0 * std::atan2(sine, turn.w));
    octant::Pose pose;
    pose.eye_m = plain(now.eye_m);
    pose.attitude = plain(now.attitude);
    pose.previous_eye_m = plain(before.eye_m);
    pose.previous_attitude = plain(before.attitude);
    pose.velocity_mps = plain((now.eye_m - before.eye_m) / previous_s);
    if (sine > 0.0) { pose.turn_rate_degps = plain(axis / sine * (angle_deg / previous_s)); }
    return pose;
}

} // namespace octant::ui::dataset
