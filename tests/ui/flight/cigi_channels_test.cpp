#include "sim/links/cigi_host.h"
#include "sim/links/udp_port.h"
#include "ui/flight/sender.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <fmt/format.h>

using namespace octant;
namespace links = sim::links;

TEST_CASE("a host does what else there is to do while it waits for an image generator") {
    constexpr std::uint32_t loopback = 0x7f000001;
    links::UdpPort generator(loopback, 0);
    const std::uint16_t own = links::UdpPort(loopback, 0).port();
    ui::flight::CigiChannels channels;
    channels.add(fmt::format("cigi:127.0.0.1:{}:{}", generator.port(), own));
    int done = 0;
    const auto unanswered = channels.wait_for_first_frames([&] {
        if (++done == 10) {
            links::WireWriter start(links::ByteOrder::Big);
            links::add_start_of_frame(start, {});
            generator.send({loopback, own}, start.bytes());
        }
    });
    CHECK(unanswered.empty());
    CHECK(done >= 10);
}
