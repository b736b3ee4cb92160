#pragma once

#include "ui/base/output_options.h"
#include "ui/command_line/command.h"
#include "ui/report/table.h"
#include "ui/settings/settings.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace octant::ui::studies::program {

/// One scene of a bench.
struct BenchScene {
    std::string name;
    settings::RunSettings settings;
    bool is_optional = false; ///< left out where its world cannot be loaded
};

/// A scene as it is with no feature at all, with each one alone, with its ground by a texture, with an airfield where
/// there is room for one, with the features that are there by default, and with all others; then with that texture and
/// with the defaults by OpenGL, whose frame times they are to keep. The first one is what the others are compared with.
std::vector<BenchScene> feature_scenes(const BenchScene& scene);

/// A scene with 20,000, 50,000, 100,000 and 200,000 triangles of ground.
std::vector<BenchScene> triangle_count_scenes(const BenchScene& scene);

struct BenchOptions : base::OutputOptions {
    settings::RunSettings settings =
        settings::measurement_settings(); ///< size, samples, triangles, aircraft and drawing are used
    /// One scene each, and each renderer if none is asked for; none: the usual ones.
    std::vector<std::string> terrains;
    std::optional<int> frames;    ///< timed, of each scene; else as many as are usual
    bool features = false;        ///< each scene with and without each feature of the picture
    bool triangle_counts = false; ///< each scene with 20,000 to 200,000 triangles of ground
};

/// Frames that are timed of each scene: by default few where there are many scenes.
int timed_frames(const BenchOptions& options);

struct BenchResult;

/// How the result of a scene is printed.
std::span<const report::Column<BenchResult>> bench_columns();

/// Draws all scenes in turn, frame by frame, the platform's floor first: a lit grid of 20,000 triangles over the whole
/// picture, by OpenGL with one sample a pixel, read back. With features, the scenes of each ground and renderer are
/// drawn in turn, after a floor of their own; by default those of one ground by the raster renderer. Prints a row for
/// each scene.
command_line::Command bench_command();

} // namespace octant::ui::studies::program
