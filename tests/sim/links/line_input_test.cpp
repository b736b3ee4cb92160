#include "sim/links/line_input.h"

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <netinet/in.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace octant::sim::links;

namespace {

constexpr std::uint32_t this_machine = 0x7f000001;
constexpr std::uint32_t another = 0x7f000002;

sockaddr generic_of(std::uint32_t address, std::uint16_t port) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(address);
    sockaddr generic{};
    std::memcpy(&generic, &to, sizeof(generic));
    return generic;
}

/// A client with an address of its own.
class Client {
public:
    Client(std::uint32_t address, std::uint16_t port)
        : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        const sockaddr own = generic_of(address, 0);
        const sockaddr to = generic_of(this_machine, port);
        REQUIRE(::bind(socket_, &own, sizeof(own)) == 0);
        REQUIRE(::connect(socket_, &to, sizeof(to)) == 0);
    }

    ~Client() { ::close(socket_); }

    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    Client(Client&&) = delete;
    Client& operator=(Client&&) = delete;

    void say(std::string_view text) const {
        ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }

private:
    int socket_;
};

/// Reads until a line has come that begins so, two seconds at most. Returns whether one has.
bool hears(LineServer& server, std::string_view beginning, const std::function<void()>& meanwhile) {
    for (int i = 0; i < 1000; ++i) {
        meanwhile();
        std::vector<Datagram> lines;
        server.drain(0.0, lines);
        for (const Datagram& line : lines) {
            const std::string text(
                reinterpret_cast<const char*>(line.bytes.data()), line.bytes.size()); // NOLINT
            CHECK(text.size() <= 4096);
            if (text.starts_with(beginning)) {
                return true;
            }
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

} // namespace

TEST_CASE("an endless line, binary bytes and a slow writer keep no other line waiting") {
    LineServer server(this_machine, 0);
    const Client endless(this_machine, server.port());
    const Client binary(this_machine, server.port());
    const Client slow(this_machine, server.port());
    const Client good(this_machine, server.port());
    const std::string block(20000, 'x');
    std::string bytes;
    for (int i = 0; i < 5000; ++i) {
        bytes += static_cast<char>(i * 37 % 256);
    }
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
    const Client good(this_machine, server.port());
    good.say("first\n");
    CHECK(hears(server, "first", [] {}));
    std::vector<std::unique_ptr<Client>> silent;
    for (int i = 0; i < 1000; ++i) {
        silent.push_back(std::make_unique<Client>(this_machine, server.port()));
        std::vector<Datagram> lines;
        server.drain(0.0, lines);
    }
    good.say("again\n");
    CHECK(hears(server, "again", [] {}));
    const Client late(this_machine, server.port());
    late.say("late\n");
    CHECK(hears(server, "late", [] {}));
}

TEST_CASE("clients of other machines than the one that counts hold no place") {
    LineServer server(this_machine, 0, this_machine);
    std::vector<std::unique_ptr<Client>> others;
    for (std::size_t i = 0; i < 2 * LineServer::most_clients; ++i) {
        others.push_back(std::make_unique<Client>(another, server.port()));
        others.back()->say("from elsewhere\n");
    }
    std::vector<Datagram> lines;
    server.drain(0.0, lines);
    const Client good(this_machine, server.port());
    good.say("t_s,north_m\n");
    for (int i = 0; i < 500 && lines.empty(); ++i) {
        server.drain(0.0, lines);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    REQUIRE(lines.size() == 1);
    CHECK(lines.front().source.address == this_machine);
}
