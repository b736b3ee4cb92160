#pragma once

#include "ui/report/comparison.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/setting_role.h"
#include "ui/report/table.h"

#include <filesystem>
#include <span>
#include <string>

namespace octant::ui::report {

struct ReportPageOptions {
    std::span<const ResultTable> first_tables = {}; ///< shown first, or below the answer of several recordings
    std::filesystem::path folder = {};              ///< where the page will lie, for links
    std::span<const ComparedFlight> flights = {};   ///< compared_flights() of the recordings; none: nothing is compared
    std::span<const FlightChange> changes = {};     ///< flight_changes() of these flights
    double limit = 0.0;                             ///< as of answer_text()
    double resolution = 0.02;                       ///< as of answer_text()
    SettingRoles roles =
        nullptr; ///< settings that nothing depends on are no columns of the table of flights; null: all
};

/// A self-contained page on one recording or on several. The page on one has its figures with their definitions, plots
/// over simulated time with the path's legs, pictures, its slowest frames and why, settings and machine. The page on
/// several begins with the answer, what changed against the baseline, and a matrix of variants and flights; changes one
/// by one, plots and a table of all flights follow. Nothing is fetched when it is read; its own script draws the plots.
std::string html_report(Recordings recordings, const ReportPageOptions& options = {});

} // namespace octant::ui::report
