#include "ui/settings/settings_file.h"

#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/json_value.h"
#include "ui/report/packed_recording.h"
#include "ui/report/run_file.h"
#include "ui/settings/setting_rows.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

namespace octant::ui::settings {

using nlohmann::ordered_json;

namespace {

template <class Value>
ordered_json json_of(const Value& value) {
    return text_of(value);
}

ordered_json json_of(bool value) { return value; }

ordered_json json_of(int value) { return value; }

ordered_json json_of(double value) { return value; }

ordered_json json_of(const std::string& value) { return base::json_from_file_name(value); }

ordered_json json_of(const std::vector<std::string>& value) {
    ordered_json names = ordered_json::array();
    for (const std::string& name : value) { names.push_back(base::json_from_file_name(name)); }
    return names;
}

template <class Value>
ordered_json json_of(const std::optional<Value>& value) {
    return value ? json_of(*value) : ordered_json(nullptr);
}

/// Returns the text of a JSON scalar as a person would have typed it.
std::string scalar_text(const ordered_json& json) {
    return json.is_string() ? base::file_name_from_json(json.get<std::string>()) : json.dump();
}

template <class Value>
void read_field(const FieldInfo& info, const ordered_json& json, Value& value) {
    read_setting(info, scalar_text(json), value);
}

template <class Value>
void read_field(const FieldInfo& info, const ordered_json& json, std::optional<Value>& value) {
    if (json.is_null()) {
        value.reset();
    } else {
        read_setting(info, scalar_text(json), value);
    }
}

/// Older files have a number or null.
void read_field(const FieldInfo& info, const ordered_json& json, models::heights::VoidValues& voids) {
    if (json.is_null()) {
        voids = {};
    } else {
        read_setting(info, scalar_text(json), voids);
    }
}

void read_field(const FieldInfo& info, const ordered_json& json, std::vector<std::string>& value) {
    // A list that is empty by default may be so.
    const bool names = json.is_array() && (value.empty() || !json.empty()) && json.size() <= 4096 &&
                       std::all_of(json.begin(), json.end(), [](const ordered_json& item) {
                           return item.is_string() && !item.get<std::string>().empty();
                       });
    if (!names) { throw Error(fmt::format("{}: expected a list of names, got {}", info.name, printable(json.dump()))); }
    value.clear();
    for (const ordered_json& name : json) { value.push_back(base::file_name_from_json(name.get<std::string>())); }
}

int line_of_key(const std::string& text, std::string_view key) {
    const std::size_t at = text.find(fmt::format("\"{}\"", key));
    return at == std::string::npos ? 1 : report::line_of_byte(text, at);
}

} // namespace

ordered_json settings_json(const RunSettings& settings) {
    ordered_json json = ordered_json::object();
    visit_settings(
        settings, [&](const SettingInfo& info, const auto& value) { json[std::string(info.name)] = json_of(value); });
    return json;
}

namespace {

RunSettings read_settings_file(const std::filesystem::path& path, std::vector<std::string>* notes) {
    constexpr std::size_t largest_bytes = std::size_t{16} << 20;
    const std::string text = read_text_file(path, largest_bytes);
    ordered_json json = report::parsed_json(path, text);
    const bool recorded = json.is_object() && json.contains("settings");
    if (recorded) {
        report::check_format_version(path, json);
        json = ordered_json(json["settings"]);
    }
    if (!json.is_object()) {
        throw_error_at(path, 1, fmt::format("expected a JSON object of settings, got {}", json.type_name()));
    }
    RunSettings settings;
    std::set<std::string, std::less<>> known;
    const auto read_row = [&](const auto& row) {
        known.insert(std::string(row.name));
        const auto found = json.find(std::string(row.name));
        if (found == json.end()) { return; }
        try {
            read_field(row, *found, row.of(settings));
            const std::string note = old_name_note(row, scalar_text(*found), row.of(settings));
            if (notes != nullptr && !note.empty()) { notes->push_back(note); }
        } catch (const Error& fault) { throw_error_at(path, line_of_key(text, row.name), fault.what()); }
    };
    visit_rows(read_row);
    visit_old_rows(read_row);
    for (const auto& [key, value] : json.items()) {
        if (!known.contains(key)) {
            throw_error_at(
                path, line_of_key(text, key), fmt::format("expected the name of a setting, got '{}'", printable(key)));
        }
    }
    if (recorded) { resolve_paths_from(path.parent_path(), settings); }
    return settings;
}

} // namespace

RunSettings read_settings(const std::filesystem::path& given, std::vector<std::string>* notes) {
    const bool is_packed = extension_of(given) == ".zip" && is_file(given);
    const report::RecordingFolder recording =
        is_packed ? report::open_recording(given) : report::RecordingFolder{given, nullptr};
    const std::filesystem::path file = is_folder(recording.path) ? recording.path / "run.json" : recording.path;
    RunSettings settings = base::with_named_errors([&] { return read_settings_file(file, notes); });
    settings.unpacked = recording.unpacked;
    return settings;
}

} // namespace octant::ui::settings
