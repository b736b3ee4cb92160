#pragma once

#include "ui/settings/air_fields.h"
#include "ui/settings/aircraft_fields.h"
#include "ui/settings/ground_fields.h"
#include "ui/settings/path_fields.h"
#include "ui/settings/setting_row.h"
#include "ui/settings/time_fields.h"
#include "ui/settings/view_fields.h"

#include <tuple>

namespace octant::ui::settings {

/// Calls visit(row) with the Setting of every field of RunSettings, in the order of help and files.
template <class Visit>
void visit_rows(Visit&& visit) {
    const auto visit_each = [&visit](const auto&... row) { (visit(row), ...); };
    std::apply(visit_each, path_rows);
    std::apply(visit_each, view_rows);
    std::apply(visit_each, time_rows);
    std::apply(visit_each, surface_rows);
    std::apply(visit_each, shading_rows);
    std::apply(visit_each, ground_rows);
    std::apply(visit_each, air_rows);
}

/// Calls visit(SettingInfo, value) for every field of RunSettings. Command line, settings files,
/// run.json, panels and the rules of reloading are all made from it.
template <class SomeSettings, class Visit>
void visit_settings(SomeSettings& settings, Visit&& visit) {
    visit_rows(
        [&](const auto& row) { visit(static_cast<const SettingInfo&>(row), row.of(settings)); });
}

} // namespace octant::ui::settings
