#include "ui/settings/settings_change.h"

#include "ui/settings/settings_fields.h"

#include <algorithm>

namespace octant::ui::settings {

SettingsChange change_between(const RunSettings& before, const RunSettings& after) {
    SettingsChange change = SettingsChange::None;
    visit_rows([&](const auto& row) {
        if (row.of(before) != row.of(after)) { change = std::max(change, row.change); }
    });
    return change;
}

} // namespace octant::ui::settings
