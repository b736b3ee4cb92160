#include "sim/base/units.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/terrain/bisection_ground_builder.h"
#include "visuals/terrain/quadtree.h"
#include "visuals/terrain/quadtree_control.h"
#include "visuals/terrain/quadtree_mesher.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::landscape {

namespace {

constexpr double reference_fov_rad = rad_from_deg(45.0); ///< of the lens for which C is meant

bool is_same(const terrain::MeshView& a, const terrain::MeshView& b) {
    return a.eye_m == b.eye_m && a.frustum_normals == b.frustum_normals && a.magnification == b.magnification;
}

using FieldPointer = std::shared_ptr<const models::heights::HeightField>;
using RunwayPointer = std::shared_ptr<const models::heights::RunwayStrip>;

std::shared_ptr<const Ground> ground_over(
    FieldPointer field, const scene::GroundSettings& ground, const scene::AirSettings& air, RunwayPointer runway);

/// Heights, their quadtree and their colours.
class QuadtreeGround final : public Ground {
public:
    /// The tree is one of the field.
    QuadtreeGround(FieldPointer field, std::shared_ptr<const terrain::Quadtree> tree, const scene::AirSettings& air,
        RunwayPointer runway)
        : Ground(air, std::move(runway)), field_(std::move(field)), tree_(std::move(tree)),
          colours_(ground_colours(*field_, air)), mean_colour_(landscape::mean_colour(colours_)) {
        for (int row = 0; row < field_->rows(); ++row) {
            double sum_m = 0.0;
            for (int column = 0; column < field_->columns(); ++column) {
                sum_m += static_cast<double>(field_->height_m(column, row));
            }
            mean_height_m_ += sum_m / field_->columns() / field_->rows();
        }
    }

    const terrain::Quadtree& tree() const { return *tree_; }

    std::span<const std::uint32_t> colours() const { return colours_; }

    std::optional<double> height_at(double x_m, double y_m) const override { return field_->height_at(x_m, y_m); }

    double spacing_m() const override { return field_->spacing_m(); }

    glm::dvec2 half_extent_m() const override { return field_->half_extent_m(); }

    double mean_height_m() const override { return mean_height_m_; }

    glm::vec3 mean_colour() const override { return mean_colour_; }

    glm::vec3 colour_at(double x_m, double y_m, double footprint_m) const override {
        const GroundPalette palette(air(), climate_at(field_->place), nullptr);
        return nearest_colour(terrain::GroundSamples(*field_), palette, {x_m, y_m}, footprint_m);
    }

    std::optional<double> water_level_m() const override { return water_level_of(air(), climate_at(field_->place)); }

    std::optional<GroundTextureSource> source() const override {
        return GroundTextureSource{terrain::GroundSamples(*field_), models::heights::area_of(*field_), field_->place};
    }

    bool has_mesh_settings(const scene::GroundSettings& settings) const override {
        const terrain::QuadtreeOptions wanted = terrain::quadtree_options(settings.lod);
        return terrain::ground_metric(settings.lod) != terrain::GroundMetric::ScreenError &&
               wanted.roughness == tree_->options().roughness && wanted.propagation == tree_->options().propagation;
    }

    std::shared_ptr<const Ground> with_settings(
        const scene::GroundSettings& ground, const scene::AirSettings& air) const override {
        return has_mesh_settings(ground) ? std::make_shared<QuadtreeGround>(field_, tree_, air, runway())
                                         : ground_over(field_, ground, air, runway());
    }

private:
    std::unique_ptr<GroundMesher> make_mesher() const override;

    FieldPointer field_;
    std::shared_ptr<const terrain::Quadtree> tree_; ///< of that field
    std::vector<std::uint32_t> colours_;            ///< one a sample
    glm::vec3 mean_colour_;
    double mean_height_m_ = 0.0;
};

/// Meshes of the quadtree at a resolution C that holds the triangle count.
class QuadtreeGroundMesher final : public GroundMesher {
public:
    explicit QuadtreeGroundMesher(std::shared_ptr<const QuadtreeGround> ground)
        : ground_(std::move(ground)), mesher_(ground_->tree(), ground_->colours()) {}

    const Ground& ground() const override { return *ground_; }

    void apply_settings(const MeshSettings& settings) override {
        GroundMesher::apply_settings(settings);
        const scene::GroundSettings& ground = settings.ground;
        control_ = terrain::control_settings(ground.lod);
        exact_ = ground.lod.control == terrain::DetailControl::Exact;
        fixed_resolution_ = ground.lod.control == terrain::DetailControl::Fixed;
        first_resolution_ = ground.lod.resolution_c;
        order_ = settings.is_front_to_back ? terrain::PaintOrder::FrontToBack : terrain::PaintOrder::BackToFront;
        detail_ = terrain::quadtree_detail(ground.lod);
        if (fixed_resolution_ && first_resolution_ > 0.0) {
            state_ = terrain::initial_state(first_resolution_, control_);
        }
    }

    bool switch_ground(const std::shared_ptr<const Ground>& ground) override {
        auto moved = std::dynamic_pointer_cast<const QuadtreeGround>(ground);
        if (!moved || &moved->tree() != &ground_->tree()) { return false; }
        ground_ = std::move(moved);
        mesher_.set_colours(ground_->colours());
        return true;
    }

    void reset_detail(const MeshRequest& request) override {
        if (exact_) { return; }
        control_.target_triangles = request.triangle_target;
        const double resolution = first_resolution_ > 0.0
                                      ? first_resolution_
                                      : terrain::resolution_for_target(mesher_, view_of(request), detail_,
                                            control_.target_triangles, control_.max_resolution);
        state_ = terrain::initial_state(resolution, control_);
        last_view_.reset();
    }

    scene::TriangleDraw triangles(const MeshRequest& request, GroundCounts& counts) override {
        budget_.triangles = request.triangle_target;
        control_.target_triangles = request.triangle_target;
        const terrain::GroundMesh mesh = next_mesh(view_of(request));
        counts = {mesh.counters.triangles, mesh.counters.fans, mesh.resolution, mesh.error_px};
        return {mesh.vertices, mesh.indices};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        mesher_.triangles_in(wanted, triangles);
    }

private:
    terrain::GroundMesh next_mesh(const terrain::MeshView& view) {
        if (exact_) { return mesher_.mesh_within(view, detail_, budget_); }
        if (fixed_resolution_) {
            detail_.resolution = state_.resolution;
            return mesher_.mesh(view, detail_);
        }
        const bool same_view = last_view_ && is_same(*last_view_, view);
        last_view_ = view;
        terrain::controlled_mesh(state_, control_, same_view, [&](double resolution) {
            detail_.resolution = resolution;
            return mesher_.count(view, detail_);
        });
        return mesher_.counted_mesh();
    }

    terrain::MeshView view_of(const MeshRequest& request) const {
        const scene::Camera& camera = request.camera;
        const double zoom = std::tan(reference_fov_rad / 2.0) / std::tan(camera.vertical_fov_rad / 2.0);
        return {camera.eye_m, frustum_normals(camera, request.aspect), std::max(zoom, 1.0), order_};
    }

    std::shared_ptr<const QuadtreeGround> ground_;
    terrain::QuadtreeMesher mesher_;
    terrain::ControlSettings control_;
    terrain::TriangleBudget budget_;
    terrain::QuadtreeDetail detail_;
    terrain::ControlState state_;
    std::optional<terrain::MeshView> last_view_; ///< that `state_` has seen
    terrain::PaintOrder order_ = terrain::PaintOrder::BackToFront;
    double first_resolution_ = 0.0; ///< C of the first frame; 0 = the one that meets the target
    bool exact_ = true;
    bool fixed_resolution_ = false;
};

std::unique_ptr<GroundMesher> QuadtreeGround::make_mesher() const {
    return std::make_unique<QuadtreeGroundMesher>(std::static_pointer_cast<const QuadtreeGround>(shared_from_this()));
}

std::shared_ptr<const Ground> ground_over(
    FieldPointer field, const scene::GroundSettings& ground, const scene::AirSettings& air, RunwayPointer runway) {
    if (terrain::ground_metric(ground.lod) == terrain::GroundMetric::ScreenError) {
        return make_bisection_ground(terrain::make_ground_tiles(*field), air, std::move(runway));
    }
    auto tree = std::make_shared<const terrain::Quadtree>(*field, terrain::quadtree_options(ground.lod));
    return std::make_shared<QuadtreeGround>(std::move(field), std::move(tree), air, std::move(runway));
}

} // namespace

std::shared_ptr<const Ground> make_field_ground(models::heights::HeightField field, const scene::GroundSettings& ground,
    const scene::AirSettings& air, std::shared_ptr<const models::heights::RunwayStrip> runway) {
    return ground_over(
        std::make_shared<const models::heights::HeightField>(std::move(field)), ground, air, std::move(runway));
}

} // namespace octant::visuals::landscape
