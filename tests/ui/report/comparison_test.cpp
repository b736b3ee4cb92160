#include "sim/base/random_generator.h"
#include "ui/report/comparison.h"

#include <catch2/catch.hpp>

#include <array>

using namespace octant;
using namespace octant::ui::report;

namespace {

LoadedRecording run_of(const std::string& path, const std::string& method, double p50_ms) {
    LoadedRecording recording;
    recording.name = path + "-" + method;
    recording.folder.path = recording.display_name = recording.name;
    recording.run.settings = {{"path", path}, {"order-method", method}};
    recording.statistics.frames = 10;
    recording.statistics.p50_ms = p50_ms;
    recording.statistics.p99_ms = 2.0 * p50_ms;
    return recording;
}

} // namespace

TEST_CASE("only runs of the same flight are compared, and their variants told apart") {
    std::vector runs{run_of("turn", "tree", 1.0), run_of("straight", "tree", 1.0), run_of("turn", "cells", 1.0),
        run_of("turn", "tree", 1.0)};
    const auto groups = comparable_groups(runs);
    REQUIRE(groups.size() == 2);
    CHECK(groups[0] == std::vector<std::size_t>{0, 2, 3});
    CHECK(groups[1] == std::vector<std::size_t>{1});
    CHECK(variants_of(runs, groups[0]) == std::vector<std::vector<std::size_t>>{{0, 3}, {2}});
    CHECK(settings_that_differ(runs[0], runs[1]) == std::vector<std::string>{"path"});
    runs[3].run.machine_info.cores = 8;
    CHECK(settings_that_differ(runs[0], runs[3]) == std::vector<std::string>{"processor"});
}

TEST_CASE("a change is sure only where its interval leaves zero out") {
    constexpr std::array base{10.0, 10.1, 9.9, 10.05, 9.95};
    constexpr std::array slower{11.0, 11.1, 10.9, 11.05, 10.95};
    constexpr std::array noisy{8.0, 14.0, 10.2, 9.0, 12.0};
    const RelativeChange worse = relative_change(base, slower);
    CHECK(worse.share == Approx(0.1));
    CHECK(worse.is_significant());
    CHECK(worse.low > 0.07);
    CHECK(worse.high < 0.13);
    CHECK_FALSE(relative_change(base, noisy).is_significant());
    CHECK_FALSE(relative_change(base, base).is_significant());
    CHECK_FALSE(relative_change(std::span(base).first(2), slower).has_interval);
    CHECK(relative_change(base, slower).low == worse.low);
}

TEST_CASE("an interval of 95 % holds no change in about 95 of 100 comparisons of the same thing") {
    RandomGenerator dice(3);
    int held = 0;
    constexpr int trials = 150;
    for (int trial = 0; trial < trials; ++trial) {
        std::array<double, 9> a{};
        std::array<double, 9> b{};
        for (std::size_t i = 0; i < a.size(); ++i) {
            a[i] = 10.0 + dice.normal_deviate();
            b[i] = 10.0 + dice.normal_deviate();
        }
        held += relative_change(a, b).is_significant() ? 0 : 1;
    }
    CHECK(held > 0.90 * trials);
    CHECK(held < trials);
}

TEST_CASE("a gate lets figures grow by so much and no more") {
    const Gate gate = read_gate("p50=5%,p99=10%");
    CHECK(gate == Gate{{"p50_ms", 0.05}, {"p99_ms", 0.10}});
    const std::vector within{run_of("turn", "tree", 10.0), run_of("turn", "cells", 10.4)};
    CHECK(gate_failures(within, gate).empty());
    const std::vector beyond{run_of("turn", "tree", 10.0), run_of("turn", "cells", 10.8)};
    CHECK(gate_failures(beyond, gate) ==
          std::vector<std::string>{"turn-cells: p50_ms 10.800 ms, +8.0 % of 10.000 ms, above +5.0 %"});
    const std::vector others{run_of("turn", "tree", 10.0), run_of("straight", "tree", 10.0)};
    CHECK_THROWS_WITH(gate_failures(others, gate),
        "straight-tree: expected a recording to be compared with turn-tree, got one that differs "
        "in path");
    for (const char* wrong : {"", "p50", "p50=5", "p51=5%", "frames=5%", "p50=-5%", "p50=x%"}) {
        CHECK_THROWS_WITH(read_gate(wrong), Catch::StartsWith("--gate: expected figures"));
    }
}
