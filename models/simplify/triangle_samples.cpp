// Positions of samples on a triangle: two regular grids, and the R2 sequence of M. Roberts, "The
// unreasonable effectiveness of quasirandom sequences", 2018, folded into the triangle.
#include "models/simplify/triangle_samples.h"

#include <cmath>

namespace octant::models::simplify {

std::vector<TriangleSample> sample_grid(int fields) {
    std::vector<TriangleSample> samples;
    const double unit = 1.0 / (3.0 * fields * fields);
    for (int i = 0; i <= fields; ++i) {
        for (int j = 0; i + j <= fields; ++j) {
            const int k = fields - i - j;
            const int borders =
                static_cast<int>(i == 0) + static_cast<int>(j == 0) + static_cast<int>(k == 0);
            const double triangles = borders == 0 ? 6.0 : (borders == 1 ? 3.0 : 1.0);
            samples.push_back(
                {glm::dvec3(i, j, k) / static_cast<double>(fields), triangles * unit});
        }
    }
    return samples;
}

std::vector<TriangleSample> middle_grid(int fields) {
    std::vector<TriangleSample> samples;
    const double share = 1.0 / static_cast<double>(fields * fields);
    const auto add = [&](double i, double j) {
        const double u = i / fields;
        const double v = j / fields;
        samples.push_back({glm::dvec3(1.0 - u - v, u, v), share});
    };
    for (int i = 0; i < fields; ++i) {
        for (int j = 0; i + j < fields; ++j) {
            add(i + 1.0 / 3.0, j + 1.0 / 3.0);
            if (i + j + 1 < fields) {
                add(i + 2.0 / 3.0, j + 2.0 / 3.0);
            }
        }
    }
    return samples;
}

glm::dvec3 spread_weights(std::size_t i) {
    const double step = 0.5 + static_cast<double>(i);
    double u = std::fmod(step * 0.7548776662466927, 1.0);
    double v = std::fmod(step * 0.5698402909980532, 1.0);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {1.0 - u - v, u, v};
}

} // namespace octant::models::simplify
