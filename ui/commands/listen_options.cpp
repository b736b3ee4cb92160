#include "sim/base/error.h"
#include "ui/commands/listen.h"
#include "ui/commands/settings_options.h"
#include "ui/commands/value_option.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::commands {

namespace {

/// Settings that say something about a path of our own.
constexpr std::array<std::string_view, 9> path_only_settings{"path", "--heading", "--height-mode",
    "--lenient,!--no-lenient", "--start", "--frame-per-sample,!--no-frame-per-sample", "--realtime,!--no-realtime",
    "--mesh-ahead,!--no-mesh-ahead", "--path-ribbon,!--no-path-ribbon"};

/// Where packets come from.
std::vector<Option> port_options(flight::LiveInputOptions& input) {
    return {text_option("--bind", "ADDRESS",
                "listen on this IPv4 address of this machine; 0.0.0.0 = on all, for other machines too", input.bind),
        value_option({"fdm-port", "PORT",
                         "UDP port for FlightGear's FGNetFDM; 0 = any free one, -1 = closed [5550; none with "
                         "--channel]",
                         -1, 65535},
            input.fdm_port),
        value_option({"mavlink-port", "PORT", "UDP port for MAVLink 1 and 2; -1 = closed [14550; none with --channel]",
                         -1, 65535},
            input.mavlink_port),
        value_option(
            {"dis-port", "PORT", "UDP port for DIS entity states; -1 = closed [3000; none with --channel]", -1, 65535},
            input.dis_port),
        value_option({"xplane-port", "PORT",
                         "UDP port for X-Plane's DATA (groups 3, 17, 18, 20 and 21) and RREF; -1 = closed "
                         "[49003; none with --channel]",
                         -1, 65535},
            input.xplane_port),
        text_option("--xplane", "HOST[:PORT]",
            "ask the X-Plane there for its motion, at port 49000 where none is given; its DATA "
            "needs no asking",
            input.xplane_host),
        value_option(
            {"cigi-port", "PORT", "UDP port for hosts of CIGI 3.3, as their image generator; -1 = closed", -1, 65535},
            input.cigi_port),
        text_option("--cigi-host", "HOST:PORT", "who gets Start of Frame and answers", input.cigi_host),
        value_option(
            {"lines-port", "PORT", "TCP port for lines of named columns; -1 = closed", -1, 65535}, input.lines_port)};
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
        .meaning = "-: lines of named columns on standard input alone, no ports; an IPv4 address: "
                   "packets of that machine alone",
        .read = [&input](const Words& words) { read_packet_source(words.front(), input); }};
}

Option channel_option(flight::ListenerOptions& listener) {
    return {.name = "--channel",
        .form = "CHANNEL",
        .meaning = "left, front or right: one of three pictures side by side of one world; left "
                   "and right are turned by the picture's own width; a CIGI host alone drives it",
        .read = [&listener](const Words& words) {
            const auto channel = flight::live_channel_from(words.front());
            if (!channel) {
                throw Error(fmt::format(
                    "--channel: expected {}, got '{}'", flight::live_channel_names, printable(words.front())));
            }
            listener.live.channel = *channel;
            listener.input.is_channel = true;
        }};
}

Option height_option(flight::LiveOptions& live) {
    return {.name = "--height",
        .form = "MODE",
        .meaning = "whose heights count: msl: the sender's above the sea; agl: his above ground, "
                   "over ours; offset: as msl, moved so that he begins as high above our ground "
                   "[msl on a map with a place, else offset]",
        .read = [&live](const Words& words) {
            live.height = flight::live_height_mode_from(words.front());
            if (!live.height) {
                throw Error(fmt::format(
                    "--height: expected {}, got '{}'", flight::live_height_mode_names, printable(words.front())));
            }
        }};
}

/// What is shown of what comes.
std::vector<Option> view_options(ListenOptions& options) {
    return {value_option(
                {"vehicles", "N",
                    "show as many vehicles [16]: those beyond the --aircraft given look like the last one", 1, 256},
                options.vehicles),
        text_option("--entities", "FILE.toml",
            "what types of CIGI entities are: tables [[entity]] with type, aircraft and count; the "
            "aircraft are those of the file",
            options.entities),
        value_option({"cigi-view", "N",
                         "show this view of a CIGI host, and its next one in the --inset [the one of the "
                         "lowest "
                         "number]",
                         0, 65535},
            options.listener.live.view),
        value_option(
            {"delay", "S", "show what was so long ago: 0 goes on by velocity, more lies between packets", 0.0, 5.0},
            options.listener.live.delay_s)};
}

void append(std::vector<Option>& table, std::vector<Option> more) {
    std::ranges::move(more, std::back_inserter(table));
}

/// The settings that say nothing about a path of our own.
std::vector<Option> settings_of_live(settings::RunSettings& settings) {
    std::vector<Option> table;
    add_setting_options(table, settings);
    std::erase_if(table, [](const Option& option) {
        return std::ranges::find(path_only_settings, option.name) != path_only_settings.end();
    });
    return table;
}

} // namespace

std::vector<Option> listen_options(ListenOptions& options) {
    options.settings.path.name = settings::live_path;
    flight::ListenerOptions& listener = options.listener;
    std::vector<Option> table = port_options(listener.input);
    table.push_back(from_option(listener.input));
    table.push_back(flag("--step", "with --headless: one picture for each packet that moves something, of what it says",
        listener.live.step));
    table.push_back(channel_option(listener));
    append(table, view_options(options));
    table.push_back(height_option(listener.live));
    append(table, {list_option("--send", "fdm|dis|xplane|cigi|tacview:HOST:PORT",
                       "send each picture's aircraft on to another program, as octant fly --send", Arity::Repeatable,
                       options.send),
                      flag("--quiet", "no notes", options.quiet)});
    append(table, settings_of_live(options.settings));
    return table;
}

} // namespace octant::ui::commands
