#include "ui/commands/terrain_options.h"

#include "ui/commands/value_option.h"
#include "ui/settings/path_fields.h"

namespace octant::ui::commands {

void add_terrain_options(std::vector<Option>& table, terrain::GroundViewOptions& options) {
    table.insert(table.end(), {required(text_option("terrain", "NAME|FILE",
                                  "hills, canyon, an imported ground, or maps that GDAL reads", options.terrain))});
    add_file_options(table, options.files);
}

namespace {

void add_file_rows(std::vector<Option>& table, double& spacing_m, std::optional<double>& height_scale,
    std::optional<std::string>& system, models::heights::VoidValues& voids, std::optional<std::string>& band) {
    table.insert(table.end(),
        {value_option({"terrain-spacing", "METRES", "sample spacing of files that do not say", 0.01, 1e5}, spacing_m),
            value_option(
                {"height-scale", "METRES", "metres a unit of heights, of files that name no unit [1]", 1e-6, 1e4},
                height_scale),
            value_option({"terrain-system", "SYSTEM",
                             "coordinate system of files that name none: EPSG:4326, a PROJ string, a .prj file or "
                             "metres [degrees: WGS 84; else metres]"},
                system),
            value_option(settings::void_info, voids), value_option(settings::band_info, band)});
}

} // namespace

void add_file_options(std::vector<Option>& table, models::heights::ImportOptions& files) {
    add_file_rows(table, files.spacing_m, files.height_scale, files.system, files.voids, files.band);
}

void add_file_options(std::vector<Option>& table, settings::PathSettings& path) {
    add_file_rows(table, path.terrain_spacing_m, path.terrain_height_scale, path.terrain_system, path.terrain_voids,
        path.terrain_band);
}

void add_view_options(std::vector<Option>& table, terrain::GroundViewOptions& options) {
    constexpr double far_m = 1e7;
    table.insert(table.end(),
        {value_option({"eye", "X,Y,Z", "eye point: metres east, north of the map centre, up from datum", -far_m, far_m},
             options.eye_m),
            value_option({"look", "X,Y,Z", "a point in the middle of the picture", -far_m, far_m}, options.look_m),
            value_option({"size", "WIDTHxHEIGHT", "picture size in pixels", 16, 16384}, options.size_px),
            value_option({"fov", "DEGREES", "vertical field of view", 0.1, 170.0}, options.fov_deg),
            curved_option(options.curved)});
}

void add_mesh_options(std::vector<Option>& table, terrain::GroundMeshOptions& options) {
    table.insert(table.end(),
        {value_option({"mesh", "KIND", "what decides: screen-error, midpoint or printed roughness"}, options.mesh),
            value_option({"fans", "KIND", "of midpoint and printed: partial or full"}, options.fans),
            value_option({"roughness-c", "C", "of midpoint and printed: weight of roughness [20; 5]", 0.0, 1e5},
                options.roughness_c),
            flag("--geomorphs,!--no-geomorphs",
                "vertices on their way as drawn in flight; else each at its own height [false]", options.geomorphs)});
}

void add_detail_options(std::vector<Option>& table, terrain::GroundMeshOptions& options) {
    table.insert(table.end(),
        {value_option({"error-px", "PIXELS", "refine to this error (screen-error)", 0.001, 1e4}, options.error_px),
            value_option({"triangles", "N", "refine to this many triangles", 1, 1e8}, options.triangles),
            value_option(
                {"resolution-c", "C", "refine to this C (midpoint, printed)", 1.0, 1e5}, options.resolution_c)});
}

Option curved_option(bool& curved) {
    return flag("--curved", "lower the ground by d^2 / 2R as it is in flight (screen-error meshes)", curved);
}

} // namespace octant::ui::commands
