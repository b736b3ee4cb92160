#include "ui/report/comparison_text.h"

#include "ui/report/flight_plots.h"
#include "ui/report/page_plot.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace octant::ui::report {

std::string label_of(Recordings recordings, const LoadedRecording& recording) {
    const auto same = [&](const auto& each) { return each.name == recording.name; };
    const bool unique = std::ranges::count_if(recordings, same) == 1;
    return unique ? recording.name : recording.display_name;
}

std::string value_of(const NamedValues& rows, std::string_view name) {
    const auto found =
        std::ranges::find_if(rows, [&](const auto& row) { return row.first == name; });
    return found == rows.end() ? std::string() : found->second;
}

std::vector<std::string>
differing_settings(Recordings recordings, const std::vector<std::size_t>& among) {
    std::vector<std::string> names;
    const NamedValues& first = recordings[among.front()].run.settings;
    for (const auto& row : first) {
        const auto& name = row.first;
        const auto& value = row.second;
        const bool differs = std::ranges::any_of(among, [&](std::size_t i) {
            return value_of(recordings[i].run.settings, name) != value;
        });
        if (differs) {
            names.push_back(name);
        }
    }
    return names;
}

std::string short_value(const std::string& value) {
    if (value == unset_value) {
        return "not set";
    }
    const bool is_path = value.find('/') != std::string::npos;
    return is_path ? std::filesystem::path(value).filename().string() : value;
}

std::string number_cell(double value, int decimals) {
    return fmt::format("<td class=\"number\">{:.{}f}</td>", value, decimals);
}

const Statistic& statistic_named(std::string_view key) {
    return *std::ranges::find(all_statistics(), key, &Statistic::key);
}

double shared_ceiling_ms(Recordings recordings, const std::vector<std::size_t>& runs) {
    double ceiling_ms = 0.0;
    for (const std::size_t i : runs) {
        ceiling_ms = std::max(ceiling_ms, plot_ceiling_ms(recordings[i].statistics));
    }
    return ceiling_ms;
}

} // namespace octant::ui::report
