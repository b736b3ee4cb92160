// How far a result is off, and which of two faults is worse. What plain ways reach is the
// yardstick: a result that is better by one value and worse than them by another one is no better
// result.
#include "models/simplify/fault.h"

#include "models/measure/flipped_area.h"
#include "models/measure/mesh_distance.h"

#include <algorithm>
#include <cstddef>

namespace octant::models::simplify {

namespace {

/// With one percent of its area turned over a result counts as twice as far off.
constexpr double turned_price = 100.0;

/// A result should be less than these shares of the best plain value.
constexpr double wanted_off = 0.97;
constexpr double wanted_rms = 0.88;

constexpr std::size_t samples = 50'000;

measure::DistanceOptions
distance_options(const TriangleMesh& original, double tightness, int threads) {
    measure::DistanceOptions how;
    how.tightness = tightness;
    how.samples = samples;
    how.negligible_m = 1e-6 * diagonal_m(original);
    how.threads = threads;
    how.larger_alone = true;
    return how;
}

/// 1 where a value is as low as wanted, and more where it is not.
double beyond(double value, double wanted) {
    return std::max(1.0, value / wanted);
}

double fourth_power(double x) {
    return x * x * x * x;
}

} // namespace

double Fault::product() const {
    return off_m * rms_m * (1.0 + turned_price * turned);
}

Fault fault_of(
    const TriangleMesh& mesh, const TriangleMesh& original, double tightness, int threads) {
    const measure::DistanceOptions how = distance_options(original, tightness, threads);
    const measure::MeshDistance distance = measure::distance(original, mesh, how);
    Fault fault;
    fault.off_m = distance.most_hausdorff_m();
    if (!(fault.off_m > 2.0 * how.negligible_m)) {
        return {};
    }
    fault.rms_m = distance.rms_m();
    fault.turned =
        measure::flipped_area_share(mesh, original, {.samples = samples, .threads = threads});
    return fault;
}

void Yardstick::add(const TriangleMesh& plain, const TriangleMesh& original, int threads) {
    constexpr double tightness = 1.1;
    const measure::MeshDistance distance =
        measure::distance(original, plain, distance_options(original, tightness, threads));
    add(distance.most_hausdorff_m(), distance.rms_m());
}

void Yardstick::add(double off_m, double rms_m) {
    off_m_ = std::min(off_m_, off_m);
    rms_m_ = std::min(rms_m_, rms_m);
}

bool Yardstick::is_beaten_by(const Fault& fault) const {
    return fault.off_m <= wanted_off * off_m_ && fault.rms_m <= wanted_rms * rms_m_;
}

double Yardstick::badness(const Fault& fault) const {
    const double product = fault.product();
    return !(product > 0.0) ? product
                            : product * fourth_power(
                                            beyond(fault.off_m, wanted_off * off_m_) *
                                            beyond(fault.rms_m, wanted_rms * rms_m_));
}

} // namespace octant::models::simplify
