#include "tests/fuzz/obj_polygons.h"
#include "tests/fuzz/trial.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

using namespace octant::tests::fuzz;

namespace {

std::vector<std::filesystem::path> corpus() {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder = OCTANT_SOURCE_DIR "/tests/fuzz/corpus";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) { files.push_back(entry.path()); }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

TEST_CASE("every model of the corpus is ordered and painted right") {
    const TrialOptions options{.rays = 6000, .cpu_s = 120};
    REQUIRE_FALSE(corpus().empty());
    for (const std::filesystem::path& file : corpus()) {
        const TrialResult result = tried(read_obj_polygons(file), options);
        INFO(file.filename().string() << ": " << name_of(result.outcome) << ": " << result.what);
        CHECK(result.outcome == Outcome::Right);
    }
}
