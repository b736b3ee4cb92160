#include "ui/settings/settings_change.h"

#include "ui/settings/settings_fields.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::settings {

namespace {

/// Settings that decide what is loaded.
constexpr std::array<std::string_view, 15> of_the_world{
    "path",
    "aircraft",
    "axes",
    "terrain",
    "terrain-spacing",
    "place",
    "heading",
    "height-mode",
    "lenient",
    "context",
    "hidden-surface",
    "order-method",
    "ground-shading",
    "drape",
    "start"};

std::string written(bool value) {
    return value ? "true" : "false";
}

std::string written(const std::vector<std::string>& values) {
    return fmt::format("{}", fmt::join(values, "\n"));
}

template <class Value>
std::string written(const Value& value) {
    return text_of(value);
}

template <class Value>
std::string written(const std::optional<Value>& value) {
    return value ? text_of(*value) : "";
}

/// Settings that only the camera looks at.
constexpr std::array<std::string_view, 5> of_the_camera{
    "eye", "look", "azimuth", "elevation", "zoom"};

struct Written {
    std::string_view name;
    std::string text;

    bool operator==(const Written&) const = default;
};

std::vector<Written> all_of(const Settings& settings) {
    std::vector<Written> all;
    visit_settings(settings, [&](const FieldInfo& info, const auto& value) {
        all.push_back({info.name, written(value)});
    });
    return all;
}

} // namespace

SettingsChange change_by(std::string_view setting) {
    if (std::ranges::find(of_the_world, setting) != of_the_world.end()) {
        return SettingsChange::World;
    }
    return std::ranges::find(of_the_camera, setting) != of_the_camera.end()
               ? SettingsChange::Look
               : SettingsChange::Picture;
}

SettingsChange change_between(const Settings& before, const Settings& after) {
    const std::vector<Written> a = all_of(before);
    const std::vector<Written> b = all_of(after);
    SettingsChange change = SettingsChange::None;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) {
            continue;
        }
        change = std::max(change, change_by(a[i].name));
    }
    return change;
}

} // namespace octant::ui::settings
