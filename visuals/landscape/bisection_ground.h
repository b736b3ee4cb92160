#pragma once

#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/shared_roads.h"
#include "visuals/nature/relief_shadows.h"
#include "visuals/scene/land_cover_contrast.h"
#include "visuals/terrain/ground_tiles.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <optional>

namespace octant::visuals::landscape {

/// Tiles, in memory or mapped from a file, and the palette of their colours.
class BisectionGround final : public Ground {
public:
    /// `roads`: of a ground of the same heights; null where there is none.
    BisectionGround(
        std::shared_ptr<const terrain::GroundTiles> tiles,
        const scene::AirSettings& air,
        std::shared_ptr<const models::heights::RunwayStrip> runway,
        std::shared_ptr<SharedRoads> roads = nullptr);

    const terrain::GroundTiles& tiles() const { return *tiles_; }

    const scene::AirSettings& air() const { return air_; }

    const std::shared_ptr<const nature::ReliefShadows>& terrain_shadows() const { return terrain_shadows_; }

    /// Whether things may stand in the cell beyond a sample.
    bool allows_scenery(int column, int row) const;

    std::optional<double> height_at(double x_m, double y_m) const override {
        return tiles_->height_at(x_m, y_m);
    }

    double spacing_m() const override { return tiles_->spacing_m(); }

    glm::dvec2 half_extent_m() const override { return tiles_->half_extent_m(); }

    double mean_height_m() const override { return static_cast<double>(tiles_->metadata().mean_m); }

    glm::vec3 mean_colour() const override { return mean_colour_; }

    std::shared_ptr<const scene::LandCoverContrast> land_cover_contrast() const override {
        return contrast_;
    }

    glm::vec3 colour_at(double x_m, double y_m, double footprint_m) const override;
    float cover_code_at(double x_m, double y_m, double footprint_m) const override;
    nature::LightVisibility light_visibility(double x_m, double y_m) const override;
    std::shared_ptr<const roads::RoadNetwork> road_network() const override;
    std::optional<GroundTextureSource> source() const override;
    bool has_mesh_settings(const scene::GroundSettings& settings) const override;
    bool has_colour_settings(const scene::AirSettings& settings) const override;
    std::shared_ptr<const Ground>
    with_settings(const scene::GroundSettings& ground, const scene::AirSettings& air) const override;

private:
    std::unique_ptr<GroundMesher> make_mesher(const MeshSettings& settings) const override;

    std::shared_ptr<const terrain::GroundTiles> tiles_;
    scene::AirSettings air_;
    std::shared_ptr<SharedRoads> roads_;
    std::shared_ptr<const nature::ReliefShadows> terrain_shadows_;
    std::shared_ptr<const scene::LandCoverContrast> contrast_;
    glm::vec3 mean_colour_;
};

/// Meshes of it by screen-space error with geomorphs, made ahead on a thread where that is asked
/// for.
std::unique_ptr<GroundMesher>
bisection_mesher(std::shared_ptr<const BisectionGround> ground, const MeshSettings& settings);

} // namespace octant::visuals::landscape
