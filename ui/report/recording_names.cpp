#include "ui/report/recording_names.h"

#include "sim/base/output_file.h"
#include "ui/report/folder_lock.h"
#include "ui/report/kernel_counters.h"

#include <algorithm>
#include <array>

namespace octant::ui::report {

bool is_recording_name(std::string_view name) {
    constexpr std::array<std::string_view, 12> names{lock_name, "inputs", "run.json", "frames.csv", "mangohud.csv",
        "trace.json", "track.acmi", "track.csv", "flight.csv", counters_name, "packets.bin", "report.html"};
    const bool is_picture = (name.starts_with("picture-") || name.starts_with("slow-")) && name.ends_with(".png");
    return is_unfinished(name) || is_picture || std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace octant::ui::report
