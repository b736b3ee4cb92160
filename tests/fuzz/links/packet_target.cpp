#include "tests/fuzz/links/packet_target.h"

#include <cstdio>
#include <cstdlib>

namespace octant::tests {

void expect(bool holds, const char* what) {
    if (!holds) {
        std::fprintf(stderr, "expected %s\n", what);
        std::abort();
    }
}

} // namespace octant::tests
