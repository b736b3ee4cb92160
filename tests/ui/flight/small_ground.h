#pragma once

#include "models/heights/height_field_export.h"
#include "tests/scratch.h"
#include "visuals/groundfile/ground_import.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace octant::tests {

/// A map of gentle ground, 26 by 26 km, made once, and the ground imported from it. They are loaded in a tenth of the
/// time that made hills take, for flights of which it does not matter what they are over.
inline std::string small_map() {
    static const std::string file = [] {
        constexpr int side = 257;
        std::vector<float> heights_m;
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const double east = 60.0 * std::sin(column / 9.0);
                const double south = 40.0 * std::cos(row / 13.0);
                heights_m.push_back(static_cast<float>(std::lround(200.0 + east + south)));
            }
        }
        const std::filesystem::path map = scratch_folder() / "small.tif";
        models::heights::write_height_field(map, {side, side, 101.5625, heights_m});
        return map.string();
    }();
    return file;
}

inline std::string small_ground() {
    static const std::string file = [] {
        const std::filesystem::path ground = scratch_folder() / "small.ground";
        visuals::groundfile::import_ground(
            {small_map()}, ground, {}, [](visuals::groundfile::ImportStage, double) { return false; });
        return ground.string();
    }();
    return file;
}

} // namespace octant::tests
