#pragma once

#include "ui/settings/settings.h"

#include <string_view>

namespace octant::ui::settings {

/// What must be made anew when settings change while a flight goes on.
enum class SettingsChange {
    None,
    Look,    ///< from where it is seen
    Picture, ///< what is planned and drawn from now on
    World    ///< aircraft, path or ground are loaded again
};

/// For a change of one setting, by its name.
SettingsChange change_by(std::string_view setting);

SettingsChange change_between(const Settings& before, const Settings& after);

} // namespace octant::ui::settings
