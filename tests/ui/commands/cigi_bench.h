#pragma once

#include "sim/links/udp_port.h"
#include "sim/links/wire_bytes.h"
#include "tests/ui/commands/command_line.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace octant::tests {

/// A Start of Frame as it came.
struct StartOfFrame {
    std::uint32_t ig_frame = 0;
    /// In steps of 10 microseconds.
    std::uint32_t timestamp = 0;
    std::uint32_t host_frame = 0;
};

/// A host of CIGI at a port of its own. Messages go to the image generator's port.
class CigiBench {
public:
    std::uint16_t port() const { return socket_.port(); }

    std::uint16_t generator() const { return generator_; }

    void send(const sim::links::WireWriter& message);

    /// Waits for a Start of Frame that says this, half a minute at most.
    bool await(const std::function<bool(const StartOfFrame&)>& says);

    /// Takes what has come.
    void listen();

    const std::vector<StartOfFrame>& heard() const { return heard_; }

private:
    static constexpr std::uint32_t loopback = 0x7f000001;

    sim::links::UdpPort socket_{loopback, 0};
    std::uint16_t generator_ = sim::links::UdpPort(loopback, 0).port();
    std::vector<StartOfFrame> heard_;
};

/// Runs the program as the host's image generator beside what the host does.
ProgramRun generate_for(CigiBench& host, std::vector<std::string> arguments, const std::function<void()>& host_works);

} // namespace octant::tests
