#include "ui/settings/settings_fields.h"
#include "ui/window/setting_widgets.h"

#include <array>
#include <string_view>
#include <vector>

namespace octant::ui::window {

using settings::Settings;

namespace {

/// Gathers the names of the settings that it is shown.
struct Names {
    std::vector<std::string_view> all;

    template <class Value>
    void operator()(const settings::FieldInfo& info, const Value& /*value*/) {
        all.push_back(info.name);
    }
};

std::vector<std::string_view> names_of(const Settings& settings, SettingGroup group) {
    Names names;
    switch (group) {
    case SettingGroup::Path:
        settings::visit_path_settings(settings, names);
        break;
    case SettingGroup::View:
        settings::visit_view_settings(settings, names);
        break;
    case SettingGroup::Time:
        settings::visit_time_settings(settings, names);
        break;
    case SettingGroup::Surface:
        settings::visit_surface_settings(settings, names);
        break;
    case SettingGroup::Shading:
        settings::visit_shading_settings(settings, names);
        break;
    case SettingGroup::Ground:
        settings::visit_ground_settings(settings, names);
        break;
    case SettingGroup::Air:
        settings::visit_air_settings(settings, names);
        break;
    }
    return names.all;
}

} // namespace

const char* title_of(SettingGroup group) {
    constexpr std::array<const char*, setting_groups> titles{
        "Path, aircraft and ground",
        "View and picture",
        "Frames",
        "Hidden surfaces and detail of aircraft",
        "Shading of aircraft",
        "Terrain mesh",
        "Sky, haze, sun and colours"};
    return titles.at(static_cast<std::size_t>(group));
}

void edit_group(Settings& settings, SettingGroup group) {
    edit_settings(settings, names_of(settings, group));
}

} // namespace octant::ui::window
