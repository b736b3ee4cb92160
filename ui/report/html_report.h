#pragma once

#include "ui/report/html_text.h"
#include "ui/report/loaded_recording.h"
#include "ui/report/plots.h"

#include <filesystem>
#include <span>
#include <string>

namespace octant::ui::report {

/// Width of a plot in a page.
enum class PlotWidth {
    HalfWidth, ///< one of two beside each other
    FullWidth, ///< over the page's whole width
    Small      ///< one of many; without the names of its axes
};

/// A plot for a page: its title, key and numbers, which page_script() draws at the size that it finds. Numbers have
/// four significant digits.
std::string page_plot(const Plot& plot, PlotWidth place);

/// A self-contained page on one recording, or on several (several_recordings_html). That on one has its figures with
/// their definitions, plots over simulated time with the path's legs, pictures, its slowest frames and why, settings
/// and machine. `first_tables` tables come first. Nothing is fetched when it is read; its own script draws the plots.
/// `page_folder` is where the page will lie, for links.
std::string html_report(
    Recordings recordings, std::span<const HtmlTable> first_tables = {}, const std::filesystem::path& page_folder = {});

} // namespace octant::ui::report
