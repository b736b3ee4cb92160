#include "ui/settings/setting_rows.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/spelling.h"
#include "ui/settings/aircraft_entry.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace octant::ui::settings {

namespace {

namespace fs = std::filesystem;

template <class Value>
void read_words(const FieldInfo& info, const std::vector<std::string>& words, Value& value) {
    if (words.size() != 1) { throw Error(fmt::format("{}: expected one value, got {}", info.name, words.size())); }
    read_setting(info, words.front(), value);
}

void read_words(const FieldInfo& info, const std::vector<std::string>& words, std::vector<std::string>& value) {
    if ((words.empty() && !value.empty()) || std::ranges::find(words, "") != words.end()) {
        throw Error(fmt::format("{}: expected names, got an empty one or none", info.name));
    }
    value = words;
}

template <class Names>
void find_from(const fs::path& folder, const Names& built_in, std::string& name) {
    std::error_code ignored;
    const bool known = std::ranges::find(built_in, name) != built_in.end();
    if (!known && !name.empty() && fs::path(name).is_relative() && fs::exists(folder / name, ignored)) {
        name = (folder / name).lexically_normal().string();
    }
}

} // namespace

report::SettingRole comparison_role(std::string_view name) {
    using enum SettingGroup;
    auto role = report::SettingRole::Drawing;
    visit_rows([&](const SettingInfo& row) {
        if (row.name != name) { return; }
        const bool is_drawing = row.group == Surface || row.group == Shading || row.group == Ground;
        role = row.role.value_or(is_drawing ? report::SettingRole::Drawing : report::SettingRole::Scene);
    });
    return role;
}

SettingsChange change_between(const RunSettings& before, const RunSettings& after) {
    SettingsChange change = SettingsChange::None;
    visit_rows([&](const auto& row) {
        if (row.of(before) != row.of(after)) { change = std::max(change, row.change); }
    });
    return change;
}

std::string set_by_name(RunSettings& settings, std::string_view name, const std::vector<std::string>& words) {
    bool known = false;
    std::string note;
    const auto read = [&](const auto& row) {
        if (row.name == name) {
            known = true;
            read_words(row, words, row.of(settings));
            note = old_name_note(row, words.front(), row.of(settings));
        }
    };
    visit_rows(read);
    visit_old_rows(read);
    if (!known) {
        std::vector<std::string> names;
        visit_rows([&names](const SettingInfo& row) { names.emplace_back(row.name); });
        throw Error(fmt::format("{}: expected the name of a setting, got {}{}", printable(std::string(name)),
            in_quotes(name), base::did_you_mean(name, names)));
    }
    return note;
}

const std::vector<SettingFamily>& setting_families() {
    static const std::vector<SettingFamily> families{
        {"--show", "[no-]KEY,...", "what the picture shows:", SettingGroup::View,
            {{"head-up-display", "head-up-display"}, {"path-ribbon", "path-ribbon"}, {"shadows", "shadows"},
                {"relief-shadows", "relief-shadows"}, {"roads", "roads"}, {"airfield", "airfield"},
                {"mesh", "show-mesh"}, {"model", "show-model"}}},
        {"--paper-shading", "KEY=VALUE,...", "shading rule of the paper:", SettingGroup::Shading,
            {{"near", "shading-near"}, {"far", "shading-far"}, {"device-ratio", "device-ratio"}}},
        {"--terrain-mesh", "[no-]KEY,...", "properties of the terrain mesh:", SettingGroup::Ground,
            {{"geomorphs", "geomorphs"}, {"ahead", "mesh-ahead"}, {"curvature", "earth-curvature"}}},
        {"--haze", "KEY=VALUE,...", "haze, besides --visibility:", SettingGroup::Air,
            {{"height", "haze-height"}, {"colour", "background"}}},
        {"--ground-look", "KEY=VALUE,...", "appearance of the ground:", SettingGroup::Air,
            {{"palette", "palette"}, {"shading", "ground-shading"}, {"water-level", "water-level"}}}};
    return families;
}

std::string with_setting_names(std::string_view message) {
    std::vector<std::pair<std::string, std::string_view>> names; // as a command line has it, and as it is called
    for (const SettingFamily& family : setting_families()) {
        for (const auto& [key, setting] : family.keys) {
            names.emplace_back(fmt::format("{} {}", family.name, key), setting);
        }
    }
    const auto add = [&names](const SettingInfo& row) { names.emplace_back(fmt::format("--{}", row.name), row.name); };
    visit_rows(add);
    visit_old_rows(add);
    const auto continues = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-'; };
    std::string text;
    while (!message.empty()) {
        const auto is_here = [&](const auto& name) {
            return message.starts_with(name.first) &&
                   (message.size() == name.first.size() || !continues(message[name.first.size()]));
        };
        const auto name = text.empty() || !continues(text.back()) ? std::ranges::find_if(names, is_here) : names.end();
        text += name == names.end() ? message.substr(0, 1) : name->second;
        message.remove_prefix(name == names.end() ? 1 : name->first.size());
    }
    return text;
}

void resolve_paths_from(const fs::path& folder, RunSettings& settings) {
    constexpr std::array<std::string_view, 0> none{};
    find_from(folder, base::built_in_paths, settings.path.name);
    for (std::string& name : settings.path.aircraft) {
        AircraftEntry flown = parse_aircraft_entry(name);
        find_from(folder, base::built_in_models, flown.shape);
        if (flown.path) { find_from(folder, base::built_in_paths, *flown.path); }
        name = text_of(flown);
    }
    find_from(folder, built_in_terrains, settings.path.terrain);
    if (settings.path.terrain_system) { find_from(folder, none, *settings.path.terrain_system); }
    if (settings.air.drape) { find_from(folder, none, *settings.air.drape); }
    find_from(folder, built_in_order_caches, settings.surface.order_cache);
}

// The text of --terrain-lod, whose keys are the rows of its old names (settings_text.h declares these functions).

using visuals::terrain::DetailControl;
using visuals::terrain::GroundMetric;
using visuals::terrain::TerrainLod;

namespace {

[[noreturn]] void refuse_lod(const FieldInfo& info, const std::string& expected, std::string_view got) {
    throw Error(fmt::format("{}: expected {}, got '{}'", info.name, expected, printable(std::string(got))));
}

template <class Value>
std::string known_text(const Value& value) {
    return text_of(value);
}

template <class Value>
std::string known_text(const std::optional<Value>& value) {
    return value ? text_of(*value) : "none";
}

/// What the first word of --terrain-lod stands for, without keys.
TerrainLod terrain_lod_of_kind(std::string_view kind) {
    TerrainLod lod;
    if (kind == "exact") { lod.metric = GroundMetric::Midpoint; }
    if (kind == "paper") {
        lod.metric = GroundMetric::Printed;
        lod.control = DetailControl::Damped;
        lod.control_a = 1000.0;
    }
    return lod;
}

/// Calls visit(key, value of `lod`, value of `base`) for each key of --terrain-lod.
void visit_terrain_lod(TerrainLod& lod, TerrainLod& base, const auto& visit) {
    RunSettings settings;
    RunSettings others;
    settings.ground.lod = lod;
    others.ground.lod = base;
    visit_old_rows(
        [&](const auto& row) { visit(static_cast<const FieldInfo&>(row), row.of(settings), row.of(others)); });
    lod = settings.ground.lod;
}

} // namespace

std::string text_of(const TerrainLod& lod) {
    if (visuals::terrain::ground_metric(lod) == GroundMetric::ScreenError) { return "screen-error"; }
    TerrainLod shown = lod;
    shown.metric = visuals::terrain::ground_metric(lod);
    std::string text = lod.control == DetailControl::Exact ? "exact" : "paper";
    TerrainLod base = terrain_lod_of_kind(text);
    char separator = ':';
    visit_terrain_lod(shown, base, [&]<class Value>(const FieldInfo& info, const Value& value, const Value& usual) {
        if (value == usual) { return; }
        text += fmt::format("{}{}={}", std::exchange(separator, ','), info.meaning, known_text(value));
    });
    return text;
}

void read_setting(const FieldInfo& info, std::string_view text, TerrainLod& lod) {
    const std::size_t colon = text.find(':');
    const std::string_view kind = text.substr(0, colon);
    read_choice(info, kind, {"screen-error", "exact", "paper"});
    TerrainLod read = terrain_lod_of_kind(kind);
    if (colon != std::string_view::npos && kind == "screen-error") {
        refuse_lod(info, "no key after screen-error", text.substr(colon));
    }
    std::vector<std::string_view> words;
    if (colon != std::string_view::npos) { words = split_fields(text.substr(colon + 1), ','); }
    for (const std::string_view word : words) {
        const std::string_view key = word.substr(0, word.find('='));
        bool known = false;
        std::vector<std::string_view> keys;
        visit_terrain_lod(read, read, [&](FieldInfo named, auto& value, const auto&) {
            keys.push_back(named.meaning);
            if (named.meaning != key) { return; }
            known = true;
            const std::string name = fmt::format("{} {}: {}", info.name, kind, key);
            named.name = name;
            read_setting(named, key.size() < word.size() ? word.substr(key.size() + 1) : "", value);
        });
        if (!known) { refuse_lod(info, fmt::format("KEY=VALUE with a key of {}", fmt::join(keys, ", ")), word); }
    }
    if (kind != "screen-error" && read.metric != GroundMetric::Midpoint && read.metric != GroundMetric::Printed) {
        refuse_lod(info, "roughness=midpoint or printed", text);
    }
    lod = read;
}

} // namespace octant::ui::settings
