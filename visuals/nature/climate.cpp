// Tree line by latitude: about 3,900 m up to 30 degrees, then some 95 m lower a degree (fitted to figure 1 of C.
// Koerner, "A re-assessment of high elevation treeline positions and their explanation", Oecologia 115, 1998). Snow
// line: the climatic one by latitude, highest in the dry subtropics (R. G. Barry, "Mountain Weather and Climate",
// chapter 4). Dry regions: where the map of M. C. Peel, B. L. Finlayson, T. A. McMahon, "Updated world map of the
// Koeppen-Geiger climate classification", 2007, has the groups BW (1) and BS (about a half), as ellipses drawn by eye.
// On nine tenths of the land they agree with the map of M. Kottek and others, "World Map of the Koeppen-Geiger climate
// classification updated", 2006, whether it is dry; tests/evidence/nature.md has the comparison.
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

/// An ellipse of dry land.
struct DryRegion {
    double latitude_deg;
    double longitude_deg;
    double half_height_deg;
    double half_width_deg;
    float dryness; ///< of its middle
};

constexpr std::array dry_regions = {
    DryRegion{23.0, 10.0, 10.0, 28.0, 1.0F},    // Sahara
    DryRegion{24.0, 46.0, 10.0, 11.0, 1.0F},    // Arabia
    DryRegion{31.0, 58.0, 6.0, 10.0, 1.0F},     // Iran, Baluchistan
    DryRegion{27.0, 70.0, 4.0, 5.0, 1.0F},      // Thar
    DryRegion{42.0, 61.0, 5.0, 10.0, 1.0F},     // Karakum, Kyzylkum
    DryRegion{40.0, 92.0, 5.0, 18.0, 1.0F},     // Taklamakan, Gobi
    DryRegion{37.5, -113.0, 5.5, 6.2, 1.0F},    // Great Basin, Colorado Plateau
    DryRegion{30.0, -110.0, 6.0, 7.5, 1.0F},    // Sonora, Chihuahua
    DryRegion{-22.0, -69.5, 9.0, 2.5, 1.0F},    // Atacama
    DryRegion{-44.0, -68.5, 6.0, 2.5, 1.0F},    // Patagonia
    DryRegion{-24.0, 17.0, 7.0, 5.0, 1.0F},     // Namib, Kalahari
    DryRegion{-26.0, 131.0, 7.0, 14.0, 1.0F},   // Australia
    DryRegion{8.0, 46.0, 5.0, 4.0, 1.0F},       // Horn of Africa
    DryRegion{40.0, -103.5, 9.5, 4.2, 0.55F},   // Great Plains
    DryRegion{42.3, -109.0, 3.2, 4.5, 0.7F},    // Wyoming
    DryRegion{46.3, -119.2, 2.0, 2.0, 0.65F},   // Columbia Plateau
    DryRegion{43.0, -114.5, 1.6, 3.6, 0.7F},    // Snake River
    DryRegion{36.0, -119.8, 2.0, 1.2, 0.7F},    // Central Valley
    DryRegion{33.9, -117.8, 1.5, 2.0, 0.55F},   // southern California
    DryRegion{24.0, -103.0, 4.0, 4.0, 0.6F},    // northern Mexico
    DryRegion{-35.0, -66.0, 7.0, 3.0, 0.6F},    // Dry Pampas
    DryRegion{-8.5, -40.0, 4.0, 4.0, 0.5F},     // Sertao
    DryRegion{39.5, -2.5, 2.5, 4.0, 0.4F},      // Meseta
    DryRegion{37.8, -1.5, 1.1, 1.5, 0.6F},      // south-eastern Spain
    DryRegion{38.5, 33.5, 2.0, 4.0, 0.5F},      // Anatolia
    DryRegion{34.0, 3.0, 2.0, 10.0, 0.6F},      // Maghreb
    DryRegion{33.5, 38.0, 3.5, 5.0, 0.75F},     // Syria, Iraq
    DryRegion{14.8, 12.0, 2.6, 29.0, 0.6F},     // Sahel
    DryRegion{1.5, 39.0, 4.5, 3.5, 0.65F},      // Kenya, southern Ethiopia
    DryRegion{-30.5, 22.0, 4.0, 4.5, 0.75F},    // Karoo
    DryRegion{-23.0, 24.0, 5.0, 6.0, 0.55F},    // Botswana
    DryRegion{48.5, 66.0, 3.6, 17.0, 0.55F},    // Kazakh steppe
    DryRegion{46.5, 104.0, 3.6, 12.0, 0.6F},    // Mongolia
    DryRegion{38.5, 107.0, 3.2, 7.0, 0.55F},    // Ordos, Loess Plateau
    DryRegion{33.0, 84.0, 4.0, 9.0, 0.7F},      // Tibet
    DryRegion{47.0, 45.0, 3.0, 5.5, 0.5F},      // Caspian steppe
    DryRegion{17.0, 76.0, 4.0, 1.6, 0.5F},      // western Deccan
    DryRegion{-25.0, 133.0, 10.5, 19.0, 0.55F}, // around Australia's deserts
};

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

/// The driest of the regions that a place lies in, each less dry near its border.
float dryness_at(double latitude_deg, double longitude_deg) {
    float dryness = 0.0F;
    for (const DryRegion& region : dry_regions) {
        const double north = (latitude_deg - region.latitude_deg) / region.half_height_deg;
        const double turn = std::remainder(longitude_deg - region.longitude_deg, 360.0);
        const double from_middle = std::hypot(north, turn / region.half_width_deg);
        const double inside = 1.0 - std::clamp((from_middle - 0.75) / 0.4, 0.0, 1.0);
        const double share = inside * inside * (3.0 - 2.0 * inside);
        dryness = std::max(dryness, region.dryness * static_cast<float>(share));
    }
    return dryness;
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
    climate.dust = name_of_body(ellipsoid) == "Mars" ? rust : grey;
    return climate;
}

} // namespace octant::visuals::nature
