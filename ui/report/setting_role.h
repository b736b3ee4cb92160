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

} // namespace octant::ui::report
