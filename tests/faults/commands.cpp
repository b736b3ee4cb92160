#include "tests/faults/commands.h"

namespace octant::tests::faults {

std::span<const std::vector<std::string>> preparations() {
    static const std::vector<std::vector<std::string>> all{
        {"terrain", "make", "--kind", "hills", "--size", "129", "--spacing", "150", "--out", "hills.tif"},
        {"simplify", "500md", "part.ply", "--faces", "400", "--method", "fast", "--quiet"},
        {"fly", "straight", "--terrain", "none", "--frames", "3", "--size", "64x48", "--warm-up", "1",
            "--raster-threads", "1", "--record", "flown", "--quiet"},
    };
    return all;
}

std::span<const TriedCommand> tried_commands() {
    static const std::vector<TriedCommand> all{
        {"fly",
            {"fly", "straight", "--terrain", "hills.tif", "--lenient", "--frames", "3", "--size", "64x48", "--warm-up",
                "1", "--pictures", "1", "--raster-threads", "1", "--record", "made", "--quiet"},
            {"made/run.json", "made/frames.csv", "made/counters.csv", "made/mangohud.csv", "made/trace.json",
                "made/track.csv", "made/track.acmi"}},
        {"report", {"report", "flown", "--out", "page.html", "--quiet"}, {}, true},
        {"import", {"terrain", "import", "hills.tif", "--out", "made.ground", "--threads", "1", "--quiet"},
            {"made.ground.part"}},
        {"simplify", {"simplify", "part.ply", "made.obj", "--faces", "200", "--threads", "1", "--quiet"}, {"made.mtl"}},
        {"refine",
            {"refine", "part.ply", "--base", "50", "--save", "made.pm", "--out", "made.ply", "--nodes", "made.txt",
                "--quiet"},
            {}},
    };
    return all;
}

} // namespace octant::tests::faults
