// The handshake: Tacview's page on real-time telemetry. The server's greeting ends in a zero byte and names no
// password; so does the client's answer, whose last line would be one.

#include "sim/links/tacview_server.h"

#include "sim/links/tcp_socket.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fmt/format.h>
#include <sys/socket.h>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace octant::sim::links {

namespace {

constexpr std::string_view greeting = "XtraLib.Stream.0\nTacview.RealTimeTelemetry.0\n";
constexpr std::size_t longest_answer = 4096;

} // namespace

TacviewServer::TacviewServer(std::uint32_t address, std::uint16_t port, std::string name) : name_(std::move(name)) {
    std::tie(socket_, port_) = listening_socket(address, port);
}

TacviewServer::~TacviewServer() {
    for (const Client& client : clients_) { ::close(client.socket); }
    if (socket_ >= 0) { ::close(socket_); }
}

TacviewServer::TacviewServer(TacviewServer&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), port_(other.port_), name_(std::move(other.name_)),
      head_(std::move(other.head_)), clients_(std::exchange(other.clients_, {})) {}

TacviewServer& TacviewServer::operator=(TacviewServer&& other) noexcept {
    std::swap(socket_, other.socket_);
    std::swap(port_, other.port_);
    std::swap(name_, other.name_);
    std::swap(head_, other.head_);
    std::swap(clients_, other.clients_);
    return *this;
}

/// If too many clients are in their handshake, a new one replaces the oldest.
void TacviewServer::take_clients() {
    constexpr int max_a_call = 256;
    for (int taken = 0; taken < max_a_call; ++taken) {
        const auto client = accepted_client(socket_);
        if (!client) { break; }
        if (clients_.size() - readers() == max_handshakes) {
            const auto slow = std::ranges::find(clients_, false, &Client::ready);
            ::close(slow->socket);
            clients_.erase(slow);
        }
        Client newcomer{client->first, false, {}, {}, std::chrono::steady_clock::now()};
        newcomer.waiting = fmt::format("{}{}\n", greeting, name_);
        newcomer.waiting.push_back('\0');
        clients_.push_back(std::move(newcomer));
    }
}

/// Returns false if the client must be disconnected.
bool TacviewServer::do_handshake(Client& client) const {
    std::array<char, 1024> bytes{};
    ssize_t count = 0;
    while ((count = ::recv(client.socket, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
        if (client.ready) {
            continue; // What a reader says later does not matter.
        }
        client.heard.append(bytes.data(), static_cast<std::size_t>(count));
        if (client.heard.size() > longest_answer) { return false; }
    }
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK)) { return false; }
    if (client.ready) { return true; }
    if (client.heard.find('\0') == std::string::npos) {
        return std::chrono::steady_clock::now() - client.since < handshake_timeout;
    }
    if (!client.heard.starts_with("XtraLib.Stream.0\n") || readers() == max_readers) { return false; }
    client.ready = true;
    client.waiting += head_;
    return true;
}

/// Returns false if the client is too slow or has disconnected.
bool TacviewServer::flush(Client& client) {
    while (!client.waiting.empty()) {
        const ssize_t sent =
            ::send(client.socket, client.waiting.data(), client.waiting.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent <= 0) {
            const bool later = sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
            return later && client.waiting.size() <= max_waiting_bytes;
        }
        client.waiting.erase(0, static_cast<std::size_t>(sent));
    }
    return true;
}

void TacviewServer::send(std::string_view text) {
    take_clients();
    for (std::size_t i = 0; i < clients_.size();) {
        Client& client = clients_[i];
        const bool was_ready = client.ready;
        bool stays = do_handshake(client);
        if (stays && was_ready) { client.waiting += text; }
        stays = stays && flush(client);
        if (stays) {
            ++i;
        } else {
            ::close(client.socket);
            clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

std::size_t TacviewServer::readers() const {
    return static_cast<std::size_t>(std::ranges::count(clients_, true, &Client::ready));
}

} // namespace octant::sim::links
