#pragma once

#include "models/measure/target_surface.h"
#include "models/triangle_mesh.h"

#include <cstddef>
#include <functional>
#include <limits>

namespace octant::models::simplify {

/// How far a surface is off its original.
struct Fault {
    double off_m = 0.0; ///< The certified distance; 0 where it lies on the original.
    double rms_m = 0.0;
    double turned = 0.0; ///< The share of its area that is turned over.

    /// The distance times the root mean square, more where triangles are turned over.
    double product() const;
};

/// Whether a fault whose values are at least these is of no use.
using IsHopeless = std::function<bool(const Fault& least)>;

/// How a fault is measured.
struct FaultOptions {
    /// The upper bound of the distance is at most this times the lower one.
    double tightness = 1.02;
    std::size_t most_samples = 50'000; ///< For the mean; fewer where the original is small.
    int threads = 1;                   ///< The number of threads; it does not change the result.
    /// Asked when half is measured; may be empty. Where it is true all values are infinite.
    IsHopeless is_hopeless;
};

/// The fault of a mesh that has triangles, as has the original.
Fault fault_of(
    const TriangleMesh& mesh,
    const measure::TargetSurface& original,
    const FaultOptions& options = {});

/// What plain ways to simplify reach without a polish, which is about what others reach, each value
/// by the best one for it. Infinite where none was tried.
class Yardstick {
public:
    Yardstick() = default;

    /// With the shares of the best plain values below which a result should be.
    Yardstick(double wanted_off, double wanted_rms)
        : wanted_off_(wanted_off)
        , wanted_rms_(wanted_rms) {}

    void add(const TriangleMesh& plain, const measure::TargetSurface& original, int threads);
    void add(const Fault& plain);

    double rms_m() const { return rms_m_; }

    /// A result may turn over this share of its area: as much as the best plain way, or noise.
    double allowed_turned() const;

    /// A result should be no farther off.
    double wanted_off_m() const;

    /// Whether a fault is clearly below the yardstick in both distances, and turns over no more
    /// than is allowed.
    bool is_beaten_by(const Fault& fault) const;

    /// Whether plain ways are better in one of the distances.
    bool is_better_than(const Fault& fault) const {
        return fault.off_m > off_m_ || fault.rms_m > rms_m_;
    }

    /// Whether the root mean square is not clearly below that of plain ways, if any was tried.
    bool is_better_in_the_mean_than(const Fault& fault) const;

    /// How little may be hoped of a result as a start for revisions, which lower distances easily
    /// and mean ones hardly.
    double hopelessness(const Fault& fault) const;

    /// How bad a fault is: its product, and much more where one distance is not clearly below the
    /// yardstick or more is turned over than is allowed.
    double badness(const Fault& fault) const;

private:
    /// Other ones of the same kind are somewhat better than ours now and then.
    double wanted_off_ = 0.86;
    double wanted_rms_ = 0.8;
    double off_m_ = std::numeric_limits<double>::infinity();
    double rms_m_ = std::numeric_limits<double>::infinity();
    double turned_ = std::numeric_limits<double>::infinity();
};

} // namespace octant::models::simplify
