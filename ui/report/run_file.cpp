#include "ui/report/run_file.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace octant::ui::report {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* format_name = "octant recording";
constexpr int format_version = 1;

/// Text that may hold bytes which are no UTF-8 (file names): JSON cannot carry them as they are.
std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json machine_json(const RunInfo& info) {
    const MachineInfo& machine = info.machine;
    const auto ticks_per_s = static_cast<double>(sysconf(_SC_CLK_TCK));
    return {{"host", machine.host}, {"cpu", machine.cpu}, {"cores", machine.cores}, {"memory_kb", machine.memory_kb},
        {"os", machine.os}, {"kernel", machine.kernel}, {"gl_renderer", info.device}, {"compiler", machine.compiler},
        {"LP_NUM_THREADS", machine.lp_num_threads}, {"start_time_utc", machine.start_time_utc},
        {"load_average_1min", machine.load_average_1min},
        {"steal_time_s", static_cast<double>(machine.cpu_times.steal) / ticks_per_s}};
}

Json start_json(const RunInfo& info) {
    const Json settings = Json::parse(info.settings_json, nullptr, false);
    assert(settings.is_object());
    Json facts = Json::object();
    for (const auto& [name, value] : info.facts) { facts[name] = value; }
    Json json{{"format", format_name}, {"format_version", format_version}, {"title", info.title},
        {"program",
            {{"name", "octant"}, {"version", info.version}, {"commit", info.commit}, {"hash", info.program_hash}}},
        {"settings", settings}, {"machine", machine_json(info)}};
    const glm::dvec3& offset_m = info.path_offset_m;
    json["path_offset_m"] = {offset_m.x, offset_m.y, offset_m.z};
    json["rate_hz"] = info.rate_hz;
    json["legs"] = Json::array();
    for (const PlotMark& leg : info.legs) { json["legs"].push_back({{"time_s", leg.x}, {"label", leg.name}}); }
    json["facts"] = facts;
    json["notes"] = info.notes;
    json["inputs"] = Json::object();
    for (const auto& [file, hash] : info.inputs) { json["inputs"][base::json_from_file_name(file)] = hash; }
    return json;
}

double rounded(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
}

Json summary_json(const Statistics& statistics, const RunSummary& end) {
    Json summary = Json::object();
    for (const Statistic& statistic : all_statistics()) {
        const double value = statistic.value(statistics);
        if (statistic.decimals == 0) {
            summary[std::string(statistic.key)] = static_cast<int>(value);
        } else {
            summary[std::string(statistic.key)] = rounded(value, 6);
        }
    }
    summary["state_hash"] = fmt::format("{:016x}", end.state_hash);
    summary["picture_hash"] = nullptr;
    if (end.picture_hash) { summary["picture_hash"] = fmt::format("{:016x}", *end.picture_hash); }
    return summary;
}

Json noise_json(const MachineInfo& machine, const RunSummary& end) {
    const auto use = cpu_use_between(machine.cpu_times, end.cpu_times);
    Json noise = Json::object();
    if (use) {
        noise["steal_share"] = rounded(use->stolen, 4);
        noise["others_share"] = rounded(use->others, 4);
    }
    const auto reasons = noise_reasons(machine.load_average_1min, machine.cores, use);
    noise["noisy"] = !reasons.empty();
    noise["reasons"] = reasons;
    return noise;
}

/// A JSON value as a report shows it.
std::string display_text(const Json& value) {
    if (value.is_string()) { return value.get<std::string>(); }
    if (value.is_array()) {
        std::string text;
        for (const Json& each : value) {
            text += text.empty() ? "" : ", ";
            text += display_text(each);
        }
        return text;
    }
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void append_rows(NamedValues& rows, const Json& object, const std::string& prefix) {
    for (const auto& [name, value] : object.items()) {
        if (value.is_object()) {
            append_rows(rows, value, prefix + name + ".");
        } else {
            rows.emplace_back(prefix + name, display_text(value));
        }
    }
}

/// The member of that name, or null JSON when there is none.
Json member(const Json& json, const char* name) {
    return json.is_object() && json.contains(name) ? json[name] : Json();
}

std::string text_in(const Json& json, const char* name) {
    const Json value = member(json, name);
    return value.is_null() ? std::string() : display_text(value);
}

/// The number of that name from 0 to `largest`, or 0 where there is none such.
double number_in(const Json& json, const char* name, double largest) {
    const Json value = member(json, name);
    const double number = value.is_number() ? value.get<double>() : 0.0;
    return number >= 0.0 && number <= largest ? number : 0.0;
}

MachineInfo machine_from(const Json& json) {
    MachineInfo machine;
    machine.host = text_in(json, "host");
    machine.cpu = text_in(json, "cpu");
    machine.cores = static_cast<int>(number_in(json, "cores", 1e6));
    machine.memory_kb = static_cast<std::uint64_t>(number_in(json, "memory_kb", 1e15));
    machine.os = text_in(json, "os");
    machine.kernel = text_in(json, "kernel");
    machine.compiler = text_in(json, "compiler");
    machine.lp_num_threads = text_in(json, "LP_NUM_THREADS");
    machine.start_time_utc = text_in(json, "start_time_utc");
    machine.load_average_1min = number_in(json, "load_average_1min", 1e6);
    return machine;
}

std::vector<std::string> noise_from(const Json& json, const MachineInfo& machine) {
    const Json reasons = member(member(json, "noise"), "reasons");
    if (!reasons.is_array()) { return noise_reasons(machine.load_average_1min, machine.cores, std::nullopt); }
    std::vector<std::string> texts;
    for (const Json& reason : reasons) { texts.push_back(display_text(reason)); }
    return texts;
}

} // namespace

std::string value_of(const NamedValues& rows, std::string_view name) {
    const auto found = std::ranges::find(rows, name, &NamedValues::value_type::first);
    return found == rows.end() ? std::string() : found->second;
}

std::string pauses_note(int frames) {
    return fmt::format("frames in which the program was stopped (SIGSTOP), as in the turns of octant compare: {}; no "
                       "figure counts them",
        frames);
}

std::string run_json(const RunInfo& info) { return json_text(start_json(info)); }

std::string run_json(const RunInfo& info, const RunSummary& end, const Statistics& statistics) {
    Json json = start_json(info);
    for (const std::string& note : end.notes) { json["notes"].push_back(note); }
    json["summary"] = summary_json(statistics, end);
    if (!end.stopped.empty()) { json["stopped"] = end.stopped; }
    json["noise"] = noise_json(info.machine, end);
    return json_text(json);
}

void check_format_version(const std::filesystem::path& path, const Json& run) {
    const Json version = member(run, "format_version");
    const bool is_newer = version.is_number() && version.get<double>() > format_version;
    if (is_newer || !(version.is_null() || version.is_number_integer())) {
        throw_error_in(path, fmt::format("expected format_version {} or earlier, got {}{}", format_version,
                                 printable(display_text(version)), is_newer ? ": a newer Octant wrote it" : ""));
    }
}

RunFile read_run_file(const std::filesystem::path& path) {
    const Json json = parsed_json(path, read_text_file(path));
    if (text_in(json, "format") != format_name) {
        throw_error_in(path, fmt::format("expected \"format\": \"{}\", got none", format_name));
    }
    check_format_version(path, json);
    RunFile run;
    run.title = text_in(json, "title");
    append_rows(run.settings, member(json, "settings"), "");
    append_rows(run.machine, member(json, "program"), "program.");
    append_rows(run.machine, member(json, "machine"), "");
    append_rows(run.facts, member(json, "facts"), "");
    append_rows(run.inputs, member(json, "inputs"), "");
    for (const Json& note : member(json, "notes")) { run.facts.emplace_back("note", display_text(note)); }
    for (const Json& leg : member(json, "legs")) {
        run.legs.push_back({text_in(leg, "label"), number_in(leg, "time_s", 1e7)});
    }
    run.machine_info = machine_from(member(json, "machine"));
    run.device = text_in(member(json, "machine"), "gl_renderer");
    run.path_offset = text_in(json, "path_offset_m");
    const Json summary = member(json, "summary");
    run.ended = summary.is_object();
    append_rows(run.summary, summary.is_object() ? summary : Json::object(), "");
    run.stopped = text_in(json, "stopped");
    run.state_hash = text_in(summary, "state_hash");
    run.picture_hash = text_in(summary, "picture_hash");
    run.noise = noise_from(json, run.machine_info);
    return run;
}

bool is_run_file(const std::filesystem::path& path) {
    Json json;
    try {
        json = parsed_json(path, read_text_file(path));
    } catch (const Error&) { return false; }
    if (text_in(json, "format") != format_name) { return false; }
    check_format_version(path, json);
    return true;
}

namespace {

constexpr int deepest_nesting = 64;

} // namespace

int line_of_byte(const std::string& text, std::size_t byte) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
    return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

nlohmann::ordered_json parsed_json(const std::filesystem::path& path, const std::string& text) {
    using Json = nlohmann::ordered_json;
    const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > deepest_nesting) {
            throw_error_in(path, fmt::format("expected at most {} levels of nesting, got more", deepest_nesting));
        }
        return true;
    };
    try {
        return Json::parse(text, shallow);
    } catch (const Json::parse_error& fault) {
        throw_error_at(path, line_of_byte(text, fault.byte == 0 ? 0 : fault.byte - 1),
            "expected JSON, got something else or a part of it");
    } catch (const Json::exception&) {
        throw_error_in(path, "expected JSON with numbers that fit into 64 bits, got others");
    }
}

} // namespace octant::ui::report
