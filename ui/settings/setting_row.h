#pragma once

#include "ui/settings/enum_names.h"
#include "ui/settings/settings.h"
#include "ui/settings/settings_text.h"

#include <array>
#include <span>
#include <string_view>

namespace octant::ui::settings {

/// Groups under which help and the settings panel show settings.
enum class SettingGroup { Path, View, Time, Surface, Shading, Ground, Air };

/// The headlines of the groups.
template <>
inline constexpr std::array enum_names<SettingGroup>{EnumName{SettingGroup::Path, "Path, aircraft and ground"},
    EnumName{SettingGroup::View, "View and picture"}, EnumName{SettingGroup::Time, "Frames"},
    EnumName{SettingGroup::Surface, "Hidden surfaces, aircraft detail"},
    EnumName{SettingGroup::Shading, "Shading of aircraft"}, EnumName{SettingGroup::Ground, "Terrain mesh"},
    EnumName{SettingGroup::Air, "Sky, haze, sun and colours"}};

/// What must be made anew when settings change during a flight. Each value includes those before it.
enum class SettingsChange {
    None,
    /// What a recording and a run without a window go by: the pictures stay as they are.
    Recording,
    /// Only the eye point or the direction of view moves, or how far one sees.
    Look,
    /// The sun stands elsewhere: the ground has other colours.
    Light,
    /// Frames are planned and drawn in another way from now on.
    Picture,
    /// Aircraft, path and ground are loaded again, and the flight goes on.
    World,
    /// The path or what flies along it is another one: the flight begins again.
    Flight
};

/// What the program does with a setting, beside what people write for it.
struct SettingBehaviour {
    SettingGroup group;
    /// What a change of this setting makes anew.
    SettingsChange change;
    /// Built-in names that a text setting takes beside files; empty where it takes other text.
    std::span<const std::string_view> known{};
    /// Where an optional number begins when it is switched on by hand.
    double start = 0.0;
    /// The window sets it, so that its panels only show it.
    bool set_by_window = false;
};

/// Everything about a setting but where its value stands.
struct SettingInfo : FieldInfo, SettingBehaviour {};

/// The row of one setting. `members` lead from RunSettings to the value: a pointer to the part, then one to its member.
template <auto... members>
struct Setting : SettingInfo {
    /// Returns the value in `settings`, which is constant where they are.
    template <class SomeSettings>
    static constexpr auto& of(SomeSettings& settings) {
        return (settings.*....*members);
    }
};

/// Makes the row of the setting to which `members` lead.
template <auto... members>
constexpr Setting<members...> setting(const FieldInfo& info, const SettingBehaviour& facts) {
    return {{info, facts}};
}

} // namespace octant::ui::settings
