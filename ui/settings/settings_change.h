#pragma once

#include "ui/settings/setting_row.h"
#include "ui/settings/settings.h"

namespace octant::ui::settings {

/// Returns what must be made anew when `before` gives way to `after`: the most that is asked for by the rows whose
/// values differ.
SettingsChange change_between(const RunSettings& before, const RunSettings& after);

} // namespace octant::ui::settings
