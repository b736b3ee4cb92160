#include "ui/commands/window_options.h"

#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"

#include <string>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

void add_window_options(std::vector<Option>& table, window::ViewOptions& view, std::filesystem::path* recordings) {
    std::vector<FamilyKey> keys{{"full-screen", flag("--full-screen", "fill the screen (F11)", view.full_screen)},
        {"vsync", with_shown_default(
                      "true", flag("--vsync,!--no-vsync",
                                  "one picture per refresh of the display; else as many as possible", view.vsync))},
        {"panels",
            with_shown_default("true", flag("--panels,!--no-panels", "begin with panels shown (Tab)", view.panels))}};
    if (recordings != nullptr) {
        keys.push_back({"recordings", with_shown_default(recordings->string(),
                                          text_option("--records-into", "DIR",
                                              "folder for recordings (F9) and screenshots (F12)", *recordings))});
    }
    add_family(table, {.name = "--window", .form = "[no-]KEY,...", .meaning = "the window:"}, std::move(keys));
}

void run_viewer(window::Viewer& viewer, const std::optional<int>& frames, bool quiet) {
    const base::StopSignals stop_signals;
    int shown = 0;
    while (viewer.run_frame() && !base::StopSignals::received()) {
        if (frames && ++shown >= *frames) { break; }
    }
    if (const auto report = viewer.finish_recording()) { base::print_note(quiet, *report); }
}

} // namespace octant::ui::commands
