// What libFuzzer calls: format_fuzzer --only=NAME tries the target of that name.
#include "tests/fuzz/formats/target.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

using octant::tests::formats::Target;

const Target* chosen = nullptr;

} // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
    constexpr std::string_view option = "--only=";
    for (int i = 1; i < *count; ++i) {
        const std::string_view word = (*words)[i];
        if (!word.starts_with(option)) { continue; }
        const auto all = octant::tests::formats::targets();
        const auto found = std::ranges::find(all, word.substr(option.size()), &Target::name);
        if (found != all.end()) { chosen = &*found; }
    }
    if (chosen == nullptr) {
        std::fputs("expected --only= and the name of a format\n", stderr);
        std::exit(2);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    octant::tests::formats::tried(*chosen, {reinterpret_cast<const char*>(data), size}); // NOLINT
    return 0;
}
