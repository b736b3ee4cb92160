#include "sim/links/tacview_server.h"

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <array>
#include <chrono>
#include <cstring>
#include <memory>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace octant::sim::links;

namespace {

constexpr std::uint32_t loopback = 0x7f000001;

/// A reader of the other side.
class Reader {
public:
    explicit Reader(std::uint16_t port)
        : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(port);
        to.sin_addr.s_addr = htonl(loopback);
        sockaddr generic{};
        std::memcpy(&generic, &to, sizeof(generic));
        REQUIRE(::connect(socket_, &generic, sizeof(to)) == 0);
    }

    ~Reader() { ::close(socket_); }

    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    void answer() const {
        const std::string text("XtraLib.Stream.0\nTacview.RealTimeTelemetry.0\nme\n0\0", 50);
        REQUIRE(::send(socket_, text.data(), text.size(), 0) == 50);
    }

    /// All that is there now.
    std::string read() const {
        std::string text;
        std::array<char, 4096> bytes{};
        ssize_t count = 0;
        while ((count = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT)) > 0) {
            text.append(bytes.data(), static_cast<std::size_t>(count));
        }
        return text;
    }

private:
    int socket_;
};

/// Lets the server work until so many readers are ready, at most two seconds.
void settle(TacviewServer& server, std::size_t readers) {
    for (int i = 0; i < 2000 && server.readers() != readers; ++i) {
        server.send("");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(server.readers() == readers);
}

std::string wait_for(TacviewServer& server, const Reader& reader, const std::string& end) {
    std::string text;
    for (int i = 0; i < 2000 && !text.ends_with(end); ++i) {
        server.send("");
        text += reader.read();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return text;
}

} // namespace

TEST_CASE("Tacview's server speaks first, and sends what there is once it is answered") {
    TacviewServer server(loopback, 0, "us");
    server.set_head("HEAD\n");
    const Reader reader(server.port());
    const std::string greeting("XtraLib.Stream.0\nTacview.RealTimeTelemetry.0\nus\n\0", 49);
    CHECK(wait_for(server, reader, std::string(1, '\0')) == greeting);
    reader.answer();
    settle(server, 1);
    server.send("#1\n");
    CHECK(wait_for(server, reader, "#1\n") == "HEAD\n#1\n");
}

TEST_CASE("late joiners get the head, and not what was before them") {
    TacviewServer server(loopback, 0, "us");
    server.set_head("HEAD\n");
    server.send("#1\n");
    const Reader late(server.port());
    late.answer();
    settle(server, 1);
    server.send("#2\n");
    const std::string text = wait_for(server, late, "#2\n");
    CHECK(text.find("HEAD\n#2\n") != std::string::npos);
    CHECK(text.find("#1") == std::string::npos);
}

TEST_CASE("readers that do not read are let go and hold up nobody") {
    TacviewServer server(loopback, 0, "us");
    std::vector<std::unique_ptr<Reader>> stuck;
    for (int i = 0; i < 4; ++i) {
        stuck.push_back(std::make_unique<Reader>(server.port()));
        stuck.back()->answer();
    }
    const Reader good(server.port());
    good.answer();
    settle(server, 5);
    good.read();
    const std::string line(100000, 'x');
    for (int i = 0; i < 200 && server.readers() > 1; ++i) {
        server.send(line);
        for (int tries = 0; tries < 50 && good.read().empty(); ++tries) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    CHECK(server.readers() == 1);
    server.send("#9\n");
    CHECK(wait_for(server, good, "#9\n").ends_with("#9\n"));
}

TEST_CASE("stuck readers and a thousand half-open connections delay a live reader by no sending") {
    TacviewServer server(loopback, 0, "us");
    server.set_head("HEAD\n");
    std::vector<std::unique_ptr<Reader>> stuck;
    for (int i = 0; i < 4; ++i) {
        stuck.push_back(std::make_unique<Reader>(server.port()));
        stuck.back()->answer();
    }
    const Reader live(server.port());
    live.answer();
    settle(server, 5);
    wait_for(server, live, "HEAD\n");
    std::vector<std::unique_ptr<Reader>> half_open;
    const std::string state(2000, 'x');
    for (int frame = 0; frame < 100; ++frame) {
        for (int i = 0; i < 10; ++i) {
            half_open.push_back(std::make_unique<Reader>(server.port()));
        }
        const std::string mark = "#" + std::to_string(frame) + "\n";
        server.send(state + mark);
        std::string text;
        for (int tries = 0; tries < 1000 && !text.ends_with(mark); ++tries) {
            text += live.read();
            std::this_thread::sleep_for(std::chrono::microseconds(tries == 0 ? 0 : 200));
        }
        REQUIRE(text.ends_with(mark));
    }
    CHECK(half_open.size() == 1000);

    const Reader late(server.port());
    late.answer();
    int sendings = 0;
    for (std::string text; text.find("HEAD") == std::string::npos && sendings < 60; ++sendings) {
        server.send("#100\n");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        text += late.read();
    }
    CHECK(sendings < 30); // half a second of pictures
}

TEST_CASE("Tacview's server has a place for so many readers and no more") {
    TacviewServer server(loopback, 0, "us");
    std::vector<std::unique_ptr<Reader>> readers;
    for (std::size_t i = 0; i < TacviewServer::most_readers + 3; ++i) {
        readers.push_back(std::make_unique<Reader>(server.port()));
        readers.back()->answer();
    }
    settle(server, TacviewServer::most_readers);
    for (int i = 0; i < 50; ++i) {
        server.send("");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(server.readers() == TacviewServer::most_readers);
}

TEST_CASE("connections that never shake hands keep no reader out") {
    TacviewServer server(loopback, 0, "us");
    std::vector<std::unique_ptr<Reader>> half_open;
    for (int i = 0; i < 60; ++i) {
        half_open.push_back(std::make_unique<Reader>(server.port()));
        server.send("");
    }
    const Reader good(server.port());
    good.answer();
    settle(server, 1);
}
