#include "sim/base/error.h"
#include "sim/base/output_file.h"
#include "sim/base/text_file.h"
#include "ui/base/data_files.h"
#include "ui/base/progress.h"
#include "ui/base/stop_signals.h"
#include "ui/command_line/setting_option.h"
#include "ui/commands/commands.h"
#include "ui/flight/flight_loop.h"
#include "ui/flight/flight_recorder.h"
#include "ui/flight/listener.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/report/video_pipe.h"
#include "ui/settings/settings.h"
#include "ui/window/viewer.h"
#include "ui/world/entity_table.h"
#include "ui/world/input_files.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace octant::ui::commands {

using namespace command_line;

namespace {

struct ListenOptions : base::OutputOptions {
    settings::RunSettings settings;
    flight::ListenerOptions listener;
    std::optional<int> vehicles;         ///< number shown, at least as many as there are aircraft; nothing = 16
    std::optional<std::string> entities; ///< file of world::read_entity_table
    std::vector<std::string> send;       ///< addresses, as flight::Sender has them
    flight::RecordOptions record;
    window::ViewOptions window;
    bool headless = false;
};

/// Settings of a path that the program flies itself.
constexpr std::array<std::string_view, 10> path_only_settings{"path", "heading", "height-mode", "over-map", "lenient",
    "start", "frame-per-sample", "realtime", "mesh-ahead", "path-ribbon"};

/// Options that only --help-all shows.
constexpr std::array<std::string_view, 12> rarely_used{"--xplane", "--step", "--vehicles", "--channel", "--frames",
    "--adapt", "--shading", "--triangles", "--error-px", "--place", "--renderer", "--terrain-lod"};

/// UDP and TCP ports, the address to listen on and hosts to contact.
void add_port_options(std::vector<Option>& table, flight::LiveInputOptions& input) {
    table.insert(table.end(),
        {text_option("--bind", "ADDRESS",
             "IPv4 address of this machine to listen on; 0.0.0.0 = all addresses, reachable from other machines",
             input.bind),
            text_option("--xplane", "HOST[:PORT]",
                "request motion data from the X-Plane at this address [port 49000]; not needed if X-Plane sends DATA",
                input.xplane_host)});
    const auto port = [](std::string_view name, std::string_view meaning, auto& value) {
        return value_option({name, "PORT", meaning, -1, 65535}, value);
    };
    add_family(table,
        {.name = "--ports",
            .form = "KEY=PORT,...",
            .meaning = "ports to listen on; 0 = any free one, -1 = closed; with --channel only CIGI is open"},
        {{"fdm", port("fdm-port", "UDP, FlightGear's FGNetFDM [5550]", input.fdm_port)},
            {"mavlink", port("mavlink-port", "UDP, MAVLink 1 and 2 [14550]", input.mavlink_port)},
            {"dis", port("dis-port", "UDP, DIS entity states [3000]", input.dis_port)},
            {"xplane", port("xplane-port", "UDP, X-Plane's DATA (groups 3, 17, 18, 20 and 21) and RREF [49003]",
                           input.xplane_port)},
            {"cigi", port("cigi-port", "UDP, CIGI 3.3 hosts, as their image generator", input.cigi_port)},
            {"lines", port("lines-port", "TCP, lines of named columns", input.lines_port)}});
}

/// What a CIGI host gets and which of its views is shown.
void add_cigi_options(std::vector<Option>& table, flight::ListenerOptions& listener) {
    add_family(table, {.name = "--cigi", .form = "KEY=VALUE,...", .meaning = "CIGI host:", .shown = Shown::InHelpAll},
        {{"host", text_option("--cigi-host", "HOST:PORT", "address that receives Start of Frame and responses",
                      listener.input.cigi_host)},
            {"view", value_option({"cigi-view", "N",
                                      "view to show, with the next one in the --inset [the lowest number]", 0, 65535},
                         listener.live.view)}});
}

void read_packet_source(const std::string& from, flight::LiveInputOptions& input) {
    if (from != "-") {
        sim::links::address_from_text("--from", from);
        input.only_from = from;
        return;
    }
    input.standard_input = true;
    input.fdm_port = -1;
    input.mavlink_port = -1;
    input.dis_port = -1;
    input.xplane_port = -1;
    input.cigi_port = -1;
}

Option from_option(flight::LiveInputOptions& input) {
    return {.name = "--from",
        .form = "-|ADDRESS",
        .meaning = "-: only lines of named columns from standard input; an IPv4 address: only packets of this machine",
        .read = [&input](const Words& words) { read_packet_source(words.front(), input); }};
}

Option channel_option(flight::ListenerOptions& listener) {
    Option option = value_option({"channel", "CHANNEL",
                                     "left, front or right: one of three adjacent pictures of a panorama, rotated by "
                                     "the horizontal field of view; driven by a CIGI host only"},
        listener.live.channel);
    option.shown_default.clear();
    option.read = [&listener, read = option.read](const Words& words) {
        read(words);
        listener.input.is_channel = true;
    };
    return option;
}

void read_vehicles(const std::string& word, ListenOptions& options) {
    if (is_file(word) || extension_of(word) == ".toml") {
        options.entities = word;
    } else {
        settings::read_setting({"--vehicles", "", "", 1, 256}, word, options.vehicles);
    }
}

/// What is shown of what comes.
std::vector<Option> view_options(ListenOptions& options) {
    return {{.name = "--vehicles",
                .form = "N|FILE.toml",
                .meaning = "largest number of vehicles shown [16], of which those beyond the --aircraft options look "
                           "like the last of them; or the aircraft of CIGI entity types: a file of tables [[entity]] "
                           "with type, aircraft and count, which replaces --aircraft",
                .read = [&options](const Words& words) { read_vehicles(words.front(), options); }},
        old_name(text_option("--entities", "FILE.toml", "", options.entities), "--vehicles FILE.toml"),
        value_option(
            {"delay", "S",
                "display delay in seconds: 0 extrapolates by velocity, larger values interpolate between packets", 0.0,
                5.0},
            options.listener.live.delay_s)};
}

void append(std::vector<Option>& table, std::vector<Option> more) {
    std::ranges::move(more, std::back_inserter(table));
}

std::vector<Option> options_of(ListenOptions& options) {
    options.settings.path.name = settings::live_path;
    flight::ListenerOptions& listener = options.listener;
    std::vector<Option> table = with_output_options(options,
        {flag("--headless", "no window: only pictures, video and recording", options.headless),
            text_option("--record", "DIR", "folder for the recording and its report; in a window until F9 ends it",
                options.record.folder),
            text_option("--video", "FILE.mp4", "with --headless: write a video (needs ffmpeg)", options.record.video)});
    add_window_options(table, options.window);
    add_port_options(table, listener.input);
    add_cigi_options(table, listener);
    table.push_back(from_option(listener.input));
    table.push_back(flag("--step",
        "with --headless: render one picture for each packet that moves something, without delay", listener.live.step));
    table.push_back(channel_option(listener));
    append(table, view_options(options));
    table.push_back(
        value_option({"height", "MODE",
                         "how received heights are used: msl: above mean sea level; agl: the sender's height "
                         "above ground, added to our ground; offset: as msl, shifted so that the first "
                         "height above our ground equals the sender's [msl on a georeferenced map, else "
                         "offset]"},
            listener.live.height));
    table.push_back(advanced(list_option("--send", "PROTOCOL:HOST:PORT",
        "forward aircraft to another program, as octant fly --send", Arity::Repeatable, options.send)));
    add_setting_options(table, options.settings, nullptr, path_only_settings);
    for (Option& option : table) {
        if (std::ranges::find(rarely_used, option.name) != rarely_used.end()) { option.shown = Shown::InHelpAll; }
    }
    return table;
}

constexpr double poll_interval_s = 0.0005; ///< in steps, for the next packet

/// What came, for programs: every vehicle, and what its packets were.
base::JsonValue::JsonMembers results_of_run(const sim::links::LiveTraffic& traffic) {
    base::JsonValue vehicles = base::JsonValue::list({});
    for (const sim::links::VehicleReport& vehicle : traffic.vehicle_reports()) {
        vehicles.push_back({{"protocol", std::string(sim::links::name_of(vehicle.protocol))}, {"name", vehicle.name},
            {"marking", vehicle.marking}, {"from", sim::links::text_of(vehicle.source)}, {"packets", vehicle.packets},
            {"latitude_deg", vehicle.latitude_deg}, {"longitude_deg", vehicle.longitude_deg},
            {"altitude_m", vehicle.altitude_m}, {"shown", vehicle.is_shown}});
    }
    base::JsonValue packets = base::JsonValue::list({});
    for (const sim::links::PacketReport& form : traffic.packet_reports()) {
        packets.push_back({{"from", sim::links::text_of(form.source)}, {"what", form.text}, {"packets", form.packets},
            {"refused", form.is_wrong}});
    }
    return {{"vehicles", std::move(vehicles)}, {"packets", std::move(packets)},
        {"packets_untold", traffic.counts().unreported}};
}

/// A flight from outside, picture after picture, at the rate of the settings by the clock.
class HeadlessListener {
public:
    explicit HeadlessListener(const ListenOptions& options)
        : options_(options), listener_(options.listener), sender_(options.send), session_(options.settings),
          recorder_(options.record, options.settings, session_) {
        listener_.attach(session_);
        if (options.record.folder) { listener_.start_packet_recording(*options.record.folder); }
    }

    flight::FlightResult fly() {
        print_new_messages();
        const double frame_s = 1.0 / options_.settings.time.rate_hz;
        began_s_ = listener_.now_s();
        double due_s = began_s_;
        const bool step = options_.listener.live.step;
        int frame = 0;
        while (!base::StopSignals::received() && !is_over(frame)) {
            wait_until(step ? listener_.now_s() + poll_interval_s : due_s);
            const bool drawn = draw(due_s + frame_s);
            frame += drawn ? 1 : 0;
            due_s = std::max(due_s + frame_s, listener_.now_s() - frame_s);
            if (listener_.has_ended() && !(step && drawn)) { break; }
        }
        if (base::StopSignals::received()) {
            base::print_note(
                options_.quiet, fmt::format("note: ended by {} after {} pictures", base::StopSignals::name(), frame));
        }
        listener_.finish();
        return recorder_.finish(session_);
    }

    const sim::links::LiveTraffic& traffic() const { return listener_.live().traffic(); }

private:
    bool is_over(int frame) const {
        const settings::TimeSettings& time = options_.settings.time;
        return (time.frames && frame >= *time.frames) ||
               (time.seconds && frame > 0 && listener_.now_s() - began_s_ >= *time.seconds);
    }

    void wait_until(double due_s) const {
        const double left_s = due_s - listener_.now_s();
        if (left_s > 0.0) { std::this_thread::sleep_for(std::chrono::duration<double>(left_s)); }
    }

    /// Returns false where there is nothing to draw.
    bool draw(double next_due_s) {
        const std::optional<double> time_s = listener_.take(session_);
        for (const std::string& line : listener_.take_new_messages()) { base::print_note(options_.quiet, line); }
        if (!time_s) {
            listener_.contact_hosts();
            return false;
        }
        report::FrameRecord record = session_.draw_at(*time_s, std::nullopt);
        listener_.finish_picture(record);
        if (options_.listener.live.step) {
            record.latency_ms = std::numeric_limits<double>::quiet_NaN();
        } else {
            record.missed = listener_.now_s() > next_due_s ? 1 : 0;
        }
        sender_.send(session_);
        recorder_.add(record, session_);
        return true;
    }

    void print_new_messages() const {
        for (const std::string& note : session_.world().notes) {
            base::print_note(options_.quiet, fmt::format("note: {}", note));
        }
    }

    const ListenOptions& options_;
    flight::Listener listener_;
    flight::Sender sender_;
    flight::Session session_;
    /// From here on a signal ends the flight in order: the recorder makes files.
    const base::StopSignals stop_signals_;
    flight::FlightRecorder recorder_;
    double began_s_ = 0.0;
};

void listen_without_window(const ListenOptions& options) {
    if (options.record.video) { report::check_video(*options.record.video); }
    HeadlessListener run(options);
    const flight::FlightResult end = run.fly();
    for (const std::string& note : end.notes) { base::print_note(options.quiet, note); }
    for (const std::string& warning : end.missing_programs) { base::print_note(false, warning); }
    for (const sim::links::PacketReport& form : run.traffic().packet_reports()) {
        if (form.is_wrong) {
            base::print_note(options.quiet,
                fmt::format("note: {} packets from {}: {}", form.packets, sim::links::text_of(form.source), form.text));
        }
    }
    if (const long unreported = run.traffic().counts().unreported; unreported > 0) {
        base::print_note(
            options.quiet, fmt::format("note: {} packets more, of too many kinds to tell each", unreported));
    }
    flight::print_result(end, std::nullopt, options.json, results_of_run(run.traffic()));
    if (!end.fault.empty()) { throw Error(end.fault); }
}

constexpr int default_vehicles = 16;

void listen_in_window(ListenOptions options) {
    if (options.listener.live.step) { throw Error("--step: expected --headless beside it, got none"); }
    if (options.record.video) { throw Error("--video: expected --headless beside it, got none"); }
    options.window.settings = options.settings;
    options.window.config_folder = base::configuration_folder();
    options.window.listener = options.listener;
    options.window.send = options.send;
    options.window.record = options.record.folder;
    options.window.quiet = options.quiet;
    window::Viewer viewer(options.window);
    viewer.run(options.settings.time.frames, options.quiet);
}

void listen(ListenOptions options) {
    settings::RunSettings& settings = options.settings;
    settings.path.name = settings::live_path;
    std::vector<std::string>& aircraft = settings.path.aircraft;
    if (options.entities) {
        if (options.vehicles) {
            throw Error("--vehicles: expected no --entities beside it, whose count says how many");
        }
        world::EntityTable table = world::read_entity_table(*options.entities);
        aircraft = std::move(table.aircraft);
        options.listener.live.shapes = std::move(table.types);
    } else {
        const auto vehicles = static_cast<std::size_t>(options.vehicles.value_or(default_vehicles));
        const std::string last = aircraft.back();
        aircraft.resize(std::max(aircraft.size(), vehicles), last);
    }
    settings = world::with_absolute_paths(settings);
    if (options.headless) {
        listen_without_window(options);
    } else {
        listen_in_window(std::move(options));
    }
}

} // namespace

Command listen_command() {
    auto options = std::make_shared<ListenOptions>();
    options->window.recordings_folder = ".";
    return {.name = "listen",
        .summary =
            "Displays aircraft that other programs control: FlightGear FDM, X-Plane, CIGI, MAVLink, DIS, lines of "
            "numbers",
        .options = options_of(*options),
        .footer = "Examples:\n"
                  "  octant listen --terrain map.tif --view cockpit --delay 0.1\n"
                  "  octant listen --headless --seconds 60 --record my-flight --video flight.mp4\n"
                  "  my-script | octant listen --from - --headless --step --record steps\n"
                  "Ctrl-C ends it and completes the recording. How other programs are set up: sim/links/README.md.",
        .run = [options] { listen(*options); }};
}

} // namespace octant::ui::commands
