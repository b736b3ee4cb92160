#include "tests/sim/links/tcp_client.h"

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <array>
#include <cstddef>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace octant::tests {

namespace {

sockaddr socket_address(std::uint32_t address, std::uint16_t port) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(address);
    sockaddr generic{};
    std::memcpy(&generic, &to, sizeof(generic));
    return generic;
}

} // namespace

TcpClient::TcpClient(std::uint16_t port, std::uint32_t own_address) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const sockaddr own = socket_address(own_address, 0);
    const sockaddr to = socket_address(loopback, port);
    REQUIRE(::bind(socket_, &own, sizeof(own)) == 0);
    REQUIRE(::connect(socket_, &to, sizeof(to)) == 0);
}

TcpClient::~TcpClient() { ::close(socket_); }

long TcpClient::say(std::string_view text) const {
    return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

std::string TcpClient::read() const {
    std::string text;
    std::array<char, 4096> bytes{};
    ssize_t count = 0;
    while ((count = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
        text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return text;
}

} // namespace octant::tests
