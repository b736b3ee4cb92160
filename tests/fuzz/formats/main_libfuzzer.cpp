// What libFuzzer calls; the one target that is linked is tried.
#include "tests/fuzz/formats/target.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace octant::tests::formats;
    tried(targets().front(), {reinterpret_cast<const char*>(data), size});
    return 0;
}
