// How far a result is off, and which of two faults is worse. What plain ways reach is the
// yardstick: a result that is better by one value and worse than them by another one is no better
// result.
#include "models/simplify/fault.h"

#include "models/measure/hausdorff.h"
#include "models/measure/sampled_distance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace octant::models::simplify {

namespace {

/// With one percent of its area turned over a result counts as twice as far off.
constexpr double price_of_turned = 100.0;

/// A smaller share of turned area is a few samples.
constexpr double noise = 3e-4;
/// By no more than this what turns more over than plain ways counts as worse.
constexpr double most_for_turned = 4.0;

/// Twenty a triangle of the original tell two results apart, but no fewer than these.
constexpr std::size_t fewest_samples = 10'000;
/// Distances below this share of the diagonal need not be told apart.
constexpr double negligible = 1e-6;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// 1 where a value is as low as wanted, and more where it is not.
double beyond(double value, double wanted) {
    return std::max(1.0, value / wanted);
}

double fourth_power(double x) {
    return x * x * x * x;
}

} // namespace

double Fault::product() const {
    return off_m * rms_m * (1.0 + price_of_turned * turned);
}

Fault fault_of(
    const TriangleMesh& mesh, const measure::TargetSurface& original, const FaultOptions& options) {
    measure::HausdorffLimits limits;
    limits.tightness = options.tightness;
    limits.negligible_m = negligible * diagonal_m(original.mesh());
    limits.threads = options.threads;
    const double negligible_m = limits.negligible_m;
    const std::size_t samples =
        std::clamp(20 * original.mesh().triangles.size(), fewest_samples, options.most_samples);
    measure::SampleOptions how{.samples = samples, .threads = options.threads};
    const measure::TargetSurface surface(mesh);
    const measure::HausdorffBounds there =
        measure::one_way_hausdorff(original.mesh(), surface, limits);
    const double rms_there_m = measure::sampled_distance(original.mesh(), surface, how).rms_m;
    if (options.is_hopeless && options.is_hopeless({there.most_m, rms_there_m, 0.0})) {
        return {infinite, infinite, infinite};
    }
    // Only the larger one of the two ways need be tight.
    limits.negligible_m = std::max(limits.negligible_m, there.least_m);
    const measure::HausdorffBounds back = measure::one_way_hausdorff(mesh, original, limits);
    const double off_m = std::max(there.most_m, back.most_m);
    if (!(off_m > 2.0 * negligible_m)) {
        return {};
    }
    how.flipped = true;
    const measure::SampledDistance sampled_back = measure::sampled_distance(mesh, original, how);
    return {off_m, std::max(rms_there_m, sampled_back.rms_m), sampled_back.flipped_share};
}

void Yardstick::add(
    const TriangleMesh& plain, const measure::TargetSurface& original, int threads) {
    add(fault_of(plain, original, {.tightness = 1.1, .threads = threads, .is_hopeless = {}}));
}

void Yardstick::add(const Fault& plain) {
    off_m_ = std::min(off_m_, plain.off_m);
    rms_m_ = std::min(rms_m_, plain.rms_m);
    turned_ = std::min(turned_, plain.turned);
}

double Yardstick::allowed_turned() const {
    return std::isfinite(turned_) ? std::max(turned_, noise) : noise;
}

double Yardstick::wanted_off_m() const {
    return wanted_off_ * off_m_;
}

bool Yardstick::is_beaten_by(const Fault& fault) const {
    return fault.off_m <= wanted_off_m() && fault.rms_m <= wanted_rms_ * rms_m_ &&
           fault.turned <= allowed_turned();
}

bool Yardstick::is_better_in_the_mean_than(const Fault& fault) const {
    return std::isfinite(off_m_) && fault.rms_m > wanted_rms_ * rms_m_;
}

double Yardstick::hopelessness(const Fault& fault) const {
    const double turned = std::min(beyond(fault.turned, allowed_turned()), most_for_turned);
    return fault.off_m * fault.rms_m * fault.rms_m * fault.rms_m * turned;
}

double Yardstick::badness(const Fault& fault) const {
    const double product = fault.product();
    if (!(product > 0.0)) {
        return product;
    }
    const double turned = std::min(beyond(fault.turned, allowed_turned()), most_for_turned);
    return product * turned *
           fourth_power(
               beyond(fault.off_m, wanted_off_m()) * beyond(fault.rms_m, wanted_rms_ * rms_m_));
}

} // namespace octant::models::simplify
