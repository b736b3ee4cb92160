#pragma once

#include "models/part_motion.h"
#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/aircraft_state.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/planning/rotor_discs.h"
#include "visuals/refine/mesh_creases.h"
#include "visuals/refine/mesh_textures.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/scene/camera_rig.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/shading/shaded_polygons.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// The mesh of a level of detail.
struct MeshSource {
    /// Triangles to be drawn, in body axes.
    const models::TriangleMesh* mesh = nullptr;
    /// The largest distance from a point of it to the original surface, and from a point of that to it.
    double error_m = 0.0;
};

/// A level of detail as drawn: a range of its model's index buffer.
struct MeshLevel {
    scene::IndexRange range;
    double error_m = 0.0;
    /// How its triangles are shaded.
    shading::ShadedPolygons shaded;
};

/// Appends a mesh to a model's buffers, with the textures of its materials: equal corners share a vertex, but the first
/// corner of each triangle has its own. Normals are the mesh's own where it has any, else by crease angle. Loading
/// work.
MeshLevel append_level(scene::ModelBuffers& buffers, const MeshSource& source);

/// The index of the representation to draw: the coarsest whose error is at most `max_m`, or else the finest.
/// `errors_m`: finest first, ascending. Hysteresis: `before`, the last one drawn (negative: none), stays while its
/// error is small enough and no coarser one's is by a margin.
int select_level(std::span<const double> errors_m, double max_m, int before);

/// The dials of a cockpit's model (body axes, from the pilot's eye): one in the first polygon of each part named
/// dial_speed, dial_altitude, dial_attitude, dial_heading or dial_load, as large as fits. These polygons lie ahead and
/// square to the x axis. The scales cover `limits`. Loading work.
overlay::InstrumentLayout dials_of(const models::polygons::PolygonModel& cockpit, const sim::AircraftLimits& limits);

/// Polygons of a list that are drawn alike, up to the first one of the next run. A polygon of RotorDisc::sides has a
/// run of its own.
struct OpacityRun {
    std::uint32_t first = 0; ///< place in the list
    float opacity = 1.0F;
    std::uint32_t disc = models::none; ///< index into AircraftModel::discs of the disc whose blades they are
    /// For each side whether it is RotorDisc::Side::polygon.
    std::array<bool, 2> has_side{};

    bool operator==(const OpacityRun&) const = default;
};

/// The transparent polygons of a mesh, in the model's index buffer as `order` lists them.
struct OrderedGlass {
    draworder::DrawOrder order;
    /// As AircraftModel::first_indices and AircraftModel::opacity_runs.
    std::vector<std::uint32_t> first_indices;
    std::vector<OpacityRun> opacity_runs;
};

/// A model as drawn. As polygons: the vertices of polygon after polygon, one a corner and one where another polygon's
/// corner lies on a side; one index buffer that holds the polygons of the order's flat list and, behind them, all
/// polygons in file order. As meshes, where it has levels of detail: behind both. Representation 0 .. n - 1 are the
/// mesh levels, finest first, or 0 the progressive mesh; the last one is the ordered polygons.
struct AircraftModel {
    /// The polygons of `order`.
    models::polygons::PolygonModel polygons;
    draworder::DrawOrder order;
    scene::ModelBuffers buffers;
    /// The index of the first vertex of each polygon, and the end of the last one's.
    std::vector<std::uint32_t> first_vertices;
    /// For each of these vertices the polygon beyond the side that begins there, of the same part; models::none where
    /// there is none.
    std::vector<std::uint32_t> neighbours;
    /// The place in the index buffer at which each polygon of order.polygons() begins, and the end of the last one.
    std::vector<std::uint32_t> first_indices;
    scene::IndexRange file_order;
    /// The polygons that file_order draws, without repeats.
    std::vector<std::uint32_t> file_list;
    /// The bounds of polygons and meshes.
    AxisAlignedBox hull;
    scene::Subject subject;
    /// How the polygons are shaded.
    shading::ShadedPolygons shaded;
    /// Levels of detail, finest first; often none.
    std::vector<MeshLevel> levels;
    /// Instead of levels: a mesh that is refined in each frame. Body axes.
    std::shared_ptr<const refine::ProgressiveMesh> progressive;
    /// The pictures on the progressive mesh; null where there are none. They come first in ModelBuffers::textures.
    std::shared_ptr<const refine::MeshTextures> progressive_textures;
    /// One for each representation.
    std::vector<double> errors_m;
    /// With a progressive mesh: the triangles of turning parts, which turn by the pivots of the polygons, without the
    /// blades of discs, which follow them. All have polygon number 0: all are smooth, or all are flat.
    scene::IndexRange turning{};
    /// Of the polygons of order.polygons(); empty where all are opaque and none is a blade of a disc.
    std::vector<OpacityRun> opacity_runs{};
    /// With levels or a progressive mesh: the transparent surfaces of the finest mesh, which are blended over all
    /// others. All have polygon number 0.
    std::optional<OrderedGlass> glass{};
    /// Of the progressive mesh; null where each vertex has one normal.
    std::shared_ptr<const refine::MeshCreases> creases = {};
    /// How controls move the parts of the turning triangles: first those of the pivots, then further parts; those at
    /// the end that nothing moves are missing. Body axes.
    std::vector<models::PartMoves> moves = {};
    std::vector<RotorDisc> discs = {};
    /// For each polygon the index of the disc whose blade it is, models::none for the others; empty without discs.
    std::vector<std::uint32_t> disc_of_polygon = {};

    /// The number of matrices that place the model: of the body, the pivots and the further parts.
    std::size_t part_count() const { return 1 + std::max(polygons.pivots.size(), moves.size()); }

    /// The number of indices of a polygon.
    std::uint32_t index_count_of(std::uint32_t polygon) const {
        return 3 * (first_vertices[polygon + 1] - first_vertices[polygon] - 2);
    }

    /// The number of the representation by polygons.
    std::size_t polygon_representation() const { return errors_m.size() - 1; }

    /// The shaded polygons of a level of detail, or of the ordered polygons.
    const shading::ShadedPolygons& shaded_as(std::size_t representation) const {
        return representation < levels.size() ? levels[representation].shaded : shaded;
    }
};

/// Makes the buffers of a model. `pilot_eye_m`: body axes. `normals`: for smooth shading, one for each corner; empty =
/// by crease angle, which needs polygons that are not split. Loading work.
AircraftModel aircraft_model(models::polygons::PolygonModel polygons, draworder::DrawOrder order,
    const glm::dvec3& pilot_eye_m, std::vector<glm::vec3> normals = {});

/// Adds levels of detail, finest first. `polygons_error_m`: the error of the ordered polygons, the coarsest
/// representation. Errors must ascend (asserted). Loading work.
void add_levels(AircraftModel& model, std::span<const MeshSource> sources, double polygons_error_m);

/// Adds a mesh that is refined in each frame, before any other mesh of the model (asserted), with the pictures on it
/// (null: none). Far away, where `polygons_error_m` is small enough, the ordered polygons are drawn. Loading work.
void add_progressive(AircraftModel& model, std::shared_ptr<const refine::ProgressiveMesh> mesh, double polygons_error_m,
    std::shared_ptr<const refine::MeshTextures> textures = {});

/// A part of a mesh aircraft that turns by a pivot of its polygons, or that its controls move, or both.
struct MovingPartMesh {
    /// The part at time 0 and at rest, in body axes.
    const models::TriangleMesh* mesh = nullptr;
    /// Index into PolygonModel::pivots; nothing for a part that does not turn by time.
    std::optional<std::uint32_t> pivot;
    models::PartMoves moves = {};
};

/// Adds moving parts to a model with a progressive mesh. Loading work.
void add_moving_parts(AircraftModel& model, std::span<const MovingPartMesh> parts);

/// Adds transparent polygons, in body axes, and their painting order to a model with meshes. `normals`: one for each
/// corner. Loading work.
void add_glass(AircraftModel& model, const models::polygons::PolygonModel& glass, draworder::DrawOrder order,
    std::vector<glm::vec3> normals);

/// The depth of the lowest corner of an upright model below its reference point, metres, with turning parts as at time
/// 0. Loading work.
double reach_below_m(const AircraftModel& model);

/// An assumed pilot's eye for a model that names none, body axes: a quarter of the length behind the nose at the height
/// of the top.
glm::dvec3 pilot_eye_m(const models::polygons::PolygonModel& model);

/// The colours of smooth and of flat polygons under ModelDisplay::Shading.
inline constexpr scene::PolygonTints shading_tints{.smooth = 0xffe6a050U, .flat = 0xff3090ffU};

/// The colour, as ColourVertex::colour, of a surface with that error under ModelDisplay::Levels. `radius_m`: of the
/// whole model.
std::uint32_t level_colour(double error_m, double radius_m);

} // namespace octant::visuals::planning
