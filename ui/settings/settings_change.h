#pragma once

#include "ui/settings/setting_row.h"
#include "ui/settings/settings.h"

namespace octant::ui::settings {

/// What must be made anew when `before` gives way to `after`: the most that any row asks for whose
/// values differ.
SettingsChange change_between(const Settings& before, const Settings& after);

} // namespace octant::ui::settings
