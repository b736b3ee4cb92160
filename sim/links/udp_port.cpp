#include "sim/links/udp_port.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace octant::sim::links {

std::string_view name_of(Protocol protocol) {
    switch (protocol) {
    case Protocol::Fdm:
        return "FlightGear FDM";
    case Protocol::Lines:
        return "lines";
    case Protocol::MavLink:
        return "MAVLink";
    case Protocol::Dis:
        return "DIS";
    case Protocol::Cigi:
        return "CIGI";
    case Protocol::XPlane:
        return "X-Plane";
    }
    return "unknown";
}

std::string text_of(const PacketSource& source) {
    if (source == PacketSource{}) { return "standard input"; }
    const auto part = [&source](unsigned shift) { return source.address >> shift & 0xffU; };
    return fmt::format("{}.{}.{}.{}:{}", part(24), part(16), part(8), part(0), source.port);
}

namespace {

constexpr std::size_t batch_size = 64;
constexpr std::size_t control_bytes = CMSG_SPACE(sizeof(timespec));

double seconds(const timespec& time) {
    constexpr double nano = 1e-9;
    return static_cast<double>(time.tv_sec) + nano * static_cast<double>(time.tv_nsec);
}

sockaddr_in internet_address(std::uint32_t address, std::uint16_t port) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(port);
    result.sin_addr.s_addr = htonl(address);
    return result;
}

[[noreturn]] void refuse(std::uint32_t address, std::uint16_t port) {
    throw Error(fmt::format(
        "{}: expected a free UDP port of this machine, got: {}", text_of({address, port}), std::strerror(errno)));
}

} // namespace

/// Room for packets that are received together.
struct UdpPort::Batch {
    std::array<std::array<std::byte, largest_bytes>, batch_size> bytes{};
    std::array<std::array<char, control_bytes>, batch_size> control{};
    std::array<sockaddr_in, batch_size> from{};
    std::array<iovec, batch_size> parts{};
    std::array<mmsghdr, batch_size> headers{};

    void prepare() {
        for (std::size_t i = 0; i < batch_size; ++i) {
            parts[i] = {bytes[i].data(), largest_bytes};
            headers[i] = {};
            msghdr& header = headers[i].msg_hdr;
            header.msg_name = &from[i];
            header.msg_namelen = sizeof(from[i]);
            header.msg_iov = &parts[i];
            header.msg_iovlen = 1;
            header.msg_control = control[i].data();
            header.msg_controllen = control_bytes;
        }
    }

    /// How long ago a packet reached this machine, seconds.
    double age_s(std::size_t i, double system_now_s) {
        msghdr& header = headers[i].msg_hdr;
        for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
            if (part->cmsg_level == SOL_SOCKET && part->cmsg_type == SCM_TIMESTAMPNS) {
                timespec time{};
                std::memcpy(&time, CMSG_DATA(part), sizeof(time));
                constexpr double longest_s = 10.0;
                const double age_s = system_now_s - seconds(time);
                return age_s > 0.0 && age_s < longest_s ? age_s : 0.0;
            }
        }
        return 0.0;
    }
};

std::uint32_t address_from_text(const std::string& option, const std::string& text) {
    in_addr address{};
    if (inet_pton(AF_INET, text.c_str(), &address) != 1) {
        throw Error(fmt::format(
            "{}: expected an IPv4 address such as 127.0.0.1 or 0.0.0.0, got '{}'", option, printable(text)));
    }
    return ntohl(address.s_addr);
}

PacketSource peer_from_text(const std::string& option, const std::string& text) {
    const std::size_t colon = text.rfind(':');
    const auto port =
        colon == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(colon + 1));
    constexpr long last_port = 65535;
    if (!port || *port < 1 || *port > last_port || colon == 0) {
        throw Error(fmt::format("{}: expected HOST:PORT, got '{}'", option, printable(text)));
    }
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    addrinfo* found = nullptr;
    const std::string host = text.substr(0, colon);
    if (getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0 || found == nullptr) {
        throw Error(fmt::format("{}: expected a host with an IPv4 address, got '{}'", option, printable(host)));
    }
    sockaddr_in address{};
    std::memcpy(&address, found->ai_addr, sizeof(address));
    freeaddrinfo(found);
    return {ntohl(address.sin_addr.s_addr), static_cast<std::uint16_t>(*port)};
}

UdpPort::UdpPort(std::uint32_t address, std::uint16_t port)
    : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)), batch_(std::make_unique<Batch>()) {
    sockaddr_in own = internet_address(address, port);
    socklen_t length = sizeof(own);
    sockaddr generic{};
    std::memcpy(&generic, &own, sizeof(generic));
    if (socket_ < 0 || ::bind(socket_, &generic, length) != 0 || ::getsockname(socket_, &generic, &length) != 0) {
        const int fault = errno;
        if (socket_ >= 0) { ::close(socket_); }
        errno = fault;
        refuse(address, port);
    }
    std::memcpy(&own, &generic, sizeof(own));
    port_ = ntohs(own.sin_port);
    // Both are wishes: without them there are more losses and a little more jitter.
    const int on = 1;
    const int buffer_bytes = 4 << 20;
    ::setsockopt(socket_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof(on));
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof(buffer_bytes));
}

UdpPort::~UdpPort() {
    if (socket_ >= 0) { ::close(socket_); }
}

UdpPort::UdpPort(UdpPort&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), port_(other.port_), batch_(std::move(other.batch_)) {}

UdpPort& UdpPort::operator=(UdpPort&& other) noexcept {
    std::swap(socket_, other.socket_);
    std::swap(port_, other.port_);
    std::swap(batch_, other.batch_);
    return *this;
}

void UdpPort::drain(Protocol protocol, double now_s, std::vector<Datagram>& into) {
    timespec system_now{};
    clock_gettime(CLOCK_REALTIME, &system_now);
    for (std::size_t taken = 0; taken < max_a_drain;) {
        batch_->prepare();
        const int count = ::recvmmsg(socket_, batch_->headers.data(), batch_size, MSG_DONTWAIT, nullptr);
        if (count <= 0) { return; }
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            const std::byte* const first = batch_->bytes[i].data();
            into.push_back({protocol, {ntohl(batch_->from[i].sin_addr.s_addr), ntohs(batch_->from[i].sin_port)},
                now_s - batch_->age_s(i, seconds(system_now)), {first, first + batch_->headers[i].msg_len}});
        }
        taken += static_cast<std::size_t>(count);
    }
}

bool UdpPort::send(const PacketSource& to, std::span<const std::byte> bytes) {
    const sockaddr_in peer = internet_address(to.address, to.port);
    sockaddr generic{};
    std::memcpy(&generic, &peer, sizeof(generic));
    const ssize_t sent = ::sendto(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT, &generic, sizeof(peer));
    return sent == static_cast<ssize_t>(bytes.size());
}

bool SourceLimit::admits(const PacketSource& source, double arrival_s) {
    const std::uint64_t key = static_cast<std::uint64_t>(source.address) << 16U | source.port;
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U; // the golden ratio's bits: spreads keys
    constexpr unsigned to_index = 54;                  // the ten highest bits
    Bucket& bucket = buckets_[static_cast<std::size_t>(key * odd >> to_index)];
    const double passed_s = std::max(arrival_s - bucket.filled_s, 0.0);
    bucket.tokens = std::min(bucket.tokens + passed_s * packets_per_s, burst);
    bucket.filled_s = std::max(bucket.filled_s, arrival_s);
    if (bucket.tokens < 1.0) { return false; }
    bucket.tokens -= 1.0;
    return true;
}

} // namespace octant::sim::links
