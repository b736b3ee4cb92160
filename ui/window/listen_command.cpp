#include "ui/window/listen_command.h"

#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/base/user_folders.h"
#include "ui/commands/listen.h"
#include "ui/window/view_command.h"
#include "ui/window/viewer.h"
#include "ui/world/entity_table.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace octant::ui::window {

namespace {

constexpr int default_vehicles = 16;

struct ListenWork {
    commands::ListenOptions listen;
    ViewOptions view;
    bool headless = false;
};

void listen_in_window(ListenWork work) {
    if (work.listen.listener.live.step) { throw Error("--step: expected --headless beside it, got none"); }
    if (work.listen.record.video) { throw Error("--video: expected --headless beside it, got none"); }
    work.view.settings = work.listen.settings;
    work.view.config_folder = base::configuration_folder();
    work.view.listener = work.listen.listener;
    work.view.send = work.listen.send;
    work.view.record = work.listen.record.folder;
    work.view.quiet = work.listen.quiet;
    Viewer viewer(work.view);
    const base::StopSignals stop_signals;
    int frames = 0;
    while (viewer.run_frame() && !base::StopSignals::received()) {
        if (work.view.settings.time.frames && ++frames >= *work.view.settings.time.frames) { break; }
    }
    if (const auto report = viewer.finish_recording()) { base::print_note(work.listen.quiet, *report); }
}

void listen(ListenWork work) {
    settings::RunSettings& settings = work.listen.settings;
    settings.path.name = settings::live_path;
    std::vector<std::string>& aircraft = settings.path.aircraft;
    if (work.listen.entities) {
        if (work.listen.vehicles) {
            throw Error("--vehicles: expected no --entities beside it, whose count says how many");
        }
        world::EntityTable table = world::read_entity_table(*work.listen.entities);
        aircraft = std::move(table.aircraft);
        work.listen.listener.live.shapes = std::move(table.types);
    } else {
        const auto vehicles = static_cast<std::size_t>(work.listen.vehicles.value_or(default_vehicles));
        const std::string last = aircraft.back();
        aircraft.resize(std::max(aircraft.size(), vehicles), last);
    }
    settings = world::with_absolute_paths(settings);
    if (work.headless) {
        commands::listen_without_window(work.listen);
    } else {
        listen_in_window(std::move(work));
    }
}

std::vector<commands::Option> options_of(ListenWork& work) {
    using namespace commands;
    ListenOptions& listen = work.listen;
    std::vector<Option> table = {flag("--headless", "no window: pictures, video and recording alone", work.headless),
        text_option("--record", "DIR",
            "write the recording and its report into this folder; in a window its view stays as it "
            "is until F9 ends it",
            listen.record.folder),
        text_option("--video", "FILE.mp4", "with --headless: write a video (needs ffmpeg)", listen.record.video),
        flag("--json", "with --headless: summary as JSON, with every vehicle and what its packets were", listen.json),
        flag("--full-screen", "fill the screen (F11)", work.view.full_screen),
        flag("--vsync,!--no-vsync", "one picture a refresh of the display; else as many as there can be",
            work.view.vsync),
        flag("--panels,!--no-panels", "begin with panels shown (Tab)", work.view.panels)};
    std::vector<Option> shared = listen_options(listen);
    table.insert(table.end(), std::make_move_iterator(shared.begin()), std::make_move_iterator(shared.end()));
    return table;
}

} // namespace

commands::Command listen_command() {
    auto work = std::make_shared<ListenWork>();
    work->view.recordings_folder = ".";
    return {.name = "listen",
        .summary = "Shows what other programs fly: FlightGear FDM, X-Plane, CIGI, MAVLink, DIS, lines of "
                   "numbers",
        .options = options_of(*work),
        .footer = "Examples:\n"
                  "  octant listen\n"
                  "  octant listen --terrain map.tif --view cockpit --delay 0.1\n"
                  "  octant listen --headless --seconds 60 --record my-flight --video flight.mp4\n"
                  "  my-script | octant listen --from - --headless --step --record steps\n"
                  "JSBSim: JSBSim --script=... --realtime --logdirectivefile=FILE, in FILE:\n"
                  "  <output name=\"127.0.0.1\" type=\"FLIGHTGEAR\" port=\"5550\" "
                  "protocol=\"UDP\" rate=\"60\"/>\n"
                  "ArduPilot: sim_vehicle.py -v ArduPlane\n"
                  "FlightGear: fgfs --native-fdm=socket,out,60,127.0.0.1,5550,udp\n"
                  "X-Plane: data output by UDP of groups 3, 17, 18, 20 and 21 to port 49003; or "
                  "octant listen --xplane HOST\n"
                  "Ctrl-C ends it; a recording is then completed.",
        .run = [work] { listen(*work); }};
}

} // namespace octant::ui::window
