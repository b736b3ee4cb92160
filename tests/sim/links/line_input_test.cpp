#include "sim/links/line_input.h"
#include "tests/sim/links/tcp_client.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

using namespace octant::sim::links;
using octant::tests::TcpClient;

namespace {

constexpr std::uint32_t this_machine = TcpClient::loopback;
constexpr std::uint32_t another = 0x7f000002;

/// Reads until a line has come that begins so, two seconds at most. Returns whether one has.
bool hears(LineServer& server, std::string_view beginning, const std::function<void()>& meanwhile) {
    for (int i = 0; i < 1000; ++i) {
        meanwhile();
        std::vector<Datagram> lines;
        server.drain(0.0, lines);
        for (const Datagram& line : lines) {
            const std::string text(reinterpret_cast<const char*>(line.bytes.data()), line.bytes.size()); // NOLINT
            CHECK(text.size() <= 4096);
            if (text.starts_with(beginning)) { return true; }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

} // namespace

TEST_CASE("an endless line, binary bytes and a slow writer keep no other line waiting") {
    LineServer server(this_machine, 0);
    const TcpClient endless(server.port());
    const TcpClient binary(server.port());
    const TcpClient slow(server.port());
    const TcpClient good(server.port());
    const std::string block(20000, 'x');
    std::string bytes;
    for (int i = 0; i < 5000; ++i) { bytes += static_cast<char>(i * 37 % 256); }
    const std::string word = "slow,line\n";
    std::size_t said = 0;
    const auto hostile = [&] {
        endless.say(block);
        binary.say(bytes);
        slow.say(std::string_view(word).substr(said++ % word.size(), 1));
    };
    good.say("t_s,north_m\n");
    CHECK(hears(server, "t_s,north_m", hostile));
    CHECK(hears(server, "slow,line", hostile));
    good.say("1,2\n");
    CHECK(hears(server, "1,2", hostile));
}

TEST_CASE("a thousand connections that say nothing keep out nobody who speaks") {
    LineServer server(this_machine, 0);
    const TcpClient good(server.port());
    good.say("first\n");
    CHECK(hears(server, "first", [] {}));
    std::vector<std::unique_ptr<TcpClient>> silent;
    for (int i = 0; i < 1000; ++i) {
        silent.push_back(std::make_unique<TcpClient>(server.port()));
        std::vector<Datagram> lines;
        server.drain(0.0, lines);
    }
    good.say("again\n");
    CHECK(hears(server, "again", [] {}));
    const TcpClient late(server.port());
    late.say("late\n");
    CHECK(hears(server, "late", [] {}));
}

TEST_CASE("clients of other machines than the one that counts hold no place") {
    LineServer server(this_machine, 0, this_machine);
    std::vector<std::unique_ptr<TcpClient>> others;
    for (std::size_t i = 0; i < 2 * LineServer::max_clients; ++i) {
        others.push_back(std::make_unique<TcpClient>(server.port(), another));
        others.back()->say("from elsewhere\n");
    }
    std::vector<Datagram> lines;
    server.drain(0.0, lines);
    const TcpClient good(server.port());
    good.say("t_s,north_m\n");
    for (int i = 0; i < 500 && lines.empty(); ++i) {
        server.drain(0.0, lines);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(lines.size() == 1);
    CHECK(lines.front().source.address == this_machine);
}
