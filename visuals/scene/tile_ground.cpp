#include "sim/base/units.h"
#include "visuals/scene/ground.h"
#include "visuals/scene/vertex_colours.h"
#include "visuals/scene/worker.h"
#include "visuals/terrain/error_mesher.h"
#include "visuals/terrain/ground_prefetcher.h"
#include "visuals/terrain/ground_query.h"
#include "visuals/terrain/ground_tiles.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace octant::visuals::scene {

namespace {

constexpr double frames_ahead = 120.0;  ///< how far along the eye's way pages are asked for
constexpr double least_error_px = 0.25; ///< what is finer than this nobody sees

class TileGround final : public Ground {
public:
    TileGround(terrain::GroundTiles ground, const Settings& settings)
        : ground_(std::move(ground))
        , mesher_(ground_)
        , settings_(settings)
        , colours_(std::in_place, ground_, settings.air)
        , mean_colour_(colours_->mean())
        , prefetcher_(ground_) {
        follow(settings);
    }

    bool can_follow(const Settings& settings) const override {
        return ground_metric(settings.ground) == GroundMetric::ScreenError;
    }

    void follow(const Settings& settings) override {
        worker_.wait();
        prepared_.reset();
        if (!same_colours(settings.air, settings_.air)) {
            colours_.emplace(ground_, settings.air);
            mean_colour_ = colours_->mean();
            mesh_ = {};
        }
        settings_ = settings;
        order_ = settings.surface.hidden_surface == HiddenSurface::DepthBuffer
                     ? terrain::PaintOrder::FrontToBack
                     : terrain::PaintOrder::BackToFront;
        target_.error_px = settings.ground.error_px.value_or(least_error_px);
        target_.geomorphs = settings.ground.geomorphs;
        earth_radius_m_ = settings.ground.earth_curvature ? terrain::earth_radius_m : 0.0;
        set_triangle_target(triangle_target(settings));
    }

    std::optional<double> height_at(double x_m, double y_m) const override {
        return ground_.height_at(x_m, y_m);
    }

    double spacing_m() const override { return ground_.spacing_m(); }

    glm::dvec2 half_extent_m() const override { return ground_.half_extent_m(); }

    double mean_height_m() const override { return static_cast<double>(ground_.facts().mean_m); }

    glm::vec3 mean_colour() const override { return mean_colour_; }

    void settle(const Camera& /*camera*/, double /*aspect*/) override {}

    void set_triangle_target(int triangles) override {
        const int most = triangles >= unlimited_triangles ? terrain::any_triangles : triangles;
        if (most != target_.most_triangles) {
            worker_.wait();
            prepared_.reset();
            target_.most_triangles = most;
        }
    }

    double earth_radius_m() const override { return earth_radius_m_; }

    void prepare(const Camera& camera, double aspect) override {
        prepared_ = view_of(camera, aspect);
        worker_.begin([this] { make(*prepared_); });
    }

    TriangleDraw triangles(const Camera& camera, double aspect, GroundCounts& counts) override {
        worker_.wait();
        const terrain::MeshView view = view_of(camera, aspect);
        if (prepared_ != view) {
            make(view);
        }
        prepared_.reset();
        const glm::dvec3 way_m = camera.eye_m - last_eye_m_.value_or(camera.eye_m);
        prefetcher_.go_to(glm::dvec2(camera.eye_m + frames_ahead * way_m));
        last_eye_m_ = camera.eye_m;
        counts = {mesh_.counters.triangles, mesh_.counters.fans, 0.0, mesh_.error_px};
        return {mesh_.vertices, mesh_.indices};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        mesher_.triangles_in(wanted, triangles);
    }

private:
    void make(const terrain::MeshView& view) {
        const terrain::GroundMesh mesh = mesher_.mesh(view, target_);
        if (mesh.vertices.data() != mesh_.vertices.data()) {
            colours_->fill(mesher_.vertices(), mesh.origins);
            mesher_.measure_boxes();
        }
        mesh_ = mesh;
    }

    terrain::MeshView view_of(const Camera& camera, double aspect) const {
        return {
            .eye_m = camera.eye_m,
            .frustum_normals = frustum_normals(camera, aspect),
            .order = order_,
            .focal_px = focal_px(camera, settings_.view.size_px.y),
            .earth_radius_m = earth_radius_m_};
    }

    terrain::GroundTiles ground_;
    terrain::ErrorMesher mesher_;
    Settings settings_;
    std::optional<VertexColours> colours_;
    glm::vec3 mean_colour_;
    terrain::PaintOrder order_ = terrain::PaintOrder::BackToFront;
    terrain::ErrorTarget target_;
    double earth_radius_m_ = 0.0;
    terrain::GroundMesh mesh_;
    std::optional<terrain::MeshView> prepared_;
    std::optional<glm::dvec3> last_eye_m_;
    terrain::GroundPrefetcher prefetcher_;
    Worker worker_; ///< goes first: it uses the others
};

} // namespace

std::unique_ptr<Ground> ground_from_tiles(terrain::GroundTiles ground, const Settings& settings) {
    return std::make_unique<TileGround>(std::move(ground), settings);
}

} // namespace octant::visuals::scene
