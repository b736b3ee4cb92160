#include "ui/studies/hybrid_shading/shading_runs.h"

#include "sim/base/units.h"
#include "ui/studies/picture_quality.h"
#include "ui/studies/shading_pictures.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numeric>

namespace octant::ui::studies::hybrid_shading {

namespace shading = visuals::shading;

namespace {

constexpr int views = 8;
constexpr std::uint64_t random_seeds = 4;
constexpr double distance_radii = 3.0;

/// What pictures of one view are compared with.
struct References {
    LightPicture gouraud;
    LightPicture per_pixel;
};

void compare(
    const LightPicture& picture,
    const LightPicture& reference,
    const ShadingPictures& pictures,
    double weight,
    ShareQuality& quality) {
    quality.mean_square.back() +=
        weight * mean_square_error(picture, reference, pictures.covered());
    quality.similarity +=
        weight / views * structural_similarity(picture, reference, pictures.covered());
}

void run_rule(
    const ShadedModel& model,
    const StudiedRule& rule,
    const glm::dvec3& eye_m,
    const ShadingPictures& pictures,
    const References& references,
    RuleQuality& quality) {
    const std::uint64_t seeds = rule.rule == shading::ShadingRule::Random ? random_seeds : 1;
    for (std::size_t step = 0; step < share_steps; ++step) {
        quality.to_gouraud[step].mean_square.push_back(0.0);
        quality.to_per_pixel[step].mean_square.push_back(0.0);
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const double share = static_cast<double>(step) / (share_steps - 1);
            const LightPicture picture =
                pictures.hybrid(smooth_polygons(model.polygons, rule, eye_m, share, seed));
            const double weight = 1.0 / static_cast<double>(seeds);
            compare(picture, references.gouraud, pictures, weight, quality.to_gouraud[step]);
            compare(picture, references.per_pixel, pictures, weight, quality.to_per_pixel[step]);
        }
    }
}

std::vector<std::uint8_t>
facing_polygons(const shading::ShadedPolygons& polygons, const glm::dvec3& eye_m) {
    std::vector<std::uint8_t> facing;
    for (const shading::ShadedPolygon& polygon : polygons.polygons) {
        const glm::vec3 to_eye_m = glm::vec3(eye_m) - polygon.centre_m;
        facing.push_back(glm::dot(polygon.normal, to_eye_m) > 0.0F ? 1 : 0);
    }
    return facing;
}

/// How many must be smooth so that `count` of them face the eye; all where fewer do. More smooth
/// ones keep those that fewer have.
int count_with_facing(
    shading::ShadingSelector& selector,
    const std::vector<std::uint8_t>& facing,
    const glm::dvec3& eye_m,
    int count) {
    int least = count;
    int most = static_cast<int>(facing.size());
    while (least < most) {
        const int middle = std::midpoint(least, most);
        const auto smooth = selector.choose(eye_m, study_light(), middle).smooth;
        if (std::inner_product(smooth.begin(), smooth.end(), facing.begin(), 0) < count) {
            least = middle + 1;
        } else {
            most = middle;
        }
    }
    return least;
}

} // namespace

double ShareQuality::psnr_db() const {
    const double sum = std::accumulate(mean_square.begin(), mean_square.end(), 0.0);
    return ui::studies::psnr_db(sum / static_cast<double>(mean_square.size()));
}

shading::ShadingLight study_light() {
    shading::ShadingLight light;
    light.ambient = 0.2F;
    light.diffuse = 0.7F;
    light.to_light = glm::normalize(glm::vec3(0.4F, 0.5F, -0.75F));
    return light;
}

std::vector<glm::dvec3> study_eyes(const shading::ShadedPolygons& polygons) {
    constexpr std::array elevations_deg{25.0, 60.0, 5.0, -30.0};
    std::vector<glm::dvec3> eyes_m;
    for (std::size_t i = 0; i < views; ++i) {
        const double azimuth_rad = 2.0 * pi * (static_cast<double>(i) + 0.3) / views;
        const double elevation_rad = rad_from_deg(elevations_deg[i % elevations_deg.size()]);
        eyes_m.push_back(
            glm::dvec3(polygons.centre_m) + distance_radii * polygons.radius_m *
                                                glm::dvec3(
                                                    std::cos(elevation_rad) * std::cos(azimuth_rad),
                                                    std::cos(elevation_rad) * std::sin(azimuth_rad),
                                                    -std::sin(elevation_rad)));
    }
    return eyes_m;
}

std::vector<std::uint8_t> smooth_polygons(
    const shading::ShadedPolygons& polygons,
    const StudiedRule& rule,
    const glm::dvec3& eye_m,
    double share,
    std::uint64_t seed) {
    shading::ShadingRuleSettings settings = shading::without_hysteresis(rule.rule);
    settings.seed = seed;
    shading::ShadingSelector selector(polygons, settings);
    auto count = static_cast<int>(std::lround(share * static_cast<double>(polygons.size())));
    if (rule.facing_only) {
        count = count_with_facing(selector, facing_polygons(polygons, eye_m), eye_m, count);
    }
    const auto smooth = selector.choose(eye_m, study_light(), count).smooth;
    return {smooth.begin(), smooth.end()};
}

ShadingRun run_shading(const ShadedModel& model, int size_px, const std::function<void()>& tick) {
    ShadingRun run;
    run.name = model.name;
    run.polygons = model.polygons.size();
    for (const glm::dvec3& eye_m : study_eyes(model.polygons)) {
        const ShadingPictures pictures(model.polygons, study_light(), eye_m, size_px);
        const std::vector<std::uint8_t> all(model.polygons.size(), 1);
        const References references{pictures.hybrid(all), pictures.per_pixel()};
        const auto facing = facing_polygons(model.polygons, eye_m);
        run.facing_share += std::accumulate(facing.begin(), facing.end(), 0.0) /
                            static_cast<double>(facing.size()) / views;
        for (std::size_t rule = 0; rule < studied_rules.size(); ++rule) {
            run_rule(model, studied_rules[rule], eye_m, pictures, references, run.rules[rule]);
        }
        tick();
    }
    return run;
}

} // namespace octant::ui::studies::hybrid_shading
