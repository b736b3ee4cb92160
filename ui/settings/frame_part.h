#pragma once

#include <optional>
#include <string>

namespace octant::ui::settings {

/// One of several parts that a flight's frames are divided into.
struct FlightPart {
    int number = 1; ///< from 1
    int of = 1;
};

/// A part from "K/N", 1 <= K <= N <= 10000; nothing for other text.
std::optional<FlightPart> part_from_text(const std::string& text);

/// Frames [first, end) of a flight.
struct FrameRange {
    int first = 0;
    int end = 0;
};

/// The frames of a part: its share, and the one before it, which the part before has too. Throws Error where there are
/// fewer frames than parts.
FrameRange frames_of(const FlightPart& part, int frames);

} // namespace octant::ui::settings
