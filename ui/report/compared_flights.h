#pragma once

#include "ui/report/loaded_recording.h"

#include <span>
#include <string>

namespace octant::ui::report {

/// Recordings of the same flight on the same kind of machine beside each other, as HTML: a table of
/// their variants where settings differ, and their frame times in one plot. Says so where no two
/// belong together.
std::string compared_flights_html(Recordings recordings);

} // namespace octant::ui::report
