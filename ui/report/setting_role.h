#pragma once

#include <string_view>

namespace octant::ui::report {

/// What a setting means to a comparison.
enum class SettingRole {
    Scene,   ///< what is flown and seen: flights that differ in it are different flights
    Drawing, ///< how it is drawn: flights that differ in it are variants of one flight
    Ignored  ///< neither states nor pictures nor times depend on it
};

/// Gives the role of each setting. ui/settings has the table.
using SettingRoles = SettingRole (*)(std::string_view setting);

/// The role of an entry of a recording's settings: "terrain-lod.kind" has that of "terrain-lod".
inline SettingRole role_of(std::string_view entry, SettingRoles roles) {
    return roles(entry.substr(0, entry.find('.')));
}

} // namespace octant::ui::report
