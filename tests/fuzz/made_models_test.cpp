#include "tests/fuzz/kinds.h"
#include "tests/fuzz/obj_polygons.h"
#include "tests/fuzz/trial.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>

using namespace octant::tests::fuzz;

TEST_CASE("a made model is the same each time and another one for another seed") {
    for (const auto kind : kind_names()) {
        INFO(kind);
        const std::string text = text_of(made_model(kind, 7, 20), "");
        CHECK(text == text_of(made_model(kind, 7, 20), ""));
        CHECK(text != text_of(made_model(kind, 8, 20), ""));
    }
}

TEST_CASE("made models of all kinds are ordered and painted right") {
    constexpr int polygons = 12;
    constexpr std::uint64_t seed = 1;
    for (const auto kind : kind_names()) {
        const TrialResult result = tried(made_model(kind, seed, polygons), {.rays = 1000, .cpu_s = 120});
        INFO(kind << ' ' << seed << ": " << name_of(result.outcome) << ": " << result.what);
        CHECK(result.outcome == Outcome::Right);
    }
}
