#pragma once

#include "models/heights/runway_strip.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/ground_decoration.h"

#include <glm/vec2.hpp>

#include <array>
#include <memory>
#include <string>
#include <vector>

// The surface of a runway and what is painted on it, as rectangles: ICAO Annex 14, volume I, chapter 5 (visual aids for
// navigation), for a runway 45 m wide, of code number 4 and up to 2,400 m long. Where Annex 14 leaves a range, widths
// are those of FAA AC 150/5340-1 (Standards for Airport Markings). The ranges for the aiming point are also in EASA
// CS-ADR-DSN, L.540.
//
// threshold         12 stripes of 30 x 1.75 m, 6 m from the end
// number            18.3 m tall (60 feet), of straight strokes
// centre line       stripes of 30 x 0.9 m with gaps of 20 m or a little more
// touchdown zone    pairs of 3, 2 and 2 bars of 22.5 x 1.8 m at 150, 450 and 600 m
// aiming point      a pair of 45 x 9 m at 300 m, 22 m apart
// side stripes      0.9 m
//
// Deviations: numbers are by grid north and not by magnetic north, which the ground does not know; they have the size
// of the AC, Annex 14 draws them 9 m tall and with slanted strokes. The AC leaves out the bars at 600 m where a runway
// is shorter than 1,826 m.

namespace octant::visuals::nature {

/// A rectangle along the runway's axes: metres from its beginning, and metres left of its centre line. Markings do not
/// overlap and lie within the surface.
struct RunwayRectangle {
    glm::vec2 min_m{0.0F};
    glm::vec2 max_m{0.0F};
    bool is_painted = false; ///< a white marking; else the surface
};

/// The designators of both ends, such as "07" and "25": that of a landing at the beginning first.
std::array<std::string, 2> runway_numbers(double heading_rad);

/// The surface, then its markings. The runway must be at least 45 m wide and 1,500 m long (asserted).
std::vector<RunwayRectangle> runway_rectangles(double length_m, double width_m, double heading_rad);

/// The runway on a strip of levelled ground. Markings that look narrow fade to the colour of the surface before they
/// are left out.
std::unique_ptr<GroundDecoration> runway_decoration(
    std::shared_ptr<const models::heights::RunwayStrip> strip, const Daylight& day);

} // namespace octant::visuals::nature
