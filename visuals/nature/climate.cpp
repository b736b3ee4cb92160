// Tree line by latitude: about 3,900 m up to 30 degrees, then some 95 m lower a degree (fitted to figure 1 of C.
// Koerner, "A re-assessment of high elevation treeline positions and their explanation", Oecologia 115, 1998). Snow
// line: the climatic one by latitude, highest in the dry subtropics (R. G. Barry, "Mountain Weather and Climate",
// chapter 4). Deserts: where the map of M. C. Peel, B. L. Finlayson, T. A. McMahon, "Updated world map of the
// Koeppen-Geiger climate classification", 2007, has the group BW, as ellipses drawn by eye.
#include "visuals/nature/climate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace octant::visuals::nature {

namespace {

struct SnowLine {
    double latitude_deg;
    double height_m;
};

constexpr std::array snow_lines = {SnowLine{0.0, 4800.0}, SnowLine{20.0, 5600.0}, SnowLine{32.0, 5300.0},
    SnowLine{40.0, 3700.0}, SnowLine{46.0, 2900.0}, SnowLine{60.0, 1500.0}, SnowLine{70.0, 800.0},
    SnowLine{80.0, 100.0}, SnowLine{90.0, 0.0}};

struct Desert {
    double latitude_deg;
    double longitude_deg;
    double half_height_deg;
    double half_width_deg;
};

constexpr std::array deserts = {Desert{23.0, 10.0, 10.0, 28.0}, // Sahara
    Desert{24.0, 46.0, 10.0, 11.0},                             // Arabia
    Desert{31.0, 58.0, 6.0, 10.0},                              // Iran, Baluchistan
    Desert{27.0, 70.0, 4.0, 5.0},                               // Thar
    Desert{42.0, 61.0, 5.0, 10.0},                              // Karakum, Kyzylkum
    Desert{40.0, 92.0, 5.0, 18.0},                              // Taklamakan, Gobi
    Desert{37.5, -113.0, 5.5, 7.0},                             // Great Basin, Colorado Plateau
    Desert{30.0, -110.0, 6.0, 9.0},                             // Sonora, Chihuahua
    Desert{-22.0, -69.5, 9.0, 2.5},                             // Atacama
    Desert{-44.0, -68.5, 6.0, 2.5},                             // Patagonia
    Desert{-24.0, 17.0, 7.0, 5.0},                              // Namib, Kalahari
    Desert{-26.0, 131.0, 7.0, 14.0},                            // Australia
    Desert{8.0, 46.0, 5.0, 4.0}};                               // Horn of Africa

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

bool is_desert(double latitude_deg, double longitude_deg) {
    return std::ranges::any_of(deserts, [&](const Desert& desert) {
        const double north = (latitude_deg - desert.latitude_deg) / desert.half_height_deg;
        const double turn = std::remainder(longitude_deg - desert.longitude_deg, 360.0);
        return std::hypot(north, turn / desert.half_width_deg) < 1.0;
    });
}

} // namespace

Climate climate_of(double latitude_deg, double longitude_deg) {
    const double from_equator_deg = std::min(std::abs(latitude_deg), 90.0);
    const double trees_m = std::clamp(3900.0 - 95.0 * (from_equator_deg - 30.0), 0.0, 3900.0);
    const double snow_m = snow_line_m(from_equator_deg);
    return {static_cast<float>(std::min(trees_m, 0.9 * snow_m)), static_cast<float>(snow_m),
        is_desert(latitude_deg, longitude_deg), static_cast<float>(std::clamp(latitude_deg / 20.0, -1.0, 1.0))};
}

Climate extraterrestrial_climate(const Ellipsoid& ellipsoid) {
    constexpr glm::vec3 rust(0.62F, 0.43F, 0.31F);
    constexpr glm::vec3 grey(0.46F, 0.45F, 0.44F);
    constexpr float never_m = 1e6F;
    Climate climate{-never_m, never_m, true, 0.0F};
    climate.dust = name_of_body(ellipsoid) == "Mars" ? rust : grey;
    return climate;
}

} // namespace octant::visuals::nature
