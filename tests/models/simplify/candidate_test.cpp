#include "models/simplify/candidate.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace octant::models::simplify;

namespace {

Candidate candidate(Chooser chosen_by, const Fault& fault, bool misses = false) {
    Candidate made;
    made.result.chosen_by = chosen_by;
    made.fault = fault;
    made.misses = misses;
    return made;
}

} // namespace

TEST_CASE("revisions start from the most promising result of each way to choose collapses") {
    const std::vector<Candidate> tried = {
        candidate(Chooser::Distances, {1.0, 1.2, 0.0}),
        candidate(Chooser::Volumes, {0.1, 0.1, 0.0}, true),
        candidate(Chooser::Planes, {0.6, 1.4, 0.0}),
        candidate(Chooser::Distances, {1.1, 1.0, 0.0}),
        candidate(Chooser::Quadrics, {1.5, 0.8, 0.0})};
    INFO("what misses the goal comes last, whatever its fault");
    CHECK(starts(tried, Yardstick()) == std::vector<std::size_t>{4, 3, 2, 1});
}
