#include "sim/links/tacview_server.h"
#include "tests/sim/links/tcp_client.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace octant::sim::links;
using octant::tests::TcpClient;

namespace {

constexpr std::uint32_t this_host = TcpClient::loopback;

/// Answers the server's greeting as Tacview does.
void answer(const TcpClient& reader) {
    REQUIRE(reader.say({"XtraLib.Stream.0\nTacview.RealTimeTelemetry.0\nme\n0\0", 50}) == 50);
}

/// Lets the server work until so many readers are ready, at most two seconds.
void settle(TacviewServer& server, std::size_t readers) {
    for (int i = 0; i < 2000 && server.readers() != readers; ++i) {
        server.send("");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(server.readers() == readers);
}

std::string wait_for(TacviewServer& server, const TcpClient& reader, const std::string& end) {
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
    TacviewServer server(this_host, 0, "us");
    server.set_head("HEAD\n");
    const TcpClient reader(server.port());
    const std::string greeting("XtraLib.Stream.0\nTacview.RealTimeTelemetry.0\nus\n\0", 49);
    CHECK(wait_for(server, reader, std::string(1, '\0')) == greeting);
    answer(reader);
    settle(server, 1);
    server.send("#1\n");
    CHECK(wait_for(server, reader, "#1\n") == "HEAD\n#1\n");
}

TEST_CASE("late joiners get the head, and not what was before them") {
    TacviewServer server(this_host, 0, "us");
    server.set_head("HEAD\n");
    server.send("#1\n");
    const TcpClient late(server.port());
    answer(late);
    settle(server, 1);
    server.send("#2\n");
    const std::string text = wait_for(server, late, "#2\n");
    CHECK(text.find("HEAD\n#2\n") != std::string::npos);
    CHECK(text.find("#1") == std::string::npos);
}

TEST_CASE("readers that do not read are let go and hold up nobody") {
    TacviewServer server(this_host, 0, "us");
    std::vector<std::unique_ptr<TcpClient>> stuck;
    for (int i = 0; i < 4; ++i) {
        stuck.push_back(std::make_unique<TcpClient>(server.port()));
        answer(*stuck.back());
    }
    const TcpClient good(server.port());
    answer(good);
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
    TacviewServer server(this_host, 0, "us");
    server.set_head("HEAD\n");
    std::vector<std::unique_ptr<TcpClient>> stuck;
    for (int i = 0; i < 4; ++i) {
        stuck.push_back(std::make_unique<TcpClient>(server.port()));
        answer(*stuck.back());
    }
    const TcpClient live(server.port());
    answer(live);
    settle(server, 5);
    wait_for(server, live, "HEAD\n");
    std::vector<std::unique_ptr<TcpClient>> half_open;
    const std::string state(2000, 'x');
    for (int frame = 0; frame < 100; ++frame) {
        for (int i = 0; i < 10; ++i) { half_open.push_back(std::make_unique<TcpClient>(server.port())); }
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

    const TcpClient late(server.port());
    answer(late);
    int sendings = 0;
    for (std::string text; text.find("HEAD") == std::string::npos && sendings < 60; ++sendings) {
        server.send("#100\n");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        text += late.read();
    }
    CHECK(sendings < 30); // half a second of pictures
}

TEST_CASE("Tacview's server has a place for so many readers and no more") {
    TacviewServer server(this_host, 0, "us");
    std::vector<std::unique_ptr<TcpClient>> readers;
    for (std::size_t i = 0; i < TacviewServer::max_readers + 3; ++i) {
        readers.push_back(std::make_unique<TcpClient>(server.port()));
        answer(*readers.back());
    }
    settle(server, TacviewServer::max_readers);
    for (int i = 0; i < 50; ++i) {
        server.send("");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(server.readers() == TacviewServer::max_readers);
}

TEST_CASE("connections that never shake hands keep no reader out") {
    TacviewServer server(this_host, 0, "us");
    std::vector<std::unique_ptr<TcpClient>> half_open;
    for (int i = 0; i < 60; ++i) {
        half_open.push_back(std::make_unique<TcpClient>(server.port()));
        server.send("");
    }
    const TcpClient good(server.port());
    answer(good);
    settle(server, 1);
}
