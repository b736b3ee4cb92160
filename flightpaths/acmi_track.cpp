#include "flightpaths/fix_table.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/text_scanner.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
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
struct AcmiPlace {
    double longitude_deg = 0.0;
    double latitude_deg = 0.0;
    double altitude_m = 0.0;
    double roll_deg = 0.0;
    double pitch_deg = 0.0;
    double heading_deg = 0.0;
};

constexpr double longest_recording_s = 86400.0;
constexpr std::size_t max_objects = 1000000;

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

bool flies(std::string_view type) {
    const auto tags = split_fields(type, '+');
    return type.empty() || std::ranges::find(tags, "Air") != tags.end();
}

/// Reads the objects of an ACMI text. Throws Error with file and line.
class AcmiReader {
public:
    explicit AcmiReader(const TrackSource& source)
        : source_(source), text_(source.file, source.bytes, {.joins_lines = true}),
          fixes_("Tacview ACMI", source.file) {
        fixes_.heights = HeightKind::Sea;
        fixes_.sorts = true;
        fixes_.splits = false;
    }

    TrackRecording read() {
        constexpr std::string_view type = "FileType=text/acmi/tacview";
        constexpr std::string_view version = "FileVersion=2.";
        if (next_line() != type) { refuse(type, text_.line()); }
        if (!next_line().starts_with(version)) { refuse("FileVersion=2.x", text_.line()); }
        while (text_.next_line()) {
            const std::string_view line = text_.line();
            if (line.starts_with("#")) {
                take_time(line.substr(1));
            } else if (line.starts_with("-")) {
                const auto gone = now_.find(id_from(line.substr(1)));
                if (gone != now_.end()) {
                    stay_until_now(gone->second);
                    now_.erase(gone);
                }
            } else if (!text_.peek().empty() && !line.starts_with("//")) {
                take_object(line);
            }
        }
        return recording();
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
        AcmiPlace place;
        bool has_place = false;
        bool has_attitude = false;
    };

    /// One object from its first line to the one that takes it away. Its number may then be another's.
    struct Object {
        std::string key;
        std::string name;
        std::string call_sign;
        std::string pilot;
        std::string type;
        std::string group;
        double importance = 0.0;
        bool has_places = false;
    };

    /// The greatest is followed: the pilot at the recorder, then who matters more to the recording.
    static double rank_of(const Object& object) {
        constexpr double player = 2.0;
        constexpr double piloted = 0.5;
        const bool is_player = object.group == "Player" || object.pilot == "Player";
        return object.importance + (is_player ? player : 0.0) + (object.pilot.empty() ? 0.0 : piloted);
    }

    /// A place is written only when it changes: an aircraft with a single one stands there until it is taken away.
    void stay_until_now(const Present& present) {
        const Object& object = objects_[present.object];
        if (!object.has_places || !flies(object.type)) { return; }
        const std::vector<Fix>& fixes = fixes_.series(object.key).fixes;
        if (fixes.size() == 1 && time_s_ > fixes.front().time_s) { add_fix(present); }
    }

    TrackRecording recording() {
        for (const auto& [id, present] : now_) { stay_until_now(present); }
        for (const Object& object : objects_) {
            if (!flies(object.type)) {
                ++others_;
            } else if (object.has_places) {
                FixSeries& series = fixes_.series(object.key);
                series.name = object.name;
                series.call_sign = object.call_sign;
                series.pilot = object.pilot;
                series.type = object.type;
                series.importance = rank_of(object);
            }
        }
        const auto tell = [&](long count, std::string_view what) {
            if (count > 0) { fixes_.add_note(fmt::format("left out {} {}", count, what)); }
        };
        tell(others_, "objects that are no aircraft");
        tell(off_earth_, "samples off the earth");
        for (const Object& object : objects_) {
            // Of those whose type came after their places.
            if (!flies(object.type) && object.has_places) { fixes_.series(object.key).fixes.clear(); }
        }
        if (fixes_.aircraft_count() == 0) {
            throw_error_in(source_.file, fmt::format("expected aircraft, got none among {} objects", objects_.size()));
        }
        return std::move(fixes_).recording(source_.follow);
    }

    void take_time(std::string_view text) {
        time_s_ = number_from(text);
        first_s_ = first_s_.value_or(time_s_);
        if (!(std::abs(time_s_ - *first_s_) <= longest_recording_s)) {
            refuse(fmt::format("a time within {:.0f} s of the first", longest_recording_s), text);
        }
    }

    void take_object(std::string_view line) {
        const std::vector<std::string_view> fields = fields_of(line);
        const std::uint64_t id = id_from(fields.front());
        if (id == 0) {
            for (std::size_t i = 1; i < fields.size(); ++i) { take_global(fields[i]); }
            return;
        }
        const auto [found, is_new] = now_.try_emplace(id, Present{objects_.size(), {}, false, false});
        if (is_new) {
            if (objects_.size() == max_objects) { refuse(fmt::format("at most {} objects", max_objects), line); }
            objects_.emplace_back().key = key_of(id);
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
        } else if (name == "ReferenceTime") {
            if (const auto time = log_time(field.substr(equals + 1)); time && time->is_date) {
                fixes_.begin_utc_s = time->seconds;
            }
        }
    }

    /// An object's number; the second of that number is another aircraft.
    std::string key_of(std::uint64_t id) {
        const int before = uses_[id]++;
        return before == 0 ? fmt::format("{:x}", id) : fmt::format("{:x}({})", id, before + 1);
    }

    void take_property(std::string_view field, Present& present) {
        Object& object = objects_[present.object];
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
        } else if (name == "CallSign") {
            object.call_sign = plain(value);
        } else if (name == "Pilot") {
            object.pilot = plain(value);
        } else if (name == "Group") {
            object.group = plain(value);
        } else if (name == "Importance") {
            object.importance = finite_number(value).value_or(0.0);
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
        AcmiPlace& place = present.place;
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
        present.has_attitude = present.has_attitude || count >= turned;
        if (present.has_place) { add_fix(present); }
    }

    void add_fix(const Present& present) {
        Object& object = objects_[present.object];
        if (!flies(object.type)) { return; }
        const AcmiPlace& place = present.place;
        constexpr double highest_m = 1e6;
        if (!(std::abs(place.latitude_deg) <= 90.0 && std::abs(place.longitude_deg) <= 360.0 &&
                std::abs(place.altitude_m) <= highest_m)) {
            ++off_earth_;
            return;
        }
        Fix fix;
        fix.line = text_.line_number();
        fix.time_s = time_s_;
        fix.latitude_deg = place.latitude_deg;
        fix.longitude_deg = place.longitude_deg;
        fix.altitude_m = place.altitude_m;
        if (present.has_attitude) {
            fix.roll_deg = place.roll_deg;
            fix.pitch_deg = place.pitch_deg;
            fix.heading_deg = place.heading_deg;
        }
        object.has_places = true;
        fixes_.add(fixes_.series(object.key), fix);
    }

    const TrackSource& source_;
    TextScanner text_;
    FixTable fixes_;
    double time_s_ = 0.0;
    std::optional<double> first_s_;
    double longitude_deg_ = 0.0;
    double latitude_deg_ = 0.0;
    std::map<std::uint64_t, Present> now_;
    std::map<std::uint64_t, int> uses_;
    std::vector<Object> objects_;
    long others_ = 0;
    long off_earth_ = 0;
};

} // namespace

bool is_acmi(std::string_view text) { return text.starts_with("FileType="); }

TrackRecording acmi_recording(const TrackSource& source) { return AcmiReader(source).read(); }

} // namespace octant::flightpaths
