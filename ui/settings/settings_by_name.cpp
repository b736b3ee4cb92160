#include "ui/settings/settings_by_name.h"

#include "sim/base/error.h"
#include "ui/base/data_files.h"
#include "ui/settings/aircraft_entry.h"
#include "ui/settings/order_cache_name.h"
#include "ui/settings/settings_fields.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace octant::ui::settings {

namespace {

namespace fs = std::filesystem;

template <class Value>
void read_words(const FieldInfo& info, const std::vector<std::string>& words, Value& value) {
    if (words.size() != 1) { throw Error(fmt::format("{}: expected one value, got {}", info.name, words.size())); }
    read_setting(info, words.front(), value);
}

void read_words(const FieldInfo& info, const std::vector<std::string>& words, std::vector<std::string>& value) {
    if (words.empty() || std::ranges::find(words, "") != words.end()) {
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

void set_by_name(RunSettings& settings, std::string_view name, const std::vector<std::string>& words) {
    bool known = false;
    visit_settings(settings, [&](const SettingInfo& info, auto& value) {
        if (info.name == name) {
            known = true;
            read_words(info, words, value);
        }
    });
    if (!known) {
        throw Error(fmt::format("{}: expected the name of a setting, got this", printable(std::string(name))));
    }
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

} // namespace octant::ui::settings
