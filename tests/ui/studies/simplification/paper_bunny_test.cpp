#include "tests/real_files.h"
#include "ui/studies/simplification/study_simplification.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

using namespace octant::ui::studies::simplification;

TEST_CASE("the bunny of 2000 counted vertices is as the 2005 paper has it") {
    const auto file = octant::tests::real_file("meshes/bun_zipper.ply");
    if (!file) { return; }
    octant::ui::base::Progress progress("bunny", 3, true);
    const auto runs = paper_runs(bunny_from(*file), paper_bunny_vertices, ColourReading::None, progress);
    REQUIRE(runs.size() == 3);
    for (const PaperRun& run : runs) {
        CHECK(run.result.counted_vertices == 2000);
        CHECK(run.result.contractions == 33947);
        CHECK(run.result.mesh.vertices_m.size() >= 883);
        CHECK(run.result.mesh.vertices_m.size() <= 887);
        CHECK(run.result.mesh.triangles.size() >= 1723);
        CHECK(run.result.mesh.triangles.size() <= 1734);
    }
    const auto& previous = runs[0].result.sums;
    const auto& one_way = runs[1].result.sums;
    const auto& both = runs[2].result;
    CHECK(one_way.triangle_m2 <= 0.84 * previous.triangle_m2);
    CHECK(both.sums.bidirectional_m2 <= 0.84 * previous.bidirectional_m2);
    CHECK(both.sums.bidirectional_m2 == Approx(one_way.bidirectional_m2).epsilon(0.02));
    // The paper: 2501472 of 2783088. Exact arithmetic takes every border for outside.
    CHECK(both.feet == 2767338);
    CHECK(both.feet_outside == 2603070);
}
