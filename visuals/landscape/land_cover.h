#pragma once

#include "visuals/landscape/ground_point.h"
#include "visuals/nature/climate.h"
#include "visuals/scene/land_cover_contrast.h"

#include <glm/vec3.hpp>

#include <array>

namespace octant::visuals::landscape {

/// A place of ground before light falls on it.
struct SiteConditions {
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
    float patchiness;
    /// Share of the summer that fields and woods need: 0 where only heath grows.
    float summer_share = 1.0F;
};

/// What covers a place of temperate ground, shares 0..1.
struct LandCover {
    float below_tree_line = 0.0F;
    float farmland = 0.0F;
    float forest_share = 0.0F;
    float rock_share = 0.0F;
};

/// Smooth noise in [-1, 1] whose features are `cell_m` wide.
float patch_noise(float east_m, float north_m, float cell_m);

SiteConditions site_conditions(const TerrainPoint& point, float footprint_m, float water_m);

/// Site::summer of low ground in a climate.
float summer_share_of(const nature::Climate& climate);

/// The height at which temperate ground has what grows at a place's height in its climate.
float temperate_height_m(float height_m, const nature::Climate& climate);

/// How much of a place lies under snow: more on the shaded side, none where it is too steep to
/// hold.
float snow_share(const SiteConditions& site, const glm::vec3& normal, const nature::Climate& climate);

/// What covers a place whose height is what temperate_height_m() gives.
LandCover land_cover(const SiteConditions& site);

/// The colour of temperate ground before light falls on it, display values. The height of the place
/// is what temperate_height_m() gives.
glm::vec3 temperate_colour(const SiteConditions& site);

/// Share of desert ground that shrubs cover, 0..1.
float shrub_cover(const SiteConditions& site);

/// Own colour of desert ground, display values.
glm::vec3 arid_colour(const SiteConditions& site);

/// Own colour of ground on which nothing but this dust lies, display values: bare where it is
/// steep.
glm::vec3 dust_colour(const SiteConditions& site, const glm::vec3& dust);

constexpr glm::vec3 snow_colour(0.93F, 0.94F, 0.96F);

/// The covers of ground for scene::LandCoverContrast, by their numbers: woods or shrubs, meadows or
/// bare soil, rock and snow.
constexpr float woods_code = 64.0F;
constexpr float meadow_code = 128.0F;
constexpr float rock_code = 192.0F;
constexpr float snow_code = 255.0F;
std::array<scene::LandCover, scene::LandCoverContrast::covers> temperate_covers();
std::array<scene::LandCover, scene::LandCoverContrast::covers> arid_covers();
std::array<scene::LandCover, scene::LandCoverContrast::covers> dust_covers(const glm::vec3& dust);

/// What temperate_colour(), arid_colour() and dust_colour() are mixed of, as such a number; at least woods_code.
float temperate_cover_code(const SiteConditions& site);
float arid_cover_code(const SiteConditions& site);
float dust_cover_code(const SiteConditions& site);

} // namespace octant::visuals::landscape
