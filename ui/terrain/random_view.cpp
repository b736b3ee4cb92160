#include "ui/terrain/random_view.h"

#include "sim/base/units.h"
#include "visuals/terrain/ground_query.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octant::ui::terrain {

namespace terrain = visuals::terrain;

namespace {

/// Splitmix64: the same numbers everywhere.
class RandomNumbers {
public:
    RandomNumbers(std::uint64_t seed, std::uint64_t number)
        : state_(seed * 0x9e3779b97f4a7c15ULL ^ number * 0xd1342543de82ef95ULL) {}

    double between(double low, double high) {
        constexpr double steps = 9007199254740992.0; // 2^53
        return low + (high - low) * (static_cast<double>(next() >> 11U) / steps);
    }

    /// A number between two positive ones whose logarithm is spread evenly.
    double scaled_between(double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    }

    bool is_one_in(std::uint64_t times) { return next() % times == 0; }

private:
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ z >> 27U) * 0x94d049bb133111ebULL;
        return z ^ z >> 31U;
    }

    std::uint64_t state_;
};

} // namespace

RandomView random_view(
    const terrain::GroundSamples& ground, bool by_error, std::uint64_t seed, std::uint64_t number) {
    RandomNumbers numbers(seed, number);
    const glm::dvec2 half_m = ground.half_extent_m();
    const double reach = numbers.between(0.0, 1.0) < 0.3 ? 1.4 : 1.0;
    const double x_m = reach * numbers.between(-half_m.x, half_m.x);
    const double y_m = reach * numbers.between(-half_m.y, half_m.y);
    const double below_m =
        terrain::ground_height_m(
            ground, std::clamp(x_m, -half_m.x, half_m.x), std::clamp(y_m, -half_m.y, half_m.y))
            .value_or(0.0);
    const glm::dvec3 eye_m(x_m, y_m, below_m + numbers.scaled_between(2.0, 20000.0));
    const double heading_rad = numbers.between(0.0, 2.0 * std::numbers::pi);
    const double pitch_rad = rad_from_deg(numbers.between(-90.0, 30.0));
    const glm::dvec3 ahead(
        std::sin(heading_rad) * std::cos(pitch_rad),
        std::cos(heading_rad) * std::cos(pitch_rad),
        std::sin(pitch_rad));
    RandomView view;
    view.camera = visuals::scene::camera_looking_at(eye_m, eye_m + ahead);
    view.camera.vertical_fov_rad = rad_from_deg(numbers.scaled_between(5.0, 100.0));
    if (numbers.is_one_in(2)) {
        view.triangles = static_cast<int>(numbers.scaled_between(100.0, 60000.0));
    } else {
        view.coarseness =
            by_error ? numbers.scaled_between(0.25, 32.0) : 1.0 / numbers.scaled_between(2.0, 64.0);
    }
    return view;
}

} // namespace octant::ui::terrain
