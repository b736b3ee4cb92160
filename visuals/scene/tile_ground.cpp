#include "sim/base/units.h"
#include "visuals/scene/ground.h"
#include "visuals/scene/ground_mesher.h"
#include "visuals/scene/ground_palette.h"
#include "visuals/scene/vertex_colours.h"
#include "visuals/scene/worker.h"
#include "visuals/terrain/error_mesher.h"
#include "visuals/terrain/ground_prefetcher.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/ground_tiles.h"

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace octant::visuals::scene {

namespace {

constexpr double frames_ahead = 120.0;  ///< how far along the eye's way pages are asked for
constexpr double least_error_px = 0.25; ///< what is finer than this nobody sees

/// Tiles, in memory or mapped from a file, and the palette of their colours.
class TileGround final : public Ground {
public:
    TileGround(std::shared_ptr<const terrain::GroundTiles> tiles, const Settings& settings)
        : tiles_(std::move(tiles))
        , air_(settings.air)
        , mean_colour_(VertexColours(*tiles_, settings.air).mean()) {}

    const terrain::GroundTiles& tiles() const { return *tiles_; }

    const AirSettings& air() const { return air_; }

    std::optional<double> height_at(double x_m, double y_m) const override {
        return tiles_->height_at(x_m, y_m);
    }

    double spacing_m() const override { return tiles_->spacing_m(); }

    glm::dvec2 half_extent_m() const override { return tiles_->half_extent_m(); }

    double mean_height_m() const override { return static_cast<double>(tiles_->facts().mean_m); }

    glm::vec3 mean_colour() const override { return mean_colour_; }

    bool suits(const Settings& settings) const override {
        return ground_metric(settings.ground) == GroundMetric::ScreenError &&
               same_colours(settings.air, air_);
    }

    std::shared_ptr<const Ground> remade(const Settings& settings) const override {
        return ground_metric(settings.ground) == GroundMetric::ScreenError
                   ? std::make_shared<TileGround>(tiles_, settings)
                   : nullptr;
    }

    std::unique_ptr<GroundMesher> mesher(const Settings& settings) const override;

private:
    std::shared_ptr<const terrain::GroundTiles> tiles_;
    AirSettings air_;
    glm::vec3 mean_colour_;
};

/// Meshes by screen-space error with geomorphs, made ahead on a thread where that is asked for.
class TileMesher final : public GroundMesher {
public:
    TileMesher(std::shared_ptr<const TileGround> ground, const Settings& settings)
        : ground_(std::move(ground))
        , mesher_(ground_->tiles())
        , colours_(ground_->tiles(), ground_->air())
        , prefetcher_(ground_->tiles()) {
        follow(settings);
    }

    const Ground& ground() const override { return *ground_; }

    void follow(const Settings& settings) override {
        worker_.wait();
        prepared_.reset();
        order_ = settings.surface.hidden_surface == HiddenSurface::DepthBuffer
                     ? terrain::PaintOrder::FrontToBack
                     : terrain::PaintOrder::BackToFront;
        picture_height_px_ = settings.view.size_px.y;
        target_.error_px = settings.ground.error_px.value_or(least_error_px);
        target_.geomorphs = settings.ground.geomorphs;
        earth_radius_m_ = settings.ground.earth_curvature ? terrain::earth_radius_m : 0.0;
    }

    double earth_radius_m() const override { return earth_radius_m_; }

    void prepare(const GroundRequest& request) override {
        aim_at(request.triangle_target);
        prepared_ = view_of(request);
        worker_.begin([this] { make(*prepared_); });
    }

    TriangleDraw triangles(const GroundRequest& request, GroundCounts& counts) override {
        aim_at(request.triangle_target);
        worker_.wait();
        const terrain::MeshView view = view_of(request);
        if (prepared_ != view) {
            make(view);
        }
        prepared_.reset();
        const glm::dvec3& eye_m = request.camera.eye_m;
        const glm::dvec3 way_m = eye_m - last_eye_m_.value_or(eye_m);
        prefetcher_.go_to(glm::dvec2(eye_m + frames_ahead * way_m));
        last_eye_m_ = eye_m;
        counts = {mesh_.counters.triangles, mesh_.counters.fans, 0.0, mesh_.error_px};
        return {mesh_.vertices, mesh_.indices};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        mesher_.triangles_in(wanted, triangles);
    }

private:
    /// What has been prepared for another target is made anew.
    void aim_at(int triangles) {
        const int most = triangles >= unlimited_triangles ? terrain::any_triangles : triangles;
        if (most != target_.most_triangles) {
            worker_.wait();
            prepared_.reset();
            target_.most_triangles = most;
        }
    }

    void make(const terrain::MeshView& view) {
        const terrain::GroundMesh mesh = mesher_.mesh(view, target_);
        if (mesh.vertices.data() != mesh_.vertices.data()) {
            colours_.fill(mesher_.vertices(), mesh.origins);
            mesher_.measure_boxes();
        }
        mesh_ = mesh;
    }

    terrain::MeshView view_of(const GroundRequest& request) const {
        return {
            .eye_m = request.camera.eye_m,
            .frustum_normals = frustum_normals(request.camera, request.aspect),
            .order = order_,
            .focal_px = focal_px(request.camera, picture_height_px_),
            .earth_radius_m = earth_radius_m_};
    }

    std::shared_ptr<const TileGround> ground_;
    terrain::ErrorMesher mesher_;
    VertexColours colours_;
    terrain::PaintOrder order_ = terrain::PaintOrder::BackToFront;
    int picture_height_px_ = 0;
    terrain::ErrorTarget target_;
    double earth_radius_m_ = 0.0;
    terrain::GroundMesh mesh_;
    std::optional<terrain::MeshView> prepared_;
    std::optional<glm::dvec3> last_eye_m_;
    terrain::GroundPrefetcher prefetcher_;
    Worker worker_; ///< goes first: it uses the others
};

std::unique_ptr<GroundMesher> TileGround::mesher(const Settings& settings) const {
    assert(ground_metric(settings.ground) == GroundMetric::ScreenError);
    return std::make_unique<TileMesher>(
        std::static_pointer_cast<const TileGround>(shared_from_this()), settings);
}

} // namespace

std::shared_ptr<const Ground>
ground_from_tiles(terrain::GroundTiles ground, const Settings& settings) {
    return std::make_shared<TileGround>(
        std::make_shared<const terrain::GroundTiles>(std::move(ground)), settings);
}

} // namespace octant::visuals::scene
