#pragma once

#include "ui/studies/hybrid_shading/shading_models.h"
#include "visuals/shading/intensity.h"
#include "visuals/shading/shading_rule.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

/// A way to choose the smooth polygons.
struct StudiedRule {
    const char* name;
    visuals::shading::ShadingRule rule;
    bool facing_only = false; ///< as if polygons that face away were not there
};

inline constexpr std::array studied_rules{
    StudiedRule{"random", visuals::shading::ShadingRule::Random},
    StudiedRule{"paper", visuals::shading::ShadingRule::Paper},
    StudiedRule{"paper, facing only", visuals::shading::ShadingRule::Paper, true},
    StudiedRule{"error (ours)", visuals::shading::ShadingRule::Error}};
inline constexpr std::size_t random_rule = 0; ///< indices into studied_rules
inline constexpr std::size_t paper_rule = 1;
inline constexpr std::size_t facing_rule = 2;
inline constexpr std::size_t error_rule = 3;
inline constexpr int share_step_percent = 10;
inline constexpr std::size_t share_steps = 100 / share_step_percent + 1;

/// Beyond this, a hundred thousandth of white, a picture counts as the same.
inline constexpr double exact_db = 100.0;

/// Pictures of one share of smooth polygons against a reference.
struct ShareQuality {
    std::vector<double> mean_square; ///< by view
    double similarity = 0.0;         ///< mean of the views

    /// Of the mean square over all views.
    double psnr_db() const;
};

/// One rule: by share, 0 % first.
struct RuleQuality {
    std::array<ShareQuality, share_steps> to_gouraud;   ///< reference: all smooth
    std::array<ShareQuality, share_steps> to_per_pixel; ///< reference: Phong's shading
};

struct ShadingRun {
    std::string name;
    std::size_t polygons = 0;
    double facing_share = 0.0; ///< of the polygons, towards the eye; mean of the views
    std::array<RuleQuality, studied_rules.size()> rules;
};

/// The light of the study, from above and one side.
visuals::shading::ShadingLight study_light();

/// Eight eyes around a model, three times its radius from its middle, above and below.
std::vector<glm::dvec3> study_eyes(const visuals::shading::ShadedPolygons& polygons);

/// Polygons that a rule makes smooth for one eye, nothing remembered. `share` is of all polygons;
/// fewer where only facing ones count and there are no more.
std::vector<std::uint8_t> smooth_polygons(
    const visuals::shading::ShadedPolygons& polygons,
    const StudiedRule& rule,
    const glm::dvec3& eye_m,
    double share,
    std::uint64_t seed = 1);

/// All rules and shares. Random is the mean of several seeds. `tick`: called after each view.
ShadingRun run_shading(const ShadedModel& model, int size_px, const std::function<void()>& tick);

} // namespace octant::ui::studies::hybrid_shading
