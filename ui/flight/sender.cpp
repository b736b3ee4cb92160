#include "ui/flight/sender.h"

#include "sim/aircraft_kind.h"
#include "sim/aircraft_state.h"
#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/error.h"
#include "sim/base/stopwatch.h"
#include "sim/base/text_file.h"
#include "sim/base/units.h"
#include "sim/links/cigi_host.h"
#include "sim/links/dis_entity.h"
#include "sim/links/fix.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/xplane.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

namespace octant::ui::flight {

namespace links = sim::links;
namespace scene = visuals::scene;
using Clock = std::chrono::steady_clock;

namespace {

const EarthFrame& frame_of(const Session& session) {
    return frame_or_at_zero(
        session.simulation().is_live() ? session.simulation().source().frame() : session.world().ground.frame.get());
}

/// Microseconds as a clock that wraps around.
std::uint32_t ticks_at(double time_s) {
    constexpr double per_second = 1e6;
    return static_cast<std::uint32_t>(std::llround(time_s * per_second) & 0xffffffffLL);
}

/// An aircraft's motion as packets have it: geodetic by the session's place on the earth, or around 0 N, 0 E where its
/// ground has none.
links::Fix fix_of(const Session& session, const sim::AircraftState& state) {
    const glm::dvec3& at_m = state.position_m;
    const EarthFrame& frame = frame_of(session);
    const GeoPosition place = frame.geo_from_local(glm::dvec2(at_m.x, at_m.y));
    links::Fix fix;
    fix.latitude_deg = place.latitude_deg;
    fix.longitude_deg = place.longitude_deg;
    fix.altitude_m = at_m.z;
    if (const auto ground_m = session.world().scene.ground->height_at(at_m.x, at_m.y)) {
        fix.above_ground_m = at_m.z - *ground_m;
    }
    fix.attitude = euler_from_body_to_world(state.body_to_world);
    fix.velocity_ned_mps = glm::dvec3(state.velocity_mps.y, state.velocity_mps.x, -state.velocity_mps.z);
    fix.ticks = ticks_at(state.time_s);
    fix = links::with_rotated_axes(fix, -frame.place_of(place).north_bearing_rad);
    fix.attitude.heading_rad = wrapped_to_two_pi(fix.attitude.heading_rad);
    return fix;
}

/// The same of an aircraft in the session's last picture; nothing for one that nobody flies or that receivers would not
/// believe.
std::optional<links::Fix> flown_fix(const Session& session, std::size_t aircraft) {
    const Simulation& simulation = session.simulation();
    if (simulation.is_live() && !simulation.source().is_flown(aircraft)) { return std::nullopt; }
    const sim::AircraftState& state = session.states()[aircraft];
    const links::Fix fix = fix_of(session, state);
    const bool is_shown = state.is_present && links::error_of_fix(fix) == links::PacketError::None;
    return is_shown ? std::optional(fix) : std::nullopt;
}

constexpr std::size_t max_entities = 48;  // of one packet that receivers take
constexpr int max_consecutive_missed = 5; ///< frames, then a channel is not waited for

links::CigiEntityControl entity_of(const Session& session, std::size_t number, const links::Fix& fix) {
    links::CigiEntityControl entity;
    entity.entity = static_cast<std::uint16_t>(number);
    entity.state = flown_fix(session, number) ? 1 : 0;
    entity.type = static_cast<std::uint16_t>(session.world().scene.aircraft[number] + 1);
    entity.attitude = fix.attitude;
    entity.place = {fix.latitude_deg, fix.longitude_deg, fix.altitude_m};
    return entity;
}

/// How an entity goes on from this picture on: by its fix in this one, and by its states in the one before and in this
/// one.
links::CigiRateControl rate_of(
    std::size_t number, const links::Fix& fix, const sim::AircraftState& before, const sim::AircraftState& now) {
    links::CigiRateControl rate;
    rate.entity = static_cast<std::uint16_t>(number);
    rate.mps = fix.velocity_ned_mps.value_or(glm::dvec3(0.0));
    const double step_s = now.time_s - before.time_s;
    if (step_s > 0.0) {
        glm::dquat turn = glm::conjugate(before.body_to_world) * now.body_to_world;
        turn = turn.w < 0.0 ? -turn : turn;
        rate.radps = 2.0 / step_s * glm::dvec3(turn.x, turn.y, turn.z);
    }
    return rate;
}

/// The camera from the first aircraft, along and about its body axes.
links::CigiViewControl cigi_view_control_of(const scene::Camera& camera, const sim::AircraftState& aircraft) {
    const glm::dquat world_to_body = glm::conjugate(aircraft.body_to_world);
    const glm::dquat turned = world_to_body * camera.view_to_world * glm::conjugate(scene::body_from_view());
    links::CigiViewControl view;
    view.offset_m = world_to_body * (camera.eye_m - aircraft.position_m);
    view.angles = euler_from_body_to_world(glm::normalize(body_to_world_from_euler({}) * turned));
    return view;
}

links::CigiViewDefinition frustum_of(const scene::Camera& camera, const glm::dvec2& size_px) {
    links::CigiViewDefinition frustum;
    const double half_high = std::tan(0.5 * camera.vertical_fov_rad);
    const double half_wide = half_high * camera.pixel_aspect * size_px.x / size_px.y;
    frustum.left_rad = std::atan(camera.middle.x - half_wide);
    frustum.right_rad = std::atan(camera.middle.x + half_wide);
    frustum.top_rad = std::atan(camera.middle.y + half_high);
    frustum.bottom_rad = std::atan(camera.middle.y - half_high);
    return frustum;
}

} // namespace

void CigiChannels::add(const std::string& target) {
    constexpr std::string_view prefix = "cigi:";
    std::string peer = target.substr(prefix.size());
    const std::size_t last = peer.rfind(':');
    std::uint16_t own_port = default_own_port;
    if (last != std::string::npos && peer.find(':') != last) {
        own_port = links::peer_from_text("--send", "0.0.0.0" + peer.substr(last)).port;
        peer.resize(last);
    }
    const Channel channel{links::peer_from_text("--send", peer)};
    if (socket_ && own_port != own_port_) {
        throw Error(fmt::format("--send: expected one own port for all channels, got '{}'", printable(target)));
    }
    if (!socket_) {
        constexpr std::uint32_t loopback_net = 127;
        constexpr std::uint32_t loopback = 0x7f000001;
        const bool is_near = channel.peer.address >> 24U == loopback_net;
        own_port_ = own_port;
        socket_.emplace(is_near ? loopback : 0U, own_port);
    }
    channels_.push_back(channel);
}

/// The channel that answers from there. Messages do not say which channel sends them: an address without a channel is
/// the way back of the first one on that machine that does not answer yet.
CigiChannels::Channel* CigiChannels::channel_of_source(const links::PacketSource& source) {
    auto channel = std::ranges::find(channels_, source, &Channel::peer);
    if (channel == channels_.end()) {
        channel = std::ranges::find(channels_, std::optional(source), &Channel::answer_source);
    }
    if (channel == channels_.end()) {
        channel = std::ranges::find_if(channels_, [&source](const Channel& each) {
            const bool is_free = !each.answer_source || each.consecutive_missed >= max_consecutive_missed;
            return is_free && each.peer.address == source.address;
        });
    }
    return channel == channels_.end() ? nullptr : &*channel;
}

/// Takes what has come: who shows what.
void CigiChannels::receive() {
    received_.clear();
    socket_->drain(links::Protocol::Cigi, 0.0, received_);
    for (const links::Datagram& packet : received_) {
        const auto frame = links::start_of_frame_of(packet.bytes);
        Channel* const channel = frame ? channel_of_source(packet.source) : nullptr;
        if (channel != nullptr) {
            channel->answer_source = packet.source;
            channel->consecutive_missed =
                channel->shown_host_frame == frame->host_frame ? channel->consecutive_missed : 0;
            channel->shown_host_frame = frame->host_frame;
            channel->ig_frame = frame->ig_frame;
        }
    }
}

bool CigiChannels::has_answered(const Channel& channel) const { return channel.shown_host_frame == host_frame_; }

std::vector<std::string> CigiChannels::wait_for_first_frames(const std::function<void()>& meanwhile) {
    const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
    const auto all_answer = [this] {
        receive();
        return std::ranges::all_of(channels_, [](const Channel& channel) { return channel.answer_source.has_value(); });
    };
    while (!channels_.empty() && !all_answer() && Clock::now() < end && !base::StopSignals::received()) {
        meanwhile();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::vector<std::string> lines;
    for (const Channel& channel : channels_) {
        if (!channel.answer_source) {
            lines.push_back(fmt::format("{}: no Start of Frame came to port {}; it is not waited for",
                links::text_of(channel.peer), own_port_));
        }
    }
    return lines;
}

std::vector<std::byte> CigiChannels::message_for(const Session& session, std::uint32_t last_ig_frame) const {
    constexpr double second_in_ticks = 1e5;
    const auto states = session.states();
    links::CigiIgControl control;
    control.mode = links::CigiMode::Operate;
    control.timestamp_valid = true;
    control.host_frame = host_frame_;
    control.timestamp =
        static_cast<std::uint32_t>(std::llround(states.front().time_s * second_in_ticks) & 0xffffffffLL);
    control.last_ig_frame = last_ig_frame;
    links::WireWriter message(links::ByteOrder::Big);
    links::add_ig_control(message, control);
    for (std::size_t i = 0; i < std::min(states.size(), max_entities); ++i) {
        const links::Fix fix = fix_of(session, states[i]);
        links::add_entity(message, entity_of(session, i, fix));
        const bool was_there = previous_states_.size() == states.size();
        links::add_rate(message, rate_of(i, fix, was_there ? previous_states_[i] : states[i], states[i]));
    }
    links::add_view_definition(message, frustum_of(session.camera(), glm::dvec2(session.settings().view.size_px)));
    links::add_view_control(message, cigi_view_control_of(session.camera(), states.front()));
    return message.take();
}

void CigiChannels::send(const Session& session) {
    if (channels_.empty()) { return; }
    receive();
    ++host_frame_;
    for (Channel& channel : channels_) {
        channel.message = message_for(session, channel.ig_frame);
        socket_->send(channel.peer, channel.message);
    }
    previous_states_.assign(session.states().begin(), session.states().end());
}

/// To those that are not there, and to those behind relays, of which it is not known whose answers are whose.
void CigiChannels::resend() {
    for (Channel& channel : channels_) {
        const bool is_relayed = channel.answer_source && *channel.answer_source != channel.peer;
        if (channel.answer_source && (is_relayed || !has_answered(channel))) {
            socket_->send(channel.peer, channel.message);
            ++channel.resent;
        }
    }
}

/// Whether those that answer and missed at most so many frames in a row show what was sent last.
bool CigiChannels::all_have_answered(int max_missed) const {
    return std::ranges::all_of(channels_, [&](const Channel& channel) {
        return !channel.answer_source || channel.consecutive_missed > max_missed || has_answered(channel);
    });
}

int CigiChannels::wait_for_pictures() {
    if (channels_.empty()) { return -1; }
    constexpr double max_wait_s = 1.0;
    constexpr double max_wait_after_miss_s = 0.1;
    constexpr double min_again_s = 0.02;
    constexpr double max_again_s = 0.3;
    const Stopwatch since_sent;
    double again_s = std::clamp(2.0 * typical_wait_s_, min_again_s, max_again_s);
    bool resent = false;
    for (receive();; receive()) {
        const double waited_s = since_sent.s();
        const bool all = waited_s < max_wait_after_miss_s;
        const bool there = all_have_answered(all ? max_consecutive_missed - 1 : 0);
        if (there || waited_s > max_wait_s) {
            typical_wait_s_ = std::max(resent ? 0.0 : waited_s, 0.9 * typical_wait_s_);
            break;
        }
        if (waited_s > again_s) {
            resend();
            resent = true;
            again_s *= 2.0;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    std::optional<std::uint32_t> skew;
    for (Channel& channel : channels_) {
        if (channel.answer_source) {
            const std::uint32_t behind = host_frame_ - channel.shown_host_frame;
            skew = std::max(skew.value_or(0), behind);
            channel.missed += behind > 0 ? 1 : 0;
            channel.consecutive_missed = behind > 0 ? channel.consecutive_missed + 1 : 0;
        }
    }
    constexpr std::uint32_t max_skew = 0x7fffffff;
    return skew ? static_cast<int>(std::min(*skew, max_skew)) : -1;
}

std::vector<std::string> CigiChannels::lines() const {
    std::vector<std::string> lines;
    for (const Channel& channel : channels_) {
        if (channel.missed > 0 || channel.resent > 0) {
            lines.push_back(fmt::format("{}: {} of {} frames not shown in time; {} messages sent again",
                links::text_of(channel.answer_source.value_or(channel.peer)), channel.missed, host_frame_,
                channel.resent));
        }
    }
    return lines;
}

namespace {

/// Of "tacview:PORT" or "tacview:ADDRESS:PORT".
links::PacketSource reader_address(const std::string& target) {
    const std::string rest = target.substr(target.find(':') + 1);
    return links::peer_from_text("--send", rest.find(':') == std::string::npos ? "127.0.0.1:" + rest : rest);
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
    std::string head = fmt::format("FileType=text/acmi/tacview\nFileVersion=2.2\n0,ReferenceTime=2026-01-01T00:00:00Z\n"
                                   "0,DataSource=Octant\n0,Title={}\n",
        acmi_value(session.world().flight.title));
    for (std::size_t i = 0; i < session.world().scene.aircraft.size(); ++i) {
        const std::string& shape = session.world().scene.model_of(i).polygons.name;
        const sim::AircraftKind* const kind = sim::find_aircraft_kind(shape);
        head += fmt::format("{:x},Type={},Name={},Color=Blue\n", i + 1, kind == nullptr ? "Air" : kind->tacview_type,
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
            throw Error(fmt::format("--send: expected fdm:HOST:PORT, xplane:HOST:PORT, dis:HOST:PORT, cigi:HOST:PORT "
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
    if (!origin_) { origin_ = {rad_from_deg(fix.latitude_deg), rad_from_deg(fix.longitude_deg), fix.altitude_m}; }
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
        for (links::TacviewServer& server : tacview_) { server.send({}); }
    });
}

void Sender::send_header(const Session& session) {
    if (tacview_.empty() || std::exchange(header_is_sent_, true)) { return; }
    for (links::TacviewServer& server : tacview_) { server.set_head(tacview_head(session)); }
}

void Sender::send_tacview(const Session& session) {
    const auto states = session.states();
    send_header(session);
    std::string text = fmt::format("#{:.3f}\n", states.front().time_s);
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::optional<links::Fix> fix = flown_fix(session, i);
        if (!fix) { continue; }
        text += fmt::format("{:x},T={:.7f}|{:.7f}|{:.2f}|{:.2f}|{:.2f}|{:.2f}\n", i + 1, fix->longitude_deg,
            fix->latitude_deg, fix->altitude_m, deg_from_rad(fix->attitude.roll_rad),
            deg_from_rad(fix->attitude.pitch_rad), deg_from_rad(fix->attitude.heading_rad));
    }
    for (links::TacviewServer& server : tacview_) { server.send(text); }
}

void Sender::send(const Session& session) {
    if (!tacview_.empty()) { send_tacview(session); }
    channels_.send(session);
    for (const Target& target : targets_) {
        const auto states = session.states();
        const std::size_t count = target.packet_format == PacketFormat::Dis ? states.size() : 1;
        for (std::size_t i = 0; i < count; ++i) {
            const std::optional<links::Fix> fix = flown_fix(session, i);
            if (!fix) { continue; }
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
