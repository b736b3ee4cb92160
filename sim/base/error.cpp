#include "sim/base/error.h"

#include <fmt/format.h>

namespace octant {

void throw_error_at(const std::filesystem::path& path, int line, const std::string& what) {
    throw Error(fmt::format("{}:{}: {}", path.string(), line, what));
}

void throw_error_in(const std::filesystem::path& path, const std::string& what) {
    throw Error(fmt::format("{}: {}", path.string(), what));
}

std::string printable(const std::string& text) {
    constexpr std::size_t longest = 60;
    std::string out;
    for (const char c : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(c);
        out += (byte < 0x20 || byte >= 0x7f) ? '?' : c;
    }
    return text.size() > longest ? out + "..." : out;
}

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", printable(std::string(text))); }

} // namespace octant
