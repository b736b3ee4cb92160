#pragma once

#include <stdexcept>

#pragma GCC visibility push(default)

namespace octant {

/// Wrong input from outside (file, option, argument, driver). what() is one line. The programs catch it once in main,
/// print the line and end with exit code 2.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace octant

#pragma GCC visibility pop
