#pragma once

namespace octant::visuals::overlay {

// Where the hands of dials stand: angles clockwise from the top, radians.

/// Ends of a dial's scale, in the unit that it shows.
struct DialScale {
    double least = 0.0;
    double most = 1.0;

    bool operator==(const DialScale&) const = default;
};

/// Hand of a dial whose scale runs clockwise over most of a turn, from the left of its foot to the
/// right; beyond the ends the hand stays there.
double scale_hand_rad(double value, const DialScale& scale);

/// Hand that turns once in `feet_per_turn`, straight up at sea level.
double altitude_hand_rad(double height_m, double feet_per_turn);

/// A scale in knots from 0 to a round number that holds a speed.
DialScale speed_scale_kt(double max_speed_mps);

/// A scale in g that holds two load factors and 1 g.
DialScale load_scale_g(double min_load_factor, double max_load_factor);

/// Distance of the numbers of a scale, in its unit: a round one, of which no more than nine fit,
/// or five where they have three digits.
double label_step(const DialScale& scale);

} // namespace octant::visuals::overlay
