#include "flightpaths/height_envelope.h"

#include <algorithm>
#include <deque>

namespace octant::flightpaths {

std::vector<double> running_max(const std::vector<double>& values, std::size_t half) {
    std::vector<double> maxima(values.size());
    std::deque<std::size_t> falling;
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (; next < std::min(values.size(), i + half + 1); ++next) {
            while (!falling.empty() && values[falling.back()] <= values[next]) { falling.pop_back(); }
            falling.push_back(next);
        }
        while (falling.front() + half < i) { falling.pop_front(); }
        maxima[i] = values[falling.front()];
    }
    return maxima;
}

std::vector<double> running_min(std::vector<double> values, std::size_t half) {
    for (double& value : values) { value = -value; }
    values = running_max(values, half);
    for (double& value : values) { value = -value; }
    return values;
}

std::vector<double> running_mean(const std::vector<double>& values, std::size_t half) {
    const std::size_t width = 2 * half + 1;
    std::vector<double> means;
    means.reserve(values.size() - 2 * half);
    // Sums of differences to the first value keep a level profile exactly level.
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += values[i] - values.front();
        if (i >= width) { sum -= values[i - width] - values.front(); }
        if (i + 1 >= width) { means.push_back(values.front() + sum / static_cast<double>(width)); }
    }
    return means;
}

std::vector<double> padded(const std::vector<double>& values, std::size_t by) {
    std::vector<double> out(by, values.front());
    out.insert(out.end(), values.begin(), values.end());
    out.insert(out.end(), by, values.back());
    return out;
}

double smooth_step(double share) {
    const double inside = std::clamp(share, 0.0, 1.0);
    return inside * inside * (3.0 - 2.0 * inside);
}

std::vector<double> smooth_above(const std::vector<double>& values, std::size_t half) {
    return running_mean(running_mean(running_max(padded(values, 2 * half), 2 * half), half), half);
}

} // namespace octant::flightpaths
