#include "visuals/camera/sensor.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

namespace octant::visuals::camera {

namespace {

double light_by_formula(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::vector<std::uint16_t> developed(
    const Sensor& sensor, std::uint16_t colour, std::size_t pixels, const Sensor::NoiseKey& key = {}) {
    const std::vector<std::uint16_t> colours(3 * pixels, colour);
    std::vector<float> sums(colours.size(), 0.0F);
    add_light(colours, sums);
    std::vector<std::uint16_t> result(colours.size());
    sensor.develop(sums, 1, key, result);
    return result;
}

struct Moments {
    double mean = 0.0;
    double deviation = 0.0;
    double fourth = 0.0; ///< of a normal distribution 3
};

Moments moments_of(const std::vector<double>& values) {
    Moments moments;
    for (const double value : values) { moments.mean += value / static_cast<double>(values.size()); }
    double square = 0.0;
    double fourth = 0.0;
    for (const double value : values) {
        const double off = value - moments.mean;
        square += off * off / static_cast<double>(values.size());
        fourth += off * off * off * off / static_cast<double>(values.size());
    }
    moments.deviation = std::sqrt(square);
    moments.fourth = fourth / (square * square);
    return moments;
}

std::vector<double> as_shares(const std::vector<std::uint16_t>& colours) {
    std::vector<double> shares;
    for (const std::uint16_t colour : colours) { shares.push_back(colour / 65535.0); }
    return shares;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const Moments of_a = moments_of(a);
    const Moments of_b = moments_of(b);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) { sum += (a[i] - of_a.mean) * (b[i] - of_b.mean); }
    return sum / static_cast<double>(a.size()) / (of_a.deviation * of_b.deviation);
}

constexpr std::uint16_t grey = 32768;

} // namespace

TEST_CASE("light is that of sRGB, and each colour comes back from its light") {
    double worst = 0.0;
    int changed = 0;
    for (int i = 0; i <= 65535; ++i) {
        const auto colour = static_cast<std::uint16_t>(i);
        worst = std::max(worst, std::abs(light_of(colour) - light_by_formula(i / 65535.0)));
        changed += colour_of(light_of(colour)) == colour ? 0 : 1;
    }
    CHECK(worst < 1e-7);
    CHECK(changed == 0);
    CHECK(colour_of(-1.0F) == 0);
    CHECK(colour_of(2.0F) == 65535);
}

TEST_CASE("without exposure and noise a picture stays as it is, also as the mean of equal ones") {
    std::vector<std::uint16_t> colours;
    for (int i = 0; i < 3 * 5000; ++i) { colours.push_back(static_cast<std::uint16_t>(i * 4)); }
    std::vector<float> sums(colours.size(), 0.0F);
    for (int i = 0; i < 8; ++i) { add_light(colours, sums); }
    std::vector<std::uint16_t> result(colours.size());
    Sensor().develop(sums, 8, {}, result);
    int worst = 0;
    for (std::size_t i = 0; i < colours.size(); ++i) { worst = std::max(worst, std::abs(colours[i] - result[i])); }
    CHECK(worst == 0);
}

TEST_CASE("an exposure multiplies light and clips it") {
    Sensor sensor;
    sensor.exposure = 2.0;
    const double value = 0.3;
    const auto colour = static_cast<std::uint16_t>(value * 65535.0 + 0.5);
    const double light = 2.0 * light_by_formula(value);
    const double wanted = 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    CHECK(developed(sensor, colour, 1)[0] == Approx(wanted * 65535.0).margin(1.5));
    CHECK(developed(sensor, 60000, 1)[0] == 65535);
    sensor.exposure = 0.0;
    CHECK(developed(sensor, 60000, 1)[0] == 0);
}

TEST_CASE("the noise of grey has the mean 0, the wanted deviation and the shape of a normal distribution") {
    for (const double noise : {0.002, 0.01}) {
        Sensor sensor;
        sensor.noise = noise;
        const Moments moments = moments_of(as_shares(developed(sensor, grey, 100'000, {5, 0})));
        CAPTURE(noise, moments.mean, moments.deviation, moments.fourth);
        CHECK(std::abs(moments.mean - 0.5) < 0.02 * noise);
        CHECK(moments.deviation == Approx(noise).epsilon(0.02));
        CHECK(moments.fourth == Approx(3.0).margin(0.08));
    }
    // So strong that the transfer function bends its colours: its light is as wanted.
    Sensor strong;
    strong.noise = 0.05;
    std::vector<double> lights;
    for (const std::uint16_t colour : developed(strong, grey, 100'000)) {
        lights.push_back(light_by_formula(colour / 65535.0));
    }
    const Moments moments = moments_of(lights);
    const double light_of_noise = light_by_formula(0.505) - light_by_formula(0.495);
    CHECK(moments.mean == Approx(light_by_formula(0.5)).epsilon(1e-3));
    CHECK(moments.deviation == Approx(5.0 * light_of_noise).epsilon(0.01));
    CHECK(moments.fourth == Approx(3.0).margin(0.08));
}

TEST_CASE("the noise of light grows with its square root above that of reading") {
    Sensor sensor;
    sensor.noise = 0.01;
    const auto deviation_of_light = [&](double light) {
        std::vector<double> lights;
        for (const std::uint16_t colour : developed(sensor, colour_of(static_cast<float>(light)), 50'000)) {
            lights.push_back(light_by_formula(colour / 65535.0));
        }
        return moments_of(lights).deviation;
    };
    const double grey_light = light_by_formula(0.5);
    const double of_grey = deviation_of_light(grey_light);
    for (const double share : {0.25, 2.0, 4.0}) {
        CAPTURE(share);
        CHECK(deviation_of_light(share * grey_light) / of_grey ==
              Approx(std::sqrt(15.0 / 16.0 * share + 1.0 / 16.0)).epsilon(0.02));
    }
}

TEST_CASE("noise has no ties between colours, neighbours, pictures and seeds") {
    Sensor sensor;
    sensor.noise = 0.01;
    constexpr std::size_t pixels = 60'000;
    const auto first = developed(sensor, grey, pixels, {0, 7});
    const auto channel = [&](const std::vector<std::uint16_t>& colours, std::size_t k, std::size_t begin) {
        std::vector<double> values;
        for (std::size_t i = begin; i < begin + pixels - 1000; ++i) { values.push_back(colours[3 * i + k]); }
        return values;
    };
    constexpr double most = 0.017; // four deviations of a correlation of that many
    const std::vector<double> red = channel(first, 0, 0);
    CHECK(std::abs(correlation(red, channel(first, 1, 0))) < most);
    CHECK(std::abs(correlation(red, channel(first, 2, 0))) < most);
    for (const std::size_t away : {1U, 2U, 64U, 128U, 640U}) {
        CAPTURE(away);
        CHECK(std::abs(correlation(red, channel(first, 0, away))) < most);
    }
    CHECK(std::abs(correlation(red, channel(developed(sensor, grey, pixels, {0, 8}), 0, 0))) < most);
    CHECK(std::abs(correlation(red, channel(developed(sensor, grey, pixels, {1, 7}), 0, 0))) < most);
    CHECK(developed(sensor, grey, pixels, {0, 7}) == first);
}

TEST_CASE("noise is the same on all processors") {
    Sensor sensor;
    sensor.noise = 0.05;
    const std::vector<std::uint16_t> colours = developed(sensor, grey, 4, {2, 9});
    CAPTURE(colours);
    CHECK(colours == std::vector<std::uint16_t>{
                         34942, 34613, 26362, 34878, 30397, 32270, 34815, 31392, 26444, 35992, 35321, 33854});
}

TEST_CASE("bytes are the nearest ones") {
    const std::vector<std::uint16_t> colours{0, 128, 129, 65535, 32767, 257};
    std::vector<std::uint8_t> bytes(colours.size());
    to_bytes(colours, bytes);
    CHECK(bytes == std::vector<std::uint8_t>{0, 0, 1, 255, 127, 1});
}

} // namespace octant::visuals::camera
