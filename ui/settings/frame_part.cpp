#include "ui/settings/frame_part.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <fmt/format.h>

namespace octant::ui::settings {

std::optional<FlightPart> part_from_text(const std::string& text) {
    constexpr long max_parts = 10000;
    const auto fields = split_fields(text, '/');
    const auto number = fields.size() == 2 ? whole_number(fields[0]) : std::nullopt;
    const auto of = fields.size() == 2 ? whole_number(fields[1]) : std::nullopt;
    if (!number || !of || *number < 1 || *number > *of || *of > max_parts) { return std::nullopt; }
    return FlightPart{static_cast<int>(*number), static_cast<int>(*of)};
}

FrameRange frames_of(const FlightPart& part, int frames) {
    if (frames < part.of) {
        throw Error(fmt::format(
            "--part: expected at most as many parts as the flight has frames ({}), got {}", frames, part.of));
    }
    const auto share = [&](int number) { return static_cast<int>(static_cast<long>(frames) * number / part.of); };
    return {std::max(0, share(part.number - 1) - 1), share(part.number)};
}

} // namespace octant::ui::settings
