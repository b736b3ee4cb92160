#pragma once

#include "models/polygons/polygon_model.h"
#include "models/triangle_mesh.h"
#include "sim/aircraft_state.h"
#include "visuals/draworder/draw_order.h"
#include "visuals/overlay/instrument_panel.h"
#include "visuals/planning/bounding_box.h"
#include "visuals/refine/progressive_mesh.h"
#include "visuals/scene/camera_rig.h"
#include "visuals/scene/frame_plan.h"
#include "visuals/shading/shaded_polygons.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace octant::visuals::planning {

/// A level of detail before it is made ready to be drawn.
struct MeshSource {
    /// Triangles to be drawn, in body axes.
    const models::TriangleMesh* mesh = nullptr;
    /// No point of it is farther than this from the original surface, nor the other way round.
    double error_m = 0.0;
};

/// A level of detail as drawn: a range of its model's index buffer.
struct MeshLevel {
    scene::IndexRange range;
    double error_m = 0.0;
    /// How its triangles are shaded.
    shading::ShadedPolygons shaded;
};

/// Appends a mesh to a model's buffers: corners that look the same share a vertex, but each triangle has a first corner
/// of its own. Normals are the mesh's own where it has any, else by crease angle. Loading work.
MeshLevel append_level(scene::ModelBuffers& buffers, const MeshSource& source);

/// Which of several representations, finest first, is drawn: the coarsest whose error is at most `max_m`, the finest
/// where none is. Hysteresis: `before`, the one drawn last (negative: none), is kept while it is good enough and no
/// coarser one is good enough by a margin. Errors rise, or stay.
int select_level(std::span<const double> errors_m, double max_m, int before);

/// The dials that a cockpit's model (body axes, from the pilot's eye) has room for: one where its first part named
/// dial_speed, dial_altitude, dial_attitude, dial_heading or dial_load begins, as large as fits into that polygon,
/// which lies ahead and square to the x axis. Scales hold what `limits` allow. Loading work.
overlay::InstrumentLayout dials_of(const models::polygons::PolygonModel& cockpit, const sim::AircraftLimits& limits);

/// A model as drawn. As polygons: the vertices of polygon after polygon, one a corner and one where another polygon's
/// corner lies on a side; one index buffer that holds the polygons of the order's flat list and, behind them, all
/// polygons in file order. As meshes, where it has levels of detail: behind both. Representation 0 .. n - 1 are the
/// mesh levels, finest first, or 0 the progressive mesh; the last one is the ordered polygons.
struct AircraftModel {
    /// The polygons that the order speaks of.
    models::polygons::PolygonModel polygons;
    draworder::DrawOrder order;
    scene::ModelBuffers buffers;
    /// Where the vertices of each polygon begin, and those of the last one end.
    std::vector<std::uint32_t> first_vertices;
    /// Where each polygon of order.polygons() begins in the index buffer, and the last one ends.
    std::vector<std::uint32_t> first_indices;
    scene::IndexRange file_order;
    /// The polygons that file_order draws, without repeats.
    std::vector<std::uint32_t> file_list;
    /// Holds polygons and meshes.
    AxisAlignedBox hull;
    scene::Subject subject;
    /// How the polygons are shaded.
    shading::ShadedPolygons shaded;
    /// Levels of detail, finest first; often none.
    std::vector<MeshLevel> levels;
    /// In place of levels: a mesh that is refined in each frame. Body axes.
    std::shared_ptr<const refine::ProgressiveMesh> progressive;
    /// One for each representation.
    std::vector<double> errors_m;
    /// With a progressive mesh: triangles of what turns beside it, by the pivots of the polygons. Their polygons have
    /// the number 0 each: all smooth, or all flat.
    scene::IndexRange turning{};
    /// With a progressive mesh: its transparent surfaces, which are blended over all others. Their polygons have the
    /// number 0 each.
    scene::IndexRange transparent{};
    /// How much of what is behind the transparent surfaces hide.
    float opacity = 1.0F;

    /// How many indices draw a polygon.
    std::uint32_t index_count_of(std::uint32_t polygon) const {
        return 3 * (first_vertices[polygon + 1] - first_vertices[polygon] - 2);
    }

    /// The number of the representation by polygons.
    std::size_t polygon_representation() const { return errors_m.size() - 1; }

    /// What is shaded where the aircraft is shown by this level of detail, or by its polygons.
    const shading::ShadedPolygons& shaded_as(std::size_t representation) const {
        return representation < levels.size() ? levels[representation].shaded : shaded;
    }
};

/// The part of a model's index buffer that holds a range of its order.
scene::IndexRange index_range(const AircraftModel& model, const draworder::DrawOrder::Range& range);

/// Makes a model ready to be drawn. `pilot_eye_m`: body axes. `normals`: one a corner, for smooth shading; empty = made
/// here by crease angle, for polygons that are whole. Loading work.
AircraftModel aircraft_model(models::polygons::PolygonModel polygons, draworder::DrawOrder order,
    const glm::dvec3& pilot_eye_m, std::vector<glm::vec3> normals = {});

/// Gives a model levels of detail, finest first, of which its polygons are the last one, wrong by `polygons_error_m`.
/// Errors must not fall (asserted). Loading work.
void add_levels(AircraftModel& model, std::span<const MeshSource> sources, double polygons_error_m);

/// Gives a model a mesh that is refined in each frame; far away, where `polygons_error_m` is little, it is drawn as its
/// polygons. Loading work.
void add_progressive(
    AircraftModel& model, std::shared_ptr<const refine::ProgressiveMesh> mesh, double polygons_error_m);

/// A part of a mesh aircraft that turns by a pivot of its polygons.
struct TurningPartMesh {
    /// The part as at the time 0, in body axes.
    const models::TriangleMesh* mesh = nullptr;
    /// Index into PolygonModel::pivots.
    std::uint32_t pivot = 0;
};

/// Gives a model with a progressive mesh the parts that turn beside it. Loading work.
void add_turning_parts(AircraftModel& model, std::span<const TurningPartMesh> parts);

/// Gives a model with a progressive mesh its transparent surfaces; body axes. Loading work.
void add_transparent(AircraftModel& model, const models::TriangleMesh& mesh, float opacity);

/// How far a model reaches below its reference point when it stands upright, metres; parts that turn as at the time 0.
/// Goes with the corners: to be asked once, at loading.
double reach_below_m(const AircraftModel& model);

/// Where a pilot's eye may be in an aircraft of which only the shape is known, body axes: a quarter of the length
/// behind the nose at the height of the top.
glm::dvec3 pilot_eye_m(const models::polygons::PolygonModel& model);

} // namespace octant::visuals::planning
