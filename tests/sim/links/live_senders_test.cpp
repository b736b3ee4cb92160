// Senders of many kinds, their networks and a receiver, all on a clock that is a number: an hour of flight takes a
// second. What is shown is judged against the truth of the flight, not against what the receiver says of itself.

#include "sim/base/random_generator.h"
#include "sim/base/units.h"
#include "sim/links/dis_entity.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/live_traffic.h"
#include "sim/links/sender_clock.h"
#include "tests/sim/links/mavlink_frames.h"
#include "tests/sim/links/receiver.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace octant;
using namespace octant::sim;
using namespace octant::sim::links;

namespace {

constexpr double earth_m = 6.4e6; ///< of the earth, as flat as the world of these tests

/// A level flight from the origin to the east, straight or turning to the right; its speed may swing.
struct Flight {
    double speed_mps = 100.0;
    double turn_degps = 0.0;
    double swing_mps = 0.0; ///< of the speed, with a period of half a minute

    glm::dvec3 at(double t) const {
        constexpr double swing_radps = 2.0 * pi / 30.0;
        if (turn_degps == 0.0) {
            const double swung_m = swing_mps / swing_radps * (1.0 - std::cos(swing_radps * t));
            return {speed_mps * t + swung_m, 0.0, 1500.0};
        }
        const double turn_radps = rad_from_deg(turn_degps);
        const double turn_rad = turn_radps * t;
        return speed_mps / turn_radps * glm::dvec3(std::sin(turn_rad), std::cos(turn_rad) - 1.0, 0.0) +
               glm::dvec3(0.0, 0.0, 1500.0);
    }

    glm::dvec3 velocity_mps(double t) const {
        constexpr double step_s = 1e-4;
        return (at(t + step_s) - at(t - step_s)) / (2.0 * step_s);
    }
};

enum class Form { Fdm, Lines, Dis, MavLink };

/// What a sender tells, and when.
struct Sender {
    Flight flight = {};
    Form form = Form::Fdm;
    double rate_hz = 30.0;
    double uneven = 0.0; ///< share of the period that is spread as waiting times are
    bool velocity = false;
    std::optional<double> tick_s = {}; ///< of cur_time
    bool time_column = false;
    double clock_drift = 0.0;
    double clock_rate = 1.0;           ///< seconds of the simulation a second
    double noise_m = 0.0;              ///< standard deviation of places
    int sent_each = 1;                 ///< how often each place is sent
    std::vector<double> stalls_s = {}; ///< when the sender does nothing for 0.8 s
    std::optional<double> restart_s = {};
};

/// What the network does.
struct Network {
    double jitter_s = 0.0;
    double loss = 0.0;
    double doubled = 0.0;
    double burst_s = 0.0;                  ///< packets wait for a time that is a multiple of it
    std::optional<double> stall_at_s = {}; ///< for 0.8 s
};

struct Packet {
    double arrival_s = 0.0;
    double sent_s = 0.0;
    double place_s = 0.0; ///< the time of the place that it tells
    double clock_s = 0.0; ///< the sender's clock
    int number = 0;
};

constexpr double stall_s = 0.8;

struct Sent {
    std::vector<Packet> packets; ///< in the order of their arrivals
    long lost = 0;
};

Sent sent(const Sender& sender, const Network& network, double length_s, RandomGenerator& dice) {
    Sent all;
    auto stall = sender.stalls_s.begin();
    double place_s = 0.0;
    double clock_0_s = 0.0;
    double t = 0.0;
    for (int number = 0; t < length_s; ++number) {
        if (stall != sender.stalls_s.end() && t > *stall) {
            t += stall_s + 0.01 * dice.next();
            ++stall;
        }
        clock_0_s = sender.restart_s && t >= *sender.restart_s ? *sender.restart_s : 0.0;
        place_s = number % sender.sent_each == 0 ? t : place_s;
        Packet packet{t + 0.0005 + network.jitter_s * dice.next(), t, place_s, 0.0, number};
        packet.clock_s = (t - clock_0_s) * sender.clock_rate * (1.0 + sender.clock_drift);
        if (network.burst_s > 0.0) {
            packet.arrival_s = std::ceil(packet.arrival_s / network.burst_s) * network.burst_s;
        }
        if (network.stall_at_s && packet.arrival_s > *network.stall_at_s) {
            packet.arrival_s = std::max(packet.arrival_s, *network.stall_at_s + stall_s);
        }
        const bool is_lost = dice.next() < network.loss;
        all.lost += is_lost ? 1 : 0;
        if (!is_lost) { all.packets.push_back(packet); }
        if (!is_lost && dice.next() < network.doubled) {
            packet.arrival_s += 0.03 * dice.next();
            all.packets.push_back(packet);
        }
        const double waited = 1.0 - sender.uneven - sender.uneven * std::log(1.0 - dice.next());
        t += waited / sender.rate_hz;
    }
    std::ranges::stable_sort(all.packets, {}, &Packet::arrival_s);
    return all;
}

/// HIL_STATE_QUATERNION as PX4 sends it.
std::vector<std::byte> hil_state(const Fix& fix, const Packet& packet) {
    WireWriter payload(ByteOrder::Little);
    payload.add(static_cast<std::uint64_t>(1e6 * packet.clock_s));
    payload.add(static_cast<float>(std::cos(0.5 * fix.attitude.heading_rad)));
    payload.add_zeros(8);
    payload.add(static_cast<float>(std::sin(0.5 * fix.attitude.heading_rad)));
    payload.add_zeros(12);
    payload.add(static_cast<std::int32_t>(1e7 * fix.latitude_deg));
    payload.add(static_cast<std::int32_t>(1e7 * fix.longitude_deg));
    payload.add(static_cast<std::int32_t>(1e3 * fix.altitude_m));
    payload.add(static_cast<std::int16_t>(100.0 * fix.velocity_ned_mps->x));
    payload.add(static_cast<std::int16_t>(100.0 * fix.velocity_ned_mps->y));
    payload.add_zeros(12);
    return octant::tests::encode_mavlink(
        {MavLinkKind::HilStateQuaternion, 1, payload.take()}, static_cast<std::uint8_t>(packet.number));
}

std::vector<std::byte> bytes_of(const Sender& sender, const Fix& fix, const Packet& packet) {
    const double clock_s = packet.clock_s;
    if (sender.form == Form::MavLink) { return hil_state(fix, packet); }
    if (sender.form == Form::Dis) {
        DisEntity entity;
        entity.reckoning = DeadReckoning::Fpw;
        entity.fix = fix;
        const auto bytes = encode_dis(entity, clock_s);
        return {bytes.begin(), bytes.end()};
    }
    if (sender.form == Form::Fdm) {
        const auto bytes = encode_fdm(fix);
        return {bytes.begin(), bytes.end()};
    }
    const std::string line =
        fmt::format("{}{:.9f},{:.9f},{:.3f}", sender.time_column ? fmt::format("{:.3f},", clock_s) : std::string(),
            fix.latitude_deg, fix.longitude_deg, fix.altitude_m);
    const auto bytes = std::as_bytes(std::span(line));
    return {bytes.begin(), bytes.end()};
}

Datagram datagram_of(const Sender& sender, const Packet& packet, RandomGenerator& dice) {
    glm::dvec3 at_m = sender.flight.at(packet.place_s);
    at_m += sender.noise_m * glm::dvec3(dice.normal_deviate(), dice.normal_deviate(), 0.0);
    const glm::dvec3 mps = sender.flight.velocity_mps(packet.place_s);
    Fix fix;
    fix.latitude_deg = deg_from_rad(at_m.y / earth_m);
    fix.longitude_deg = deg_from_rad(at_m.x / earth_m);
    fix.altitude_m = at_m.z;
    fix.attitude.heading_rad = std::atan2(mps.x, mps.y);
    if (sender.velocity) { fix.velocity_ned_mps = glm::dvec3(mps.y, mps.x, -mps.z) / sender.clock_rate; }
    if (sender.tick_s) {
        // So that it wraps around after five minutes.
        const double ticks = packet.clock_s / *sender.tick_s + 4294967296.0 - 300.0 / *sender.tick_s;
        fix.ticks = static_cast<std::uint32_t>(static_cast<std::uint64_t>(ticks));
    }
    const Protocol protocol = sender.form == Form::Fdm       ? Protocol::Fdm
                              : sender.form == Form::Dis     ? Protocol::Dis
                              : sender.form == Form::MavLink ? Protocol::MavLink
                                                             : Protocol::Lines;
    return {protocol, {1, 1}, packet.arrival_s, bytes_of(sender, fix, packet)};
}

/// What was shown, against the truth, from the fifth second on.
struct Shown {
    std::vector<double> speeds; ///< over the true one, in order of size
    long backwards = 0;         ///< pictures that move against the one before
    double rms_m = 0.0;
    double max_m = 0.0;
    std::optional<long> lost; ///< as the receiver says
    long lost_truly = 0;
    long snaps = 0;

    double speed(double share) const {
        return speeds[static_cast<std::size_t>(share * static_cast<double>(speeds.size() - 1))];
    }
};

WorldPosition on_flat_earth(const VehicleKey&, const Fix& fix) {
    return {
        .at_m = {rad_from_deg(fix.longitude_deg) * earth_m, rad_from_deg(fix.latitude_deg) * earth_m, fix.altitude_m}};
}

/// Sixty pictures a second.
Shown shown(const Sender& sender, const Network& network, double length_s) {
    constexpr double frame_s = 1.0 / 60.0;
    constexpr double from_s = 5.0;
    RandomGenerator dice(3);
    const Sent all = sent(sender, network, length_s, dice);
    LiveTraffic traffic(on_flat_earth);
    if (sender.form == Form::Lines) {
        const std::string names = std::string(sender.time_column ? "t_s," : "") + "lat_deg,lon_deg,alt_m";
        const auto bytes = std::as_bytes(std::span(names));
        traffic.take({Protocol::Lines, {1, 1}, 0.0, {bytes.begin(), bytes.end()}});
    }
    Shown result;
    result.lost_truly = all.lost;
    std::vector<AircraftState> states(1);
    glm::dvec3 before_m(0.0);
    glm::dvec3 step_before_m(0.0);
    double squares_m2 = 0.0;
    auto packet = all.packets.begin();
    for (int i = 6; i * frame_s < length_s; ++i) {
        const double now_s = i * frame_s;
        for (; packet != all.packets.end() && packet->arrival_s <= now_s; ++packet) {
            traffic.take(datagram_of(sender, *packet, dice));
        }
        if (traffic.show(now_s, 0.0, states) == 0) { continue; }
        const glm::dvec3 step_m = states[0].position_m - before_m;
        if (now_s > from_s) {
            const double true_mps = glm::length(sender.flight.velocity_mps(now_s));
            const double error_m = glm::distance(states[0].position_m, sender.flight.at(now_s));
            result.speeds.push_back(glm::length(step_m) / frame_s / true_mps);
            result.backwards += glm::dot(step_m, step_before_m) < 0.0 ? 1 : 0;
            squares_m2 += error_m * error_m;
            result.max_m = std::max(result.max_m, error_m);
        }
        before_m = states[0].position_m;
        step_before_m = step_m;
    }
    result.rms_m = std::sqrt(squares_m2 / static_cast<double>(result.speeds.size()));
    std::ranges::sort(result.speeds);
    result.lost = traffic.counts().lost;
    result.snaps = traffic.counts().snaps;
    return result;
}

std::vector<double> every_two_minutes(double length_s) {
    std::vector<double> times_s;
    for (double t = 100.0; t < length_s; t += 120.0) { times_s.push_back(t); }
    return times_s;
}

/// The speed of nearly all pictures is within so much of the truth, and none moves backwards.
void check_smooth(const Shown& found, double share) {
    CHECK(found.backwards == 0);
    CHECK(found.speed(0.5) == Approx(1.0).margin(0.5 * share));
    CHECK(found.speed(0.01) > 1.0 - share);
    CHECK(found.speed(0.99) < 1.0 + share);
}

} // namespace

TEST_CASE("places at an uneven rate without velocities or a clock are shown at the true speed") {
    for (const double rate_hz : {5.0, 8.0, 10.0, 20.0, 30.0, 60.0}) {
        for (const double turn_degps : {0.0, 6.0}) {
            CAPTURE(rate_hz, turn_degps);
            const Shown found =
                shown({.flight = {.turn_degps = turn_degps}, .rate_hz = rate_hz, .uneven = 0.6}, {}, 60.0);
            check_smooth(found, 0.03);
            CHECK(found.rms_m < 0.5);
        }
    }
}

TEST_CASE("losses are told of senders that number their packets, at any rate, and of no others") {
    const Network network{.jitter_s = 0.04, .loss = 0.1, .doubled = 0.05};
    for (const double rate_hz : {5.0, 20.0, 60.0}) {
        for (const double uneven : {0.0, 0.6}) {
            CAPTURE(rate_hz, uneven);
            Sender sender{.rate_hz = rate_hz, .uneven = uneven, .velocity = true};
            CHECK_FALSE(shown(sender, network, 30.0).lost);
            sender.form = Form::MavLink;
            const auto none = shown(sender, {.jitter_s = 0.04, .doubled = 0.05}, 30.0).lost;
            REQUIRE(none);
            CHECK(*none <= 2); // that are on their way at the end
            const Shown found = shown(sender, network, 30.0);
            REQUIRE(found.lost);
            CHECK(found.lost_truly > 10);
            CHECK(*found.lost == Approx(found.lost_truly).margin(2.0)); // at both ends
        }
    }
}

TEST_CASE("numbers of packets count what is missing, not what comes late, twice or anew") {
    const auto lost = [](const std::vector<std::uint32_t>& numbers, int bits) {
        SequenceCount count;
        double arrival_s = 0.0;
        for (std::uint32_t i = 230; i < 250; ++i) { count.add(i, bits, arrival_s); }
        for (const std::uint32_t number : numbers) { count.add(number, bits, arrival_s += 0.1); }
        REQUIRE(count.is_numbered());
        return count.lost();
    };
    CHECK(lost({250, 251, 254, 255, 0, 1, 3}, 8) == 3); // 252, 253 and 2; wraps around
    CHECK(lost({250, 254, 252, 255}, 8) == 2);          // one of them comes late
    CHECK(lost({250, 250, 249, 252, 252}, 8) == 1);     // doubled
    CHECK(lost({250, 100, 101, 102}, 8) == 0);          // the sender begins anew
    CHECK(lost({250, 100000, 100001, 100003}, 32) == 1);
    CHECK(lost({0, 1, 2}, 32) == 0);
    SequenceCount silent;
    silent.add(1, 8, 0.0);
    silent.add(5, 8, 2.5);
    for (std::uint32_t i = 6; i < 20; ++i) { silent.add(i, 8, 2.5); }
    CHECK(silent.is_numbered());
    CHECK(silent.lost() == 0);
}

TEST_CASE("a counter that stands or that several streams share tells no losses") {
    SequenceCount stands;
    SequenceCount shared;
    RandomGenerator dice(3);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        stands.add(7, 32, 0.01 * i);
        if (dice.next() < 0.5) { shared.add(i, 8, 0.01 * i); }
    }
    CHECK_FALSE(stands.is_numbered());
    CHECK_FALSE(shared.is_numbered());
    CHECK(shared.lost() == 0);
}

TEST_CASE("an hour of jitter, losses and stalls is shown as well as its first minutes") {
    const Network network{.jitter_s = 0.04, .loss = 0.05};
    for (const bool velocity : {false, true}) {
        CAPTURE(velocity);
        const double length_s = velocity ? 3600.0 : 1200.0;
        const Shown found = shown({.velocity = velocity, .stalls_s = every_two_minutes(length_s)}, network, length_s);
        check_smooth(found, velocity ? 0.03 : 0.2);
        CHECK(found.rms_m < 2.0); // of which 1.2 m are the 0.3 s that it stands in each stall
        CHECK(found.max_m < 50.0);
    }
    CHECK(shown({.velocity = true}, network, 300.0).rms_m < 0.3);
}

TEST_CASE("an hour takes no more memory than a minute") {
    constexpr double mebibyte = 1048576.0;
    LiveTraffic traffic(on_flat_earth);
    std::vector<AircraftState> states(1);
    const Sender sender{.velocity = false};
    RandomGenerator dice(5);
    double at_a_minute = 0.0;
    for (int i = 0; i < 3600 * 30; ++i) {
        const double t = i / 30.0;
        traffic.take(datagram_of(sender, {t, t, t, t}, dice));
        traffic.show(t, 0.0, states);
        at_a_minute = i == 60 * 30 ? octant::tests::used_bytes() : at_a_minute;
    }
    CHECK(octant::tests::used_bytes() - at_a_minute < 0.25 * mebibyte);
}

TEST_CASE("sender's clocks may drift, wrap around and count in any power of ten") {
    const Network network{.jitter_s = 0.04, .loss = 0.05, .doubled = 0.02};
    for (const auto& [tick_s, drift] : {std::pair(1e-6, -1e-4), std::pair(1e-3, 1e-4)}) {
        CAPTURE(tick_s, drift);
        const Shown found = shown({.velocity = true, .tick_s = tick_s, .clock_drift = drift}, network, 900.0);
        check_smooth(found, 0.03);
        CHECK(found.rms_m < 0.5);
        CHECK(found.max_m < 5.0);
    }
}

TEST_CASE("a clock that counts whole seconds, stands or has another unit is passed over") {
    CHECK(shown({.tick_s = 1.0}, {}, 60.0).rms_m < 0.5);
    const Sender lines{.form = Form::Lines, .rate_hz = 20.0, .time_column = true};
    for (const double clock_rate : {1.0, 0.0, 1000.0, 0.001}) {
        CAPTURE(clock_rate);
        Sender sender = lines;
        sender.clock_rate = clock_rate;
        const Shown found = shown(sender, {}, 60.0);
        check_smooth(found, 0.03);
        CHECK(found.rms_m < 1.0);
    }
}

TEST_CASE("a simulation at half or double speed is shown as fast as it goes") {
    for (const double clock_rate : {0.5, 2.0}) {
        CAPTURE(clock_rate);
        const Shown found = shown({.velocity = true, .tick_s = 1e-6, .clock_rate = clock_rate}, {}, 60.0);
        check_smooth(found, 0.1);
    }
}

TEST_CASE("places that are sent several times each do not stop the flight") {
    for (const bool velocity : {false, true}) {
        for (const int sent_each : {2, 6}) {
            CAPTURE(velocity, sent_each);
            const Shown found = shown({.rate_hz = 60.0, .velocity = velocity, .sent_each = sent_each}, {}, 60.0);
            check_smooth(found, 0.03);
        }
    }
}

TEST_CASE("bursts, stalls of the network and doubled packets leave no frame backwards") {
    for (const bool velocity : {false, true}) {
        CAPTURE(velocity);
        check_smooth(shown({.rate_hz = 66.6, .velocity = velocity}, {.burst_s = 0.088}, 60.0), 0.1);
        const Shown stalled = shown({.velocity = velocity}, {.stall_at_s = 20.0}, 60.0);
        check_smooth(stalled, 0.05);
        const Network bad{.jitter_s = 0.04, .loss = 0.05, .doubled = 0.05};
        CHECK(shown({.rate_hz = 20.0, .uneven = 0.6, .velocity = velocity}, bad, 60.0).backwards == 0);
    }
}

TEST_CASE("packets of a quick sender that overtake one another all the time are put in order") {
    const Shown found = shown({.rate_hz = 100.0}, {.jitter_s = 0.02}, 60.0);
    check_smooth(found, 0.1);
    CHECK(found.rms_m < 1.0);
}

TEST_CASE("speed that changes, slow vehicles and noisy places are followed without velocities") {
    const Sender swings{.flight = {.swing_mps = 20.0}, .rate_hz = 20.0, .uneven = 0.6};
    check_smooth(shown(swings, {}, 60.0), 0.03);
    for (const double speed_mps : {0.5, 2.0, 5.0}) {
        CAPTURE(speed_mps);
        check_smooth(shown({.flight = {.speed_mps = speed_mps}, .rate_hz = 20.0, .uneven = 0.6}, {}, 60.0), 0.03);
    }
    const Sender gps{.flight = {.speed_mps = 30.0}, .rate_hz = 5.0, .noise_m = 0.5};
    const Shown found = shown(gps, {}, 60.0);
    CHECK(found.backwards == 0);
    CHECK(found.speed(0.5) == Approx(1.0).margin(0.05));
    CHECK(found.rms_m < 1.5);
}

TEST_CASE("an entity of DIS goes on by dead reckoning between heartbeats of five seconds") {
    const Sender sender{.form = Form::Dis, .rate_hz = 0.2, .velocity = true};
    const Shown found = shown(sender, {.jitter_s = 0.04}, 300.0);
    CHECK(found.backwards == 0);
    CHECK(found.speed(0.001) > 0.9);
    CHECK(found.rms_m < 4.0);
}

TEST_CASE("a sender that begins its clock anew is shown again within half a second") {
    Sender sender{.velocity = true, .tick_s = 1e-6};
    sender.restart_s = 30.0;
    const Shown found = shown(sender, {.jitter_s = 0.01}, 60.0);
    CHECK(found.backwards == 0);
    CHECK(found.max_m < 50.0);
    CHECK(found.rms_m < 2.0);
}
