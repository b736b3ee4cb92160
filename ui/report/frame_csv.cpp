#include "ui/report/frame_csv.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace octant::ui::report {

namespace fs = std::filesystem;

namespace {

enum class Kind { Whole, Number, MayBeEmpty, Hash };

struct CsvColumn {
    std::string_view name;
    Kind kind;
    int decimals;
    double (*get)(const FrameRecord&);
    void (*set)(FrameRecord&, double);
    /// Of Kind::Hash, in place of get and set.
    std::optional<std::uint64_t> FrameRecord::*hash = nullptr;
    /// Whether a file without this column is no recording.
    bool required = false;
};

template <auto Member>
constexpr CsvColumn column(std::string_view name, Kind kind = Kind::Whole, int decimals = 0) {
    return {name, kind, decimals, [](const FrameRecord& record) { return static_cast<double>(record.*Member); },
        [](FrameRecord& record, double value) {
            record.*Member = static_cast<std::remove_reference_t<decltype(record.*Member)>>(value);
        }};
}

template <auto Member, int axis>
constexpr CsvColumn axis_column(std::string_view name) {
    return {name, Kind::MayBeEmpty, 3, [](const FrameRecord& record) { return (record.*Member)[axis]; },
        [](FrameRecord& record, double value) { (record.*Member)[axis] = value; }};
}

constexpr CsvColumn hash_column(std::string_view name, std::optional<std::uint64_t> FrameRecord::*hash) {
    return {name, Kind::Hash, 0, nullptr, nullptr, hash};
}

constexpr CsvColumn required(CsvColumn column) {
    column.required = true;
    return column;
}

using R = FrameRecord;
constexpr auto seconds = 6;
constexpr auto milliseconds = 4;
constexpr std::array frame_columns{
    required(column<&R::frame>("frame")),
    required(column<&R::sim_time_s>("sim_time_s", Kind::Number, seconds)),
    required(column<&R::wall_s>("wall_s", Kind::Number, seconds)),
    required(column<&R::frame_ms>("frame_ms", Kind::Number, milliseconds)),
    required(column<&R::sim_ms>("sim_ms", Kind::Number, milliseconds)),
    required(column<&R::plan_ms>("plan_ms", Kind::Number, milliseconds)),
    required(column<&R::draw_ms>("draw_ms", Kind::Number, milliseconds)),
    required(column<&R::read_ms>("read_ms", Kind::Number, milliseconds)),
    required(column<&R::terrain_triangles>("terrain_triangles")),
    required(column<&R::terrain_fans>("terrain_fans")),
    required(column<&R::aircraft_polygons>("aircraft_polygons")),
    required(column<&R::draw_cell>("draw_cell")),
    required(column<&R::resolution_c>("resolution_c", Kind::MayBeEmpty, 6)),
    required(column<&R::triangle_change>("triangle_change")),
    required(column<&R::stress>("stress", Kind::MayBeEmpty, 4)),
    required(column<&R::overrun>("overrun")),
    column<&R::warm_up>("warm_up"),
    column<&R::record_ms>("record_ms", Kind::Number, milliseconds),
    column<&R::draw_calls>("draw_calls"),
    column<&R::shadow_triangles>("shadow_triangles"),
    column<&R::transparent_triangles>("veil_triangles"),
    column<&R::cuts>("cuts"),
    column<&R::unordered>("unordered"),
    axis_column<&R::eye_m, 0>("eye_x_m"),
    axis_column<&R::eye_m, 1>("eye_y_m"),
    axis_column<&R::eye_m, 2>("eye_z_m"),
    axis_column<&R::aircraft_m, 0>("aircraft_x_m"),
    axis_column<&R::aircraft_m, 1>("aircraft_y_m"),
    axis_column<&R::aircraft_m, 2>("aircraft_z_m"),
    column<&R::aircraft_agl_m>("aircraft_agl_m", Kind::MayBeEmpty, 3),
    column<&R::triangle_target>("triangle_target"),
    column<&R::detail_triangles>("fine_triangles"),
    column<&R::scenery_triangles>("scenery_triangles"),
    column<&R::error_px>("error_px", Kind::MayBeEmpty, 4),
    column<&R::latency_ms>("latency_ms", Kind::MayBeEmpty, milliseconds),
    column<&R::missed>("missed"),
    column<&R::smooth_polygons>("smooth_polygons"),
    column<&R::smooth_target>("smooth_target"),
    column<&R::aircraft_level>("aircraft_level"),
    column<&R::refine_splits>("refine_splits"),
    column<&R::refine_collapses>("refine_collapses"),
    column<&R::refine_ms>("refine_ms", Kind::Number, milliseconds),
    column<&R::mesh_wait_ms>("mesh_wait_ms", Kind::Number, milliseconds),
    column<&R::draw_wait_ms>("draw_wait_ms", Kind::Number, milliseconds),
    column<&R::packets>("packets"),
    column<&R::packets_lost>("packets_lost", Kind::MayBeEmpty),
    column<&R::packets_late>("packets_late"),
    column<&R::packets_wrong>("packets_wrong"),
    column<&R::stale>("stale"),
    column<&R::jitter_ms>("jitter_ms", Kind::Number, milliseconds),
    column<&R::host_frame>("host_frame"),
    column<&R::skew_frames>("skew_frames"),
    hash_column("state_hash", &R::state_hash),
    hash_column("picture_hash", &R::picture_hash),
};

std::string header_line() {
    std::string line;
    for (const CsvColumn& each : frame_columns) {
        line += line.empty() ? "" : ",";
        line += each.name;
    }
    return line;
}

std::string field_text(const CsvColumn& column, const FrameRecord& record) {
    if (column.kind == Kind::Hash) {
        const auto& hash = record.*column.hash;
        return hash ? fmt::format("{:016x}", *hash) : std::string();
    }
    const double value = column.get(record);
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, column.decimals) : std::string();
}

/// 16 hexadecimal digits.
std::optional<std::uint64_t> hash_from(std::string_view text) {
    constexpr std::size_t digits = 16;
    constexpr int hexadecimal = 16;
    std::uint64_t hash = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, hash, hexadecimal);
    const bool whole = text.size() == digits && read.ec == std::errc() && read.ptr == end;
    return whole ? std::optional(hash) : std::nullopt;
}

/// The column's value from its text, or nothing when the text does not fit the column.
std::optional<double> field_value(const CsvColumn& column, std::string_view text) {
    if (column.kind == Kind::Whole) {
        const auto whole = whole_number(text);
        const bool fits =
            whole && *whole >= std::numeric_limits<int>::min() && *whole <= std::numeric_limits<int>::max();
        return fits ? std::optional(static_cast<double>(*whole)) : std::nullopt;
    }
    if (text.empty() && column.kind == Kind::MayBeEmpty) { return std::numeric_limits<double>::quiet_NaN(); }
    return finite_number(text);
}

/// Sets the column's value from its text; false when the text does not fit the column.
bool set_field(const CsvColumn& column, std::string_view text, FrameRecord& record) {
    if (column.kind == Kind::Hash) {
        record.*column.hash = hash_from(text);
        return text.empty() || record.*column.hash;
    }
    const auto value = field_value(column, text);
    if (value) { column.set(record, *value); }
    return value.has_value();
}

std::string_view is_required_by(Kind kind) {
    return kind == Kind::Whole ? "whole number" : kind == Kind::Hash ? "hash" : "number";
}

/// For each field of the header its column's number, one past the last for what is not ours.
std::vector<std::size_t> read_header(
    const std::filesystem::path& path, std::string_view line, std::span<const std::string_view> required_columns) {
    std::vector<std::size_t> order;
    for (const std::string_view name : split_fields(line, ',')) {
        const auto found = std::find_if(
            frame_columns.begin(), frame_columns.end(), [&](const CsvColumn& each) { return each.name == name; });
        const auto column = static_cast<std::size_t>(found - frame_columns.begin());
        if (found != frame_columns.end() && std::find(order.begin(), order.end(), column) != order.end()) {
            throw_error_at(path, 1, fmt::format("expected column {} once, got it twice", name));
        }
        order.push_back(column);
    }
    for (std::size_t i = 0; i < frame_columns.size(); ++i) {
        const std::string_view name = frame_columns[i].name;
        const bool is_needed = frame_columns[i].required || std::find(required_columns.begin(), required_columns.end(),
                                                                name) != required_columns.end();
        if (is_needed && std::find(order.begin(), order.end(), i) == order.end()) {
            throw_error_at(path, 1, fmt::format("expected a column {}, got '{}'", name, printable(std::string(line))));
        }
    }
    return order;
}

FrameRecord read_line(
    const std::filesystem::path& path, int line_number, std::string_view line, const std::vector<std::size_t>& order) {
    const auto fields = split_fields(line, ',');
    if (fields.size() != order.size()) {
        throw_error_at(path, line_number, fmt::format("expected {} fields, got {}", order.size(), fields.size()));
    }
    FrameRecord record;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (order[i] == frame_columns.size()) { continue; }
        const CsvColumn& column = frame_columns[order[i]];
        if (!set_field(column, fields[i], record)) {
            throw_error_at(path, line_number,
                fmt::format("expected a {} in column {}, got '{}'", is_required_by(column.kind), column.name,
                    printable(std::string(fields[i]))));
        }
    }
    return record;
}

} // namespace

std::string frame_csv_header() { return header_line() + "\n"; }

std::string frame_csv_line(const FrameRecord& record) {
    std::string line;
    for (const CsvColumn& each : frame_columns) {
        line += line.empty() ? "" : ",";
        line += field_text(each, record);
    }
    return line + "\n";
}

FrameRecord rounded_as_csv(const FrameRecord& record) {
    FrameRecord rounded;
    for (const CsvColumn& each : frame_columns) {
        if (each.kind == Kind::Hash) {
            rounded.*each.hash = record.*each.hash;
            continue;
        }
        const std::string text = field_text(each, record);
        each.set(rounded, finite_number(text).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    rounded.counters = record.counters;
    return rounded;
}

FrameReader::FrameReader(fs::path path, std::span<const std::string_view> required_columns)
    : path_(std::move(path)), lines_(TextScanner::of_file(path_)) {
    const bool has_header = lines_.next_line();
    is_truncated_ = has_header && lines_.is_truncated();
    ended_ = !has_header || (is_truncated_ && header_line().starts_with(lines_.line()));
    if (!ended_) { columns_ = read_header(path_, lines_.line(), required_columns); }
}

std::optional<FrameRecord> FrameReader::next() {
    const bool has_line = !ended_ && lines_.next_line();
    is_truncated_ = has_line ? lines_.is_truncated() : is_truncated_;
    if (!has_line || is_truncated_) {
        ended_ = true;
        return std::nullopt;
    }
    FrameRecord record = read_line(path_, lines_.line_number(), lines_.line(), columns_);
    if (last_frame_ && record.frame <= *last_frame_) {
        lines_.refuse(fmt::format("a frame after {}", *last_frame_), std::to_string(record.frame));
    }
    last_frame_ = record.frame;
    return record;
}

FrameFile read_frame_csv(const fs::path& path, std::span<const std::string_view> required_columns) {
    FrameReader reader(path, required_columns);
    FrameFile file;
    while (const auto record = reader.next()) { file.records.push_back(*record); }
    file.is_truncated = reader.is_truncated();
    return file;
}

} // namespace octant::ui::report
