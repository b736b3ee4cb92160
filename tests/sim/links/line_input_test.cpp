#include "sim/links/line_input.h"

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <netinet/in.h>
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

    void say(const char* line) const { ::send(socket_, line, std::strlen(line), MSG_NOSIGNAL); }

private:
    int socket_;
};

} // namespace

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
