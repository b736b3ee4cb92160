#include "sim/links/tcp_socket.h"

#include "sim/base/error.h"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace octant::sim::links {

std::pair<int, std::uint16_t> listening_socket(std::uint32_t address, std::uint16_t port) {
    constexpr int waiting_clients = 4096; // or as many as the system allows
    const int listening = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const int on = 1;
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_port = htons(port);
    own.sin_addr.s_addr = htonl(address);
    socklen_t length = sizeof(own);
    sockaddr generic{};
    std::memcpy(&generic, &own, sizeof(generic));
    if (listening < 0 || ::setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) != 0 ||
        ::bind(listening, &generic, length) != 0 || ::listen(listening, waiting_clients) != 0 ||
        ::getsockname(listening, &generic, &length) != 0) {
        const int fault = errno;
        if (listening >= 0) { ::close(listening); }
        throw Error(fmt::format(
            "{}: expected a free TCP port of this machine, got: {}", text_of({address, port}), std::strerror(fault)));
    }
    std::memcpy(&own, &generic, sizeof(own));
    return {listening, ntohs(own.sin_port)};
}

std::optional<std::pair<int, PacketSource>> accepted_client(int listening) {
    sockaddr generic{};
    socklen_t length = sizeof(generic);
    const int client = ::accept4(listening, &generic, &length, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (client < 0) { return std::nullopt; }
    sockaddr_in from{};
    std::memcpy(&from, &generic, sizeof(from));
    return std::pair(client, PacketSource{ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)});
}

} // namespace octant::sim::links
