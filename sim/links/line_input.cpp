#include "sim/links/line_input.h"

#include "sim/links/tcp_socket.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <poll.h>
#include <sys/socket.h>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace octant::sim::links {

namespace {

constexpr std::size_t read_bytes = 65536;
constexpr std::size_t client_bytes = 16384; ///< read from a client by one drain(); the rest waits
constexpr int max_newcomers = 64;           ///< accepted by one drain(); the rest waits

} // namespace

void StandardInput::drain(double now_s, std::vector<Datagram>& into) {
    std::array<std::byte, read_bytes> bytes{};
    const auto take = [&](const std::vector<std::byte>& line) { into.push_back({Protocol::Lines, {}, now_s, line}); };
    constexpr int max_reads = 16;
    for (int i = 0; i < max_reads && !ended_; ++i) {
        pollfd state{STDIN_FILENO, POLLIN, 0};
        if (::poll(&state, 1, 0) <= 0) { return; }
        const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        if (count <= 0) {
            ended_ = true;
            lines_.finish(take);
            return;
        }
        lines_.add(std::span(bytes).first(static_cast<std::size_t>(count)), take);
    }
}

LineServer::LineServer(std::uint32_t address, std::uint16_t port, std::optional<std::uint32_t> only_from)
    : only_from_(only_from) {
    std::tie(socket_, port_) = listening_socket(address, port);
}

LineServer::~LineServer() {
    for (const Client& client : clients_) { ::close(client.socket); }
    if (socket_ >= 0) { ::close(socket_); }
}

LineServer::LineServer(LineServer&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), port_(other.port_), only_from_(other.only_from_),
      clients_(std::exchange(other.clients_, {})) {}

LineServer& LineServer::operator=(LineServer&& other) noexcept {
    std::swap(socket_, other.socket_);
    std::swap(port_, other.port_);
    std::swap(only_from_, other.only_from_);
    std::swap(clients_, other.clients_);
    return *this;
}

/// If all places are taken, a new client replaces one that has not sent anything yet.
void LineServer::take_clients() {
    const auto now = std::chrono::steady_clock::now();
    for (int taken = 0; taken < max_newcomers; ++taken) {
        const auto client = accepted_client(socket_);
        if (!client) { return; }
        if (only_from_ && client->second.address != *only_from_) {
            ::close(client->first);
            continue;
        }
        if (clients_.size() == max_clients) {
            const auto silent = std::ranges::find(clients_, false, &Client::has_sent);
            if (silent == clients_.end()) {
                ::close(client->first);
                continue;
            }
            ::close(silent->socket);
            clients_.erase(silent);
        }
        clients_.push_back({client->first, client->second, {}, false, now});
    }
}

/// Returns false if the client has disconnected.
bool LineServer::read(Client& client, double now_s, std::vector<Datagram>& into) {
    std::array<std::byte, client_bytes> bytes{};
    const ssize_t count = ::recv(client.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    const auto take = [&](const std::vector<std::byte>& line) {
        into.push_back({Protocol::Lines, client.source, now_s, line});
    };
    if (count > 0) {
        client.has_sent = true;
        client.lines.add(std::span(bytes).first(static_cast<std::size_t>(count)), take);
        return true;
    }
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
        return client.has_sent || std::chrono::steady_clock::now() - client.since < first_line_timeout;
    }
    client.lines.finish(take);
    return false;
}

void LineServer::drain(double now_s, std::vector<Datagram>& into) {
    take_clients();
    for (std::size_t i = 0; i < clients_.size();) {
        if (read(clients_[i], now_s, into)) {
            ++i;
        } else {
            ::close(clients_[i].socket);
            clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

} // namespace octant::sim::links
