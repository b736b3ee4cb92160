// GPX as topografix.com/GPX/1/1 defines it, and KML as OGC 07-147r2 and Google's extension gx:Track define it.

#include "flightpaths/fix_table.h"
#include "flightpaths/log_columns.h"
#include "flightpaths/track_readers.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <new>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::flightpaths {

namespace {

/// Where bytes of a text lie, by line. Offsets must not decrease by much: lines are counted from the last one on.
class LineCounter {
public:
    explicit LineCounter(std::string_view text) : text_(text) {}

    int line_at(std::size_t offset) {
        offset = std::min(offset, text_.size());
        if (offset < counted_) {
            line_ = 1;
            counted_ = 0;
        }
        line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
            text_.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
        counted_ = offset;
        return line_;
    }

private:
    std::string_view text_;
    std::size_t counted_ = 0;
    int line_ = 1;
};

/// The name of an element without its namespace's prefix.
std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == name.npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_named(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node& child : node) {
        if (local_name(child) == name) { return child; }
    }
    return {};
}

/// The text of a child without the blanks around it; empty where there is none.
std::string_view child_text(const pugi::xml_node& node, std::string_view name) {
    const auto words = split_fields(child_named(node, name).child_value(), '\n');
    for (const std::string_view word : words) {
        if (!word.empty()) { return word; }
    }
    return {};
}

std::vector<std::string_view> blank_separated(std::string_view text) {
    std::vector<std::string_view> words;
    constexpr std::string_view blanks = " \t\r\n";
    for (std::size_t at = text.find_first_not_of(blanks); at != text.npos; at = text.find_first_not_of(blanks, at)) {
        const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

/// Reads the tracks of one XML document into a table of fixes.
class XmlTrackReader {
public:
    XmlTrackReader(const TrackSource& source, std::string format)
        : source_(source), lines_(source.bytes), fixes_(std::move(format), source.file) {
        const pugi::xml_parse_result result = document_.load_buffer(source.bytes.data(), source.bytes.size(),
            pugi::parse_cdata | pugi::parse_escapes | pugi::parse_wconv_attribute, pugi::encoding_utf8);
        if (result.status == pugi::status_out_of_memory) { throw std::bad_alloc(); }
        if (result.status != pugi::status_ok) {
            throw_error_at(source.file,
                lines_.line_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
                fmt::format("expected well-formed XML, got {}", in_quotes(result.description())));
        }
    }

    TrackRecording read_gpx();
    TrackRecording read_kml();

private:
    int line_of(const pugi::xml_node& node) {
        return lines_.line_at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)));
    }

    [[noreturn]] void refuse(const pugi::xml_node& node, std::string_view expected, std::string_view got) {
        throw_error_at(source_.file, line_of(node), fmt::format("expected {}, got {}", expected, in_quotes(got)));
    }

    double number(const pugi::xml_node& node, std::string_view text, std::string_view what) {
        const auto value = finite_number(text);
        if (!value) { refuse(node, what, text); }
        return *value;
    }

    /// Seconds since 1970 of a time with a date; nothing for an empty text.
    std::optional<LogTime> time(const pugi::xml_node& node, std::string_view text) {
        if (text.empty()) { return std::nullopt; }
        const auto read = log_time(text);
        if (read && read->is_date) { return read; }
        if (const auto day = log_date(text)) { return day; }
        refuse(node, "a time such as 2024-01-02T07:41:03Z", text);
    }

    /// Calls `use` for each element of this name, in the order of the document.
    template <class Use>
    void for_each_named(std::string_view name, const Use& use) {
        constexpr int deepest = 200;
        std::vector<std::pair<pugi::xml_node, int>> open{{document_, 0}};
        while (!open.empty()) {
            const auto [node, depth] = open.back();
            open.pop_back();
            if (local_name(node) == name) {
                use(node);
                continue;
            }
            if (depth > deepest) { refuse(node, fmt::format("elements at most {} deep", deepest), node.name()); }
            for (pugi::xml_node child = node.last_child(); child; child = child.previous_sibling()) {
                if (child.type() == pugi::node_element) { open.emplace_back(child, depth + 1); }
            }
        }
    }

    bool has_gpx_times(const std::vector<pugi::xml_node>& points);
    void take_gpx_point(const pugi::xml_node& point, bool has_times, FixSeries& series);
    bool take_kml_track(const pugi::xml_node& track, FixSeries& series);
    void take_kml_point(const pugi::xml_node& placemark);
    void take_kml_line(const pugi::xml_node& line);
    void take_altitude_mode(const pugi::xml_node& geometry);
    bool take_coordinates(const pugi::xml_node& node, const std::vector<std::string_view>& parts, Fix& fix);

    const TrackSource& source_;
    LineCounter lines_;
    pugi::xml_document document_;
    FixTable fixes_;
    std::optional<Fix> last_of_lines_;
    int lines_read_ = 0;
};

void XmlTrackReader::take_gpx_point(const pugi::xml_node& point, bool has_times, FixSeries& series) {
    const auto when = has_times ? time(point, child_text(point, "time")) : LogTime{};
    const std::string_view latitude = point.attribute("lat").value();
    const std::string_view longitude = point.attribute("lon").value();
    if (!when || latitude.empty() || longitude.empty()) {
        fixes_.skip_row();
        return;
    }
    Fix fix;
    fix.line = line_of(point);
    fix.time_s = when->seconds;
    fix.is_leap_second = when->is_leap_second;
    fix.latitude_deg = number(point, latitude, "a latitude in degrees");
    fix.longitude_deg = number(point, longitude, "a longitude in degrees");
    if (const std::string_view height = child_text(point, "ele"); !height.empty()) {
        fix.altitude_m = number(point, height, "a height in metres");
    }
    if (const auto speed = finite_number(child_text(point, "speed"))) {
        fix.ground_speed_mps = static_cast<float>(*speed);
    }
    if (const auto course = finite_number(child_text(point, "course"))) { fix.track_deg = static_cast<float>(*course); }
    fixes_.add(series, fix);
}

/// Whether most points have times, and these are more than fractions of one moment.
bool XmlTrackReader::has_gpx_times(const std::vector<pugi::xml_node>& points) {
    std::size_t count = 0;
    double first_s = 0.0;
    double most_apart_s = 0.0;
    for (const pugi::xml_node& point : points) {
        const auto when = time(point, child_text(point, "time"));
        if (!when) { continue; }
        if (count++ == 0) { first_s = when->seconds; }
        most_apart_s = std::max(most_apart_s, std::abs(when->seconds - first_s));
    }
    constexpr double least_step_s = 0.01;
    return 2 * count >= points.size() && most_apart_s > least_step_s * static_cast<double>(count);
}

TrackRecording XmlTrackReader::read_gpx() {
    fixes_.time_scale = TimeScale::Utc;
    std::vector<std::string> names; ///< of the tracks of `points`
    std::vector<pugi::xml_node> points;
    for_each_named("trk", [&](const pugi::xml_node& track) {
        const std::string name(child_text(track, "name"));
        for (const pugi::xml_node& segment : track) {
            for (const pugi::xml_node& point : segment) {
                if (local_name(point) != "trkpt") { continue; }
                names.push_back(name);
                points.push_back(point);
            }
        }
    });
    if (points.empty()) {
        throw_error_in(source_.file, "expected track points (trkpt), got none: waypoints and routes have no times");
    }
    // Tracks of one name are the parts of one flight; of several names, several aircraft.
    const bool has_times = has_gpx_times(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        FixSeries& series = fixes_.series(names[i]);
        series.call_sign = names[i];
        take_gpx_point(points[i], has_times, series);
    }
    if (has_times) {
        fixes_.join_in_sequence();
    } else {
        fixes_.space_out();
    }
    return std::move(fixes_).recording(source_.follow);
}

void XmlTrackReader::take_altitude_mode(const pugi::xml_node& geometry) {
    const std::string_view mode = child_text(geometry, "altitudeMode");
    if (mode == "absolute") {
        fixes_.heights = HeightKind::Sea;
    } else if (mode == "relativeToGround") {
        fixes_.heights = HeightKind::AboveGround;
    }
}

/// Longitude, latitude and maybe a height. False where there is no place.
bool XmlTrackReader::take_coordinates(
    const pugi::xml_node& node, const std::vector<std::string_view>& parts, Fix& fix) {
    if (parts.size() < 2) { return false; }
    fix.line = line_of(node);
    fix.longitude_deg = number(node, parts[0], "a longitude in degrees");
    fix.latitude_deg = number(node, parts[1], "a latitude in degrees");
    if (parts.size() > 2 && !parts[2].empty()) { fix.altitude_m = number(node, parts[2], "a height in metres"); }
    return true;
}

/// The n-th time belongs to the n-th place.
bool XmlTrackReader::take_kml_track(const pugi::xml_node& track, FixSeries& series) {
    std::vector<pugi::xml_node> times;
    std::vector<pugi::xml_node> places;
    std::vector<pugi::xml_node> angles;
    for (const pugi::xml_node& child : track) {
        const std::string_view name = local_name(child);
        if (name == "when") { times.push_back(child); }
        if (name == "coord") { places.push_back(child); }
        if (name == "angles") { angles.push_back(child); }
    }
    if (times.size() != places.size()) {
        throw_error_at(source_.file, line_of(track),
            fmt::format(
                "expected as many places (gx:coord) as times (when), got {} and {}", places.size(), times.size()));
    }
    take_altitude_mode(track);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const auto when = time(times[i], blank_separated(times[i].child_value()).empty()
                                             ? std::string_view()
                                             : blank_separated(times[i].child_value()).front());
        Fix fix;
        if (!when || !take_coordinates(places[i], blank_separated(places[i].child_value()), fix)) {
            fixes_.skip_row();
            continue;
        }
        fix.time_s = when->seconds;
        fix.is_leap_second = when->is_leap_second;
        if (angles.size() == times.size()) {
            const auto parts = blank_separated(angles[i].child_value());
            if (!parts.empty()) { fix.heading_deg = finite_number(parts[0]).value_or(not_measured); }
            if (parts.size() == 3) {
                fix.pitch_deg = finite_number(parts[1]).value_or(not_measured);
                fix.roll_deg = finite_number(parts[2]).value_or(not_measured);
            }
        }
        fixes_.add(series, fix);
    }
    return !times.empty();
}

void XmlTrackReader::take_kml_point(const pugi::xml_node& placemark) {
    const pugi::xml_node point = child_named(placemark, "Point");
    const pugi::xml_node stamp = child_named(placemark, "TimeStamp");
    const pugi::xml_node span = child_named(placemark, "TimeSpan");
    if (!point || (!stamp && !span)) { return; }
    const auto when = stamp ? time(stamp, child_text(stamp, "when")) : time(span, child_text(span, "begin"));
    Fix fix;
    if (!when || !take_coordinates(point, split_fields(child_text(point, "coordinates"), ','), fix)) {
        fixes_.skip_row();
        return;
    }
    take_altitude_mode(point);
    fix.time_s = when->seconds;
    fix.is_leap_second = when->is_leap_second;
    fixes_.add(fixes_.series(""), fix);
}

/// The places of a line; their times are 0 until FixTable::space_out() sets them. A line that begins where the one
/// before it ended continues it, any other is one of its own.
void XmlTrackReader::take_kml_line(const pugi::xml_node& line) {
    take_altitude_mode(line);
    const pugi::xml_node coordinates = child_named(line, "coordinates");
    bool is_first = true;
    for (const std::string_view tuple : blank_separated(coordinates.child_value())) {
        Fix fix;
        if (!take_coordinates(coordinates, split_fields(tuple, ','), fix)) { continue; }
        const bool continues = last_of_lines_ && last_of_lines_->latitude_deg == fix.latitude_deg &&
                               last_of_lines_->longitude_deg == fix.longitude_deg;
        lines_read_ += is_first && !continues ? 1 : 0;
        is_first = false;
        fixes_.add(fixes_.series(fmt::format("line {}", lines_read_)), fix);
        last_of_lines_ = fix;
    }
}

TrackRecording XmlTrackReader::read_kml() {
    fixes_.time_scale = TimeScale::Utc;
    int number_of_tracks = 0;
    for_each_named("Placemark", [&](const pugi::xml_node& placemark) {
        const std::string name(child_text(placemark, "name"));
        const auto take = [&](const pugi::xml_node& track) {
            FixSeries& series = fixes_.series(fmt::format("{}", number_of_tracks + 1));
            series.call_sign = name;
            number_of_tracks += take_kml_track(track, series) ? 1 : 0;
        };
        for (const pugi::xml_node& child : placemark) {
            if (local_name(child) == "Track") { take(child); }
            if (local_name(child) != "MultiTrack") { continue; }
            for (const pugi::xml_node& track : child) {
                if (local_name(track) == "Track") { take(track); }
            }
        }
    });
    if (number_of_tracks == 0) {
        for_each_named("Placemark", [&](const pugi::xml_node& placemark) { take_kml_point(placemark); });
    }
    if (fixes_.fix_count() == 0) {
        for_each_named("LineString", [&](const pugi::xml_node& line) { take_kml_line(line); });
        fixes_.space_out();
        fixes_.keep_longest();
    }
    if (fixes_.fix_count() == 0) {
        throw_error_in(source_.file, "expected a track (gx:Track), points with times or a line (LineString), got none");
    }
    fixes_.join_in_sequence();
    return std::move(fixes_).recording(source_.follow);
}

/// True for a text whose root element has this name.
bool has_root(std::string_view text, std::string_view name) {
    constexpr std::size_t head = 4096;
    const std::string_view start = text.substr(0, head);
    const std::size_t first = start.find_first_not_of(" \t\r\n");
    return first != start.npos && start[first] == '<' && start.find(name) != start.npos;
}

} // namespace

bool is_gpx(std::string_view text) { return has_root(text, "<gpx") || has_root(text, ":gpx"); }

bool is_kml(std::string_view text) { return has_root(text, "<kml") || has_root(text, ":kml"); }

TrackRecording gpx_recording(const TrackSource& source) { return XmlTrackReader(source, "GPX").read_gpx(); }

TrackRecording kml_recording(const TrackSource& source) { return XmlTrackReader(source, "KML").read_kml(); }

} // namespace octant::flightpaths
