#include "ui/commands/listen.h"

#include "sim/base/error.h"
#include "ui/base/progress.h"
#include "ui/commands/flight_summary.h"
#include "ui/commands/interrupt.h"
#include "ui/commands/read_option.h"
#include "ui/commands/settings_options.h"
#include "ui/flight/sender.h"
#include "ui/flight/session.h"
#include "ui/report/video_pipe.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace octant::ui::commands {

namespace {

/// Settings that say something about a path of our own.
constexpr std::array<std::string_view, 9> of_paths{
    "path",
    "--heading",
    "--height-mode",
    "--lenient,!--no-lenient",
    "--start",
    "--frame-per-sample,!--no-frame-per-sample",
    "--realtime,!--no-realtime",
    "--mesh-ahead,!--no-mesh-ahead",
    "--path-ribbon,!--no-path-ribbon"};

constexpr double look_every_s = 0.0005; ///< in steps, for the next packet

/// A flight from outside, picture after picture, at the rate of the settings by the clock.
class HeadlessRun {
public:
    explicit HeadlessRun(const ListenOptions& options)
        : options_(options)
        , listener_(options.listener)
        , session_(options.settings)
        , recorder_(options.record, options.settings, session_)
        , sender_(options.send) {
        listener_.attach(session_);
        if (options.record.folder) {
            listener_.record_into(*options.record.folder);
        }
        session_.simulation().start_log();
    }

    flight::FlightEnd fly() {
        tell_notes();
        const Interrupt interrupt;
        const double frame_s = 1.0 / options_.settings.time.rate_hz;
        began_s_ = listener_.now_s();
        double due_s = began_s_;
        const bool step = options_.listener.live.step;
        for (int frame = 0; !interrupt.came() && !is_over(frame);) {
            wait_until(step ? listener_.now_s() + look_every_s : due_s);
            const bool drawn = draw(due_s + frame_s);
            frame += drawn ? 1 : 0;
            due_s = std::max(due_s + frame_s, listener_.now_s() - frame_s);
            if (listener_.has_ended() && !(step && drawn)) {
                break;
            }
        }
        listener_.finish();
        return recorder_.finish(session_);
    }

private:
    bool is_over(int frame) const {
        const settings::TimeSettings& time = options_.settings.time;
        return (time.frames && frame >= *time.frames) ||
               (time.seconds && frame > 0 && listener_.now_s() - began_s_ >= *time.seconds);
    }

    void wait_until(double due_s) const {
        const double left_s = due_s - listener_.now_s();
        if (left_s > 0.0) {
            std::this_thread::sleep_for(std::chrono::duration<double>(left_s));
        }
    }

    /// Returns false where there is nothing to draw.
    bool draw(double next_due_s) {
        const std::optional<double> time_s = listener_.take(session_);
        for (const std::string& line : listener_.take_news()) {
            base::say(options_.quiet, line);
        }
        if (!time_s) {
            listener_.call_hosts();
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

    void tell_notes() const {
        for (const std::string& note : session_.world().notes) {
            base::say(options_.quiet, fmt::format("note: {}", note));
        }
    }

    const ListenOptions& options_;
    flight::Listener listener_;
    flight::Session session_;
    flight::FlightRecorder recorder_;
    flight::Sender sender_;
    double began_s_ = 0.0;
};

void take_from(const std::string& from, ListenOptions& options) {
    flight::LiveInputOptions& input = options.listener.input;
    if (from != "-") {
        sim::links::address_from_text(from);
        input.only_from = from;
        return;
    }
    input.standard_input = true;
    input.fdm_port = -1;
    input.mavlink_port = -1;
    input.dis_port = -1;
    input.cigi_port = -1;
}

} // namespace

std::vector<Option> listen_options(ListenOptions& options) {
    options.settings.path.name = settings::live_path;
    std::vector<Option> table = {
        text_option(
            "--bind",
            "ADDRESS",
            "listen on this IPv4 address of this machine; 0.0.0.0 = on all, for other machines too",
            options.listener.input.bind),
        read_option(
            {"fdm-port",
             "PORT",
             "UDP port for FlightGear's FGNetFDM; 0 = any free one, -1 = closed [5550; none with "
             "--channel]",
             -1,
             65535},
            options.listener.input.fdm_port),
        read_option(
            {"mavlink-port",
             "PORT",
             "UDP port for MAVLink 1 and 2; -1 = closed [14550; none with --channel]",
             -1,
             65535},
            options.listener.input.mavlink_port),
        read_option(
            {"dis-port",
             "PORT",
             "UDP port for DIS entity states; -1 = closed [3000; none with --channel]",
             -1,
             65535},
            options.listener.input.dis_port),
        read_option(
            {"cigi-port",
             "PORT",
             "UDP port for hosts of CIGI 3.3, as their image generator; -1 = closed",
             -1,
             65535},
            options.listener.input.cigi_port),
        text_option(
            "--cigi-host",
            "HOST:PORT",
            "who gets Start of Frame and answers",
            options.listener.input.cigi_host),
        read_option(
            {"lines-port", "PORT", "TCP port for lines of named columns; -1 = closed", -1, 65535},
            options.listener.input.lines_port),
        {.name = "--from",
         .form = "-|ADDRESS",
         .meaning = "-: lines of named columns on standard input alone, no ports; an IPv4 address: "
                    "packets of that machine alone",
         .read = [&options](const Words& words) { take_from(words.front(), options); }},
        flag(
            "--step",
            "with --headless: one picture for each packet that moves something, of what it says",
            options.listener.live.step),
        {.name = "--channel",
         .form = "CHANNEL",
         .meaning = "left, front or right: one of three pictures side by side of one world; left "
                    "and right are turned by the picture's own width; a CIGI host alone drives it",
         .read =
             [&options](const Words& words) {
                 const auto channel = flight::live_channel_from(words.front());
                 if (!channel) {
                     throw Error(fmt::format(
                         "--channel: expected {}, got '{}'",
                         flight::live_channel_names,
                         printable(words.front())));
                 }
                 options.listener.live.channel = *channel;
                 options.listener.input.is_channel = true;
             }},
        read_option(
            {"vehicles",
             "N",
             "show as many vehicles [16]: those beyond the --aircraft given look like the last one",
             1,
             256},
            options.vehicles),
        text_option(
            "--entities",
            "FILE.toml",
            "what types of CIGI entities are: tables [[entity]] with type, aircraft and count; the "
            "aircraft are those of the file",
            options.entities),
        read_option(
            {"cigi-view",
             "N",
             "show this view of a CIGI host, and its next one in the --inset [the one of the "
             "lowest "
             "number]",
             0,
             65535},
            options.listener.live.view),
        read_option(
            {"delay",
             "S",
             "show what was so long ago: 0 goes on by velocity, more lies between packets",
             0.0,
             5.0},
            options.listener.live.delay_s),
        {.name = "--height",
         .form = "MODE",
         .meaning = "whose heights count: msl: the sender's above the sea; agl: his above ground, "
                    "over ours; offset: as msl, moved once to be as high above our ground [msl on "
                    "a map with a place, else offset]",
         .read =
             [&options](const Words& words) {
                 options.listener.live.height = flight::live_height_from(words.front());
                 if (!options.listener.live.height) {
                     throw Error(fmt::format(
                         "--height: expected {}, got '{}'",
                         flight::live_height_names,
                         printable(words.front())));
                 }
             }},
        list_option(
            "--send",
            "fdm|dis|cigi|tacview:HOST:PORT",
            "send each picture's aircraft on to another program, as octant fly --send",
            Takes::OneWordAgain,
            options.send),
        flag("--quiet", "no notes", options.quiet)};
    const std::size_t own = table.size();
    add_setting_options(table, options.settings);
    const auto first = table.begin() + static_cast<std::ptrdiff_t>(own);
    table.erase(
        std::remove_if(
            first,
            table.end(),
            [](const Option& option) {
                return std::ranges::find(of_paths, option.name) != of_paths.end();
            }),
        table.end());
    return table;
}

void listen_without_window(const ListenOptions& options) {
    if (options.record.video) {
        report::check_video(*options.record.video);
    }
    HeadlessRun run(options);
    const flight::FlightEnd end = run.fly();
    for (const std::string& note : end.notes) {
        base::say(options.quiet, note);
    }
    for (const std::string& missing : end.missing) {
        base::say(false, missing);
    }
    print_summary(end, std::nullopt, options.json);
    if (!end.fault.empty()) {
        throw Error(end.fault);
    }
}

} // namespace octant::ui::commands
