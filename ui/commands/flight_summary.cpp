#include "ui/commands/flight_summary.h"

#include "ui/base/json_value.h"
#include "ui/report/statistics.h"

#include <cstdio>
#include <fmt/format.h>

namespace octant::ui::commands {

void print_summary(const flight::FlightResult& end, const std::optional<flight::ReplayComparison>& verdict, bool json,
    const base::JsonValue::JsonMembers& extra_results) {
    if (json) {
        base::JsonValue object = report::json_of(report::all_statistics(), end.statistics);
        object["state_hash"] = report::hash_text(end.state_hash);
        object["picture_hash"] = report::hash_text(end.picture_hash);
        if (verdict) {
            object["replay"] = {{"state_hash", verdict->state_hash}, {"picture_hash", verdict->picture_hash}};
        }
        for (const auto& [name, statistic] : extra_results) { object[name] = statistic; }
        base::print_value(object, true);
        return;
    }
    for (const report::Statistic& statistic : report::all_statistics()) {
        std::fputs(
            fmt::format("{:<28} {}\n", statistic.name, report::statistic_text(statistic, end.statistics)).c_str(),
            stdout);
    }
    std::fputs(
        fmt::format("{:<28} {:016x}\n{:<28} {:016x}\n", "state hash", end.state_hash, "picture hash", end.picture_hash)
            .c_str(),
        stdout);
    if (verdict) { std::fputs(fmt::format("{:<28} {}\n", "replay", verdict->line).c_str(), stdout); }
}

} // namespace octant::ui::commands
