#include "visuals/planning/smooth_choice.h"

#include "visuals/planning/refined_aircraft.h"
#include "visuals/shading/shading_rule.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace octant::visuals::planning {

namespace {

constexpr std::size_t word_bits = 32;

/// An aircraft nearer than this many radii weighs no more.
constexpr double nearest_radii = 1.0;

std::size_t mask_words_for(const AircraftModel& model) {
    std::size_t max_polygons = 0;
    for (std::size_t as = 0; as <= model.levels.size(); ++as) {
        max_polygons = std::max(max_polygons, model.shaded_as(as).size());
    }
    return max_polygons / word_bits + 1;
}

double distance_m(const PlacedAircraft& aircraft) { return glm::length(glm::dvec3(aircraft.parts[0][3])); }

/// Those that may be flat or smooth.
int polygons_of(const PlacedAircraft& aircraft) {
    return is_refined(aircraft) ? aircraft.polygon_count
                                : static_cast<int>(aircraft.model->shaded_as(aircraft.representation).size());
}

/// Whether some polygons may be smooth while others are not.
bool chooses_by(const scene::ShadingSettings& settings, bool follows_clock) {
    return settings.kind == scene::AircraftShading::Hybrid &&
           (settings.smooth_share < 1.0 || settings.device_ratio || follows_clock ||
               settings.rule == scene::HybridRule::Paper);
}

/// The light of the sun on an aircraft, in its body axes.
shading::ShadingLight illumination(const PlacedAircraft& aircraft, const glm::dvec3& to_sun, const glm::vec2& light) {
    shading::ShadingLight sun;
    sun.to_light = glm::vec3(to_sun * glm::dmat3(aircraft.parts[0]));
    sun.ambient = light.x;
    sun.diffuse = light.y;
    sun.specular = 0.0F;
    return sun;
}

/// About the solid angle under which an aircraft is seen.
double weight_of(const PlacedAircraft& aircraft) {
    const double radius_m = aircraft.model->subject.radius_m;
    const double sine = radius_m / std::max(distance_m(aircraft), nearest_radii * radius_m);
    return sine * sine;
}

} // namespace

void distribute_smooth(std::span<const SmoothCandidate> aircraft, int smooth, std::span<int> assigned) {
    assert(assigned.size() == aircraft.size());
    std::ranges::fill(assigned, 0);
    int left = smooth;
    bool filled = true; // Some aircraft has got all its polygons; the others share the rest.
    while (left > 0 && filled) {
        double weight = 0.0;
        for (std::size_t i = 0; i < aircraft.size(); ++i) {
            weight += assigned[i] < aircraft[i].polygons ? aircraft[i].weight : 0.0;
        }
        filled = false;
        const int to_share = left;
        for (std::size_t i = 0; i < aircraft.size() && weight > 0.0; ++i) {
            const int room = aircraft[i].polygons - assigned[i];
            const double part = to_share * (aircraft[i].weight / weight);
            filled = filled || (room > 0 && part >= room);
            const int more = static_cast<int>(std::min<double>(room, part));
            assigned[i] += more;
            left -= more;
        }
    }
    for (std::size_t i = 0; i < aircraft.size() && left > 0; ++i) { // what rounding left over
        const int more = std::min(left, aircraft[i].polygons - assigned[i]);
        assigned[i] += more;
        left -= more;
    }
}

SmoothChoice::SmoothChoice(const scene::ShadingSettings& settings, bool follows_clock, std::span<PlacedAircraft> placed)
    : settings_(settings), selects_(chooses_by(settings, follows_clock)), selectors_(placed.size()),
      shares_(placed.size()), assigned_(placed.size()) {
    std::size_t words = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const AircraftModel& model = *placed[i].model;
        placed[i].first_smooth = static_cast<std::uint32_t>(words);
        std::size_t needed = mask_words_for(model);
        for (std::size_t as = 0; selects_ && as <= model.levels.size(); ++as) {
            selectors_[i].emplace_back(model.shaded_as(as), shading_rule_of(settings));
        }
        if (placed[i].far_model != nullptr) {
            needed = std::max(needed, mask_words_for(*placed[i].far_model));
            if (selects_) { selectors_[i].emplace_back(placed[i].far_model->shaded, shading_rule_of(settings)); }
        }
        words += needed;
    }
    bits_.assign(words + 1, settings.kind == scene::AircraftShading::Flat ? 0U : ~0U);
    bits_.push_back(1);
}

/// Fills in assigned_; returns the sum of the polygons.
int SmoothChoice::smooth_count_for(std::span<const PlacedAircraft> placed, const SmoothTarget& smooth_target) {
    int all = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        shares_[i] = {polygons_of(placed[i]), weight_of(placed[i])};
        all += shares_[i].polygons;
    }
    const double share = smooth_target.share.value_or(settings_.smooth_share);
    int wanted = static_cast<int>(std::lround(share * all));
    if (settings_.device_ratio && !smooth_target.share) {
        wanted = shading::device_smooth_count(*settings_.device_ratio, all);
    }
    wanted = std::min(smooth_target.polygons.value_or(wanted), all);
    distribute_smooth(shares_, wanted, assigned_);
    if (settings_.rule == scene::HybridRule::Paper) {
        const shading::ShadingRange range{settings_.near_m, settings_.far_m};
        for (std::size_t i = 0; i < placed.size(); ++i) {
            assigned_[i] =
                std::min(assigned_[i], shading::smooth_count(distance_m(placed[i]), range, shares_[i].polygons));
        }
    }
    return all;
}

SmoothChoice::Count SmoothChoice::choose(std::span<const PlacedAircraft> placed,
    std::span<const std::unique_ptr<RefinedAircraft>> refined, const SmoothTarget& smooth_target,
    const glm::dvec3& to_sun, const glm::vec2& light, std::vector<std::uint32_t>& smooth) {
    Count count{smooth_count_for(placed, smooth_target), 0};
    for (std::size_t i = 0; i < placed.size(); ++i) {
        int assigned = settings_.kind == scene::AircraftShading::Flat ? 0 : shares_[i].polygons;
        const shading::ShadingLight sun = illumination(placed[i], to_sun, light);
        const glm::dvec3 eye_m = -glm::dvec3(placed[i].parts[0][3]) * glm::dmat3(placed[i].parts[0]);
        if (selects_) { assigned = assigned_[i]; }
        if (is_refined(placed[i])) {
            refined[i]->shade(eye_m, sun, assigned);
        } else if (selects_) {
            write_bits(placed[i], selector_of(i, placed[i]).choose(eye_m, sun, assigned));
        }
        count.smooth += assigned;
    }
    smooth.assign(bits_.begin(), bits_.end());
    return count;
}

shading::ShadingSelector& SmoothChoice::selector_of(std::size_t aircraft, const PlacedAircraft& placed) {
    const std::size_t polygons = placed.near_model->levels.size();
    const std::size_t as_it_is = is_mesh(placed) ? placed.representation : polygons;
    return selectors_[aircraft][is_far(placed) ? polygons + 1 : as_it_is];
}

void SmoothChoice::write_bits(const PlacedAircraft& aircraft, const shading::ShadingChoice& choice) {
    for (std::size_t first = 0; first < choice.smooth.size(); first += word_bits) {
        const auto part = choice.smooth.subspan(first, std::min(word_bits, choice.smooth.size() - first));
        std::uint32_t word = 0;
        for (std::size_t i = 0; i < part.size(); ++i) { word |= std::uint32_t{part[i]} << i; }
        bits_[aircraft.first_smooth + first / word_bits] = word;
    }
}

} // namespace octant::visuals::planning
