// A. Zeller, R. Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", IEEE Transactions on Software
// Engineering 28(2), 2002: ddmin, with complements only.
#include "tests/fuzz/reducer.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <iterator>
#include <utility>

namespace octant::tests::fuzz {

namespace {

ObjPolygons without(const ObjPolygons& model, std::size_t first, std::size_t count) {
    ObjPolygons out = model;
    const auto begin = out.polygons.begin() + static_cast<std::ptrdiff_t>(first);
    out.polygons.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return out;
}

} // namespace

ObjPolygons reduced(ObjPolygons model, Outcome outcome, const TrialOptions& options, const ReductionLimits& limits) {
    const auto begin = std::chrono::steady_clock::now();
    int trials = 0;
    const auto may_go_on = [&] {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        return trials < limits.trials && spent.count() < limits.wall_s;
    };
    std::size_t chunk = std::max<std::size_t>(1, model.polygons.size() / 2);
    bool again = true;
    while (again && may_go_on()) {
        bool less = false;
        for (std::size_t at = 0; at < model.polygons.size() && may_go_on();) {
            const std::size_t count = std::min(chunk, model.polygons.size() - at);
            if (count == model.polygons.size()) { break; }
            ObjPolygons fewer = without(model, at, count);
            ++trials;
            if (tried(fewer, options).outcome == outcome) {
                model = std::move(fewer);
                less = true;
            } else {
                at += count;
            }
        }
        again = chunk > 1 || less;
        chunk = std::max<std::size_t>(1, chunk / 2);
    }
    return model;
}

} // namespace octant::tests::fuzz
