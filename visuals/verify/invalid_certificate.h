#pragma once

#include <string>

namespace octant::visuals::verify {

/// A claim that is false, or missing where one is needed. Thrown on the first one.
struct InvalidCertificate {
    int line = 0;
    std::string what; ///< "expected ..., got ..."
};

} // namespace octant::visuals::verify
