#include "ui/base/version.h"

#include "sim/base/hash.h"

#include <cstddef>
#include <fmt/format.h>
#include <fstream>
#include <octant_version.h>
#include <span>
#include <vector>

namespace octant::ui::base {

std::string program_version() { return OCTANT_VERSION; }

std::string program_commit() { return OCTANT_COMMIT; }

std::string program_hash() {
    static const std::string text = [] {
        std::ifstream in("/proc/self/exe", std::ios::binary);
        std::vector<char> piece(std::size_t{1} << 20);
        Hash hash;
        bool any = false;
        while (in) {
            in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
            const auto got = static_cast<std::size_t>(in.gcount());
            hash.add(std::as_bytes(std::span(piece.data(), got)));
            any = any || got > 0;
        }
        return any ? fmt::format("{:016x}", hash.value()) : std::string();
    }();
    return text;
}

} // namespace octant::ui::base
