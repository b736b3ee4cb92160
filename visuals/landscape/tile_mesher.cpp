#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/landscape/tile_ground.h"
#include "visuals/landscape/vertex_colours.h"
#include "visuals/landscape/worker.h"
#include "visuals/nature/near_ground.h"
#include "visuals/roads/road_network.h"
#include "visuals/terrain/error_mesher.h"
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

constexpr double frames_ahead = 120.0;  ///< how far along the eye's way pages are asked for
constexpr double min_error_px = 0.25; ///< what is finer than this nobody sees
constexpr double usual_triangles = 20000.0;

/// Meshes by screen-space error with geomorphs, made ahead on a thread where that is asked for.
class TileMesher final : public GroundMesher {
public:
    TileMesher(std::shared_ptr<const TileGround> ground, const MeshSettings& settings)
        : ground_(std::move(ground))
        , mesher_(ground_->tiles())
        , colours_(ground_->tiles(), ground_->air(), ground_->relief())
        , near_(nature::Scenery(
              -ground_->tiles().half_extent_m(),
              {ground_->tiles().columns(), ground_->tiles().rows()},
              ground_->tiles().spacing_m(),
              [this](int column, int row) { return growth_at(column, row); }))
        , prefetcher_(ground_->tiles()) {
        near_.scenery().light_by(daylight_of(ground_->air()));
        follow(settings);
    }

    const Ground& ground() const override { return *ground_; }

    void follow(const MeshSettings& settings) override {
        worker_.wait();
        order_ = settings.nearest_first ? terrain::PaintOrder::FrontToBack
                                        : terrain::PaintOrder::BackToFront;
        picture_height_px_ = settings.picture_height_px;
        target_.error_px = settings.ground.error_px.value_or(min_error_px);
        target_.geomorphs = settings.ground.geomorphs;
        detail_ = {settings.ground.near_detail, settings.ground.scenery && !settings.textured};
        textured_ = settings.textured;
        lead_roads(settings.ground.roads && !settings.textured);
        is_coloured_ = false;
        earth_radius_m_ = settings.ground.earth_curvature
                              ? ellipsoid_below(ground_->tiles().facts().place).mean_radius_m()
                              : 0.0;
    }

    bool move_to(const std::shared_ptr<const Ground>& ground) override {
        auto moved = std::dynamic_pointer_cast<const TileGround>(ground);
        if (!moved || &moved->tiles() != &ground_->tiles()) {
            return false;
        }
        worker_.wait();
        ground_ = std::move(moved);
        colours_.follow(ground_->air(), ground_->relief());
        lead_roads(roads_ != nullptr);
        near_.scenery().forget();
        near_.scenery().light_by(daylight_of(ground_->air()));
        is_coloured_ = false;
        return true;
    }

    double earth_radius_m() const override { return earth_radius_m_; }

    /// A second mesh ahead would take the memory of the one that is being drawn.
    void prepare(const GroundRequest& request, const Beside& beside) override {
        worker_.wait();
        if (std::exchange(is_ahead_, true)) {
            return;
        }
        aim_at(request);
        next_view_ = view_of(request);
        worker_.begin([this] { make(next_view_); }, beside);
    }

    void wait() override { worker_.wait(); }

    scene::TriangleDraw triangles(const GroundRequest& request, GroundCounts& counts) override {
        is_ahead_ = false;
        worker_.wait();
        aim_at(request);
        make(view_of(request));
        const glm::dvec3& eye_m = request.camera.eye_m;
        const glm::dvec3 way_m = eye_m - last_eye_m_.value_or(eye_m);
        prefetcher_.go_to(glm::dvec2(eye_m + frames_ahead * way_m));
        last_eye_m_ = eye_m;
        counts = {
            static_cast<int>(shown_.indices.size() / 3),
            mesh_.counters.fans,
            0.0,
            mesh_.error_px,
            static_cast<int>(shown_.fine),
            static_cast<int>(shown_.things)};
        return {shown_.vertices, shown_.indices};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        if (!has_detail()) {
            mesher_.triangles_in(wanted, triangles);
            return;
        }
        const std::size_t first = triangles.size();
        const double moved_m = nature::max_fine_move * ground_->spacing_m();
        const glm::dvec3 below_m(0.0, 0.0, moved_m);
        const glm::dvec3 above_m(0.0, 0.0, moved_m + nature::Scenery::highest_m);
        mesher_.triangles_in(
            [&](const glm::dvec3& min_m, const glm::dvec3& max_m) {
                return wanted(min_m - below_m, max_m + above_m);
            },
            triangles);
        near_.replace(triangles, first);
    }

private:
    /// Where things stand follows from where roads are.
    void lead_roads(bool wanted) {
        std::shared_ptr<const roads::RoadNetwork> roads =
            wanted ? ground_->road_network() : nullptr;
        if (roads != roads_) {
            roads_ = std::move(roads);
            near_.scenery().forget();
        }
    }

    /// Nothing stands on a road, and more houses stand along it.
    nature::Growth growth_at(int column, int row) const {
        constexpr double along_road_m = 90.0;
        constexpr float houses_along_road = 8.0F; ///< times as many
        if (!ground_->may_bear(column, row)) {
            return {};
        }
        nature::Growth growth = colours_.growth_of(column, row);
        const double spacing_m = ground_->spacing_m();
        const glm::dvec2 middle_m =
            (glm::dvec2(column, row) + 0.5) * spacing_m - ground_->half_extent_m();
        if (!roads_) {
            return growth;
        }
        if (roads_->is_near(middle_m, spacing_m * 0.75 + roads::half_width_m)) {
            return {};
        }
        if (growth.houses > 0.0F && roads_->is_near(middle_m, along_road_m + spacing_m)) {
            growth.houses = std::min(houses_along_road * growth.houses, 0.3F);
        }
        return growth;
    }

    bool has_detail() const { return detail_.fine_ground || detail_.scenery; }

    /// Of the triangles that are aimed at, what detail may need is kept for it.
    void aim_at(const GroundRequest& request) {
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
        if (has_detail()) {
            const double over_m = eye_m.z - ground_->height_at(eye_m.x, eye_m.y).value_or(0.0);
            nature::share_out_detail(
                {unlimited ? std::nullopt : std::optional(triangles / usual_triangles),
                 request.camera.vertical_fov_rad * request.aspect,
                 focal_px(request.camera, picture_height_px_),
                 std::max(over_m, 0.0)},
                detail_,
                near_view_);
        }
        const int kept =
            has_detail() ? static_cast<int>(near_view_.max_splits + near_view_.max_things) : 0;
        target_.max_triangles = unlimited ? terrain::any_triangles : std::max(triangles - kept, 1);
    }

    /// Does nothing where this mesh is the last one.
    void make(const terrain::MeshView& view) {
        const terrain::GroundMesh mesh = mesher_.mesh(view, target_);
        if (!is_coloured_ || mesh.vertices.data() != mesh_.vertices.data()) {
            is_coloured_ = false;
            colours_.fill(mesher_.vertices(), mesh.origins);
            if (textured_) {
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
        shown_ = {mesh.vertices, mesh.indices, 0, 0};
        if (has_detail()) {
            shown_ = near_.made(mesh, near_view_, detail_, textured_ ? nullptr : &place_colour_);
        }
    }

    terrain::MeshView view_of(const GroundRequest& request) const {
        return {
            .eye_m = request.camera.eye_m,
            .frustum_normals = frustum_normals(request.camera, request.aspect),
            .order = order_,
            .focal_px = focal_px(request.camera, picture_height_px_),
            .ahead = ahead_of(request.camera),
            .corner_cos = corner_cos(request.camera, request.aspect),
            .earth_radius_m = earth_radius_m_};
    }

    std::shared_ptr<const TileGround> ground_;
    terrain::ErrorMesher mesher_;
    VertexColours colours_;
    nature::NearGround near_;
    nature::NearDetail detail_;
    std::shared_ptr<const roads::RoadNetwork> roads_; ///< null: none are shown
    bool textured_ = false;
    nature::PlaceColour place_colour_ =
        [this](const glm::dvec2& place_m, const glm::vec3& from_eye_m) {
            return colours_.at(place_m, from_eye_m);
        };
    nature::FineView near_view_;
    nature::NearGround::Triangles shown_; ///< mesh_ with its detail
    terrain::PaintOrder order_ = terrain::PaintOrder::BackToFront;
    int picture_height_px_ = 0;
    terrain::ErrorTarget target_;
    double earth_radius_m_ = 0.0;
    terrain::GroundMesh mesh_;
    bool is_coloured_ = false;    ///< mesh_, in the ground's colours
    terrain::MeshView next_view_; ///< of the mesh that is made ahead
    bool is_ahead_ = false;       ///< a mesh has been begun that nobody has asked for yet
    std::optional<glm::dvec3> last_eye_m_;
    terrain::GroundPrefetcher prefetcher_;
    Worker worker_; ///< goes first: it uses the others
};

} // namespace

std::unique_ptr<GroundMesher>
tile_mesher(std::shared_ptr<const TileGround> ground, const MeshSettings& settings) {
    return std::make_unique<TileMesher>(std::move(ground), settings);
}

} // namespace octant::visuals::landscape
