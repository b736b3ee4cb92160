#include "ui/base/progress.h"
#include "ui/base/results_text.h"
#include "ui/commands/commands.h"
#include "ui/report/packed_recording.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>

namespace octant::ui::commands {

namespace {

struct PackOptions {
    std::filesystem::path folder;
    std::optional<std::filesystem::path> out;
    bool with_terrain = false;
    bool json = false;
    bool quiet = false;
};

void pack(const PackOptions& options) {
    std::filesystem::path folder = options.folder;
    if (!folder.has_filename()) { // "my-flight/"
        folder = folder.parent_path();
    }
    const std::filesystem::path file = options.out.value_or(folder.string() + ".zip");
    const report::PackResult packing = report::pack_recording(folder, file, options.with_terrain);
    for (const std::string& note : packing.notes) { base::print_note(options.quiet, "note: " + note); }
    if (options.json) {
        base::print_value({{"file", file.string()}, {"files", packing.files}, {"notes", packing.notes}}, true);
    }
    base::print_note(options.quiet, fmt::format("packed: {}, {} files", file.string(), packing.files));
}

} // namespace

Command pack_command() {
    auto options = std::make_shared<PackOptions>();
    return {.name = "pack",
        .summary = "Makes one file of a recording, to be reported and flown again anywhere",
        .options = {required(text_option("folder", "DIR", "folder of a recording", options->folder)),
            with_shown_default("DIR.zip", text_option("--out", "FILE.zip", "the file", options->out)),
            flag("--with-terrain", "pack the terrain file too", options->with_terrain),
            flag("--json", "what was packed as JSON", options->json), flag("--quiet", "no notes", options->quiet)},
        .footer = "Examples:\n"
                  "  octant pack my-flight --out my-flight.zip\n"
                  "On any machine then: octant report my-flight.zip --out page.html; and octant fly\n"
                  "--replay or --settings my-flight.zip.",
        .run = [options] { pack(*options); }};
}

} // namespace octant::ui::commands
