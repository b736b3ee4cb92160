// Drives a target without libFuzzer: with files given, or with its seeds and as many changes of them as the first
// argument says.

#include "sim/base/random_generator.h"
#include "tests/fuzz/links/packet_target.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace {

using Bytes = std::vector<std::byte>;

void run(const Bytes& bytes) {
    // A block of its own size, so that a sanitizer sees what lies beyond.
    const Bytes exact(bytes.begin(), bytes.end());
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(exact.data()), exact.size()); // NOLINT
}

std::size_t below(octant::RandomGenerator& dice, std::size_t most) {
    return static_cast<std::size_t>(dice.next() * static_cast<double>(most));
}

/// The bytes with some of them changed, cut, doubled or thrown away.
Bytes changed(Bytes bytes, octant::RandomGenerator& dice) {
    const std::size_t changes = 1 + below(dice, 4);
    for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
        const std::size_t at = below(dice, bytes.size());
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        switch (below(dice, 6)) {
        case 0:
            bytes[at] = static_cast<std::byte>(below(dice, 256));
            break;
        case 1:
            bytes[at] ^= static_cast<std::byte>(1U << below(dice, 8));
            break;
        case 2:
            bytes[at] = dice.next() < 0.5 ? std::byte{0xff} : std::byte{0x7f};
            break;
        case 3:
            bytes.erase(place, bytes.end());
            break;
        case 4:
            bytes.insert(place, static_cast<std::byte>(below(dice, 256)));
            break;
        default:
            bytes.insert(bytes.end(), bytes.begin(), place);
            break;
        }
    }
    constexpr std::size_t largest = 4096;
    bytes.resize(std::min(bytes.size(), largest));
    return bytes;
}

void run_file(const char* name) {
    std::ifstream file(name, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    Bytes bytes;
    for (const char letter : text) { bytes.push_back(static_cast<std::byte>(letter)); }
    run(bytes);
}

} // namespace

int main(int count, char** arguments) {
    char* end = nullptr;
    const long tries = count > 1 ? std::strtol(arguments[1], &end, 10) : 0;
    if (count > 1 && *end != '\0') {
        for (int i = 1; i < count; ++i) { run_file(arguments[i]); }
        return 0;
    }
    octant::RandomGenerator dice(11);
    const auto seeds = octant::tests::packet_seeds();
    for (const Bytes& seed : seeds) { run(seed); }
    for (long i = 0; i < tries; ++i) { run(changed(seeds[below(dice, seeds.size())], dice)); }
    std::printf("%ld changes of %zu packets\n", tries, seeds.size());
    return 0;
}
