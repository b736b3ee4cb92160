#include "ui/flight/sender.h"

#include "sim/aircraft_kind.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/xplane.h"
#include "ui/flight/session_fix.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <utility>

namespace octant::ui::flight {

namespace links = sim::links;

namespace {

/// Of "tacview:PORT" or "tacview:ADDRESS:PORT".
links::PacketSource reader_address(const std::string& target) {
    const std::string rest = target.substr(target.find(':') + 1);
    return links::peer_from_text(
        "--send", rest.find(':') == std::string::npos ? "127.0.0.1:" + rest : rest);
}

/// Text as a property's value: no commas and no ends of lines of its own.
std::string acmi_value(const std::string& text) {
    std::string value;
    for (const char c : printable(text)) {
        value += c == ',' || c == '\\' ? "\\" : "";
        value += c;
    }
    return value;
}

/// What Tacview is told of all aircraft before they move.
std::string tacview_head(const Session& session) {
    std::string head = fmt::format(
        "FileType=text/acmi/tacview\nFileVersion=2.2\n0,ReferenceTime=2026-01-01T00:00:00Z\n"
        "0,DataSource=Octant\n0,Title={}\n",
        acmi_value(session.world().flight.title));
    for (std::size_t i = 0; i < session.world().scene.aircraft.size(); ++i) {
        const std::string& shape = session.world().scene.model_of(i).polygons.name;
        const sim::AircraftKind* const kind = sim::find_aircraft_kind(shape);
        head += fmt::format(
            "{:x},Type={},Name={},Color=Blue\n",
            i + 1,
            kind == nullptr ? "Air" : kind->tacview_type,
            kind == nullptr ? acmi_value(shape) : kind->tacview_name);
    }
    return head;
}

} // namespace

Sender::Sender(const std::vector<std::string>& targets) {
    for (const std::string& target : targets) {
        const std::string_view text = target;
        if (text.starts_with("tacview:")) {
            const links::PacketSource own = reader_address(target);
            tacview_.emplace_back(own.address, own.port, "Octant");
            continue;
        }
        if (text.starts_with("cigi:")) {
            channels_.add(target);
            continue;
        }
        const auto packet_format = text.starts_with("fdm:")      ? std::optional(PacketFormat::Fdm)
                          : text.starts_with("xplane:") ? std::optional(PacketFormat::XPlane)
                          : text.starts_with("dis:")    ? std::optional(PacketFormat::Dis)
                                                        : std::nullopt;
        if (!packet_format) {
            throw Error(fmt::format(
                "--send: expected fdm:HOST:PORT, xplane:HOST:PORT, dis:HOST:PORT, cigi:HOST:PORT "
                "or tacview:PORT, got '{}'",
                printable(target)));
        }
        const std::string peer = target.substr(target.find(':') + 1);
        targets_.push_back({*packet_format, links::peer_from_text("--send", peer)});
    }
    if (!targets_.empty()) {
        socket_.emplace_back(0, std::uint16_t{0}); // any address of ours, any port
    }
}

void Sender::send_fdm(const Target& target, const links::Fix& fix) {
    socket_.front().send(target.peer, links::encode_fdm(fix));
}

void Sender::send_xplane(const Target& target, const links::Fix& fix, double time_s) {
    if (!origin_) {
        origin_ = {rad_from_deg(fix.latitude_deg), rad_from_deg(fix.longitude_deg), fix.altitude_m};
    }
    socket_.front().send(target.peer, links::encode_xplane(fix, *origin_, time_s));
}

void Sender::send_dis(const Target& target, std::size_t number, links::Fix fix, double time_s) {
    links::DisEntity entity;
    entity.site = 1;
    entity.application = 1;
    entity.entity = static_cast<std::uint16_t>(number + 1);
    entity.force = 1;
    entity.type = {1, 2, 0, 0, 0, 0, 0, 0}; // a platform in the air
    entity.reckoning = links::DeadReckoning::Fpw;
    constexpr std::string_view name = "OCTANT";
    std::copy(name.begin(), name.end(), entity.marking.begin());
    entity.fix = fix;
    socket_.front().send(target.peer, links::encode_dis(entity, time_s));
}

std::vector<std::string> Sender::wait_for_channels(const Session& session) {
    send_header(session);
    return channels_.wait_for_first_frames([this] {
        for (links::TacviewServer& server : tacview_) {
            server.send({});
        }
    });
}

void Sender::send_header(const Session& session) {
    if (tacview_.empty() || std::exchange(header_is_sent_, true)) {
        return;
    }
    for (links::TacviewServer& server : tacview_) {
        server.set_head(tacview_head(session));
    }
}

void Sender::send_tacview(const Session& session) {
    const auto states = session.states();
    send_header(session);
    std::string text = fmt::format("#{:.3f}\n", states.front().time_s);
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::optional<links::Fix> fix = flown_fix(session, i);
        if (!fix) {
            continue;
        }
        text += fmt::format(
            "{:x},T={:.7f}|{:.7f}|{:.2f}|{:.2f}|{:.2f}|{:.2f}\n",
            i + 1,
            fix->longitude_deg,
            fix->latitude_deg,
            fix->altitude_m,
            deg_from_rad(fix->attitude.roll_rad),
            deg_from_rad(fix->attitude.pitch_rad),
            deg_from_rad(fix->attitude.heading_rad));
    }
    for (links::TacviewServer& server : tacview_) {
        server.send(text);
    }
}

void Sender::send(const Session& session) {
    if (!tacview_.empty()) {
        send_tacview(session);
    }
    channels_.send(session);
    for (const Target& target : targets_) {
        const auto states = session.states();
        const std::size_t count = target.packet_format == PacketFormat::Dis ? states.size() : 1;
        for (std::size_t i = 0; i < count; ++i) {
            const std::optional<links::Fix> fix = flown_fix(session, i);
            if (!fix) {
                continue;
            }
            if (target.packet_format == PacketFormat::Fdm) {
                send_fdm(target, *fix);
            } else if (target.packet_format == PacketFormat::XPlane) {
                send_xplane(target, *fix, states[i].time_s);
            } else {
                send_dis(target, i, *fix, states[i].time_s);
            }
        }
    }
}

} // namespace octant::ui::flight
