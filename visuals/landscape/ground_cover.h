#pragma once

#include "visuals/landscape/ground_point.h"
#include "visuals/nature/climate.h"
#include "visuals/scene/cover_contrast.h"

#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::landscape {

/// A place of ground before light falls on it.
struct Site {
    /// East and north of the field's south-west corner.
    float east_m;
    float north_m;
    /// Above the water level.
    float height_m;
    /// 1 - cosine of the slope.
    float steepness;
    /// What is smaller is seen as its mean.
    float footprint_m;
    /// Noise in [-1, 1] with features of some hundred metres.
    float patches;
    /// Share of the summer that fields and woods need: 0 where only heath grows.
    float summer = 1.0F;
};

/// What covers a place of temperate ground, shares 0..1.
struct Cover {
    float below_trees = 0.0F;
    float farmed = 0.0F;
    float wooded = 0.0F;
    float bare = 0.0F;
};

/// Smooth noise in [-1, 1] whose features are `cell_m` wide.
float patch_noise(float east_m, float north_m, float cell_m);

Site site_of(const GroundPoint& point, float footprint_m, float water_m);

/// Site::summer of low ground in a climate.
float summer_of(const nature::Climate& climate);

/// The height at which temperate ground has what grows at a place's height in its climate.
float height_of_cover_m(float height_m, const nature::Climate& climate);

/// How much of a place lies under snow: more on the shaded side, none where it is too steep to
/// hold.
float snow_cover(const Site& site, const glm::vec3& normal, const nature::Climate& climate);

/// What covers a place whose height is what height_of_cover_m() gives.
Cover cover_of(const Site& site);

/// The colour of temperate ground before light falls on it, display values. The height of the place
/// is what height_of_cover_m() gives.
glm::vec3 temperate(const Site& site);

/// Share of desert ground that shrubs cover, 0..1.
float shrubs_of(const Site& site);

/// Own colour of desert ground, display values.
glm::vec3 arid(const Site& site);

/// Own colour of ground on which nothing but this dust lies, display values: bare where it is
/// steep.
glm::vec3 dusty(const Site& site, const glm::vec3& dust);

constexpr glm::vec3 snow_colour(0.93F, 0.94F, 0.96F);

/// The covers of ground for scene::CoverContrast, by their numbers: woods or shrubs, meadows or
/// bare soil, rock and snow.
constexpr float grown_number = 64.0F;
constexpr float level_number = 128.0F;
constexpr float rock_number = 192.0F;
constexpr float snow_number = 255.0F;
std::array<scene::Cover, scene::CoverContrast::covers> temperate_covers();
std::array<scene::Cover, scene::CoverContrast::covers> arid_covers();
std::array<scene::Cover, scene::CoverContrast::covers> dusty_covers(const glm::vec3& dust);

/// What temperate(), arid() and dusty() are mixed of, as such a number; at least grown_number.
float temperate_mixture(const Site& site);
float arid_mixture(const Site& site);
float dusty_mixture(const Site& site);

} // namespace octant::visuals::landscape
