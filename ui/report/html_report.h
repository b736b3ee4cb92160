#pragma once

#include "ui/report/html_text.h"
#include "ui/report/loaded_recording.h"

#include <span>
#include <string>

namespace octant::ui::report {

/// A self-contained page on one recording, or on several side by side: figures with their
/// definitions, plots, pictures, overruns and why, settings and machine; rows in which recordings
/// differ are marked. `further` tables come last. Nothing is fetched when it is read. Without
/// gnuplot the page has no plots and says so. Throws Error when gnuplot fails.
std::string
html_report(std::span<const LoadedRecording> recordings, std::span<const HtmlTable> further = {});

} // namespace octant::ui::report
