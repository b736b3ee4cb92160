#include "ui/studies/hybrid_shading/budget_times.h"

#include "ui/base/progress.h"
#include "ui/flight/make_renderer.h"
#include "ui/flight/session.h"
#include "ui/report/frame_times.h"
#include "ui/report/statistics.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <utility>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

namespace scene = visuals::scene;

namespace {

constexpr int budget_frames = 300;
constexpr int unsettled_frames = 100;
constexpr int clock_frames = 60; ///< of all flat and all Gouraud, to find the budgets
constexpr double clock_rate_hz = 500.0;

/// Budgets: so many of the way from what all flat takes (0) to what all Gouraud takes (1).
constexpr std::array budgets{-3.0, 0.5, 4.0};
constexpr double min_way = 0.1; ///< of all flat's time

constexpr std::array budget_modes{
    scene::AircraftShading::Flat, scene::AircraftShading::Gouraud, scene::AircraftShading::Hybrid};
constexpr std::size_t flat_flight = 0; ///< indices into budget_modes
constexpr std::size_t smooth_flight = 1;
constexpr std::size_t budget_flight = 2;

struct BudgetFlights {
    std::array<std::vector<double>, budget_modes.size()> frame_ms;
    std::vector<double> smooth_share; ///< of the flight that is held
    bool has_no_gain = false;

    double median_ms(std::size_t mode) const {
        return report::statistics_of_times(frame_ms[mode]).p50_ms;
    }
};

std::unique_ptr<flight::Session>
budget_session(const std::string& aircraft, std::size_t mode, double rate_hz, int frames) {
    settings::RunSettings settings;
    settings.path.name = "turn";
    settings.view.kind = scene::View::Orbit;
    settings.path.terrain = "none";
    settings.path.aircraft = {aircraft};
    settings.time.frames = frames;
    settings.time.rate_hz = rate_hz;
    settings.time.warm_up = 0;
    settings.drawing.renderer = settings::RendererKind::Raster;
    settings.shading.kind = budget_modes[mode];
    settings.adapt.shading = mode == budget_flight;
    return std::make_unique<flight::Session>(settings);
}

/// Flies the first `ways` of budget_modes in turn; the first frames do not count.
BudgetFlights
fly_all(const std::string& aircraft, std::size_t ways, double rate_hz, int frames, int left_out) {
    std::vector<std::unique_ptr<flight::Session>> sessions;
    for (std::size_t mode = 0; mode < ways; ++mode) {
        sessions.push_back(budget_session(aircraft, mode, rate_hz, frames));
    }
    BudgetFlights flights;
    for (int frame = 0; frame < frames; ++frame) {
        for (std::size_t turn = 0; turn < ways; ++turn) {
            const std::size_t mode = (turn + static_cast<std::size_t>(frame)) % ways;
            const report::FrameRecord record = sessions[mode]->draw(frame);
            if (frame < left_out) {
                continue;
            }
            flights.frame_ms[mode].push_back(record.frame_ms);
            if (mode == budget_flight) {
                flights.smooth_share.push_back(
                    static_cast<double>(record.smooth_polygons) /
                    std::max(sessions[mode]->shading()->polygons, 1));
            }
        }
    }
    if (ways > budget_flight) {
        flights.has_no_gain = sessions[budget_flight]->shading()->has_no_gain;
    }
    return flights;
}

double share_over(const std::vector<double>& times_ms, double budget_ms) {
    const auto over = std::ranges::count_if(times_ms, [&](double ms) { return ms > budget_ms; });
    return static_cast<double>(over) / static_cast<double>(times_ms.size());
}

std::vector<std::string>
cells_of(const std::string& aircraft, double budget_ms, const BudgetFlights& flights) {
    std::vector<std::string> cells{aircraft, fmt::format("{:.2f}", budget_ms)};
    for (std::size_t mode = 0; mode < budget_modes.size(); ++mode) {
        cells.push_back(fmt::format("{:.2f}", flights.median_ms(mode)));
        cells.push_back(
            fmt::format("{:.0f} %", 100.0 * share_over(flights.frame_ms[mode], budget_ms)));
    }
    const double smooth = report::statistics_of_times(flights.smooth_share).p50_ms;
    cells.push_back(fmt::format("{:.0f} %", 100.0 * (1.0 - smooth)));
    cells.emplace_back(flights.has_no_gain ? "nothing: all smooth" : "time");
    return cells;
}

} // namespace

report::HtmlTable budget_times_table(std::span<const std::string> aircraft, bool quiet) {
    report::HtmlTable table;
    table.title = "Adaptation flown: what a budget makes of the share of flat polygons, raster, 16 "
                  "samples";
    table.header = {
        "aircraft",
        "budget T, ms",
        "all flat, ms",
        "over T",
        "all Gouraud, ms",
        "over T",
        "adapted, ms",
        "over T",
        "flat polygons",
        "flat gains"};
    base::Progress progress(
        "budgets", static_cast<int>(aircraft.size() * budgets.size()), quiet, "flights");
    int done = 0;
    for (const std::string& each : aircraft) {
        const BudgetFlights clock = fly_all(each, budget_flight, clock_rate_hz, clock_frames, 10);
        const double flat_ms = clock.median_ms(flat_flight);
        const double way_ms =
            std::max(clock.median_ms(smooth_flight) - flat_ms, min_way * flat_ms);
        for (const double budget : budgets) {
            const double budget_ms = flat_ms + budget * way_ms;
            const BudgetFlights flights =
                fly_all(each, budget_modes.size(), 1000.0 / budget_ms, budget_frames, unsettled_frames);
            table.rows.push_back(
                cells_of(std::filesystem::path(each).stem().string(), budget_ms, flights));
            progress.show(++done);
        }
    }
    progress.finish();
    table.note = fmt::format(
        "Medians of {} frames after {} of the path turn without ground, orbit view, 1280 x 720; "
        "the three flights draw every frame in turn. Budgets lie below what all flat took in a "
        "flight before, half way from all flat to all Gouraud and well above both; a tenth of all "
        "flat's time counts as that way where it is shorter. Flat gains: what the control has "
        "found out; where flat polygons take as long as smooth ones, to within the noise, it makes "
        "all smooth whatever the budget is, for fewer would only look worse.",
        budget_frames - unsettled_frames,
        unsettled_frames);
    return table;
}

} // namespace octant::ui::studies::hybrid_shading
