#include "sim/base/error.h"
#include "sim/base/lazy_library.h"

#include <catch2/catch.hpp>

namespace octant {

namespace {

constinit LazyLibrary numbers("libm.so.6");
constinit LazyLibrary nowhere("liboctant-is-not-there.so.1");
const LazyFunction<double(double)> late_root(numbers, "sqrt");
const LazyFunction<double(double)> late_nothing(numbers, "no_such_root");
const LazyFunction<double(double)> late_nowhere(nowhere, "sqrt");

} // namespace

TEST_CASE("a function of a library that is opened late is called like any other") {
    CHECK(late_root(9.0) == 3.0);
    double (*const passed_on)(double) = late_root;
    CHECK(passed_on(16.0) == 4.0);
}

TEST_CASE("a library or a function that is not there is named in one line") {
    CHECK_THROWS_WITH(late_nothing(1.0), "expected libm.so.6 with no_such_root on this system, got none");
    CHECK_THROWS_WITH(late_nowhere(1.0), "expected liboctant-is-not-there.so.1 on this system, got none");
    CHECK_THROWS_AS(late_nowhere(1.0), Error);
}

} // namespace octant
