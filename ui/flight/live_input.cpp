#include "ui/flight/live_input.h"

#include "sim/base/error.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/mavlink.h"
#include "sim/links/xplane.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::ui::flight {

namespace links = sim::links;

LiveInput::LiveInput(const LiveInputOptions& options)
    : bind_(options.bind) {
    const std::uint32_t address = links::address_from_text("--bind", options.bind);
    const auto default_port = [&](std::uint16_t port) { return options.is_channel ? -1 : int{port}; };
    const auto open = [&](links::Protocol protocol, int port) {
        if (port >= 0) {
            ports_.push_back({protocol, links::UdpPort(address, static_cast<std::uint16_t>(port))});
        }
    };
    open(links::Protocol::Fdm, options.fdm_port.value_or(default_port(links::fdm_port)));
    open(links::Protocol::MavLink, options.mavlink_port.value_or(default_port(links::mavlink_port)));
    open(links::Protocol::Dis, options.dis_port.value_or(default_port(links::dis_port)));
    if (!options.xplane_host.empty()) {
        const bool has_port = options.xplane_host.find(':') != std::string::npos;
        xplane_ = Peer{
            ports_.size(),
            links::peer_from_text(
                "--xplane",
                has_port ? options.xplane_host
                         : fmt::format("{}:{}", options.xplane_host, links::xplane_request_port))};
        if (options.xplane_port.value_or(0) < 0) {
            throw Error("--xplane: expected an open --xplane-port, got -1");
        }
    }
    open(
        links::Protocol::XPlane,
        options.xplane_port.value_or(
            xplane_ ? int{links::xplane_port} : default_port(links::xplane_port)));
    if (options.cigi_port >= 0) {
        cigi_ = Peer{ports_.size(), links::peer_from_text("--cigi-host", options.cigi_host)};
        open(links::Protocol::Cigi, options.cigi_port);
    }
    if (!options.only_from.empty()) {
        only_from_ = links::address_from_text("--from", options.only_from);
    }
    if (options.lines_port >= 0) {
        line_server_.emplace(address, static_cast<std::uint16_t>(options.lines_port), only_from_);
    }
    if (options.standard_input) {
        standard_input_.emplace();
    }
}

LiveInput::~LiveInput() {
    if (requested_s_) {
        request_xplane_data(0);
    }
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
        if (packet.protocol == links::Protocol::XPlane &&
            packet.source.address == xplane_->host.address) {
            received_s_ = packet.arrival_s;
        }
    }
    if (!requested_s_ || now - std::max(*requested_s_, received_s_) > patience_s) {
        request_xplane_data(per_second);
        requested_s_ = now;
    }
}

double LiveInput::now_s() const {
    const std::chrono::duration<double, std::micro> passed =
        std::chrono::steady_clock::now() - begin_;
    constexpr double per_second = 1e6;
    return std::floor(passed.count()) / per_second;
}

std::vector<links::Datagram>& LiveInput::drain() {
    packets_.clear();
    for (Port& port : ports_) {
        port.socket.drain(port.protocol, now_s(), packets_);
    }
    if (line_server_) {
        line_server_->drain(now_s(), packets_);
    }
    std::erase_if(packets_, [this](const links::Datagram& packet) {
        return (only_from_ && packet.source.address != *only_from_) ||
               !limit_.admits(packet.source, packet.arrival_s);
    });
    if (xplane_) {
        request_silent_xplane_data();
    }
    if (standard_input_) {
        standard_input_->drain(now_s(), packets_);
    }
    return packets_;
}

void LiveInput::send_cigi(std::span<const std::byte> message) {
    if (cigi_) {
        ports_[cigi_->port].socket.send(cigi_->host, message);
    }
}

bool LiveInput::has_ended() const {
    return ports_.empty() && !line_server_ && standard_input_ && standard_input_->has_ended();
}

std::vector<std::string> LiveInput::lines() const {
    std::vector<std::string> lines;
    for (const Port& port : ports_) {
        lines.push_back(fmt::format(
            "{}: waits on UDP {}:{}", name_of(port.protocol), bind_, port.socket.port()));
    }
    if (cigi_) {
        lines.back() += fmt::format(", answers to {}", links::text_of(cigi_->host));
    }
    if (xplane_) {
        lines.push_back(fmt::format("X-Plane: asks {}", links::text_of(xplane_->host)));
    }
    if (line_server_) {
        lines.push_back(fmt::format("lines: waits on TCP {}:{}", bind_, line_server_->port()));
    }
    if (standard_input_) {
        lines.emplace_back("lines: waits on standard input");
    }
    if (bind_ != "127.0.0.1") {
        lines.push_back(fmt::format("open to other machines: bound to {}", bind_));
    }
    return lines;
}

} // namespace octant::ui::flight
