#include "ui/flight/cigi_channels.h"

#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/links/cigi_host.h"
#include "ui/base/stop_signals.h"
#include "ui/flight/session_fix.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <thread>

namespace octant::ui::flight {

namespace links = sim::links;
namespace scene = visuals::scene;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_entities = 48; // of one packet that receivers take

links::CigiEntityControl
entity_of(const Session& session, std::size_t number, const links::Fix& fix) {
    links::CigiEntityControl entity;
    entity.entity = static_cast<std::uint16_t>(number);
    entity.state = flown_fix(session, number) ? 1 : 0;
    entity.type = static_cast<std::uint16_t>(session.world().scene.aircraft[number] + 1);
    entity.attitude = fix.attitude;
    entity.place = {fix.latitude_deg, fix.longitude_deg, fix.altitude_m};
    return entity;
}

/// How an entity goes on from this picture on: by its fix in this one, and by its states in the one
/// before and in this one.
links::CigiRate rate_of(
    std::size_t number,
    const links::Fix& fix,
    const sim::AircraftState& before,
    const sim::AircraftState& now) {
    links::CigiRate rate;
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
links::CigiViewControl view_of(const scene::Camera& camera, const sim::AircraftState& aircraft) {
    const glm::dquat world_to_body = glm::conjugate(aircraft.body_to_world);
    const glm::dquat turned =
        world_to_body * camera.view_to_world * glm::conjugate(scene::body_from_view());
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
    std::uint16_t own_port = usual_own_port;
    if (last != std::string::npos && peer.find(':') != last) {
        own_port = links::peer_from_text("--send", "0.0.0.0" + peer.substr(last)).port;
        peer.resize(last);
    }
    const Channel channel{links::peer_from_text("--send", peer)};
    if (socket_ && own_port != own_port_) {
        throw Error(fmt::format(
            "--send: expected one own port for all channels, got '{}'", printable(target)));
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

/// Takes what has come: who shows what.
void CigiChannels::listen() {
    heard_.clear();
    socket_->drain(links::Protocol::Cigi, 0.0, heard_);
    for (const links::Datagram& packet : heard_) {
        const auto channel = std::ranges::find(channels_, packet.source, &Channel::peer);
        const auto frame = links::start_of_frame_of(packet.bytes);
        if (channel != channels_.end() && frame) {
            channel->answers = true;
            channel->shows = frame->host_frame;
            channel->ig_frame = frame->ig_frame;
        }
    }
}

std::vector<std::string> CigiChannels::await_first(const std::function<void()>& meanwhile) {
    const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
    const auto all_answer = [this] {
        listen();
        return std::ranges::all_of(channels_, &Channel::answers);
    };
    while (!channels_.empty() && !all_answer() && Clock::now() < end &&
           !base::StopSignals::came()) {
        meanwhile();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::vector<std::string> lines;
    for (const Channel& channel : channels_) {
        if (!channel.answers) {
            lines.push_back(fmt::format(
                "{}: no Start of Frame came to port {}; it is not waited for",
                links::text_of(channel.peer),
                own_port_));
        }
    }
    return lines;
}

std::vector<std::byte>
CigiChannels::message_for(const Session& session, std::uint32_t last_ig_frame) const {
    constexpr double second_in_ticks = 1e5;
    const auto states = session.states();
    links::CigiIgControl control;
    control.mode = links::CigiMode::Operate;
    control.timestamp_valid = true;
    control.host_frame = host_frame_;
    control.timestamp = static_cast<std::uint32_t>(
        std::llround(states.front().time_s * second_in_ticks) & 0xffffffffLL);
    control.last_ig_frame = last_ig_frame;
    links::WireWriter message(links::ByteOrder::Big);
    links::add_ig_control(message, control);
    for (std::size_t i = 0; i < std::min(states.size(), most_entities); ++i) {
        const links::Fix fix = fix_of(session, states[i]);
        links::add_entity(message, entity_of(session, i, fix));
        const bool was_there = before_.size() == states.size();
        links::add_rate(message, rate_of(i, fix, was_there ? before_[i] : states[i], states[i]));
    }
    links::add_view_definition(
        message, frustum_of(session.camera(), glm::dvec2(session.settings().view.size_px)));
    links::add_view_control(message, view_of(session.camera(), states.front()));
    return message.take();
}

void CigiChannels::send(const Session& session) {
    if (channels_.empty()) {
        return;
    }
    listen();
    ++host_frame_;
    for (const Channel& channel : channels_) {
        socket_->send(channel.peer, message_for(session, channel.ig_frame));
    }
    before_.assign(session.states().begin(), session.states().end());
}

int CigiChannels::await_pictures() {
    const Clock::time_point end = Clock::now() + std::chrono::seconds(1);
    const auto is_there = [this](const Channel& channel) {
        return !channel.answers || channel.shows == host_frame_;
    };
    const auto all_are_there = [&] {
        listen();
        return std::ranges::all_of(channels_, is_there);
    };
    while (!channels_.empty() && !all_are_there() && Clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    std::optional<std::uint32_t> first;
    std::uint32_t last = 0;
    for (Channel& channel : channels_) {
        if (channel.answers) {
            first = std::min(first.value_or(channel.shows), channel.shows);
            last = std::max(last, channel.shows);
            channel.answers = is_there(channel);
        }
    }
    return first ? static_cast<int>(last - *first) : -1;
}

} // namespace octant::ui::flight
