#pragma once

#include "ui/settings/settings.h"

#include <string>
#include <vector>

namespace octant::ui::commands {

/// One scene of a bench.
struct BenchScene {
    std::string name;
    settings::RunSettings settings;
    bool is_optional = false; ///< left out where its world cannot be loaded
};

/// A scene as it is with no feature at all, with each one alone, with its ground by a texture, with
/// an airfield where there is room for one, with the features that are there by default, and with
/// all others; then with that texture and with the
/// defaults by OpenGL, whose frame times they are to keep. The first one is what the others are
/// compared with.
std::vector<BenchScene> feature_scenes(const BenchScene& scene);

/// A scene with 20,000, 50,000, 100,000 and 200,000 triangles of ground.
std::vector<BenchScene> triangle_count_scenes(const BenchScene& scene);

} // namespace octant::ui::commands
