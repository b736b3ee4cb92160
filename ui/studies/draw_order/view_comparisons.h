#pragma once

#include "sim/base/parallel_for.h"
#include "ui/base/progress.h"
#include "ui/flight/id_comparison.h"
#include "ui/settings/settings.h"
#include "ui/studies/draw_order/ridge_tower.h"
#include "ui/world/picture_times.h"
#include "ui/world/world.h"
#include "visuals/scene/settings.h"

#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::studies::draw_order {

inline constexpr std::array compared_paths = {"straight", "jinking", "pop-up", "turn"};

struct StudiedView {
    visuals::scene::View kind;
    const char* name;
    bool behind_ridges = false; ///< From a tower that ridges hide the aircraft from now and then.
};

/// Flights of which pictures are compared: every path by each aircraft.
struct ComparisonFlights {
    settings::RunSettings settings; ///< All but path, aircraft and view.
    std::vector<std::string> aircraft;
    int every = 1; ///< Every Nth frame is compared.
    int jobs = 1;  ///< Views compared at once.
    bool quiet = false;
};

template <class Result>
struct NamedResult {
    std::vector<std::string> name; ///< Path, aircraft, view.
    Result result;
};

/// The name of a terrain or an aircraft in a table, of a file without its folder.
inline std::string short_name(const std::string& given) {
    return std::filesystem::path(given).stem().string();
}

/// How far a flight has come, told by whichever view has compared a picture.
class ComparisonProgress {
public:
    ComparisonProgress(const std::string& what, int pictures, bool quiet)
        : progress_(what, pictures, quiet, "pictures") {}

    void add(const char* view) {
        const std::scoped_lock lock(one_at_a_time_);
        progress_.show(++done_, view);
    }

private:
    std::mutex one_at_a_time_;
    base::Progress progress_;
    int done_ = 0;
};

/// Comparisons of all views of one flight, over worlds that are loaded once.
template <class Result, class Compare>
void compare_views(
    const ComparisonFlights& flights,
    const settings::RunSettings& flown,
    std::span<const StudiedView> studied_views,
    const Compare& compare,
    std::span<NamedResult<Result>> compared) {
    const flight::ComparisonWorlds worlds = flight::load_comparison_worlds(flown);
    const auto frames =
        static_cast<int>(world::picture_times_of(flown, worlds.painted.flight).times_s.size());
    const int pictures = (frames + flights.every - 1) / flights.every;
    ComparisonProgress told(
        fmt::format("{} {}", compared.front().name[0], compared.front().name[1]),
        pictures * static_cast<int>(studied_views.size()),
        flights.quiet);
    parallel_for(studied_views.size(), flights.jobs, [&](std::size_t i, std::size_t /*worker*/) {
        const StudiedView& view = studied_views[i];
        settings::RunSettings settings = flown;
        settings.view.kind = view.kind;
        if (view.behind_ridges) {
            settings.view.eye_m = ridge_tower(worlds.painted);
        }
        compared[i].result =
            compare(settings, worlds, flights.every, [&](int, int) { told.add(view.name); });
    });
}

/// A comparison of every path, aircraft and view: `compare` takes settings, worlds, every how many
/// frames, and whom to tell.
template <class Compare>
auto run_comparisons(
    const ComparisonFlights& flights,
    std::span<const StudiedView> studied_views,
    const Compare& compare) {
    using Result =
        decltype(compare(flights.settings, flight::ComparisonWorlds(), 1, [](int, int) {}));
    std::vector<NamedResult<Result>> compared;
    for (const char* path : compared_paths) {
        for (const std::string& aircraft : flights.aircraft) {
            settings::RunSettings flown = flights.settings;
            flown.path.name = path;
            flown.path.aircraft = {aircraft};
            const std::size_t first = compared.size();
            for (const StudiedView& view : studied_views) {
                compared.push_back({{path, short_name(aircraft), view.name}, {}});
            }
            compare_views<Result>(
                flights, flown, studied_views, compare, std::span(compared).subspan(first));
        }
    }
    return compared;
}

} // namespace octant::ui::studies::draw_order
