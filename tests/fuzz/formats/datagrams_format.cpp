#include "sim/base/text_file.h"
#include "sim/links/flightgear_fdm.h"
#include "sim/links/live_traffic.h"
#include "tests/fuzz/formats/target.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace octant::tests::formats::datagrams_format {

namespace {

namespace links = sim::links;

std::string seed_of(int packets) {
    std::string all;
    for (int i = 0; i < packets; ++i) {
        links::Fix fix;
        fix.latitude_deg = 47.25 + 1e-4 * i;
        fix.longitude_deg = -122.5;
        fix.altitude_m = 1234.5;
        fix.attitude = {1.25, 0.1, -0.4};
        fix.velocity_ned_mps = glm::dvec3(100.0, -50.0, 5.0);
        fix.ticks = 50U * static_cast<std::uint32_t>(i);
        const auto bytes = links::encode_fdm(fix);
        all.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    return all;
}

/// A file is packets of one size, 20 a second, the last one perhaps cut. Packets never throw, and whatever they say,
/// what is shown is finite.
void use(const std::filesystem::path& file) {
    const std::string bytes = read_file(file);
    links::LiveTraffic traffic([](const auto& /*key*/, const links::Fix& fix) {
        return links::WorldPosition{
            .at_m = 111000.0 * glm::dvec3(fix.longitude_deg, fix.latitude_deg, fix.altitude_m / 111000.0)};
    });
    std::array<sim::AircraftState, 4> states;
    double now_s = 0.0;
    for (std::size_t at = 0; at < bytes.size(); at += links::fdm_24_bytes) {
        links::Datagram packet;
        packet.arrival_s = now_s;
        const auto piece = std::as_bytes(std::span(bytes)).subspan(at);
        const auto own = piece.first(std::min(piece.size(), links::fdm_24_bytes));
        packet.bytes.assign(own.begin(), own.end());
        traffic.take(packet);
        now_s += 0.05;
        const std::size_t shown = traffic.show(now_s, 0.1, states);
        for (const sim::AircraftState& state : std::span(states).first(shown)) {
            for (int part = 0; part < 3; ++part) {
                expect(std::isfinite(state.position_m[part]), "a place");
                expect(std::isfinite(state.velocity_mps[part]), "a velocity");
            }
            expect(std::abs(glm::length(state.body_to_world) - 1.0) < 1e-6, "a unit attitude");
        }
    }
    traffic.lines();
}

const Registered target({
    .name = "datagrams",
    .file = "packets",
    .use = use,
    .seeds =
        [] {
            return std::vector<std::string>{seed_of(1), seed_of(6), std::string(552, 'U')};
        },
});

} // namespace

} // namespace octant::tests::formats::datagrams_format
