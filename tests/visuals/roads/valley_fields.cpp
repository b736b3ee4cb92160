#include "valley_fields.h"

#include <cmath>
#include <utility>
#include <vector>

namespace octant::tests {

models::heights::HeightField field_of(int samples, const HeightAt& height_m) {
    constexpr double spacing_m = 25.0;
    const double half_m = 0.5 * spacing_m * (samples - 1);
    std::vector<float> heights;
    for (int row = 0; row < samples; ++row) {
        for (int column = 0; column < samples; ++column) {
            heights.push_back(static_cast<float>(height_m({column * spacing_m - half_m, row * spacing_m - half_m})));
        }
    }
    return {samples, samples, spacing_m, std::move(heights)};
}

double two_basins(const glm::dvec2& at_m) {
    const double ridge = std::exp(-std::pow(at_m.x / 700.0, 2.0));
    const double pass = std::exp(-std::pow((at_m.y - 2000.0) / 500.0, 2.0));
    return 100.0 + 300.0 * ridge * (1.0 - pass);
}

} // namespace octant::tests
