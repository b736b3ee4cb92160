#include "ui/flight/listener.h"

#include "sim/base/error.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/mavlink.h"
#include "sim/links/xplane.h"
#include "ui/flight/live_flight.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace octant::ui::flight {

namespace links = sim::links;
using PacketOutcome = sim::links::LiveTraffic::PacketOutcome;

LiveInput::LiveInput(const LiveInputOptions& options) : bind_(options.bind) {
    const std::uint32_t address = links::address_from_text("--bind", options.bind);
    const auto default_port = [&](std::uint16_t port) { return options.is_channel ? -1 : int{port}; };
    const auto open = [&](links::Protocol protocol, int port) {
        if (port >= 0) { ports_.push_back({protocol, links::UdpPort(address, static_cast<std::uint16_t>(port))}); }
    };
    open(links::Protocol::Fdm, options.fdm_port.value_or(default_port(links::fdm_port)));
    open(links::Protocol::MavLink, options.mavlink_port.value_or(default_port(links::mavlink_port)));
    open(links::Protocol::Dis, options.dis_port.value_or(default_port(links::dis_port)));
    if (!options.xplane_host.empty()) {
        const bool has_port = options.xplane_host.find(':') != std::string::npos;
        xplane_ =
            Peer{ports_.size(), links::peer_from_text("--xplane",
                                    has_port ? options.xplane_host
                                             : fmt::format("{}:{}", options.xplane_host, links::xplane_request_port))};
        if (options.xplane_port.value_or(0) < 0) {
            throw Error("--xplane: expected an open port in --ports xplane, got -1");
        }
    }
    open(links::Protocol::XPlane,
        options.xplane_port.value_or(xplane_ ? int{links::xplane_port} : default_port(links::xplane_port)));
    if (options.cigi_port >= 0) {
        cigi_ = Peer{ports_.size(), links::peer_from_text("--cigi host", options.cigi_host)};
        open(links::Protocol::Cigi, options.cigi_port);
    }
    if (!options.only_from.empty()) { only_from_ = links::address_from_text("--from", options.only_from); }
    if (options.lines_port >= 0) {
        line_server_.emplace(address, static_cast<std::uint16_t>(options.lines_port), only_from_);
    }
    if (options.standard_input) { standard_input_.emplace(); }
}

LiveInput::~LiveInput() {
    if (requested_s_) { request_xplane_data(0); }
}

void LiveInput::request_xplane_data(int per_second) {
    for (const std::vector<std::byte>& request : links::xplane_requests(per_second)) {
        ports_[xplane_->port].socket.send(xplane_->host, request);
    }
}

/// An X-Plane that is silent may have begun anew, and forgotten what it was asked for.
void LiveInput::request_silent_xplane_data() {
    constexpr double patience_s = 2.0;
    constexpr int per_second = 60;
    const double now = now_s();
    for (const links::Datagram& packet : packets_) {
        if (packet.protocol == links::Protocol::XPlane && packet.source.address == xplane_->host.address) {
            received_s_ = packet.arrival_s;
        }
    }
    if (!requested_s_ || now - std::max(*requested_s_, received_s_) > patience_s) {
        request_xplane_data(per_second);
        requested_s_ = now;
    }
}

double LiveInput::now_s() const {
    const std::chrono::duration<double, std::micro> passed = std::chrono::steady_clock::now() - begin_;
    constexpr double per_second = 1e6;
    return std::floor(passed.count()) / per_second;
}

std::vector<links::Datagram>& LiveInput::drain() {
    packets_.clear();
    for (Port& port : ports_) { port.socket.drain(port.protocol, now_s(), packets_); }
    if (line_server_) { line_server_->drain(now_s(), packets_); }
    std::erase_if(packets_, [this](const links::Datagram& packet) {
        return (only_from_ && packet.source.address != *only_from_) || !limit_.admits(packet.source, packet.arrival_s);
    });
    if (xplane_) { request_silent_xplane_data(); }
    if (standard_input_) { standard_input_->drain(now_s(), packets_); }
    return packets_;
}

void LiveInput::send_cigi(std::span<const std::byte> message) {
    if (cigi_) { ports_[cigi_->port].socket.send(cigi_->host, message); }
}

bool LiveInput::has_ended() const {
    return ports_.empty() && !line_server_ && standard_input_ && standard_input_->has_ended();
}

std::vector<std::string> LiveInput::lines() const {
    std::vector<std::string> lines;
    for (const Port& port : ports_) {
        lines.push_back(fmt::format("{}: waits on UDP {}:{}", name_of(port.protocol), bind_, port.socket.port()));
    }
    if (cigi_) { lines.back() += fmt::format(", answers to {}", links::text_of(cigi_->host)); }
    if (xplane_) { lines.push_back(fmt::format("X-Plane: asks {}", links::text_of(xplane_->host))); }
    if (line_server_) { lines.push_back(fmt::format("lines: waits on TCP {}:{}", bind_, line_server_->port())); }
    if (standard_input_) { lines.emplace_back("lines: waits on standard input"); }
    if (bind_ != "127.0.0.1") { lines.push_back(fmt::format("open to other machines: bound to {}", bind_)); }
    return lines;
}

Listener::Listener(const ListenerOptions& options) : options_(options), input_(options.input) {}

void Listener::attach(Session& session) {
    live_ = std::make_unique<LiveFlight>(options_.live, session.world());
    session.set_state_source(*live_);
}

void Listener::start_packet_recording(const std::filesystem::path& folder) { writer_.emplace(folder, options_.live); }

std::vector<std::string> Listener::take_new_messages() {
    constexpr double every_s = 10.0;
    std::vector<std::string> news = live_->take_new_messages();
    const double now_s = input_.now_s();
    if (!reported_at_s_) {
        const std::vector<std::string> waits = input_.lines();
        news.insert(news.begin(), waits.begin(), waits.end());
        reported_at_s_ = now_s - every_s + 1.0;
    } else if (now_s - *reported_at_s_ >= every_s && !live_->traffic().vehicles().empty()) {
        const std::vector<std::string> stands = lines();
        news.insert(news.end(), stands.begin(), stands.end());
        reported_at_s_ = now_s;
    }
    return news;
}

std::vector<std::string> Listener::lines() const {
    std::vector<std::string> lines = live_->lines();
    if (live_->traffic().vehicles().empty()) {
        const std::vector<std::string> waits = input_.lines();
        lines.insert(lines.begin(), waits.begin(), waits.end());
    }
    return lines;
}

/// Whether it is a host's last message once more, as hosts send it that have not heard of its picture. It is to be
/// answered, not shown again.
bool Listener::is_retransmission(const sim::links::Datagram& packet) {
    if (packet.protocol != sim::links::Protocol::Cigi) { return false; }
    const bool repeat_option = packet.source == last_message_.source && packet.bytes == last_message_.bytes;
    last_message_ = packet;
    answers_retransmission_ = answers_retransmission_ || repeat_option;
    return repeat_option;
}

/// Returns whether something moved; in steps nothing is taken after that.
bool Listener::take_pending() {
    bool moved = false;
    while (!pending_.empty() && !(options_.live.step && moved)) {
        const sim::links::Datagram packet = std::move(pending_.front());
        pending_.pop_front();
        if (options_.live.step && is_retransmission(packet)) { continue; }
        const PacketOutcome taken = live_->take(packet);
        if (writer_ && taken != PacketOutcome::Wrong) { writer_->add(packet); }
        moved = moved || taken == PacketOutcome::Moved;
    }
    return moved;
}

std::optional<double> Listener::take(Session& session) {
    constexpr std::size_t max_waiting = 20000; // in steps: more wait in the network
    if (pending_.size() < max_waiting) {
        for (sim::links::Datagram& packet : input_.drain()) { pending_.push_back(std::move(packet)); }
    }
    const bool moved = take_pending();
    if (options_.live.step && !moved) { return std::nullopt; }
    apply_host_visibility(*live_, session);
    const std::optional<std::string> time_of_day = apply_host_time_of_day(*live_, session);
    if (writer_ && time_of_day) { writer_->add_time_of_day(*time_of_day); }
    const double time_s = options_.live.step ? static_cast<double>(++pictures_) / session.rate_hz() : input_.now_s();
    if (time_s >= overlay_at_s_) {
        constexpr double words_every_s = 0.5;
        const std::vector<std::string> overlay_lines = options_.live.step ? std::vector<std::string>() : lines();
        session.pictures().set_overlay_lines(overlay_lines);
        if (writer_) { writer_->add_overlay_lines(overlay_lines); }
        overlay_at_s_ = time_s + words_every_s;
    }
    if (writer_) { writer_->add_picture(time_s); }
    return time_s;
}

void Listener::finish_picture(report::FrameRecord& record) {
    live_->fill_in(record, input_.now_s());
    if (input_.has_cigi()) { input_.send_cigi(live_->cigi_message(++cigi_frames_, input_.now_s())); }
}

void Listener::contact_hosts() {
    constexpr double every_s = 0.1;
    const double now_s = input_.now_s();
    const bool calls = !live_->traffic().cigi().has_host() && now_s >= hosts_contacted_at_s_;
    if (input_.has_cigi() && (calls || std::exchange(answers_retransmission_, false))) {
        input_.send_cigi(live_->cigi_message(cigi_frames_, now_s));
        hosts_contacted_at_s_ = now_s + every_s;
    }
}

void Listener::finish() {
    if (writer_) {
        writer_->finish();
        writer_.reset();
    }
}

} // namespace octant::ui::flight
