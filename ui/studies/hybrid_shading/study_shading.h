#pragma once

#include "models/triangle_mesh.h"
#include "ui/studies/study.h"
#include "visuals/shading/shaded_polygons.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace octant::ui::studies::hybrid_shading {

/// A model of the shading study.
struct ShadedModel {
    std::string name;
    visuals::shading::ShadedPolygons polygons;
};

/// A closed dented ball of `rings` x `slices` cells, two triangles each (one at its ends), whose cells are up to some
/// hundred times as large in one place as in another.
models::TriangleMesh uneven_ball(int rings, int slices);

/// The paper's torus in its 416 triangles, that of this program in 416 quads, f15, 500md, an uneven ball of 9,118
/// triangles; mesh files (`more`), each as it is and refined for one eye. Throws Error.
std::vector<ShadedModel> shading_models(const std::vector<std::filesystem::path>& more);

inline constexpr std::size_t random_rule = 0; ///< indices into ShadingRun::rules
inline constexpr std::size_t paper_rule = 1;
inline constexpr std::size_t facing_rule = 2; ///< the paper's, as if polygons that face away were not there
inline constexpr std::size_t error_rule = 3;
inline constexpr int share_step_percent = 10;
inline constexpr std::size_t share_steps = 100 / share_step_percent + 1;

/// Pictures of one share of smooth polygons against a reference.
struct ShareQuality {
    std::vector<double> mean_square; ///< by view
    double similarity = 0.0;         ///< mean of the views

    /// Of the mean square over all views.
    double psnr_db() const;
};

/// One rule: by share, 0 % first.
struct RuleQuality {
    const char* name = "";
    std::array<ShareQuality, share_steps> to_gouraud;   ///< reference: all smooth
    std::array<ShareQuality, share_steps> to_per_pixel; ///< reference: Phong's shading
};

struct ShadingRun {
    std::string name;
    std::size_t polygons = 0;
    double facing_share = 0.0; ///< of the polygons, towards the eye; mean of the views
    std::vector<RuleQuality> rules;
};

/// All rules and shares. Random is the mean of several seeds. `tick`: called after each view.
ShadingRun run_shading(const ShadedModel& model, int size_px, const std::function<void()>& tick);

/// `jobs`: models at once; flights for frame times are always one at a time.
struct ShadingStudyOptions : StudyOptions {
    std::vector<std::filesystem::path> meshes; ///< files, in addition to the models of its own
    int size_px = 320;                         ///< of the square pictures
    bool times = true;                         ///< fly too, for frame times
};

/// What H. Kim and H. Park's hybrid of flat and Gouraud shading (2008) shows: its operation counts, and how near to all
/// Gouraud and to shading each pixel it comes when 0 to 100 % of the polygons are smooth, chosen at random, by the
/// paper's rule and by the error in the picture; and how the share follows frame times. Prints the tables and writes
/// them to `out` as CSV and together as Markdown, curves as PNG, and a strip of pictures of each model. The same
/// options give the same bytes but for frame times. Throws Error.
void study_shading(const ShadingStudyOptions& options);

} // namespace octant::ui::studies::hybrid_shading
