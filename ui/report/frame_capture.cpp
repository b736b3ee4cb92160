#include "ui/report/frame_capture.h"

#include "sim/base/column_reader.h"
#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

namespace octant::ui::report {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t max_frames = 20'000'000;
constexpr std::size_t max_streams = 1000;
constexpr std::size_t max_json_bytes = std::size_t{64} << 20;
constexpr double max_frame_time = 1e9; ///< milliseconds or microseconds
constexpr double max_span_s = 1e7;
constexpr const char* expected_formats =
    "a zip file of a recording, or frame times of PresentMon, CapFrameX or MangoHud";

/// A decimal number, with a point or a comma.
std::optional<double> decimal_number(std::string_view text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) { return finite_number(text); }
    if (text.find('.') != std::string_view::npos) { return std::nullopt; }
    std::string with_point(text);
    with_point[comma] = '.';
    return finite_number(with_point);
}

bool is_same(std::string_view text, std::string_view lower_case) {
    return std::ranges::equal(text, lower_case, {}, [](unsigned char c) { return std::tolower(c); });
}

/// True for what stands in place of a value that was not measured.
bool is_missing(std::string_view text) {
    constexpr std::array<std::string_view, 4> words{"", "na", "nan", "-nan"};
    return std::ranges::any_of(words, [&](std::string_view word) { return is_same(text, word); });
}

/// Adds an entry of the file to the run if it tells about the machine.
void add_machine_value(RunFile& run, std::string_view name, std::string_view value) {
    struct Entry {
        std::string_view name; ///< in lower case
        const char* row;
    };

    constexpr std::array entries{Entry{"cpu", "cpu"}, Entry{"processor", "cpu"}, Entry{"gpu", "gpu"}, Entry{"os", "os"},
        Entry{"kernel", "kernel"}, Entry{"driver", "driver"}, Entry{"gpudriverversion", "driver"},
        Entry{"ram", "memory"}, Entry{"system ram", "memory"}, Entry{"systemram", "memory"},
        Entry{"motherboard", "motherboard"}, Entry{"comment", "comment"}};
    const auto found = std::ranges::find_if(entries, [&](const Entry& entry) { return is_same(name, entry.name); });
    if (found == entries.end() || value.empty() || !value_of(run.machine, found->row).empty()) { return; }
    run.machine.emplace_back(found->row, printable(std::string(value)));
}

/// The rows of one swap chain of one application.
struct FrameStream {
    std::string application;
    std::vector<FrameTime> frames; ///< with times as the file has them
    bool has_times = true;
    long dropped = 0;
    long missing = 0;
    long generated = 0;
};

/// What is done with a frame time of 0 or more; nothing where it is refused.
bool add_frame(FrameStream& stream, double frame_time, std::optional<double> time_s) {
    if (frame_time < 0.0 || frame_time > max_frame_time) { return false; }
    if (frame_time == 0.0) {
        ++stream.missing;
        return true;
    }
    stream.has_times = stream.has_times && time_s.has_value();
    stream.frames.push_back({time_s.value_or(0.0), frame_time});
    return true;
}

void add_note(RunFile& run, std::string note) { run.facts.emplace_back("note", std::move(note)); }

bool has_rising_times(const FrameStream& stream) {
    return stream.has_times && std::ranges::is_sorted(stream.frames, {}, &FrameTime::time_s);
}

/// Removes frame times that are far longer than all of the capture, as MangoHud may write them.
void remove_impossible(FrameStream& stream, RunFile& run) {
    if (stream.frames.empty() || !has_rising_times(stream)) { return; }
    const double span_s = stream.frames.back().time_s - stream.frames.front().time_s;
    const double max_frame_ms = 1e3 * (10.0 * span_s + 10.0);
    const auto removed =
        std::erase_if(stream.frames, [&](const FrameTime& frame) { return frame.frame_ms > max_frame_ms; });
    if (removed > 0) { add_note(run, fmt::format("frame times far longer than the capture, left out: {}", removed)); }
}

/// Makes the times begin at 0. Where there are none or they cannot be right, a frame's time is the sum of the frame
/// times up to it.
void correct_times(FrameStream& stream, RunFile& run) {
    remove_impossible(stream, run);
    std::vector<FrameTime>& frames = stream.frames;
    if (frames.empty()) { return; }
    const double begin_s = frames.front().time_s;
    const double span_s = frames.back().time_s - begin_s;
    const bool rises = has_rising_times(stream);
    double sum_s = 0.0;
    for (const FrameTime& frame : std::span(frames).subspan(1)) { sum_s += 1e-3 * frame.frame_ms; }
    if (rises && span_s <= max_span_s && span_s >= 0.5 * sum_s) {
        for (FrameTime& frame : frames) { frame.time_s -= begin_s; }
        if (span_s > 1.5 * sum_s) {
            const auto rows = static_cast<double>(frames.size() - 1);
            add_note(
                run, fmt::format("rows are {:.1f} ms apart and frames take {:.1f} ms, both in the mean: some frames "
                                 "are not in the file, or the time between frames does not count",
                         1e3 * span_s / rows, 1e3 * sum_s / rows));
        }
        return;
    }
    if (stream.has_times) {
        add_note(run, fmt::format("the times of the frames {}; the sum of the frame times is taken in their place",
                          rises ? "do not fit the frame times" : "go back"));
    }
    double time_s = 0.0;
    for (FrameTime& frame : frames) {
        frame.time_s = time_s + (&frame == &frames.front() ? 0.0 : 1e-3 * frame.frame_ms);
        time_s = frame.time_s;
    }
}

void add_count_notes(const FrameStream& stream, RunFile& run) {
    if (stream.dropped > 0) {
        add_note(run, fmt::format("{} of {} frames were dropped (never shown); their times count", stream.dropped,
                          stream.frames.size()));
    }
    if (stream.missing > 0) { add_note(run, fmt::format("rows without a frame time, left out: {}", stream.missing)); }
    if (stream.generated > 0) {
        add_note(run, fmt::format("rows of frames that the driver generated, left out: {}", stream.generated));
    }
}

/// The stream with the most frames, with a note about the others.
FrameStream longest_stream(std::vector<FrameStream> streams, RunFile& run) {
    constexpr std::size_t max_named = 4;
    const auto more = [](const FrameStream& a, const FrameStream& b) { return a.frames.size() > b.frames.size(); };
    std::ranges::stable_sort(streams, more);
    std::string others;
    for (std::size_t i = 1; i < std::min(streams.size(), 1 + max_named); ++i) {
        others += fmt::format("{}{} ({})", i > 1 ? ", " : "", streams[i].application, streams[i].frames.size());
    }
    if (streams.size() > 1 + max_named) { others += fmt::format(" and {} more", streams.size() - 1 - max_named); }
    if (!others.empty()) {
        add_note(
            run, fmt::format("of {} swap chains only that with the most frames is taken, {} ({} frames); left out: {}",
                     streams.size(), streams.front().application, streams.front().frames.size(), others));
    }
    return std::move(streams.front());
}

/// What all formats do at the end of a file.
FrameCapture finished(FrameCapture capture, const fs::path& path, std::string_view application) {
    if (capture.frames.empty()) { throw_error_in(path, "expected frame times, got only impossible ones"); }
    RunFile& run = capture.run;
    run.title = application.empty() ? printable(path.stem().string()) : std::string(application);
    if (!application.empty()) { run.facts.insert(run.facts.begin(), {application_fact, run.title}); }
    run.facts.insert(run.facts.begin(), {"recorded with", capture.format});
    run.machine_info.cpu = value_of(run.machine, "cpu");
    run.machine_info.os = value_of(run.machine, "os");
    run.machine_info.kernel = value_of(run.machine, "kernel");
    run.device = value_of(run.machine, "gpu");
    return capture;
}

// Tables: PresentMon and the programs that write its columns, and MangoHud.

enum CaptureColumn : std::size_t {
    frame_time_column,
    second_part_column, ///< to be added to the frame time
    seconds_column,
    milliseconds_column,
    nanoseconds_column,
    fps_column,
    application_column,
    process_column,
    swap_chain_column,
    frame_type_column,
    dropped_column,
    until_displayed_column,
    displayed_column,
};

/// Where the rows of frames begin, and what stands before them.
struct TableHead {
    std::vector<std::string> lines; ///< before the names of the columns
    std::vector<std::string> names;
    char separator = ',';
    std::string format;
    std::array<std::string_view, 2> frame_time; ///< column, or two columns whose sum it is
};

/// Recognises the names of the columns of a format.
bool recognise(TableHead& head, std::span<const std::string_view> fields) {
    const auto has = [&](std::string_view name) { return field_named(fields, name).has_value(); };
    head.format = "PresentMon CSV";
    if (has("MsBetweenPresents")) {
        head.frame_time = {"MsBetweenPresents", ""};
    } else if (has("fps") && has("frametime")) {
        head.format = "MangoHud log";
        head.frame_time = {"frametime", ""};
    } else if (has("Application") && has("FrameTime")) {
        head.frame_time = {"FrameTime", ""};
    } else if (has("Application") && has("MsBetweenAppStart")) {
        head.frame_time = {"MsBetweenAppStart", ""};
    } else if (has("Application") && has("CPUBusy") && has("CPUWait")) {
        head.frame_time = {"CPUBusy", "CPUWait"};
    } else {
        return false;
    }
    if (std::ranges::any_of(head.lines, [](const std::string& line) { return line.starts_with("//"); })) {
        head.format = "CapFrameX CSV";
    }
    head.names.assign(fields.begin(), fields.end());
    return true;
}

/// Reads to the line that names the columns.
TableHead read_head(const fs::path& path) {
    constexpr std::size_t max_lines = 100;
    TableHead head;
    TextScanner lines = TextScanner::of_file(path);
    while (head.lines.size() < max_lines && lines.next_line()) {
        head.separator = separator_of(lines.line());
        const bool is_comment = lines.line().starts_with('#');
        if (!is_comment && recognise(head, table_fields(lines.line(), head.separator))) { return head; }
        head.lines.emplace_back(lines.line());
    }
    const auto first = std::ranges::find_if(head.lines, [](const std::string& line) { return !line.empty(); });
    throw_error_at(path, 1,
        fmt::format(
            "expected {}, got {}", expected_formats, first == head.lines.end() ? "an empty file" : in_quotes(*first)));
}

/// Adds what stands before the rows: "//GPU=..." of CapFrameX, a line of names and one of values of MangoHud. Gives the
/// application, empty where none is named.
std::string add_head_values(const TableHead& head, RunFile& run) {
    std::string application;
    for (std::size_t i = 0; i < head.lines.size(); ++i) {
        const std::string_view line = head.lines[i];
        if (line.starts_with("//") && line.find('=') != std::string_view::npos) {
            const std::string_view name = line.substr(2, line.find('=') - 2);
            const std::string_view value = line.substr(line.find('=') + 1);
            if (is_same(name, "gamename")) { application = printable(std::string(value)); }
            add_machine_value(run, name, value);
            continue;
        }
        const auto names = table_fields(line, ',');
        if (i + 1 == head.lines.size() || !field_named(names, "cpu")) { continue; }
        const auto values = table_fields(head.lines[i + 1], ',');
        for (std::size_t k = 0; names.size() == values.size() && k < names.size(); ++k) {
            add_machine_value(run, names[k], values[k]);
        }
    }
    return application;
}

/// Reads the rows of a table.
class CaptureTable {
public:
    CaptureTable(const fs::path& path, const TableHead& head)
        : head_(head), table_(TextScanner::of_file(path), head.separator) {
        while (table_.next_row() && table_.line_number() <= static_cast<int>(head.lines.size())) {}
        const std::array<TableColumn, displayed_column + 1> columns{{{head.frame_time[0]}, {head.frame_time[1]},
            {"TimeInSeconds"}, {"TimeInMs"}, {"elapsed"}, {"fps"}, {"Application"}, {"ProcessID"}, {"SwapChainAddress"},
            {"FrameType"}, {"Dropped"}, {"MsUntilDisplayed"}, {"DisplayedTime"}}};
        table_.find(columns);
    }

    void read(RunFile& run) {
        std::size_t rows = 0;
        std::size_t fields_before = 0;
        while (table_.next_row()) {
            const std::size_t fields = table_.fields().size();
            if (table_.is_truncated() && (fields < fields_before || !table_.reaches(frame_time_column))) {
                add_note(run, "the last line is cut short and left out");
                break;
            }
            if (rows++ == max_frames) { table_.refuse(fmt::format("at most {} rows", max_frames), "more"); }
            for (std::size_t i = 0; rows == 1 && i < std::min(fields, head_.names.size()); ++i) {
                add_machine_value(run, head_.names[i], table_.fields()[i]);
            }
            add_row();
            fields_before = fields;
        }
        if (std::ranges::all_of(streams, [](const FrameStream& stream) { return stream.frames.empty(); })) {
            table_.refuse("a row with a frame time", "none");
        }
        if (2 * microsecond_rows_ > rows_with_rate_) {
            for (FrameStream& stream : streams) {
                for (FrameTime& frame : stream.frames) { frame.frame_ms *= 1e-3; }
            }
            add_note(run, "frame times are in microseconds, by the column fps");
        }
    }

    std::vector<FrameStream> streams;

private:
    std::string_view text(CaptureColumn column) const {
        return table_.reaches(column) ? table_.text(column) : std::string_view();
    }

    /// Nothing where the value is missing.
    std::optional<double> number(CaptureColumn column, std::string_view what) const {
        if (is_missing(text(column))) { return std::nullopt; }
        const auto value = decimal_number(text(column));
        if (!value) { table_.refuse(what, in_quotes(text(column))); }
        return value;
    }

    std::optional<double> time_s() const {
        for (const auto& [column, unit_s] : {std::pair(seconds_column, 1.0), std::pair(milliseconds_column, 1e-3),
                 std::pair(nanoseconds_column, 1e-9)}) {
            if (!table_.has(column)) { continue; }
            const auto time = number(column, "the time of a frame");
            return time ? std::optional(*time * unit_s) : std::nullopt;
        }
        return std::nullopt;
    }

    FrameStream& stream_of_row() {
        std::string key;
        for (const CaptureColumn column : {application_column, process_column, swap_chain_column}) {
            key += fmt::format("{}\n", text(column));
        }
        const auto [found, is_new] = stream_of_.try_emplace(std::move(key), streams.size());
        if (is_new) {
            if (streams.size() == max_streams) {
                table_.refuse(fmt::format("at most {} swap chains", max_streams), "more");
            }
            streams.emplace_back().application = printable(std::string(text(application_column)));
        }
        return streams[found->second];
    }

    void add_row() {
        const std::vector<std::string_view>& fields = table_.fields();
        const std::size_t names = head_.names.size();
        if (!table_.reaches(frame_time_column) || (fields.size() > names && !fields[names].empty())) {
            table_.refuse(fmt::format("{} fields", names), std::to_string(fields.size()));
        }
        FrameStream& stream = stream_of_row();
        if (constexpr std::array<std::string_view, 4> own{"application", "notset", "not set", "unspecified"};
            !is_missing(text(frame_type_column)) &&
            std::ranges::none_of(own, [&](std::string_view type) { return is_same(text(frame_type_column), type); })) {
            ++stream.generated;
            return;
        }
        constexpr const char* what = "a frame time of 0 to 1e9 ms";
        const auto first_part = number(frame_time_column, what);
        if (!first_part) {
            ++stream.missing;
            return;
        }
        const double frame_time = *first_part + number(second_part_column, what).value_or(0.0);
        if (!add_frame(stream, frame_time, time_s())) { table_.refuse(what, in_quotes(text(frame_time_column))); }
        const bool is_never_shown =
            is_same(text(until_displayed_column), "na") || is_same(text(displayed_column), "na");
        stream.dropped += is_same(text(dropped_column), "1") || is_never_shown ? 1 : 0;
        constexpr double between_units = 31'623.0; // the product of rate and frame time is 1e3 or 1e6
        const double rate = number(fps_column, "a number of frames per second").value_or(0.0);
        rows_with_rate_ += rate > 0.0 ? 1 : 0;
        microsecond_rows_ += rate * frame_time > between_units ? 1 : 0;
    }

    const TableHead& head_;
    ColumnReader table_;
    std::map<std::string, std::size_t> stream_of_;
    long rows_with_rate_ = 0;
    long microsecond_rows_ = 0;
};

FrameCapture read_table(const fs::path& path) {
    const TableHead head = read_head(path);
    FrameCapture capture;
    capture.format = head.format;
    capture.run.facts.emplace_back("frame time is",
        fmt::format("{}{}{}", head.frame_time[0], head.frame_time[1].empty() ? "" : " + ", head.frame_time[1]));
    std::string application = add_head_values(head, capture.run);
    CaptureTable table(path, head);
    table.read(capture.run);
    FrameStream stream = longest_stream(std::move(table.streams), capture.run);
    add_count_notes(stream, capture.run);
    correct_times(stream, capture.run);
    capture.frames = std::move(stream.frames);
    if (!stream.application.empty()) { application = stream.application; }
    return finished(std::move(capture), path, application);
}

// CapFrameX JSON.

const Json* find_member(const Json& json, const char* name) {
    const auto found = json.is_object() ? json.find(name) : json.end();
    return found == json.end() ? nullptr : &*found;
}

/// The list of that name, which may be missing; then empty.
const Json& list_in(const Json& json, const char* name) {
    static const Json none = Json::array();
    const Json* const list = find_member(json, name);
    return list != nullptr && list->is_array() ? *list : none;
}

FrameStream read_run(const fs::path& path, const Json& capture) {
    const Json& frame_times = list_in(capture, "MsBetweenPresents");
    const Json& times = list_in(capture, "TimeInSeconds");
    const Json& dropped = list_in(capture, "Dropped");
    FrameStream stream;
    for (std::size_t i = 0; i < frame_times.size(); ++i) {
        if (frame_times[i].is_null()) {
            ++stream.missing;
            continue;
        }
        const bool has_time = i < times.size() && times[i].is_number();
        const double frame_time = frame_times[i].is_number() ? frame_times[i].get<double>() : -1.0;
        if (!add_frame(stream, frame_time, has_time ? std::optional(times[i].get<double>()) : std::nullopt)) {
            throw_error_in(
                path, fmt::format("expected a frame time of 0 to 1e9 ms as element {} of MsBetweenPresents, got {}", i,
                          in_quotes(frame_times[i].dump(-1, ' ', false, Json::error_handler_t::replace))));
        }
        stream.dropped += i < dropped.size() && dropped[i].is_boolean() && dropped[i].get<bool>() ? 1 : 0;
    }
    return stream;
}

FrameCapture read_json(const fs::path& path) {
    const Json json = parsed_json(path, read_text_file(path, max_json_bytes));
    FrameCapture capture;
    capture.format = "CapFrameX JSON";
    FrameStream all;
    int runs = 0;
    for (const Json& run : list_in(json, "Runs")) {
        const Json* const data = find_member(run, "CaptureData");
        FrameStream stream = data != nullptr ? read_run(path, *data) : FrameStream();
        correct_times(stream, capture.run);
        if (stream.frames.empty()) { continue; }
        const double shift_s =
            all.frames.empty() ? 0.0 : all.frames.back().time_s + 1e-3 * stream.frames.front().frame_ms;
        for (const FrameTime& frame : stream.frames) { all.frames.push_back({frame.time_s + shift_s, frame.frame_ms}); }
        all.dropped += stream.dropped;
        all.missing += stream.missing;
        ++runs;
    }
    if (all.frames.empty()) {
        throw_error_in(path, fmt::format("expected {}, got JSON without frame times in \"Runs\"", expected_formats));
    }
    if (runs > 1) { add_note(capture.run, fmt::format("{} runs, taken one after the other", runs)); }
    add_count_notes(all, capture.run);
    capture.frames = std::move(all.frames);
    std::string application;
    const Json* const info = find_member(json, "Info");
    const Json entries = info != nullptr && info->is_object() ? *info : Json::object();
    for (const auto& [name, value] : entries.items()) {
        if (!value.is_string()) { continue; }
        const std::string text = value.get<std::string>();
        add_machine_value(capture.run, name, text);
        const bool is_application = name == "GameName" || (name == "ProcessName" && application.empty());
        if (is_application && !text.empty()) { application = printable(text); }
    }
    return finished(std::move(capture), path, application);
}

/// The first bytes of a file, without a byte order mark of UTF-8.
std::string beginning_of(const fs::path& path) {
    std::string bytes(4096, '\0');
    std::ifstream file = open_file(path);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes;
}

} // namespace

bool is_frame_capture(const fs::path& path) { return is_file(path) && !beginning_of(path).starts_with("PK"); }

FrameCapture read_frame_capture(const fs::path& path) {
    const std::string beginning = beginning_of(path);
    if (beginning.starts_with("\xff\xfe") || beginning.starts_with("\xfe\xff")) {
        throw_error_at(path, 1, "expected text in UTF-8, got UTF-16");
    }
    const std::size_t first = beginning.find_first_not_of(" \t\r\n");
    return first != std::string::npos && beginning[first] == '{' ? read_json(path) : read_table(path);
}

} // namespace octant::ui::report
