#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace octant::models::heights {

/// Raw numbers of a band that stand for no data although the file does not say so.
struct UndeclaredVoids {
    std::vector<double> values;
    /// From here on unsigned numbers are negative ones in disguise, which stand for no data, too.
    double wraparound_threshold = std::numeric_limits<double>::infinity();
    std::string note; ///< how many samples of which value; empty where there are none

    bool has(double raw) const;
};

/// Numbers of this size and more are no heights in any unit, such as -FLT_MAX.
inline constexpr double undeclared_void_threshold = 1e30;

/// The shortest text of a stored number that --void takes for this number.
std::string raw_text(double raw);

/// Whether a number is one that software writes for "no data" by habit, such as -9999.
bool is_common_void_value(double raw);

/// Decides from all samples of a band which numbers stand for no data though none is declared. A usual number
/// (is_common_void_value) does where it lies apart from all other heights: deep-sea maps have true heights of -9999 m.
/// Of other numbers those do that no ground has as a height, where there is one of them, or up to three of fewer
/// samples than heights have, far from all heights and whole or a power of ten: more are heights in a unit that is not
/// known. Negative heights that were stored in unsigned numbers do, too, and all numbers from undeclared_void_threshold
/// on.
class VoidDetector {
public:
    /// `modulus`: 2^bits of the unsigned numbers that samples are or were.
    VoidDetector(double lowest_m, double highest_m, double modulus)
        : lowest_m_(lowest_m), highest_m_(highest_m), modulus_(modulus) {}

    /// A sample that has data by the file's own word.
    void add(double raw, double height_m);

    UndeclaredVoids result() const;

private:
    struct Mark {
        double raw = 0.0;
        double height_m = 0.0;
        std::int64_t samples = 0;
    };

    static void count(std::vector<Mark>& marks, double raw, double height_m);
    bool is_wrapped(double raw) const;
    /// How far a height lies outside those of ordinary samples; 0 within, infinite without any.
    double distance_m(double height_m) const;

    double lowest_m_;
    double highest_m_;
    double modulus_;
    std::int64_t ordinary_ = 0;                              ///< samples that are heights and no usual numbers
    double min_m_ = std::numeric_limits<double>::infinity(); ///< of ordinary samples
    double greatest_m_ = -std::numeric_limits<double>::infinity();
    std::vector<Mark> usual_;
    std::vector<Mark> absurd_; ///< at most max_absurd + 1
    std::vector<Mark> beyond_; ///< at most max_absurd + 1; the last stands for all others
    Mark wrapped_;             ///< the least of them, and their number
    double greatest_wrapped_ = 0.0;
};

} // namespace octant::models::heights
