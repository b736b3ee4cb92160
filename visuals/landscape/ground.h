#pragma once

#include "models/heights/height_field.h"
#include "models/heights/image.h"
#include "models/heights/runway_strip.h"
#include "models/polygons/polygon_model.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/nature/backdrop.h"
#include "visuals/nature/relief_shadows.h"
#include "visuals/roads/road_network.h"
#include "visuals/scene/land_cover_contrast.h"
#include "visuals/scene/settings.h"
#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/ground_query.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace octant::visuals::landscape {

/// What a texture of a ground is made of. It refers to the ground, which must outlive it.
struct GroundTextureSource {
    terrain::GroundSamples samples;
    models::heights::GroundArea area;
    /// Nothing for made ground.
    std::optional<GeoPosition> place;
};

/// What stands below the aircraft: a height field under a quadtree, ground under a mesh by screen-space error, or
/// polygons painted in one fixed order. Made once at loading, never changed and shared by all views: what a view needs
/// of its own is in its mesher. Always owned by a shared_ptr.
class Ground : public std::enable_shared_from_this<Ground> {
public:
    virtual ~Ground() = default;
    Ground(const Ground&) = delete;
    Ground& operator=(const Ground&) = delete;
    Ground(Ground&&) = delete;
    Ground& operator=(Ground&&) = delete;

    /// Height of the full-resolution ground, metres above datum; nothing outside the map.
    virtual std::optional<double> height_at(double x_m, double y_m) const = 0;

    /// Half the extent of the map from its centre, east and north, metres.
    virtual glm::dvec2 half_extent_m() const = 0;

    /// Distance of neighbouring samples at full resolution, metres; 0 where there are none.
    virtual double spacing_m() const { return 0.0; }

    /// Mean height above datum, metres, infinite where there is no ground at all, and mean colour of what is drawn.
    virtual double mean_height_m() const = 0;
    virtual glm::vec3 mean_colour() const = 0;

    /// How pixels differ from the colours of its vertices, whose alpha says of which covers they are mixed; null where
    /// it says nothing.
    virtual std::shared_ptr<const scene::LandCoverContrast> land_cover_contrast() const { return nullptr; }

    /// Level ground at this height above datum or below is water; nothing = there is no water.
    virtual std::optional<double> water_level_m() const { return std::nullopt; }

    /// Colour of a place on the map as the mean over about `footprint_m`, display values.
    virtual glm::vec3 colour_at(double /*x_m*/, double /*y_m*/, double /*footprint_m*/) const { return mean_colour(); }

    /// The number of the covers of that colour, 0..255; 0 where it says nothing.
    virtual float cover_code_at(double /*x_m*/, double /*y_m*/, double /*footprint_m*/) const { return 0.0F; }

    /// What the relief leaves of the light at a place.
    virtual nature::LightVisibility light_visibility(double /*x_m*/, double /*y_m*/) const { return {}; }

    /// The roads on it; null for ground that has none. Made when they are first asked for, which is loading work.
    virtual std::shared_ptr<const roads::RoadNetwork> road_network() const { return nullptr; }

    /// The land around the map; nothing for ground without samples. Made when it is first asked for, which is loading
    /// work.
    const nature::Backdrop& backdrop() const;

    /// The samples as they are drawn; nothing for ground that has none.
    virtual std::optional<GroundTextureSource> source() const { return std::nullopt; }

    /// Whether meshes of this ground are refined by what these settings say.
    virtual bool has_mesh_settings(const scene::GroundSettings& /*settings*/) const { return true; }

    /// Whether loading the same heights by these settings would give this ground: the same meshes, and the same colours
    /// (if the settings name no palette, the temperate one).
    bool matches_settings(const scene::GroundSettings& ground, const scene::AirSettings& air) const {
        return has_mesh_settings(ground) && same_colours(air, air_);
    }

    /// Ground of the same heights as these settings want it, made of what is in memory; null where it must be loaded.
    /// Loading work.
    virtual std::shared_ptr<const Ground> with_settings(
        const scene::GroundSettings& /*ground*/, const scene::AirSettings& /*air*/) const {
        return nullptr;
    }

    /// What lies on it under these settings, for one view.
    nature::GroundDecorations lying_decorations(const MeshSettings& settings) const;

    const scene::AirSettings& air() const { return air_; }

    /// The meshes of one more view. The ground has_mesh_settings() the settings say (asserted).
    std::unique_ptr<GroundMesher> mesher(const MeshSettings& settings) const;

    /// The runway for which it is levelled, where nothing else stands; null = none.
    const std::shared_ptr<const models::heights::RunwayStrip>& runway() const { return runway_; }

protected:
    /// `air`: gives it its colours.
    explicit Ground(
        const scene::AirSettings& air = {}, std::shared_ptr<const models::heights::RunwayStrip> runway = nullptr)
        : air_(air), runway_(std::move(runway)) {}

private:
    /// A mesher without settings.
    virtual std::unique_ptr<GroundMesher> make_mesher() const = 0;

    scene::AirSettings air_;
    std::shared_ptr<const models::heights::RunwayStrip> runway_;
    mutable std::once_flag backdrop_once_;
    mutable nature::Backdrop backdrop_;
};

/// The highest of the ground's samples, at most every 1/512 of its extent; 0 where there is none. Loading work.
double highest_m(const Ground& ground);

/// The mesher by which a view goes on under other settings: `before` where it meshes this very ground or the same one
/// in other colours, else a new one. As Ground::mesher.
std::unique_ptr<GroundMesher> reuse_or_make_mesher(
    std::unique_ptr<GroundMesher> before, const Ground& ground, const MeshSettings& settings);

/// A height field under the mesh that `ground.lod` chooses: the paper's quadtree or a mesh by screen-space error.
/// `runway`: for which the field has been levelled.
std::shared_ptr<const Ground> make_field_ground(models::heights::HeightField field, const scene::GroundSettings& ground,
    const scene::AirSettings& air, std::shared_ptr<const models::heights::RunwayStrip> runway = nullptr);

/// Ground under a mesh by screen-space error. `runway`: for which it has been levelled.
std::shared_ptr<const Ground> make_bisection_ground(terrain::GroundTiles ground, const scene::AirSettings& air,
    std::shared_ptr<const models::heights::RunwayStrip> runway = nullptr);

/// Polygons painted in file order over a level datum. Body axes of the model: x north, y east, z down. Without
/// polygons: nothing to see and a map of 2,000 km, for aircraft alone.
std::shared_ptr<const Ground> make_polygon_ground(
    models::polygons::PolygonModel polygons, const scene::AirSettings& air);

} // namespace octant::visuals::landscape
