#include "sim/links/udp_port.h"

#include <catch2/catch.hpp>

using namespace octant::sim::links;

TEST_CASE("a flood is cut to the limit, and a quiet sender beside it is not") {
    SourceLimit limit;
    long flood = 0;
    long quiet = 0;
    constexpr double seconds = 4.0;
    constexpr long floods_per_s = 100000;
    for (long i = 0; i < static_cast<long>(seconds) * floods_per_s; ++i) {
        const double t = static_cast<double>(i) / floods_per_s;
        flood += limit.admits({1, 1}, t) ? 1 : 0;
        if (i % 1000 == 0) { quiet += limit.admits({2, 5550}, t) ? 1 : 0; }
    }
    CHECK(quiet == 400);
    CHECK(flood <= static_cast<long>(SourceLimit::burst + seconds * SourceLimit::packets_per_s));
    CHECK(flood > 100000);
}

TEST_CASE("20,000 packets a second are let through") {
    SourceLimit limit;
    for (int i = 0; i < 200000; ++i) {
        if (!limit.admits({1, 1}, i / 20000.0)) { FAIL("packet " << i); }
    }
}
