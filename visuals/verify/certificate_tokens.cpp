#include "visuals/verify/certificate_tokens.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace octant::visuals::verify {

namespace {

constexpr double min_normal = 0.5; // The largest part of a unit vector is 0.577 at least.
constexpr double longest_normal = 1.5;

} // namespace

double CertificateTokens::coordinate(const char* what) {
    return number(what, -largest_number, largest_number);
}

Vector CertificateTokens::vector(const char* what) {
    const double x = coordinate(what);
    const double y = coordinate(what);
    const double z = coordinate(what);
    return {x, y, z};
}

Vector CertificateTokens::unit_vector(const char* what) {
    const Vector v = vector(what);
    const double longest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    if (longest < min_normal || longest > longest_normal) {
        fail_at_last(fmt::format("{} of length 1", what));
    }
    return v;
}

WrittenPlane CertificateTokens::plane() {
    const Vector normal = unit_vector("a normal");
    return {normal, coordinate("an offset")};
}

void CertificateTokens::fail_too_many() const {
    refuse(fmt::format("at most {} such lines", max_entries));
}

} // namespace octant::visuals::verify
