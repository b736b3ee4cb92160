// Layouts: Laminar Research, "Exchanging Data with X-Plane" (in the program's Instructions folder); groups and their
// order as ArduPilot's SIM_XPlane.cpp and NASA's XPlaneConnect read and write them. All numbers are little-endian; the
// fifth byte of a packet differs between versions.

#include "sim/links/xplane.h"

#include "sim/atmosphere.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>

namespace octant::sim::links {

namespace {

constexpr std::size_t head_bytes = 5;
constexpr std::size_t group_bytes = 36;
constexpr std::size_t answer_bytes = 8;
constexpr std::size_t name_bytes = 400;
/// What X-Plane writes where a group has fewer than eight values.
constexpr float no_value = -999.0F;

enum Group : std::int32_t {
    Times = 1,
    Speeds = 3,
    Angles = 17,
    Path = 18,
    Place = 20,
    Local = 21,
};

/// The requested values. The numbers of the answers begin here, where other programs are unlikely to use them.
constexpr std::int32_t first_answer = 7001;

enum Answer : std::size_t {
    AskedLatitude,
    AskedLongitude,
    AskedElevation,
    AskedAboveGround,
    AskedPitch,
    AskedRoll,
    AskedHeading,
    AskedLocalX,
    AskedLocalY,
    AskedLocalZ,
    AskedLocalVx,
    AskedLocalVy,
    AskedLocalVz,
    AskedRollRate,
    AskedPitchRate,
    AskedYawRate,
    AskedClock,
};

/// DecodeResult::got of answers that we asked for, where others hold the place.
constexpr std::uint32_t part_of_answers = 2;

constexpr std::array<std::string_view, 17> answer_names{"sim/flightmodel/position/latitude",
    "sim/flightmodel/position/longitude", "sim/flightmodel/position/elevation", "sim/flightmodel/position/y_agl",
    "sim/flightmodel/position/true_theta", "sim/flightmodel/position/true_phi", "sim/flightmodel/position/true_psi",
    "sim/flightmodel/position/local_x", "sim/flightmodel/position/local_y", "sim/flightmodel/position/local_z",
    "sim/flightmodel/position/local_vx", "sim/flightmodel/position/local_vy", "sim/flightmodel/position/local_vz",
    "sim/flightmodel/position/P", "sim/flightmodel/position/Q", "sim/flightmodel/position/R",
    "sim/time/total_running_time_sec"};

bool begins_with(Bytes bytes, std::string_view word) {
    return bytes.size() >= word.size() && std::equal(word.begin(), word.end(), bytes.begin(),
                                              [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

double value_at(const WireReader& row, std::size_t value) { return static_cast<double>(row.at<float>(4 + 4 * value)); }

glm::dvec3 values_at(const WireReader& row, std::size_t first) {
    return {value_at(row, first), value_at(row, first + 1), value_at(row, first + 2)};
}

/// One component of a vector whose components arrive one by one; those that did not arrive are NaN.
double& part_of(std::optional<glm::dvec3>& whole, std::size_t part) {
    if (!whole) { whole.emplace(std::numeric_limits<double>::quiet_NaN()); }
    return (*whole)[static_cast<int>(part)];
}

/// True if no component is missing.
bool is_complete(const std::optional<glm::dvec3>& whole) {
    return whole && !std::isnan(whole->x) && !std::isnan(whole->y) && !std::isnan(whole->z);
}

/// Moves a place, degrees and metres, by a small way east, up and south: X-Plane flies over the
/// earth, whatever is below its place here.
void move_by(glm::dvec3& place, const glm::dvec3& local_m) {
    const Geodetic moved =
        offset_by({rad_from_deg(place.x), rad_from_deg(place.y), place.z}, {-local_m.z, local_m.x, -local_m.y}, wgs84);
    place = {deg_from_rad(moved.latitude_rad), deg_from_rad(moved.longitude_rad), moved.height_m};
}

} // namespace

void XPlanePose::take_group(std::int32_t group, const WireReader& row) {
    switch (group) {
    case Times:
        received_.time_s = value_at(row, 2);
        break;
    case Speeds:
        received_.ground_speed_mps = mps_from_kt(value_at(row, 3));
        break;
    case Angles:
        attitude_deg_ = values_at(row, 0);
        break;
    case Path:
        received_.path_deg = {value_at(row, 2), value_at(row, 3)};
        break;
    case Place: {
        const glm::dvec3 place = values_at(row, 0);
        received_.place = {place.x, place.y, m_from_ft(place.z)};
        received_.above_ground_m = m_from_ft(value_at(row, 3));
        break;
    }
    case Local:
        received_.local_m = values_at(row, 0);
        received_.local_mps = values_at(row, 3);
        break;
    default:
        break;
    }
}

/// Returns whether the number is one of xplane_requests().
bool XPlanePose::take_answer(std::int32_t number, float value) {
    if (number < first_answer || number >= first_answer + static_cast<std::int32_t>(answer_names.size())) {
        return false;
    }
    const auto which = static_cast<std::size_t>(number - first_answer);
    const auto answer = static_cast<double>(value);
    if (which <= AskedElevation) {
        part_of(received_.place, which) = answer;
    } else if (which == AskedAboveGround) {
        received_.above_ground_m = answer;
    } else if (which <= AskedHeading) {
        attitude_deg_[static_cast<int>(which - AskedPitch)] = answer;
    } else if (which <= AskedLocalZ) {
        part_of(received_.local_m, which - AskedLocalX) = answer;
    } else if (which <= AskedLocalVz) {
        part_of(received_.local_mps, which - AskedLocalVx) = answer;
    } else if (which <= AskedYawRate) {
        part_of(received_.body_rates_degps, which - AskedRollRate) = answer;
    } else {
        received_.time_s = answer;
    }
    return true;
}

DecodeResult XPlanePose::take(Bytes datagram, std::optional<Fix>& fix) {
    const auto size = static_cast<std::uint32_t>(datagram.size());
    const bool is_data = begins_with(datagram, "DATA");
    if (!is_data && !begins_with(datagram, "RREF")) { return {PacketError::NotOurs, size, size}; }
    const std::size_t each = is_data ? group_bytes : answer_bytes;
    if (size <= head_bytes || (size - head_bytes) % each != 0) {
        return {PacketError::WrongSize, is_data ? 0U : 1U, size};
    }
    bool is_asked_for = false;
    for (std::size_t at = head_bytes; at < size; at += each) {
        const WireReader row(datagram.subspan(at, each), ByteOrder::Little);
        if (is_data) {
            take_group(row.at<std::int32_t>(0), row);
        } else {
            is_asked_for = take_answer(row.at<std::int32_t>(0), row.at<float>(4)) || is_asked_for;
        }
    }
    DecodeResult result{PacketError::None, is_data ? 0U : 1U, 0}; // packets differ in length and count as one kind
    if (!received_.place || (!is_data && !is_complete(received_.place))) {
        result.fault = PacketError::Unused; // Answers to RREF may bring the rest of a place later.
        result.got = is_asked_for ? part_of_answers : result.got;
        return result;
    }
    for (std::optional<glm::dvec3>* each_vector :
        {&received_.local_m, &received_.local_mps, &received_.body_rates_degps}) {
        if (!is_complete(*each_vector)) { each_vector->reset(); }
    }
    Fix complete_fix = complete();
    result.fault = error_of_fix(complete_fix);
    if (result.fault == PacketError::None) {
        Fix smoothed = complete_fix;
        smooth(smoothed);
        fix = error_of_fix(smoothed) == PacketError::None ? smoothed : complete_fix;
    }
    received_ = {};
    return result;
}

Fix XPlanePose::complete() {
    Fix fix;
    fix.latitude_deg = received_.place->x;
    fix.longitude_deg = received_.place->y;
    fix.altitude_m = received_.place->z;
    fix.above_ground_m = received_.above_ground_m;
    fix.attitude = {rad_from_deg(attitude_deg_.z), rad_from_deg(attitude_deg_.x), rad_from_deg(attitude_deg_.y)};
    if (received_.local_mps) {
        const glm::dvec3& local = *received_.local_mps;
        fix.velocity_ned_mps = glm::dvec3(-local.z, local.x, -local.y);
    } else if (received_.ground_speed_mps && received_.path_deg) {
        const double track_rad = rad_from_deg(received_.path_deg->x);
        const double steepest_deg = 89.0;
        const double up = std::tan(rad_from_deg(std::clamp(received_.path_deg->y, -steepest_deg, steepest_deg)));
        fix.velocity_ned_mps = *received_.ground_speed_mps * glm::dvec3(std::cos(track_rad), std::sin(track_rad), -up);
    }
    if (received_.body_rates_degps) {
        const glm::dvec3& rates = *received_.body_rates_degps;
        fix.body_rates_radps = glm::dvec3(rad_from_deg(rates.x), rad_from_deg(rates.y), rad_from_deg(rates.z));
    }
    // A clock that stands still is ignored: other senders than X-Plane often leave group 1 unchanged. Later it counts
    // in steps of 1 ms and more because of single precision, which is too coarse.
    constexpr double fine_until_s = 8192.0;
    if (received_.time_s && last_time_s_ && *received_.time_s > *last_time_s_ && *received_.time_s < fine_until_s) {
        fix.sent_s = received_.time_s;
    }
    last_time_s_ = received_.time_s;
    return fix;
}

/// Moves the position by the local axes, and by a twentieth of the difference to the reported position; by all of it
/// after a jump of either.
void XPlanePose::smooth(Fix& fix) {
    constexpr double farthest_m = 20.0; // of the place from where the local axes bring it
    constexpr double share = 0.05;
    constexpr double highest_latitude_deg = 89.0;
    const glm::dvec3 reported(fix.latitude_deg, fix.longitude_deg, fix.altitude_m);
    glm::dvec3 place = reported;
    if (received_.local_m && last_local_m_ && std::abs(reported.x) < highest_latitude_deg) {
        place = smooth_;
        move_by(place, *received_.local_m - *last_local_m_);
        const glm::dvec3 left = reported - place;
        constexpr double m_per_degree = 111195.0;
        const glm::dvec3 left_m(
            m_per_degree * left.x, m_per_degree * left.y * std::cos(rad_from_deg(reported.x)), left.z);
        const bool has_jumped = !(glm::length(left_m) < farthest_m);
        place = has_jumped ? reported : place + share * left;
    }
    last_local_m_ = received_.local_m;
    smooth_ = place;
    fix.latitude_deg = place.x;
    fix.longitude_deg = place.y;
    fix.altitude_m = place.z;
}

std::vector<std::vector<std::byte>> xplane_requests(int per_second) {
    std::vector<std::vector<std::byte>> requests;
    for (std::size_t i = 0; i < answer_names.size(); ++i) {
        WireWriter request(ByteOrder::Little);
        for (const char letter : std::string_view("RREF\0", head_bytes)) { request.add(letter); }
        request.add(static_cast<std::int32_t>(per_second));
        request.add(static_cast<std::int32_t>(first_answer + static_cast<std::int32_t>(i)));
        for (const char letter : answer_names[i]) { request.add(letter); }
        request.add_zeros(name_bytes - answer_names[i].size());
        requests.push_back(request.take());
    }
    return requests;
}

std::vector<std::byte> encode_xplane(const Fix& fix, const Geodetic& origin, double time_s) {
    WireWriter packet(ByteOrder::Little);
    for (const char letter : std::string_view("DATA*")) { packet.add(letter); }
    const auto add = [&packet](Group group, std::initializer_list<double> values) {
        packet.add(static_cast<std::int32_t>(group));
        for (const double value : values) { packet.add(static_cast<float>(value)); }
        for (std::size_t i = values.size(); i < 8; ++i) { packet.add(no_value); }
    };
    const glm::dvec3 ned_mps = fix.velocity_ned_mps.value_or(glm::dvec3(0.0));
    const double level_mps = std::hypot(ned_mps.x, ned_mps.y);
    const double true_kt = kt_from_mps(glm::length(ned_mps));
    const double ground_kt = kt_from_mps(level_mps);
    const double air_share = standard_air(fix.altitude_m).density_kgpm3 / standard_air(0.0).density_kgpm3;
    const double indicated_kt = true_kt * std::sqrt(air_share);
    constexpr double mph_per_kt = 1.852 / 1.609344;
    add(Times, {time_s, time_s, time_s, time_s});
    add(Speeds, {indicated_kt, indicated_kt, true_kt, ground_kt, static_cast<double>(no_value),
                    indicated_kt * mph_per_kt, true_kt * mph_per_kt, ground_kt * mph_per_kt});
    const double heading_deg = deg_from_rad(fix.attitude.heading_rad);
    add(Angles, {deg_from_rad(fix.attitude.pitch_rad), deg_from_rad(fix.attitude.roll_rad), heading_deg, heading_deg});
    const glm::dvec3 body_mps = glm::transpose(ned_from_body(fix.attitude)) * ned_mps;
    add(Path, {deg_from_rad(std::atan2(body_mps.z, body_mps.x)), deg_from_rad(std::atan2(body_mps.y, body_mps.x)),
                  deg_from_rad(std::atan2(ned_mps.y, ned_mps.x)), deg_from_rad(std::atan2(-ned_mps.z, level_mps))});
    const double altitude_ft = ft_from_m(fix.altitude_m);
    const double above_ground_ft = ft_from_m(fix.above_ground_m.value_or(fix.altitude_m));
    add(Place, {fix.latitude_deg, fix.longitude_deg, altitude_ft, above_ground_ft, 0.0, altitude_ft});
    const Geodetic place{rad_from_deg(fix.latitude_deg), rad_from_deg(fix.longitude_deg), fix.altitude_m};
    const glm::dvec3 ned_m = ned_from_ecef(origin) * (ecef_from_geodetic(place) - ecef_from_geodetic(origin));
    add(Local, {ned_m.y, -ned_m.z, -ned_m.x, ned_mps.y, -ned_mps.z, -ned_mps.x});
    return packet.take();
}

std::string xplane_text(const DecodeResult& result) {
    const std::string_view kind = result.got == 0 ? "DATA" : "RREF";
    switch (result.fault) {
    case PacketError::None:
        return fmt::format("X-Plane {}: fine", kind);
    case PacketError::Unused:
        return result.got == 0 ? "X-Plane DATA without group 20 (latitude and longitude): waits for that one; "
                                 "groups 3, 17, 18, 20 and 21 are read"
               : result.got == part_of_answers
                   ? "X-Plane RREF: a part of the answers; waits for latitude, longitude and "
                     "elevation"
                   : "X-Plane RREF lacks latitude, longitude and elevation under our request "
                     "numbers; start listen with --xplane HOST";
    case PacketError::WrongSize:
        return fmt::format("X-Plane {}: expected 5 bytes and {} for each {}, got {}", kind,
            result.got == 0 ? group_bytes : answer_bytes, result.got == 0 ? "group" : "answer", result.size);
    case PacketError::NotFinite:
        return fmt::format("X-Plane {}: expected numbers, got one that is none", kind);
    case PacketError::OutOfRange:
        return fmt::format("X-Plane {}: expected an aircraft near the earth, got none", kind);
    default:
        return fmt::format("expected X-Plane DATA or RREF, got {} bytes of something else", result.size);
    }
}

} // namespace octant::sim::links
