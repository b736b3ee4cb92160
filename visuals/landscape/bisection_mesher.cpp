#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/bisection_ground.h"
#include "visuals/landscape/vertex_colours.h"
#include "visuals/landscape/background_task.h"
#include "visuals/nature/detailed_ground.h"
#include "visuals/roads/road_network.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/ground_prefetcher.h"
#include "visuals/terrain/ground_tiles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace octant::visuals::landscape {

namespace {

constexpr double prefetch_frames = 120.0;  ///< how far along the eye's way pages are asked for
constexpr double min_error_px = 0.25; ///< what is finer than this nobody sees
constexpr double default_triangles = 20000.0;

/// Meshes by screen-space error with geomorphs, made ahead on a thread where that is asked for.
class BisectionGroundMesher final : public GroundMesher {
public:
    BisectionGroundMesher(std::shared_ptr<const BisectionGround> ground, const MeshSettings& settings)
        : ground_(std::move(ground))
        , mesher_(ground_->tiles())
        , colours_(ground_->tiles(), ground_->air(), ground_->terrain_shadows())
        , detailed_ground_(nature::Scenery(
              -ground_->tiles().half_extent_m(),
              {ground_->tiles().columns(), ground_->tiles().rows()},
              ground_->tiles().spacing_m(),
              [this](int column, int row) { return scenery_density_at(column, row); }))
        , prefetcher_(ground_->tiles()) {
        detailed_ground_.scenery().set_daylight(daylight_of(ground_->air()));
        apply_settings(settings);
    }

    const Ground& ground() const override { return *ground_; }

    void apply_settings(const MeshSettings& settings) override {
        background_task_.wait();
        order_ = settings.is_front_to_back ? terrain::PaintOrder::FrontToBack
                                        : terrain::PaintOrder::BackToFront;
        picture_height_px_ = settings.picture_height_px;
        target_.error_px = settings.ground.error_px.value_or(min_error_px);
        target_.geomorphs = settings.ground.geomorphs;
        detail_ = {settings.ground.near_detail, settings.ground.scenery && !settings.has_texture};
        has_texture_ = settings.has_texture;
        use_roads(settings.ground.roads && !settings.has_texture);
        is_coloured_ = false;
        earth_radius_m_ = settings.ground.earth_curvature
                              ? ellipsoid_below(ground_->tiles().metadata().place).mean_radius_m()
                              : 0.0;
    }

    bool switch_ground(const std::shared_ptr<const Ground>& ground) override {
        auto moved = std::dynamic_pointer_cast<const BisectionGround>(ground);
        if (!moved || &moved->tiles() != &ground_->tiles()) {
            return false;
        }
        background_task_.wait();
        ground_ = std::move(moved);
        colours_.apply_settings(ground_->air(), ground_->terrain_shadows());
        use_roads(roads_ != nullptr);
        detailed_ground_.scenery().clear_cache();
        detailed_ground_.scenery().set_daylight(daylight_of(ground_->air()));
        is_coloured_ = false;
        return true;
    }

    double earth_radius_m() const override { return earth_radius_m_; }

    /// A second mesh ahead would take the memory of the one that is being drawn.
    void begin_next_mesh(const MeshRequest& request, const IdleThreadRunner& on_idle_thread) override {
        background_task_.wait();
        if (std::exchange(has_mesh_begun_, true)) {
            return;
        }
        set_target(request);
        next_mesh_view_ = view_of(request);
        background_task_.begin([this] { make(next_mesh_view_); }, on_idle_thread);
    }

    void wait() override { background_task_.wait(); }

    scene::TriangleDraw triangles(const MeshRequest& request, GroundCounts& counts) override {
        has_mesh_begun_ = false;
        background_task_.wait();
        set_target(request);
        make(view_of(request));
        const glm::dvec3& eye_m = request.camera.eye_m;
        const glm::dvec3 way_m = eye_m - last_eye_m_.value_or(eye_m);
        prefetcher_.prefetch_around(glm::dvec2(eye_m + prefetch_frames * way_m));
        last_eye_m_ = eye_m;
        counts = {
            static_cast<int>(drawn_mesh_.indices.size() / 3),
            mesh_.counters.fans,
            0.0,
            mesh_.error_px,
            static_cast<int>(drawn_mesh_.detail_triangles),
            static_cast<int>(drawn_mesh_.scenery_triangles)};
        return {drawn_mesh_.vertices, drawn_mesh_.indices};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        if (!adds_detail()) {
            mesher_.triangles_in(wanted, triangles);
            return;
        }
        const std::size_t first = triangles.size();
        const double moved_m = nature::max_offset_ratio * ground_->spacing_m();
        const glm::dvec3 below_m(0.0, 0.0, moved_m);
        const glm::dvec3 above_m(0.0, 0.0, moved_m + nature::Scenery::highest_m);
        mesher_.triangles_in(
            [&](const glm::dvec3& min_m, const glm::dvec3& max_m) {
                return wanted(min_m - below_m, max_m + above_m);
            },
            triangles);
        detailed_ground_.replace(triangles, first);
    }

private:
    /// Where things stand follows from where roads are.
    void use_roads(bool wanted) {
        std::shared_ptr<const roads::RoadNetwork> roads =
            wanted ? ground_->road_network() : nullptr;
        if (roads != roads_) {
            roads_ = std::move(roads);
            detailed_ground_.scenery().clear_cache();
        }
    }

    /// Nothing stands on a road, and more houses stand along it.
    nature::SceneryDensity scenery_density_at(int column, int row) const {
        constexpr double along_road_m = 90.0;
        constexpr float houses_along_road = 8.0F; ///< times as many
        if (!ground_->allows_scenery(column, row)) {
            return {};
        }
        nature::SceneryDensity scenery_density = colours_.scenery_density_of(column, row);
        const double spacing_m = ground_->spacing_m();
        const glm::dvec2 middle_m =
            (glm::dvec2(column, row) + 0.5) * spacing_m - ground_->half_extent_m();
        if (!roads_) {
            return scenery_density;
        }
        if (roads_->is_near(middle_m, spacing_m * 0.75 + roads::half_width_m)) {
            return {};
        }
        if (scenery_density.houses > 0.0F && roads_->is_near(middle_m, along_road_m + spacing_m)) {
            scenery_density.houses = std::min(houses_along_road * scenery_density.houses, 0.3F);
        }
        return scenery_density;
    }

    bool adds_detail() const { return detail_.has_subdivision || detail_.scenery; }

    /// Of the triangles that are aimed at, what detail may need is kept for it.
    void set_target(const MeshRequest& request) {
        const glm::dvec3& eye_m = request.camera.eye_m;
        near_view_.eye_m = eye_m;
        near_view_.spacing_m = ground_->spacing_m();
        near_view_.order = order_;
        std::ranges::transform(
            frustum_normals(request.camera, request.aspect),
            near_view_.frustum_normals.begin(),
            [](const glm::dvec3& normal) { return glm::vec3(normal); });
        const int triangles = request.triangle_target;
        const bool unlimited = triangles >= scene::unlimited_triangles;
        if (adds_detail()) {
            const double height_above_ground_m = eye_m.z - ground_->height_at(eye_m.x, eye_m.y).value_or(0.0);
            nature::apply_detail_budget(
                {unlimited ? std::nullopt : std::optional(triangles / default_triangles),
                 request.camera.vertical_fov_rad * request.aspect,
                 focal_px(request.camera, picture_height_px_),
                 std::max(height_above_ground_m, 0.0)},
                detail_,
                near_view_);
        }
        const int kept =
            adds_detail() ? static_cast<int>(near_view_.max_splits + near_view_.max_scenery_triangles) : 0;
        target_.max_triangles = unlimited ? terrain::any_triangles : std::max(triangles - kept, 1);
    }

    /// Does nothing where this mesh is the last one.
    void make(const terrain::MeshView& view) {
        const terrain::GroundMesh mesh = mesher_.mesh(view, target_);
        if (!is_coloured_ || mesh.vertices.data() != mesh_.vertices.data()) {
            is_coloured_ = false;
            colours_.fill(mesher_.vertices(), mesh.morphs);
            if (has_texture_) {
                for (models::ColourVertex& vertex : mesher_.vertices()) {
                    vertex.colour |= 0xff000000U; // all of its light is left
                }
            }
            is_coloured_ = true;
            mesher_.measure_boxes();
            show(mesh);
        }
        mesh_ = mesh;
    }

    void show(const terrain::GroundMesh& mesh) {
        drawn_mesh_ = {mesh.vertices, mesh.indices, 0, 0};
        if (adds_detail()) {
            drawn_mesh_ = detailed_ground_.detailed_mesh(mesh, near_view_, detail_, has_texture_ ? nullptr : &colour_at_point_);
        }
    }

    terrain::MeshView view_of(const MeshRequest& request) const {
        return {
            .eye_m = request.camera.eye_m,
            .frustum_normals = frustum_normals(request.camera, request.aspect),
            .order = order_,
            .focal_px = focal_px(request.camera, picture_height_px_),
            .ahead = view_direction(request.camera),
            .corner_cos = corner_cos(request.camera, request.aspect),
            .earth_radius_m = earth_radius_m_};
    }

    std::shared_ptr<const BisectionGround> ground_;
    terrain::BisectionMesher mesher_;
    VertexColours colours_;
    nature::DetailedGround detailed_ground_;
    nature::NearDetailOptions detail_;
    std::shared_ptr<const roads::RoadNetwork> roads_; ///< null: none are shown
    bool has_texture_ = false;
    nature::ColourAtPoint colour_at_point_ =
        [this](const glm::dvec2& place_m, const glm::vec3& from_eye_m) {
            return colours_.at(place_m, from_eye_m);
        };
    nature::NearDetailView near_view_;
    nature::DetailedGround::Triangles drawn_mesh_; ///< mesh_ with its detail
    terrain::PaintOrder order_ = terrain::PaintOrder::BackToFront;
    int picture_height_px_ = 0;
    terrain::ErrorTarget target_;
    double earth_radius_m_ = 0.0;
    terrain::GroundMesh mesh_;
    bool is_coloured_ = false;    ///< mesh_, in the ground's colours
    terrain::MeshView next_mesh_view_; ///< of the mesh that is made ahead
    bool has_mesh_begun_ = false;       ///< a mesh has been begun that nobody has asked for yet
    std::optional<glm::dvec3> last_eye_m_;
    terrain::GroundPrefetcher prefetcher_;
    BackgroundTask background_task_; ///< goes first: it uses the others
};

} // namespace

std::unique_ptr<GroundMesher>
bisection_mesher(std::shared_ptr<const BisectionGround> ground, const MeshSettings& settings) {
    return std::make_unique<BisectionGroundMesher>(std::move(ground), settings);
}

} // namespace octant::visuals::landscape
