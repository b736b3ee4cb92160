#include "flightpaths/acmi_recording.h"

#include "flightpaths/derived_motion.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

// Source: Tacview, "Technical Reference - ACMI flight recordings 2.2". A line is a time (#), the end of an object (-),
// or an object's number and properties between commas; a backslash takes a comma or a line's end for what it is.

/// Where an object is, as far as the recording has said: degrees and metres.
struct AcmiSample {
    double time_s = 0.0;
    double longitude_deg = 0.0;
    double latitude_deg = 0.0;
    double altitude_m = 0.0;
    double roll_deg = 0.0;
    double pitch_deg = 0.0;
    double heading_deg = 0.0;
};

/// One object from its first line to the one that takes it away. Its number may then be another's.
struct AcmiObject {
    std::string name;
    std::string type;
    bool has_attitude = false;
    /// In the order of the text; times may not be.
    std::vector<AcmiSample> places;
};

constexpr double longest_s = 86400.0;
constexpr std::size_t max_objects = 1000000;
/// The most places of all objects together.
constexpr std::size_t max_places = 20000000;

/// Fields between commas that no backslash precedes.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\\') {
            ++i;
        } else if (line[i] == ',') {
            fields.push_back(line.substr(begin, i - begin));
            begin = i + 1;
        }
    }
    fields.push_back(line.substr(begin));
    return fields;
}

std::string plain(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        i += text[i] == '\\' && i + 1 < text.size() ? 1U : 0U;
        out += text[i];
    }
    return out;
}

/// Reads the objects of an ACMI text in the order in which they appear. Throws Error with file and line.
class AcmiReader {
public:
    AcmiReader(const std::filesystem::path& file, std::string_view text) : text_(file, text, {.joins_lines = true}) {}

    std::vector<AcmiObject> read() {
        constexpr std::string_view type = "FileType=text/acmi/tacview";
        constexpr std::string_view version = "FileVersion=2.";
        if (next_line() != type) { refuse(type, text_.line()); }
        if (!next_line().starts_with(version)) { refuse("FileVersion=2.x", text_.line()); }
        while (text_.next_line()) {
            const std::string_view line = text_.line();
            if (line.starts_with("#")) {
                take_time(line.substr(1));
            } else if (line.starts_with("-")) {
                now_.erase(id_from(line.substr(1)));
            } else if (!text_.peek().empty() && !line.starts_with("//")) {
                take_object(line);
            }
        }
        return std::move(objects_);
    }

private:
    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const {
        text_.refuse(expected, in_quotes(got));
    }

    /// A line of the head of the file; empty where the file ends.
    std::string_view next_line() { return text_.next_line() ? text_.line() : std::string_view(); }

    double number_from(std::string_view text) const {
        const auto value = finite_number(text);
        if (!value) { refuse("a number", text); }
        return *value;
    }

    std::uint64_t id_from(std::string_view text) const {
        constexpr int hexadecimal = 16;
        std::uint64_t id = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, id, hexadecimal);
        if (text.empty() || read.ec != std::errc() || read.ptr != end) {
            refuse("an object's number in hexadecimal digits, a # or a -", text);
        }
        return id;
    }

    /// What is known of an object that is there.
    struct Present {
        std::size_t object = 0;
        AcmiSample place;
        bool has_place = false;
    };

    void take_time(std::string_view text) {
        time_s_ = number_from(text);
        first_s_ = first_s_.value_or(time_s_);
        if (!(std::abs(time_s_ - *first_s_) <= longest_s)) {
            refuse(fmt::format("a time within {:.0f} s of the first", longest_s), text);
        }
    }

    void take_object(std::string_view line) {
        const std::vector<std::string_view> fields = fields_of(line);
        const std::uint64_t id = id_from(fields.front());
        if (id == 0) {
            for (std::size_t i = 1; i < fields.size(); ++i) { take_global(fields[i]); }
            return;
        }
        const auto [found, is_new] = now_.try_emplace(id, Present{objects_.size(), {}, false});
        if (is_new) {
            if (objects_.size() == max_objects) { refuse(fmt::format("at most {} objects", max_objects), line); }
            objects_.emplace_back();
        }
        for (std::size_t i = 1; i < fields.size(); ++i) { take_property(fields[i], found->second); }
    }

    void take_global(std::string_view field) {
        const std::size_t equals = field.find('=');
        const std::string_view name = field.substr(0, equals);
        if (name == "ReferenceLongitude") {
            longitude_deg_ = number_from(field.substr(equals + 1));
        } else if (name == "ReferenceLatitude") {
            latitude_deg_ = number_from(field.substr(equals + 1));
        }
    }

    void take_property(std::string_view field, Present& present) {
        AcmiObject& object = objects_[present.object];
        const std::size_t equals = field.find('=');
        if (equals == std::string_view::npos) { return; }
        const std::string_view value = field.substr(equals + 1);
        const std::string_view name = field.substr(0, equals);
        if (name == "T") {
            take_place(value, present);
        } else if (name == "Name") {
            object.name = plain(value);
        } else if (name == "Type") {
            object.type = plain(value);
        }
    }

    /// Longitude, latitude, altitude; then U, V or roll, pitch, yaw or these five and a heading.
    void take_place(std::string_view text, Present& present) {
        const std::vector<std::string_view> parts = split_fields(text, '|');
        constexpr std::size_t bare = 3;
        constexpr std::size_t flat = 5;
        constexpr std::size_t turned = 6;
        constexpr std::size_t whole = 9;
        const std::size_t count = parts.size();
        if (count != bare && count != flat && count != turned && count != whole) {
            refuse("3, 5, 6 or 9 components after T=", text);
        }
        AcmiSample& place = present.place;
        const std::array<double*, turned> targets{&place.longitude_deg, &place.latitude_deg, &place.altitude_m,
            &place.roll_deg, &place.pitch_deg, &place.heading_deg};
        const std::size_t used = count >= turned ? turned : bare;
        for (std::size_t i = 0; i < used; ++i) {
            if (!parts[i].empty()) {
                const double reference = i == 0 ? longitude_deg_ : i == 1 ? latitude_deg_ : 0.0;
                *targets[i] = reference + number_from(parts[i]);
                present.has_place = present.has_place || i < 2;
            }
        }
        AcmiObject& object = objects_[present.object];
        object.has_attitude = object.has_attitude || count >= turned;
        place.time_s = time_s_;
        if (present.has_place) {
            if (++places_ > max_places) { refuse(fmt::format("at most {} places", max_places), text); }
            object.places.push_back(place);
        }
    }

    TextScanner text_;
    double time_s_ = 0.0;
    std::optional<double> first_s_;
    double longitude_deg_ = 0.0;
    double latitude_deg_ = 0.0;
    std::map<std::uint64_t, Present> now_;
    std::vector<AcmiObject> objects_;
    std::size_t places_ = 0;
};

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
    omitted.samples +=
        static_cast<long>(std::erase_if(places, [](const AcmiSample& place) { return !is_on_earth(place); }));
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

double span_s(const std::vector<AcmiSample>& places) { return places.back().time_s - places.front().time_s; }

sim::AircraftState state_of(const AcmiSample& sample, const EarthFrame& frame, double begin_s) {
    sim::AircraftState state;
    state.time_s = sample.time_s - begin_s;
    const FramePosition local = frame.place_of({sample.latitude_deg, sample.longitude_deg});
    state.position_m = glm::dvec3(local.east_north_m, sample.altitude_m);
    state.body_to_world = body_to_world_from_euler({rad_from_deg(sample.heading_deg) + local.north_bearing_rad,
        rad_from_deg(sample.pitch_deg), rad_from_deg(sample.roll_deg)});
    return state;
}

/// Nothing where it is too far away or fewer than two samples are left.
std::optional<sim::Trajectory> trajectory_of(const std::vector<AcmiSample>& places, bool has_attitude,
    const EarthFrame& frame, double begin_s, Omitted& omitted) {
    std::vector<sim::AircraftState> samples;
    for (const AcmiSample& place : places) {
        const sim::AircraftState state = state_of(place, frame, begin_s);
        const bool near = glm::length(glm::dvec2(state.position_m)) <= furthest_m;
        const bool follows = samples.empty() || glm::distance(samples.back().position_m, state.position_m) <=
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
    if (!has_attitude) { fill_attitudes(samples); }
    fill_load_factors(samples);
    return sim::Trajectory(std::move(samples));
}

std::vector<std::string> notes_of(const Omitted& omitted, const std::filesystem::path& file) {
    std::vector<std::string> notes;
    const auto tell = [&](long count, std::string_view what) {
        if (count > 0) { notes.push_back(fmt::format("{}: left out {} {}", file.string(), count, what)); }
    };
    tell(omitted.others, "objects that are no aircraft");
    tell(omitted.once, "aircraft that are seen at one time alone");
    tell(omitted.far, "aircraft more than 1,000 km away");
    tell(omitted.many, fmt::format("aircraft beyond {}", max_recorded_aircraft));
    tell(omitted.samples, "samples off the earth or faster than 3,000 m/s");
    return notes;
}

} // namespace

AcmiRecording parse_acmi(std::string_view text, const std::filesystem::path& file) {
    std::vector<AcmiObject> objects = AcmiReader(file, text).read();
    Omitted omitted;
    const auto count = static_cast<int>(objects.size());
    std::erase_if(objects, [](const AcmiObject& object) { return !flies(object); });
    omitted.others = count - static_cast<int>(objects.size());
    for (AcmiObject& object : objects) { object.places = in_order(std::move(object.places), omitted); }
    omitted.once =
        static_cast<int>(std::erase_if(objects, [](const AcmiObject& object) { return object.places.size() < 2; }));
    if (objects.empty()) {
        throw_error_in(file, fmt::format("expected aircraft that move, got none among {} objects", count));
    }
    const auto longest =
        std::ranges::max_element(objects, {}, [](const AcmiObject& object) { return span_s(object.places); });
    std::rotate(objects.begin(), longest, longest + 1);
    double begin_s = objects.front().places.front().time_s;
    for (const AcmiObject& object : objects) { begin_s = std::min(begin_s, object.places.front().time_s); }
    const AcmiSample& first = objects.front().places.front();
    AcmiRecording recording{{}, {first.latitude_deg, first.longitude_deg}, {}};
    const TransverseMercator frame(recording.origin);
    for (AcmiObject& object : objects) {
        if (recording.aircraft.size() == max_recorded_aircraft) {
            ++omitted.many;
            continue;
        }
        auto trajectory = trajectory_of(object.places, object.has_attitude, frame, begin_s, omitted);
        if (trajectory) {
            recording.aircraft.push_back({std::move(object.name), std::move(object.type), std::move(*trajectory)});
        } else if (recording.aircraft.empty()) {
            throw_error_in(file, "expected an aircraft that moves slower than 3,000 m/s, got none");
        }
    }
    recording.notes = notes_of(omitted, file);
    return recording;
}

} // namespace octant::flightpaths
