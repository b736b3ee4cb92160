#include "ui/commands/flight_summary.h"

#include "ui/base/figures_text.h"
#include "ui/report/statistics.h"

#include <cstdio>
#include <fmt/format.h>

namespace octant::ui::commands {

void print_summary(
    const flight::FlightEnd& end,
    const std::optional<flight::ReplayVerdict>& verdict,
    bool json,
    const base::Figures::Named& further) {
    if (json) {
        base::Figures object;
        for (const report::Figure& figure : report::figures()) {
            const double value = figure.value(end.statistics);
            if (figure.decimals == 0) {
                object[figure.key] = static_cast<int>(value);
            } else {
                object[figure.key] = value;
            }
        }
        object["state_hash"] = fmt::format("{:016x}", end.state_hash);
        object["picture_hash"] = fmt::format("{:016x}", end.picture_hash);
        if (verdict) {
            object["replay"] = {
                {"state_hash", verdict->state_hash}, {"picture_hash", verdict->picture_hash}};
        }
        for (const auto& [name, figure] : further) {
            object[name] = figure;
        }
        base::print_figures(object, true);
        return;
    }
    for (const report::Figure& figure : report::figures()) {
        std::fputs(
            fmt::format("{:<28} {}\n", figure.name, report::figure_text(figure, end.statistics))
                .c_str(),
            stdout);
    }
    std::fputs(
        fmt::format(
            "{:<28} {:016x}\n{:<28} {:016x}\n",
            "state hash",
            end.state_hash,
            "picture hash",
            end.picture_hash)
            .c_str(),
        stdout);
    if (verdict) {
        std::fputs(fmt::format("{:<28} {}\n", "replay", verdict->line).c_str(), stdout);
    }
}

} // namespace octant::ui::commands
