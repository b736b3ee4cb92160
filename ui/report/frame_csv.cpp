#include "ui/report/frame_csv.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/report/table.h"

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

/// A column of frames.csv, which can be read back.
struct FrameColumn : Column<FrameRecord> {
    void (*set)(FrameRecord&, double) = nullptr;
    std::optional<std::uint64_t> FrameRecord::*hash = nullptr; ///< of Hash, in place of `set`
    bool is_required = false;                                  ///< a file without this column is no recording
};

template <auto Member>
constexpr FrameColumn frame_column(std::string_view key, int decimals, std::string_view definition) {
    return {column<Member>(key, key, decimals, definition), [](FrameRecord& record, double value) {
                record.*Member = static_cast<std::remove_reference_t<decltype(record.*Member)>>(value);
            }};
}

/// A coordinate of a place.
template <auto Member, int axis>
constexpr FrameColumn axis_column(std::string_view key, std::string_view definition) {
    FrameColumn made;
    made.key = key;
    made.decimals = 3;
    made.definition = definition;
    made.is_signed = true;
    made.value = [](const FrameRecord& record) { return (record.*Member)[axis]; };
    made.set = [](FrameRecord& record, double value) { (record.*Member)[axis] = value; };
    made.is_optional = true;
    return made;
}

template <auto Member>
constexpr FrameColumn frame_hash_column(std::string_view key, std::string_view definition) {
    return {hash_column<Member>(key, key, definition), nullptr, Member};
}

constexpr FrameColumn required(FrameColumn column) {
    column.is_required = true;
    return column;
}

/// The same, for a value that some rows do not have: it is not finite there.
constexpr FrameColumn optional(FrameColumn column) {
    column.is_optional = true;
    return column;
}

using R = FrameRecord;
constexpr auto seconds = 6;
constexpr auto milliseconds = 4;
constexpr std::array frame_columns{
    required(frame_column<&R::frame>("frame", 0, "Number of the frame, from 0.")),
    required(frame_column<&R::sim_time_s>("sim_time_s", seconds, "Simulated time.")),
    required(frame_column<&R::wall_s>("wall_s", seconds, "When the frame began, since the first frame began.")),
    required(frame_column<&R::frame_ms>("frame_ms", milliseconds,
        "From the frame's first simulation step to its pixels read back; writing files is outside it.")),
    required(frame_column<&R::sim_ms>("sim_ms", milliseconds, "Stage of frame_ms: simulation.")),
    required(frame_column<&R::plan_ms>("plan_ms", milliseconds, "Stage of frame_ms: plan of the picture.")),
    required(frame_column<&R::draw_ms>("draw_ms", milliseconds, "Stage of frame_ms: drawing.")),
    required(frame_column<&R::read_ms>("read_ms", milliseconds, "Stage of frame_ms: reading pixels.")),
    required(frame_column<&R::terrain_triangles>("terrain_triangles", 0, "Triangles of ground.")),
    required(frame_column<&R::terrain_fans>("terrain_fans", 0, "Fans of the paper's quadtree.")),
    required(frame_column<&R::aircraft_polygons>(
        "aircraft_polygons", 0, "Polygons in the lists drawn, before those that face away are left out.")),
    required(frame_column<&R::draw_cell>("draw_cell", 0, "Cell of the first aircraft's painting order.")),
    required(optional(frame_column<&R::resolution_c>("resolution_c", 6, "C of the paper's quadtree."))),
    required(with_sign(
        frame_column<&R::triangle_change>("triangle_change", 0, "terrain_triangles less those of the frame before."))),
    required(optional(frame_column<&R::stress>(
        "stress", 4, "frame_ms over the frame's share of simulated time; filtered where the ground adapts."))),
    required(frame_column<&R::overrun>("overrun", 0, "1 when frame_ms is above 16.67.")),
    frame_column<&R::warm_up>("warm_up", 0, "1 where statistics leave the frame out."),
    frame_column<&R::paused>("paused", 0,
        "1 when the program was stopped during the frame (SIGSTOP), as in the turns of octant compare: statistics "
        "leave it out."),
    frame_column<&R::record_ms>("record_ms", milliseconds, "Writing pictures and video, after the frame."),
    frame_column<&R::draw_calls>(
        "draw_calls", 0, "Calls of the graphics library; of the raster renderer its painting steps."),
    frame_column<&R::shadow_triangles>("shadow_triangles", 0, "Pieces of shadows."),
    frame_column<&R::transparent_triangles>("veil_triangles", 0, "Clouds and all else that is transparent."),
    frame_column<&R::cuts>(
        "cuts", 0, "Ground triangles and polygons painted again in front of an aircraft, cut to its outline."),
    frame_column<&R::unordered>("unordered", 0,
        "Aircraft painted by depth among themselves, because they meet others or the ground in too many places."),
    axis_column<&R::eye_m, 0>("eye_x_m", "Eye point, east."),
    axis_column<&R::eye_m, 1>("eye_y_m", "Eye point, north."),
    axis_column<&R::eye_m, 2>("eye_z_m", "Eye point, up."),
    axis_column<&R::aircraft_m, 0>("aircraft_x_m", "First aircraft, east."),
    axis_column<&R::aircraft_m, 1>("aircraft_y_m", "First aircraft, north."),
    axis_column<&R::aircraft_m, 2>("aircraft_z_m", "First aircraft, up."),
    optional(
        with_sign(frame_column<&R::aircraft_agl_m>("aircraft_agl_m", 3, "First aircraft above the ground below it."))),
    frame_column<&R::triangle_target>("triangle_target", 0, "How many terrain_triangles the frame was to have."),
    frame_column<&R::detail_triangles>("fine_triangles", 0, "Of terrain_triangles: detail near the eye."),
    frame_column<&R::scenery_triangles>(
        "scenery_triangles", 0, "Of terrain_triangles: trees, houses, roads and the runway."),
    optional(frame_column<&R::error_px>("error_px", 4,
        "How many pixels any sample of the ground in the picture may lie from its triangles, without detail near the "
        "eye; 0 where C decides.")),
    optional(frame_column<&R::latency_ms>("latency_ms", milliseconds,
        "Time from the input shown, or from when the frame was due, to the finished picture; empty unless the flight "
        "follows the clock.")),
    frame_column<&R::missed>(
        "missed", 0, "By the clock only: 1 when the picture came later than the next one was due."),
    frame_column<&R::smooth_polygons>(
        "smooth_polygons", 0, "Polygons that are lit smoothly, painted or not, with all triangles of refined meshes."),
    with_sign(frame_column<&R::smooth_target>(
        "smooth_target", 0, "How many smooth_polygons the frame was to have; -1: a share decides.")),
    frame_column<&R::aircraft_level>("aircraft_level", 0, "Level of detail of the first aircraft; 0 = finest."),
    frame_column<&R::refine_splits>("refine_splits", 0, "Vertex splits of refined meshes."),
    frame_column<&R::refine_collapses>("refine_collapses", 0, "Edge collapses of refined meshes."),
    frame_column<&R::refine_ms>("refine_ms", milliseconds, "Of plan_ms: placing aircraft and refining their meshes."),
    frame_column<&R::mesh_wait_ms>(
        "mesh_wait_ms", milliseconds, "Of plan_ms: waiting for ground that is meshed ahead."),
    frame_column<&R::draw_wait_ms>("draw_wait_ms", milliseconds, "Of draw_ms: the thread that draws had no processor."),
    frame_column<&R::packets>(
        "packets", 0, "Motion from outside: packets since the frame before that moved something."),
    optional(frame_column<&R::packets_lost>(
        "packets_lost", 0, "The same: lost, by the numbers of MAVLink and CIGI; empty where senders number none.")),
    frame_column<&R::packets_late>("packets_late", 0, "The same: dropped because they came too late."),
    frame_column<&R::packets_wrong>("packets_wrong", 0, "The same: of no known form."),
    frame_column<&R::stale>("stale", 0, "1 if an aircraft stopped because packets are missing."),
    frame_column<&R::jitter_ms>("jitter_ms", milliseconds, "How much later than the quickest packets come, mean."),
    with_sign(
        frame_column<&R::host_frame>("host_frame", 0, "Frame of the CIGI host that the picture shows; -1 = none.")),
    with_sign(frame_column<&R::skew_frames>(
        "skew_frames", 0, "Of a CIGI host: how many of its frames the last channel is behind; -1 = none.")),
    frame_hash_column<&R::state_hash>("state_hash", "Over the states of all aircraft at every step up to the picture."),
    frame_hash_column<&R::picture_hash>("picture_hash", "Over the picture's pixels; empty in a window."),
};

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

/// Sets the column's value from its text; false when the text does not fit the column.
bool set_field(const FrameColumn& column, std::string_view text, FrameRecord& record) {
    if (text.empty() && column.is_optional) {
        if (column.hash == nullptr) { column.set(record, std::numeric_limits<double>::quiet_NaN()); }
        return true;
    }
    if (column.hash != nullptr) {
        record.*column.hash = hash_from(text);
        return (record.*column.hash).has_value();
    }
    std::optional<double> value = finite_number(text);
    if (column.kind != ColumnKind::Number) {
        const auto whole = whole_number(text);
        const bool fits =
            whole && *whole >= std::numeric_limits<int>::min() && *whole <= std::numeric_limits<int>::max();
        value = fits ? std::optional(static_cast<double>(*whole)) : std::nullopt;
    }
    if (value) { column.set(record, *value); }
    return value.has_value();
}

std::string_view text_of(ColumnKind kind) {
    return kind == ColumnKind::Number ? "number" : kind == ColumnKind::Hash ? "hash" : "whole number";
}

FrameRecord read_row(const ColumnReader& table) {
    table.check_field_count();
    FrameRecord record;
    for (std::size_t i = 0; i < frame_columns.size(); ++i) {
        const FrameColumn& column = frame_columns[i];
        if (table.has(i) && !set_field(column, table.text(i), record)) {
            table.refuse(fmt::format("a {} in column {}", text_of(column.kind), column.key), in_quotes(table.text(i)));
        }
    }
    return record;
}

} // namespace

std::string frame_csv_header() { return csv_header(frame_columns); }

std::string frame_csv_line(const FrameRecord& record) { return csv_line(frame_columns, record); }

base::JsonValue frame_schema() { return schema_of(frame_columns); }

FrameRecord rounded_as_csv(const FrameRecord& record) {
    FrameRecord rounded;
    for (const FrameColumn& each : frame_columns) {
        if (each.hash != nullptr) {
            rounded.*each.hash = record.*each.hash;
            continue;
        }
        const std::string text = text_of(each, record);
        each.set(rounded, finite_number(text).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    rounded.counters = record.counters;
    return rounded;
}

FrameReader::FrameReader(const fs::path& path, std::span<const std::string_view> required_columns)
    : table_(TextScanner::of_file(path), ',') {
    const bool has_header = table_.next_row();
    is_truncated_ = has_header && table_.is_truncated();
    ended_ = !has_header || (is_truncated_ && frame_csv_header().starts_with(table_.row()));
    if (ended_) { return; }
    std::vector<TableColumn> columns;
    for (const FrameColumn& column : frame_columns) {
        const bool is_asked_for = std::ranges::find(required_columns, column.key) != required_columns.end();
        columns.push_back({column.key, column.is_required || is_asked_for});
    }
    table_.find(columns);
}

std::optional<FrameRecord> FrameReader::next() {
    const bool has_row = !ended_ && table_.next_row();
    is_truncated_ = has_row ? table_.is_truncated() : is_truncated_;
    if (!has_row || is_truncated_) {
        ended_ = true;
        return std::nullopt;
    }
    FrameRecord record = read_row(table_);
    if (last_frame_ && record.frame <= *last_frame_) {
        table_.refuse(fmt::format("a frame after {}", *last_frame_), std::to_string(record.frame));
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
