// Tree line by latitude: about 3,900 m up to 30 degrees, then some 95 m lower a degree (fitted to figure 1 of C.
// Koerner, "A re-assessment of high elevation treeline positions and their explanation", Oecologia 115, 1998). Snow
// line: the climatic one by latitude, highest in the dry subtropics (R. G. Barry, "Mountain Weather and Climate",
// chapter 4). Dry land: by the Koeppen-Geiger zones of climate_zones.h; tests/evidence/nature.md compares it with
// another map.
#include "visuals/nature/climate.h"

#include "visuals/nature/climate_zones.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>

namespace octant::visuals::nature {

namespace {

struct SnowLine {
    double latitude_deg;
    double height_m;
};

constexpr std::array snow_lines = {SnowLine{0.0, 4800.0}, SnowLine{20.0, 5600.0}, SnowLine{32.0, 5300.0},
    SnowLine{40.0, 3700.0}, SnowLine{46.0, 2900.0}, SnowLine{60.0, 1500.0}, SnowLine{70.0, 800.0},
    SnowLine{80.0, 100.0}, SnowLine{90.0, 0.0}};

constexpr int columns = 720; ///< half degrees of longitude from -180 on
constexpr int rows = 360;    ///< half degrees of latitude from -90 on

/// The letters of climate_zone_runs, one for each half degree.
std::string zones_of_runs() {
    std::string zones;
    zones.reserve(std::size_t{columns} * rows);
    const char* at = climate_zone_runs.data();
    const char* const end = at + climate_zone_runs.size();
    while (at != end) {
        const char zone = *at++;
        std::size_t count = 1;
        at = std::from_chars(at, end, count).ptr;
        zones.append(count, zone);
    }
    assert(zones.size() == std::size_t{columns} * rows);
    return zones;
}

/// Climate::dryness in the middle of a zone. Where summers are dry, shrubs replace woods where it is also warm: towards
/// the equator.
float dryness_of(char zone, double from_equator_deg) {
    switch (zone) {
    case 'd':
        return 1.0F;
    case 's':
        return 0.68F;
    case 'h':
        return 0.42F;
    case 'w':
        return 0.42F * static_cast<float>(1.0 - glm::smoothstep(36.0, 42.0, from_equator_deg));
    default:
        return 0.0F;
    }
}

double snow_line_m(double latitude_deg) {
    for (std::size_t i = 1; i < snow_lines.size(); ++i) {
        if (latitude_deg <= snow_lines[i].latitude_deg) {
            const SnowLine& a = snow_lines[i - 1];
            const SnowLine& b = snow_lines[i];
            const double share = (latitude_deg - a.latitude_deg) / (b.latitude_deg - a.latitude_deg);
            return a.height_m + share * (b.height_m - a.height_m);
        }
    }
    return 0.0;
}

/// Mean over the land up to a degree away along each axis, the nearer land counting more.
float dryness_at(double latitude_deg, double longitude_deg) {
    static const std::string zones = zones_of_runs();
    constexpr double reach = 2.0; // half degrees
    const double y = 2.0 * (latitude_deg + 90.0) - 0.5;
    const double x = 2.0 * (std::remainder(longitude_deg, 360.0) + 180.0) - 0.5;
    float sum = 0.0F;
    float weights = 0.0F;
    for (int j = -2; j <= 2; ++j) {
        const int row = static_cast<int>(std::lround(y)) + j;
        if (row < 0 || row >= rows) { continue; }
        for (int i = -2; i <= 2; ++i) {
            const int column = static_cast<int>(std::lround(x)) + i;
            const int within = (column + columns) % columns;
            const char zone = zones[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(within)];
            if (zone == 'o') { continue; }
            const auto weight = static_cast<float>(
                std::max(1.0 - std::abs(row - y) / reach, 0.0) * std::max(1.0 - std::abs(column - x) / reach, 0.0));
            sum += weight * dryness_of(zone, std::abs(latitude_deg));
            weights += weight;
        }
    }
    return weights > 0.0F ? sum / weights : 0.0F;
}

} // namespace

Climate climate_of(double latitude_deg, double longitude_deg) {
    const double from_equator_deg = std::min(std::abs(latitude_deg), 90.0);
    const double trees_m = std::clamp(3900.0 - 95.0 * (from_equator_deg - 30.0), 0.0, 3900.0);
    const double snow_m = snow_line_m(from_equator_deg);
    return {static_cast<float>(std::min(trees_m, 0.9 * snow_m)), static_cast<float>(snow_m),
        dryness_at(latitude_deg, longitude_deg), static_cast<float>(std::clamp(latitude_deg / 20.0, -1.0, 1.0))};
}

Climate extraterrestrial_climate(const Ellipsoid& ellipsoid) {
    constexpr glm::vec3 rust(0.66F, 0.40F, 0.27F);
    constexpr glm::vec3 grey(0.46F, 0.45F, 0.44F);
    constexpr float never_m = 1e6F;
    Climate climate{-never_m, never_m, 1.0F, 0.0F};
    climate.has_dusty_air = name_of_body(ellipsoid) == "Mars";
    climate.dust = climate.has_dusty_air ? rust : grey;
    return climate;
}

} // namespace octant::visuals::nature
