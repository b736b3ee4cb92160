#include "visuals/shading/operation_counts.h"

#include <catch2/catch.hpp>

using namespace octant::visuals::shading;

TEST_CASE("415 polygons of which 9 are smooth cost what table 2 prints, but for its slip") {
    const OperationCounts counts = operation_counts(415, 9);
    CHECK(counts.selection == paper_counts.selection);
    CHECK(counts.all_flat == paper_counts.all_flat);
    CHECK(counts.hybrid == paper_counts.hybrid);
    CHECK(counts.all_smooth == 5395);
}

TEST_CASE("the printed count of all smooth is that of 416 polygons") {
    CHECK(operation_counts(416, 0).all_smooth == paper_counts.all_smooth);
}

TEST_CASE("a hybrid of no or all smooth polygons costs what all flat or all smooth cost") {
    CHECK(operation_counts(416, 0).hybrid == operation_counts(416, 0).all_flat);
    CHECK(operation_counts(416, 416).hybrid == operation_counts(416, 0).all_smooth);
}
