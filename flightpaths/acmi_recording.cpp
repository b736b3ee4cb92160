#include "flightpaths/acmi_recording.h"

#include "flightpaths/acmi_text.h"
#include "flightpaths/derived_motion.h"
#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/transverse_mercator.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace octant::flightpaths {

namespace {

constexpr double fastest_mps = 3000.0;
constexpr double furthest_m = 1e6;
constexpr double highest_m = 1e6;

/// What is left out.
struct Omitted {
    long samples = 0;
    /// Objects that are seen once.
    int once = 0;
    int far = 0;
    int many = 0;
    /// Objects that are no aircraft.
    int others = 0;
};

bool flies(const AcmiObject& object) {
    const auto tags = split_fields(object.type, '+');
    return object.type.empty() || std::ranges::find(tags, "Air") != tags.end();
}

bool is_on_earth(const AcmiSample& place) {
    return std::abs(place.latitude_deg) <= 90.0 && std::abs(place.longitude_deg) <= 360.0 &&
           std::abs(place.altitude_m) <= highest_m;
}

/// In order of time, the last of those of one time, those on the earth alone.
std::vector<AcmiSample> in_order(std::vector<AcmiSample> places, Omitted& omitted) {
    omitted.samples += static_cast<long>(
        std::erase_if(places, [](const AcmiSample& place) { return !is_on_earth(place); }));
    std::ranges::stable_sort(places, {}, &AcmiSample::time_s);
    std::vector<AcmiSample> ordered;
    for (const AcmiSample& place : places) {
        if (!ordered.empty() && ordered.back().time_s == place.time_s) {
            ordered.back() = place;
        } else {
            ordered.push_back(place);
        }
    }
    return ordered;
}

double span_s(const std::vector<AcmiSample>& places) {
    return places.back().time_s - places.front().time_s;
}

sim::AircraftState state_of(const AcmiSample& taped, const EarthFrame& frame, double begin_s) {
    sim::AircraftState state;
    state.time_s = taped.time_s - begin_s;
    const FramePosition local = frame.place_of({taped.latitude_deg, taped.longitude_deg});
    state.position_m = glm::dvec3(local.east_north_m, taped.altitude_m);
    state.body_to_world = body_to_world_from_euler(
        {rad_from_deg(taped.heading_deg) + local.north_bearing_rad,
         rad_from_deg(taped.pitch_deg),
         rad_from_deg(taped.roll_deg)});
    return state;
}

/// Nothing where it is too far away or fewer than two samples are left.
std::optional<sim::Trajectory> trajectory_of(
    const std::vector<AcmiSample>& places,
    bool has_attitude,
    const EarthFrame& frame,
    double begin_s,
    Omitted& omitted) {
    std::vector<sim::AircraftState> samples;
    for (const AcmiSample& place : places) {
        const sim::AircraftState state = state_of(place, frame, begin_s);
        const bool near = glm::length(glm::dvec2(state.position_m)) <= furthest_m;
        const bool follows =
            samples.empty() || glm::distance(samples.back().position_m, state.position_m) <=
                                   fastest_mps * (state.time_s - samples.back().time_s);
        if (near && follows) {
            samples.push_back(state);
        } else {
            ++omitted.samples;
        }
    }
    if (samples.size() < 2) {
        ++omitted.far;
        return std::nullopt;
    }
    fill_velocities(samples);
    if (!has_attitude) {
        fill_attitudes(samples);
    }
    fill_load_factors(samples);
    return sim::Trajectory(std::move(samples));
}

std::vector<std::string> notes_of(const Omitted& omitted, const std::filesystem::path& file) {
    std::vector<std::string> notes;
    const auto tell = [&](long count, std::string_view what) {
        if (count > 0) {
            notes.push_back(fmt::format("{}: left out {} {}", file.string(), count, what));
        }
    };
    tell(omitted.others, "objects that are no aircraft");
    tell(omitted.once, "aircraft that are seen at one time alone");
    tell(omitted.far, "aircraft more than 1,000 km away");
    tell(omitted.many, fmt::format("aircraft beyond {}", max_taped_aircraft));
    tell(omitted.samples, "samples off the earth or faster than 3,000 m/s");
    return notes;
}

} // namespace

AcmiRecording parse_acmi(std::string_view text, const std::filesystem::path& file) {
    std::vector<AcmiObject> objects = parse_acmi_objects(text, file);
    Omitted omitted;
    const auto count = static_cast<int>(objects.size());
    std::erase_if(objects, [](const AcmiObject& object) { return !flies(object); });
    omitted.others = count - static_cast<int>(objects.size());
    for (AcmiObject& object : objects) {
        object.places = in_order(std::move(object.places), omitted);
    }
    omitted.once = static_cast<int>(
        std::erase_if(objects, [](const AcmiObject& object) { return object.places.size() < 2; }));
    if (objects.empty()) {
        throw_error_in(
            file, fmt::format("expected aircraft that move, got none among {} objects", count));
    }
    const auto longest = std::ranges::max_element(
        objects, {}, [](const AcmiObject& object) { return span_s(object.places); });
    std::rotate(objects.begin(), longest, longest + 1);
    double begin_s = objects.front().places.front().time_s;
    for (const AcmiObject& object : objects) {
        begin_s = std::min(begin_s, object.places.front().time_s);
    }
    const AcmiSample& first = objects.front().places.front();
    AcmiRecording tape{{}, {first.latitude_deg, first.longitude_deg}, {}};
    const TransverseMercator frame(tape.origin);
    for (AcmiObject& object : objects) {
        if (tape.aircraft.size() == max_taped_aircraft) {
            ++omitted.many;
            continue;
        }
        auto trajectory =
            trajectory_of(object.places, object.has_attitude, frame, begin_s, omitted);
        if (trajectory) {
            tape.aircraft.push_back(
                {std::move(object.name), std::move(object.type), std::move(*trajectory)});
        } else if (tape.aircraft.empty()) {
            throw_error_in(file, "expected an aircraft that moves slower than 3,000 m/s, got none");
        }
    }
    tape.notes = notes_of(omitted, file);
    return tape;
}

} // namespace octant::flightpaths
