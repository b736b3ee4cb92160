#include "ui/flight/cigi_channels.h"

#include "sim/base/axes.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"
#include "sim/links/cigi_host.h"
#include "ui/base/stop_signals.h"
#include "ui/base/stopwatch.h"
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

constexpr std::size_t max_entities = 48; // of one packet that receivers take
constexpr int max_consecutive_missed = 5;    ///< frames, then a channel is not waited for

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
links::CigiRateControl rate_of(
    std::size_t number,
    const links::Fix& fix,
    const sim::AircraftState& before,
    const sim::AircraftState& now) {
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
    std::uint16_t own_port = default_own_port;
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

/// The channel that answers from there. Messages do not say which channel sends them: an address
/// without a channel is the way back of the first one on that machine that does not answer yet.
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

bool CigiChannels::has_answered(const Channel& channel) const {
    return channel.shown_host_frame == host_frame_;
}

std::vector<std::string> CigiChannels::wait_for_first_frames(const std::function<void()>& meanwhile) {
    const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
    const auto all_answer = [this] {
        receive();
        return std::ranges::all_of(
            channels_, [](const Channel& channel) { return channel.answer_source.has_value(); });
    };
    while (!channels_.empty() && !all_answer() && Clock::now() < end &&
           !base::StopSignals::received()) {
        meanwhile();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::vector<std::string> lines;
    for (const Channel& channel : channels_) {
        if (!channel.answer_source) {
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
    for (std::size_t i = 0; i < std::min(states.size(), max_entities); ++i) {
        const links::Fix fix = fix_of(session, states[i]);
        links::add_entity(message, entity_of(session, i, fix));
        const bool was_there = previous_states_.size() == states.size();
        links::add_rate(message, rate_of(i, fix, was_there ? previous_states_[i] : states[i], states[i]));
    }
    links::add_view_definition(
        message, frustum_of(session.camera(), glm::dvec2(session.settings().view.size_px)));
    links::add_view_control(message, cigi_view_control_of(session.camera(), states.front()));
    return message.take();
}

void CigiChannels::send(const Session& session) {
    if (channels_.empty()) {
        return;
    }
    receive();
    ++host_frame_;
    for (Channel& channel : channels_) {
        channel.message = message_for(session, channel.ig_frame);
        socket_->send(channel.peer, channel.message);
    }
    previous_states_.assign(session.states().begin(), session.states().end());
}

/// To those that are not there, and to those behind relays, of which it is not known whose answers
/// are whose.
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
    if (channels_.empty()) {
        return -1;
    }
    constexpr double max_wait_s = 1.0;
    constexpr double max_wait_after_miss_s = 0.1;
    constexpr double min_again_s = 0.02;
    constexpr double max_again_s = 0.3;
    const base::Stopwatch since_sent;
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
            lines.push_back(fmt::format(
                "{}: {} of {} frames not shown in time; {} messages sent again",
                links::text_of(channel.answer_source.value_or(channel.peer)),
                channel.missed,
                host_frame_,
                channel.resent));
        }
    }
    return lines;
}

} // namespace octant::ui::flight
