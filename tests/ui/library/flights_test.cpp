#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <octant/flight.h>
#include <octant/octant.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace octant {

namespace {

using Words = std::vector<std::pair<std::string, std::string>>;

const Words small_flight{
    {"path", "turn"}, {"aircraft", "500md"}, {"terrain", "hills"}, {"size", "64x48"}, {"frames", "3"}};

double distance_m(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

} // namespace

TEST_CASE("a flight gives its frames, and a recording that is read again") {
    const std::filesystem::path folder = tests::empty_folder("library-flight");
    Flight flight({.settings = small_flight, .record = (folder / "flight").string(), .on_note = [](auto) {}});
    CHECK(flight.frame_count() == 3);
    std::vector<double> times_s;
    while (flight.next()) {
        times_s.push_back(flight.time_s());
        REQUIRE(flight.rgb().size() == 64 * 48 * 3);
        CHECK(std::ranges::count(flight.rgb(), flight.rgb().front()) < 64 * 48);
        REQUIRE(flight.states().size() == 1);
        CHECK(flight.timing().frame_ms >= flight.timing().draw_ms);
    }
    flight.finish();
    CHECK(times_s.size() == 3);
    CHECK(times_s[2] == Approx(2.0 / 60.0));
    CHECK_FALSE(flight.next());
    const std::vector<std::string> recordings{(folder / "flight").string()};
    write_report(recordings, (folder / "page.html").string());
    CHECK(std::filesystem::file_size(folder / "page.html") > 10000);
}

TEST_CASE("wrong settings of flights are refused") {
    for (const auto& wrong : {std::pair<std::string, std::string>{"path", "live"}, {"colour", "1"}, {"rate", "fast"}}) {
        CHECK_THROWS_AS(Flight({.settings = {wrong}}), Error);
    }
    CHECK_THROWS_AS(write_report({}, "page.html"), Error);
    CHECK_THROWS_WITH(Flight({.settings = {{"view", "chase"}, {"look", "1,2,3"}}}),
        "look: expected view free beside it, got view chase");
}

TEST_CASE("a forked process refuses its parent's flight and ends") {
    Flight flight({.settings = small_flight, .on_note = [](auto) {}});
    REQUIRE(flight.next());
    const pid_t child = fork();
    if (child == 0) {
        int code = 1;
        try {
            flight.next();
        } catch (const Error&) {
            const Flight given_up = std::move(flight);
            code = 0;
        }
        _exit(code);
    }
    int status = -1;
    for (int tenth = 0; tenth < 300 && waitpid(child, &status, WNOHANG) == 0; ++tenth) { usleep(100000); }
    CHECK(status == 0);
    if (status == -1) { kill(child, SIGKILL); }
    CHECK(flight.next());
}

TEST_CASE("the path of a world's settings lies over its ground, as the flight along it") {
    const World world({.aircraft = {"500md"}, .settings = {{"path", "turn"}}, .on_note = [](auto) {}});
    const std::vector<State> path = path_states(world, 20.0);
    REQUIRE(path.size() > 100);
    CHECK(path[20].time_s - path[0].time_s == Approx(1.0));
    Flight flight({.settings = small_flight, .on_note = [](auto) {}});
    REQUIRE(flight.next());
    CHECK(distance_m(flight.states().front().position_m, path.front().position_m) < 1e-9);
    CHECK(path.front().position_m.z > world.height_m(path.front().position_m.x, path.front().position_m.y));
    CHECK_THROWS_AS(path_states(world, 0.0), Error);
    CHECK_THROWS_AS(path_states(World({.on_note = [](auto) {}}), 20.0), Error);
}

TEST_CASE("an aircraft in trim keeps height and speed") {
    const State start{.position_m = {0.0, 0.0, 1000.0}, .attitude = attitude(0.0), .velocity_mps = {0.0, 150.0, 0.0}};
    PilotedAircraft aircraft("f15", start);
    aircraft.advance({.throttle = aircraft.trim_throttle()}, 10 * steps_per_second);
    CHECK(aircraft.state().time_s == Approx(10.0));
    CHECK(distance_m(aircraft.state().position_m, {0.0, 1500.0, 1000.0}) < 60.0);
    CHECK_FALSE(aircraft.is_stalled());
    CHECK_THROWS_AS(PilotedAircraft("f16", start), Error);
    State wrong = start;
    wrong.position_m.x = std::nan("");
    CHECK_THROWS_AS(PilotedAircraft("f15", wrong), Error);
}

TEST_CASE("every setting has a name and a meaning") {
    const std::vector<SettingDescription> all = known_settings();
    CHECK(all.size() > 50);
    CHECK(std::ranges::none_of(all, [](const auto& each) { return each.name.empty() || each.meaning.empty(); }));
}

} // namespace octant
