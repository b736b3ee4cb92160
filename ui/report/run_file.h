#pragma once

#include "ui/report/machine_info.h"
#include "ui/report/plots.h"
#include "ui/report/statistics.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace octant::ui::report {

/// Names and values in the order to show.
using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// The value of a name; empty where there is none.
std::string value_of(const NamedValues& rows, std::string_view name);

/// What rows have of a setting that is not set.
inline constexpr const char* unset_value = "null";

/// Name of the fact that a recording of a window has: its pictures followed the clock.
inline constexpr const char* window_fact = "flown";

/// Name of the fact that a flight of a sweep has: how many of the sweep's flights shared a machine.
inline constexpr const char* machine_sharing_fact = "swept";

/// What run.json says from the start of a flight.
struct RunInfo {
    std::string title;                ///< for people: "f15-pop-up over hills"
    std::string settings_json = "{}"; ///< an object as JSON text; its order is kept
    std::string version;
    std::string commit;
    std::string program_hash;      ///< of the program's file
    std::string device;            ///< that draws; "gl_renderer" in the file
    double rate_hz = 0.0;          ///< pictures a simulated second
    glm::dvec3 path_offset_m{0.0}; ///< how the path was moved to stand over the ground
    MachineInfo machine;
    NamedValues facts;              ///< anything else the report should show
    std::vector<std::string> notes; ///< notes that the user saw: voids filled, legs clipped, ...
    std::vector<PlotMark> legs;     ///< of the path, by the simulated time when they begin
    NamedValues inputs;             ///< files that were read and hashes of what was in them
    NamedValues files;              ///< copies that lie in the recording: "inputs/a.obj" and its bytes; not in run.json
};

/// What is known after the end.
struct RunSummary {
    std::uint64_t state_hash = 0;
    std::optional<std::uint64_t> picture_hash; ///< nothing where pictures follow the clock
    CpuTimes cpu_times;                        ///< read after the last frame (and after the video is whole)
    std::vector<std::string> notes = {};       ///< more of them than there were at the start
    /// What ended the flight before its last frame: "SIGINT after 120 of 240 frames"; empty = nothing did.
    std::string stopped = {};
};

/// The note of a recording whose program was stopped in so many frames after its warm-up.
std::string pauses_note(int frames);

/// run.json with `summary` and `noise` when `end` is given. `info.settings_json` must be a JSON object.
std::string run_json(const RunInfo& info);
std::string run_json(const RunInfo& info, const RunSummary& end, const Statistics& statistics);

/// run.json as a report shows it.
struct RunFile {
    std::string title;
    NamedValues settings; ///< nested names joined by dots, lists by ", "
    NamedValues machine;  ///< program, machine and renderer
    NamedValues facts;
    NamedValues inputs;         ///< as RunInfo::inputs
    MachineInfo machine_info;   ///< without cpu_times
    std::string device;         ///< as RunInfo::device
    std::string path_offset;    ///< "0, 0, 120 m"
    std::vector<PlotMark> legs; ///< as RunInfo::legs
    NamedValues summary;        ///< figures by their keys, empty unless ended
    bool ended = false;         ///< there is a summary
    std::string stopped;        ///< RunSummary::stopped
    std::string state_hash;     ///< 16 hex digits, empty unless ended
    std::string picture_hash;
    std::vector<std::string> noise; ///< see noise_reasons
};

/// Reads run.json. Missing entries stay empty, so that older recordings can be shown. Throws Error when it is not JSON
/// or not from a recording, or when a newer program wrote it.
RunFile read_run_file(const std::filesystem::path& path);

/// Throws Error for a run.json (parsed) whose format_version is newer than this program's, or no whole number: names in
/// it may mean something else. A run.json without format_version passes.
void check_format_version(const std::filesystem::path& path, const nlohmann::ordered_json& run);

/// True when the file is a run.json of ours. Throws Error when a newer program wrote it.
bool is_run_file(const std::filesystem::path& path);

/// JSON text from outside, names in their order. `path` is only named in errors. Throws Error "file:line: ..." for what
/// is no JSON, for numbers that no double holds and for more than 64 levels of nesting (deeper ones would exhaust the
/// stack of whoever walks over them).
nlohmann::ordered_json parsed_json(const std::filesystem::path& path, const std::string& text);

/// Line, from 1, of a byte of a text.
int line_of_byte(const std::string& text, std::size_t byte);

} // namespace octant::ui::report
