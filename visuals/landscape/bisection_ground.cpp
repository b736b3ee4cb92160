#include "models/colour_vertex.h"
#include "models/heights/runway_strip.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/ground_palette.h"
#include "visuals/nature/daylight.h"
#include "visuals/nature/detailed_ground.h"
#include "visuals/nature/relief_shadows.h"
#include "visuals/nature/scenery.h"
#include "visuals/roads/road_network.h"
#include "visuals/scene/land_cover_contrast.h"
#include "visuals/terrain/bisection_mesher.h"
#include "visuals/terrain/bisection_prefetcher.h"
#include "visuals/terrain/bisection_tiles.h"
#include "visuals/terrain/ground_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::landscape {

namespace {

/// Footprint as a share of the distance: about the distance of neighbouring vertices where the ground is rough, 14
/// pixels of 720 lines over 45 degrees; nearer than the distance of samples about half of what edges look like there.
constexpr float footprint_share = 1.0F / 192.0F;
constexpr float near_footprint_share = 1.0F / 40.0F;
constexpr int mean_samples = 16; ///< a side

/// Packed colours mixed by 256ths, rounded.
std::uint32_t mixed(std::uint32_t a, std::uint32_t b, std::uint32_t share_of_b) {
    constexpr std::uint32_t even = 0x00ff00ffU;
    constexpr std::uint32_t half = 0x00800080U;
    const std::uint32_t share_of_a = 256U - share_of_b;
    const std::uint32_t low = ((a & even) * share_of_a + (b & even) * share_of_b + half) >> 8U;
    const std::uint32_t high = ((a >> 8U) & even) * share_of_a + ((b >> 8U) & even) * share_of_b + half;
    return (low & even) | (high & ~even);
}

/// A distance in footprints as whole octaves and what is left, in 256ths; rises steadily.
struct Octave {
    unsigned whole;
    std::uint32_t part;
};

Octave octave_of(float footprints) {
    const auto bits = std::bit_cast<std::uint32_t>(std::max(footprints, 1.0F));
    return {(bits >> 23U) - 127U, (bits >> 15U) & 0xffU};
}

constexpr std::uint32_t subdivisions = 64;

/// A place of the grid, of which there are `subdivisions` from each sample to the next; at most 2^22 along each axis.
struct SubgridPoint {
    std::uint32_t column = 0;
    std::uint32_t row = 0;
};

/// Remembers colours by place and octave. Any number of threads may ask and add at a time: an entry is one word, which
/// holds all of the key that its bucket does not say, and whose colour follows from the key alone. So a lost entry
/// costs time and changes nothing. The two octaves that a vertex mixes are in one bucket, one line of the caches.
class ColourTable {
public:
    ColourTable() : buckets_(std::make_unique<Bucket[]>(buckets)) {}

    /// Where the colours of a place are. The table is too large for the caches: who prefetches this waits less.
    const void* address_of(const SubgridPoint& place) const { return &buckets_[hash_of(place) % buckets]; }

    /// The colour of a place and an octave up to 30, which compute() makes where it is not remembered.
    template <typename Compute>
    std::uint32_t get(const SubgridPoint& place, unsigned octave, const Compute& compute) const {
        const std::uint64_t hash = hash_of(place);
        const std::uint64_t tag = hash / buckets << 5U | (octave + 1U);
        Bucket& bucket = buckets_[hash % buckets];
        std::atomic<std::uint64_t>* free = &bucket.words[tag % bucket.words.size()];
        for (std::atomic<std::uint64_t>& entry : bucket.words) {
            const std::uint64_t word = entry.load(std::memory_order_relaxed);
            if (word >> 32U == tag) { return static_cast<std::uint32_t>(word); }
            if (word == 0) { free = &entry; }
        }
        const std::uint32_t colour = compute();
        free->store(tag << 32U | colour, std::memory_order_relaxed);
        return colour;
    }

private:
    static constexpr unsigned place_bits = 44;
    static constexpr std::uint64_t buckets = std::uint64_t{1} << 17U;

    struct alignas(32) Bucket {
        std::array<std::atomic<std::uint64_t>, 4> words{}; ///< 0 = unused
    };

    /// Multiplications by odd numbers and shifts can be undone within 44 bits: bucket and tag together are the key.
    static std::uint64_t hash_of(const SubgridPoint& place) {
        constexpr std::uint64_t mask = (std::uint64_t{1} << place_bits) - 1;
        std::uint64_t h = std::uint64_t{place.column} << 22U | std::uint64_t{place.row};
        h = h * 0x9e3779b97f4a7c15U & mask;
        h ^= h >> 25U;
        h = h * 0xd1b54a32d192ed03U & mask;
        return h ^ h >> 29U;
    }

    std::unique_ptr<Bucket[]> buckets_;
};

/// Colours the vertices of meshes with geomorphs so that no change of detail changes a colour in a step. What a vertex
/// shows depends on its sample and its distance from the eye alone: slope and cover are filtered to a footprint that
/// grows steadily with the distance. A vertex that comes or goes moves in colour as it does in height, from the mean of
/// its ends to its own. Near the eye the footprint is smaller than the distance of samples, and places between them
/// have colours, too. Water takes part of what it shows from the sky and the sun, by the eye's place.
///
/// Colours are worked out when first asked for, so that the size of the ground does not matter, and the last half a
/// million are remembered, for all views together.
class VertexColours {
public:
    /// The ground must outlive the colours.
    VertexColours(const terrain::GroundTiles& ground, const scene::AirSettings& settings,
        std::shared_ptr<const nature::ReliefShadows> terrain_shadows)
        : ground_(ground), palette_(settings, climate_at(ground.metadata().place), std::move(terrain_shadows)),
          water_(daylight_of(settings)),
          footprints_per_m_(static_cast<float>(1U << finer_octaves) / static_cast<float>(ground.spacing_m())),
          last_octave_(static_cast<unsigned>(ground.levels() - 1) + finer_octaves) {}

    /// Fills in ColourVertex::colour; `morphs` as GroundMesh::morphs.
    void fill(std::span<models::ColourVertex> vertices, std::span<const terrain::VertexMorph> morphs) const {
        assert(vertices.size() == morphs.size());
        const auto place_of = [&](std::size_t i) {
            return SubgridPoint{morphs[i].column * subdivisions, morphs[i].row * subdivisions};
        };
        constexpr std::size_t ahead = 16;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            if (i + ahead < morphs.size()) { __builtin_prefetch(table_.address_of(place_of(i + ahead))); }
            const terrain::VertexMorph& origin = morphs[i];
            std::uint32_t colour = colour_at_distance(place_of(i), glm::length(vertices[i].position_m));
            if (origin.weight < 1.0F) {
                const std::uint32_t middle =
                    mixed(vertices[origin.parent_a].colour, vertices[origin.parent_b].colour, 128U);
                colour = mixed(middle, colour, static_cast<std::uint32_t>(origin.weight * 256.0F));
            }
            vertices[i].colour = colour;
        }
        for (models::ColourVertex& vertex : vertices) {
            if (vertex.colour >> 24U == 0) { vertex.colour = seen_water(vertex.colour, vertex.position_m); }
        }
    }

    /// Colour of a place of the world, packed, with the number of its covers for alpha.
    std::uint32_t at(const glm::dvec2& place_m, const glm::vec3& from_eye_m) const {
        const glm::dvec2 grid =
            (place_m + ground_.half_extent_m()) * (static_cast<double>(subdivisions) / ground_.spacing_m());
        const auto place_of = [](double at, int samples) {
            const auto last = static_cast<double>(samples - 1) * subdivisions;
            return static_cast<std::uint32_t>(std::lround(std::clamp(at, 0.0, last)));
        };
        const std::uint32_t colour = colour_at_distance(
            {place_of(grid.x, ground_.columns()), place_of(grid.y, ground_.rows())}, glm::length(from_eye_m));
        return colour >> 24U == 0 ? seen_water(colour, from_eye_m) : colour;
    }

    const GroundPalette& palette() const { return palette_; }

    /// What stands at a sample.
    nature::SceneryDensity scenery_density_of(int column, int row) const {
        const TerrainPoint point = ground_point(terrain::GroundSamples(ground_), column, row, 1);
        return palette_.scenery_density(point, static_cast<float>(ground_.spacing_m()));
    }

    /// Mean over the ground, of widely spaced samples, display values 0..1.
    glm::vec3 mean() const {
        glm::vec3 sum(0.0F);
        for (int j = 0; j < mean_samples; ++j) {
            for (int i = 0; i < mean_samples; ++i) {
                const auto column = static_cast<std::uint32_t>((2 * i + 1) * ground_.columns() / (2 * mean_samples));
                const auto row = static_cast<std::uint32_t>((2 * j + 1) * ground_.rows() / (2 * mean_samples));
                const std::uint32_t colour = made_colour({column * subdivisions, row * subdivisions}, finer_octaves);
                sum += glm::vec3(colour & 0xffU, colour >> 8U & 0xffU, colour >> 16U & 0xffU);
            }
        }
        return sum / (255.0F * static_cast<float>(mean_samples * mean_samples));
    }

private:
    /// Footprints are counted from the distance of samples over 2^finer_octaves.
    static constexpr unsigned finer_octaves = 5;

    /// Without what water mirrors.
    std::uint32_t colour_at_distance(const SubgridPoint& place, float distance_m) const {
        const float near =
            std::min(distance_m * near_footprint_share * footprints_per_m_, static_cast<float>(1U << finer_octaves));
        const Octave octave = octave_of(std::max(near, distance_m * footprint_share * footprints_per_m_));
        if (octave.whole >= last_octave_) { return colour_of(place, last_octave_); }
        const std::uint32_t fine = colour_of(place, octave.whole);
        // Ground as far off as its samples allow no finer footprint has this part for much of the way.
        return octave.part == 0 ? fine : mixed(fine, colour_of(place, octave.whole + 1), octave.part);
    }

    std::uint32_t colour_of(const SubgridPoint& place, unsigned octave) const {
        return table_.get(place, octave, [&] { return made_colour(place, octave); });
    }

    std::uint32_t made_colour(const SubgridPoint& place, unsigned octave) const {
        const int step = octave > finer_octaves ? 1 << (octave - finer_octaves) : 1;
        const bool is_sample = place.column % subdivisions == 0 && place.row % subdivisions == 0;
        TerrainPoint point = is_sample ? sample_point(place, step) : point_between(place);
        point.land_share = palette_.is_water(point) ? land_share_at(point) : 0.0F;
        return palette_.packed(
            point, std::ldexp(static_cast<float>(ground_.spacing_m()), static_cast<int>(octave) - int{finer_octaves}));
    }

    /// A sample with the mean slope of so wide a surrounding; of a place between samples, the one south-west of it.
    TerrainPoint sample_point(const SubgridPoint& place, int step) const {
        const auto column = static_cast<int>(place.column / subdivisions);
        const auto row = static_cast<int>(place.row / subdivisions);
        const int west = std::max(column - step, 0);
        const int east = std::min(column + step, ground_.columns() - 1);
        const int south = std::max(row - step, 0);
        const int north = std::min(row + step, ground_.rows() - 1);
        const auto spacing_m = static_cast<float>(ground_.spacing_m());
        const float rise_east =
            (ground_.height_m(east, row) - ground_.height_m(west, row)) / (spacing_m * static_cast<float>(east - west));
        const float rise_north = (ground_.height_m(column, north) - ground_.height_m(column, south)) /
                                 (spacing_m * static_cast<float>(north - south));
        return {spacing_m * static_cast<float>(column), spacing_m * static_cast<float>(row),
            ground_.height_m(column, row), glm::normalize(glm::vec3(-rise_east, -rise_north, 1.0F))};
    }

    /// Heights and slopes even between four samples.
    TerrainPoint point_between(const SubgridPoint& place) const {
        const auto last_column = static_cast<std::uint32_t>(ground_.columns() - 2) * subdivisions;
        const auto last_row = static_cast<std::uint32_t>(ground_.rows() - 2) * subdivisions;
        const SubgridPoint cell{std::min(place.column, last_column), std::min(place.row, last_row)};
        const TerrainPoint a = sample_point(cell, 1);
        const TerrainPoint b = sample_point({cell.column + subdivisions, cell.row}, 1);
        const TerrainPoint c = sample_point({cell.column, cell.row + subdivisions}, 1);
        const TerrainPoint d = sample_point({cell.column + subdivisions, cell.row + subdivisions}, 1);
        const auto spacing_m = static_cast<float>(ground_.spacing_m());
        const float east_m = static_cast<float>(place.column) * (spacing_m / subdivisions);
        const float north_m = static_cast<float>(place.row) * (spacing_m / subdivisions);
        const glm::vec2 share = (glm::vec2(east_m, north_m) - glm::vec2(a.east_m, a.north_m)) / spacing_m;
        return {east_m, north_m, models::heights::bilinear(a.height_m, b.height_m, c.height_m, d.height_m, share),
            glm::normalize(models::heights::bilinear(a.normal, b.normal, c.normal, d.normal, share))};
    }

    /// By samples around, the nearer ones counting like the farther ones.
    float land_share_at(const TerrainPoint& point) const {
        constexpr std::array<glm::ivec2, 8> ways = {
            glm::ivec2(1, 0), {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
        const auto per_m = 1.0F / static_cast<float>(ground_.spacing_m());
        const glm::ivec2 here(glm::round(glm::vec2(point.east_m, point.north_m) * per_m));
        const glm::ivec2 last(ground_.columns() - 1, ground_.rows() - 1);
        int land = 0;
        int samples = 0;
        for (const int far_off : {1, 2, 4}) {
            for (const glm::ivec2& way : ways) {
                const glm::ivec2 at = glm::clamp(here + way * far_off, glm::ivec2(0), last);
                land += ground_.height_m(at.x, at.y) > point.height_m + 0.01F ? 1 : 0;
                ++samples;
            }
        }
        return static_cast<float>(land) / static_cast<float>(samples);
    }

    std::uint32_t seen_water(std::uint32_t own, const glm::vec3& from_eye_m) const {
        const auto part = [&](unsigned shift) { return static_cast<float>(own >> shift & 0xffU) * (1.0F / 255.0F); };
        const glm::vec3 shaded_colour = water_.shaded_colour({part(0), part(8), part(16)}, from_eye_m);
        return models::packed_colour(shaded_colour) & 0x00ffffffU;
    }

    const terrain::GroundTiles& ground_;
    GroundPalette palette_;
    nature::WaterReflection water_;
    float footprints_per_m_; ///< of the distance, in footprints of octave 0
    unsigned last_octave_;
    ColourTable table_;
};

constexpr double highest_desert_town_m = 3000.0; ///< the trees of deserts say nothing of people

/// The roads of a ground, found when they are first asked for, which is loading work, and shared by all grounds of the
/// same heights and water.
class SharedRoads {
public:
    explicit SharedRoads(double water_level_m) : water_level_m_(water_level_m) {}

    double water_level_m() const { return water_level_m_; }

    /// On this ground, the same in each call. `runway`: which roads keep off; null where there is none.
    std::shared_ptr<const roads::RoadNetwork> network(
        const terrain::GroundTiles& tiles, const models::heights::RunwayStrip* runway) {
        std::call_once(once_, [&] {
            const nature::Climate climate = climate_at(tiles.metadata().place);
            roads::RoadConstraints constraints;
            constraints.water_m = water_level_m_;
            constraints.max_town_height_m =
                climate.is_arid() ? highest_desert_town_m : static_cast<double>(climate.tree_line_m);
            if (runway != nullptr) {
                constraints.is_blocked = [runway](const glm::dvec2& at_m) {
                    return runway->distance_m(at_m) < models::heights::side_slope_end_m;
                };
            }
            roads_ = std::make_shared<const roads::RoadNetwork>(terrain::GroundSamples(tiles), constraints);
        });
        return roads_;
    }

private:
    double water_level_m_;
    std::once_flag once_;
    std::shared_ptr<const roads::RoadNetwork> roads_;
};

/// What a ground looks like under its sun.
struct LitGround {
    /// `same_ground`: as for nature::ReliefShadows. The ground must outlive this.
    LitGround(
        const terrain::GroundTiles& ground, const scene::AirSettings& air, const nature::ReliefShadows* same_ground)
        : shadows(make_relief_shadows(terrain::GroundSamples(ground), air, same_ground)), colours(ground, air, shadows),
          mean_colour(colours.mean()) {}

    std::shared_ptr<const nature::ReliefShadows> shadows; ///< null = none
    VertexColours colours;
    glm::vec3 mean_colour;
};

/// Tiles, in memory or mapped from a file, and what is made of them when it is first asked for.
class BisectionGround final : public Ground {
public:
    /// `same_heights`: ground of the same tiles and another sun, whose roads and light are shared; null = none.
    BisectionGround(std::shared_ptr<const terrain::GroundTiles> tiles, const scene::AirSettings& air,
        std::shared_ptr<const models::heights::RunwayStrip> runway, const BisectionGround* same_heights = nullptr)
        : Ground(air, std::move(runway)), tiles_(std::move(tiles)),
          roads_(same_heights != nullptr && same_heights->roads_->water_level_m() == air.water_level_m
                     ? same_heights->roads_
                     : std::make_shared<SharedRoads>(air.water_level_m)),
          contrast_(std::make_shared<const scene::LandCoverContrast>(
              GroundPalette(air, climate_at(tiles_->metadata().place)).contrast())),
          other_shadows_(same_heights != nullptr ? same_heights->lit().shadows : nullptr) {}

    const terrain::GroundTiles& tiles() const { return *tiles_; }

    /// Loading work where it is first asked for.
    const LitGround& lit() const {
        std::call_once(lit_once_, [this] {
            lit_.emplace(*tiles_, air(), other_shadows_.get());
            other_shadows_.reset();
        });
        return *lit_;
    }

    std::optional<double> height_at(double x_m, double y_m) const override { return tiles_->height_at(x_m, y_m); }

    double spacing_m() const override { return tiles_->spacing_m(); }

    glm::dvec2 half_extent_m() const override { return tiles_->half_extent_m(); }

    double mean_height_m() const override { return static_cast<double>(tiles_->metadata().mean_m); }

    glm::vec3 mean_colour() const override { return lit().mean_colour; }

    std::shared_ptr<const scene::LandCoverContrast> land_cover_contrast() const override { return contrast_; }

    std::optional<double> water_level_m() const override {
        return water_level_of(air(), climate_at(tiles_->metadata().place));
    }

    glm::vec3 colour_at(double x_m, double y_m, double footprint_m) const override {
        return nearest_colour(terrain::GroundSamples(*tiles_), lit().colours.palette(), {x_m, y_m}, footprint_m);
    }

    float cover_code_at(double x_m, double y_m, double footprint_m) const override {
        return lit().colours.palette().cover_code(
            nearest_point(terrain::GroundSamples(*tiles_), {x_m, y_m}, footprint_m), static_cast<float>(footprint_m));
    }

    nature::LightVisibility light_visibility(double x_m, double y_m) const override {
        const glm::vec2 at_m(glm::dvec2(x_m, y_m) + half_extent_m());
        const nature::ReliefShadows* const shadows = lit().shadows.get();
        return shadows != nullptr ? shadows->at(at_m.x, at_m.y, static_cast<float>(spacing_m()))
                                  : nature::LightVisibility();
    }

    std::shared_ptr<const roads::RoadNetwork> road_network() const override {
        const bool has_people = ellipsoid_below(tiles_->metadata().place).is_earth();
        return has_people ? roads_->network(*tiles_, runway().get()) : nullptr;
    }

    std::optional<GroundTextureSource> source() const override {
        const terrain::GroundMetadata& metadata = tiles_->metadata();
        return GroundTextureSource{terrain::GroundSamples(*tiles_),
            {metadata.name, tiles_->half_extent_m(), tiles_->spacing_m(), metadata.system}, metadata.place};
    }

    bool has_mesh_settings(const scene::GroundSettings& settings) const override {
        return terrain::ground_metric(settings.lod) == terrain::GroundMetric::ScreenError;
    }

    std::shared_ptr<const Ground> with_settings(
        const scene::GroundSettings& ground, const scene::AirSettings& air) const override {
        return has_mesh_settings(ground) ? std::make_shared<BisectionGround>(tiles_, air, runway(), this) : nullptr;
    }

private:
    std::unique_ptr<GroundMesher> make_mesher() const override;

    std::shared_ptr<const terrain::GroundTiles> tiles_;
    std::shared_ptr<SharedRoads> roads_;
    std::shared_ptr<const scene::LandCoverContrast> contrast_;
    mutable std::once_flag lit_once_;
    mutable std::optional<LitGround> lit_;
    mutable std::shared_ptr<const nature::ReliefShadows> other_shadows_; ///< Of same_heights, until lit_ is made.
};

constexpr double prefetch_frames = 120.0; ///< how far along the eye's way pages are asked for
constexpr double min_error_px = 0.25;     ///< what is finer than this nobody sees
constexpr double default_triangles = 20000.0;

/// Meshes by screen-space error with geomorphs, made ahead on a thread where that is asked for.
class BisectionGroundMesher final : public GroundMesher {
public:
    explicit BisectionGroundMesher(std::shared_ptr<const BisectionGround> ground)
        : ground_(std::move(ground)), mesher_(ground_->tiles()) {}

    const Ground& ground() const override { return *ground_; }

    void apply_settings(const MeshSettings& settings) override {
        background_task_.wait();
        order_ = settings.is_front_to_back ? terrain::PaintOrder::FrontToBack : terrain::PaintOrder::BackToFront;
        target_.error_px = settings.ground.error_px.value_or(min_error_px);
        target_.geomorphs = settings.ground.geomorphs;
        detail_ = {settings.ground.near_detail, settings.ground.scenery && !settings.has_texture};
        has_texture_ = settings.has_texture;
        colours_ = &ground_->lit().colours;
        make_decorations(settings);
        is_coloured_ = false;
        earth_radius_m_ =
            settings.ground.earth_curvature ? ellipsoid_below(ground_->tiles().metadata().place).mean_radius_m() : 0.0;
    }

    bool switch_ground(const std::shared_ptr<const Ground>& ground) override {
        auto moved = std::dynamic_pointer_cast<const BisectionGround>(ground);
        if (!moved || &moved->tiles() != &ground_->tiles()) { return false; }
        background_task_.wait();
        ground_ = std::move(moved);
        colours_ = &ground_->lit().colours;
        is_coloured_ = false;
        return true;
    }

    double earth_radius_m() const override { return earth_radius_m_; }

    /// Meshes depend on no frame before them, but for the pages that are asked for along the eye's way and for the time
    /// that it takes to find a mesh.
    void reset_detail(const MeshRequest& /*request*/) override {
        last_eye_m_.reset();
        mesher_.expect_other_view();
    }

    /// A second mesh ahead would take the memory of the one that is being drawn.
    void begin_next_mesh(const MeshRequest& request, const IdleThreadRunner& on_idle_thread) override {
        background_task_.wait();
        if (std::exchange(has_mesh_begun_, true)) { return; }
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
        if (last_eye_m_) {
            if (!prefetcher_) { prefetcher_.emplace(ground_->tiles()); }
            prefetcher_->prefetch_around(glm::dvec2(eye_m + prefetch_frames * (eye_m - *last_eye_m_)));
        }
        last_eye_m_ = eye_m;
        counts = {static_cast<int>(drawn_mesh_.indices.size() / 3), mesh_.counters.fans, 0.0, mesh_.error_px,
            static_cast<int>(drawn_mesh_.detail_triangles), static_cast<int>(drawn_mesh_.scenery_triangles)};
        return {drawn_mesh_.vertices, drawn_mesh_.indices, drawn_mesh_.standing};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        if (!adds_detail()) {
            mesher_.triangles_in(wanted, triangles);
            return;
        }
        const std::size_t first = triangles.size();
        const double moved_m = nature::max_offset_ratio * ground_->spacing_m();
        double tallest_m = 0.0;
        for (const auto& decoration : decorations_) { tallest_m = std::max(tallest_m, decoration->height_m()); }
        const glm::dvec3 below_m(0.0, 0.0, moved_m);
        const glm::dvec3 above_m(0.0, 0.0, moved_m + tallest_m);
        mesher_.triangles_in(
            [&](const glm::dvec3& min_m, const glm::dvec3& max_m) { return wanted(min_m - below_m, max_m + above_m); },
            triangles);
        detailed_ground_.replace(triangles, first);
    }

private:
    /// Trees and houses come with what lies on the ground, which says where they stand.
    void make_decorations(const MeshSettings& settings) {
        GroundMesher::apply_settings(settings);
        if (!detail_.scenery) { return; }
        const auto density_at = [this](int column, int row) {
            nature::SceneryDensity density = colours_->scenery_density_of(column, row);
            const double cell_m = ground_->spacing_m();
            const glm::dvec2 middle_m = (glm::dvec2(column, row) + 0.5) * cell_m - ground_->half_extent_m();
            for (const auto& decoration : decorations_) { decoration->limit_scenery(middle_m, cell_m, density); }
            return density;
        };
        const terrain::GroundTiles& tiles = ground_->tiles();
        decorations_.push_back(nature::scenery_decoration({-tiles.half_extent_m(), {tiles.columns(), tiles.rows()},
            tiles.spacing_m(), daylight_of(settings.air), density_at, settings.has_shadows}));
    }

    bool adds_detail() const { return detail_.has_subdivision || detail_.scenery; }

    /// Of the triangles that are aimed at, what detail may need is kept for it.
    void set_target(const MeshRequest& request) {
        const glm::dvec3& eye_m = request.camera.eye_m;
        near_view_.eye_m = eye_m;
        near_view_.spacing_m = ground_->spacing_m();
        near_view_.order = order_;
        std::ranges::transform(frustum_normals(request.camera, request.aspect), near_view_.frustum_normals.begin(),
            [](const glm::dvec3& normal) { return glm::vec3(normal); });
        const int triangles = request.triangle_target;
        const bool unlimited = triangles >= terrain::unlimited_triangles;
        if (adds_detail()) {
            const double height_above_ground_m = eye_m.z - ground_->height_at(eye_m.x, eye_m.y).value_or(0.0);
            nature::apply_detail_budget(
                {unlimited ? std::nullopt : std::optional(triangles / default_triangles),
                    request.camera.vertical_fov_rad * request.aspect,
                    focal_px(request.camera, request.picture_height_px), std::max(height_above_ground_m, 0.0)},
                detail_, near_view_);
        }
        const int kept = adds_detail() ? static_cast<int>(near_view_.max_splits + near_view_.max_scenery_triangles) : 0;
        target_.max_triangles = unlimited ? triangles : std::max(triangles - kept, 1);
    }

    /// Does nothing if the mesher returns the mesh of the last call, which was made ahead.
    void make(const terrain::MeshView& view) {
        const terrain::GroundMesh mesh = mesher_.mesh(view, target_);
        if (!is_coloured_ || mesh.vertices.data() != mesh_.vertices.data()) {
            is_coloured_ = false;
            colours_->fill(mesher_.vertices(), mesh.morphs);
            if (has_texture_) {
                for (models::ColourVertex& vertex : mesher_.vertices()) {
                    vertex.colour |= 0xff000000U; // all of its light is left
                }
            }
            is_coloured_ = true;
            show(mesh);
        }
        mesh_ = mesh;
    }

    void show(const terrain::GroundMesh& mesh) {
        drawn_mesh_ = {mesh.vertices, mesh.indices, {}, 0, 0};
        if (adds_detail()) {
            drawn_mesh_ = detailed_ground_.detailed_mesh(
                mesh, near_view_, detail_, decorations_, has_texture_ ? nullptr : &colour_at_point_);
        }
    }

    terrain::MeshView view_of(const MeshRequest& request) const {
        return {.eye_m = request.camera.eye_m,
            .frustum_normals = frustum_normals(request.camera, request.aspect),
            .order = order_,
            .focal_px = focal_px(request.camera, request.picture_height_px),
            .ahead = view_direction(request.camera),
            .corner_cos = corner_cos(request.camera, request.aspect),
            .earth_radius_m = earth_radius_m_};
    }

    std::shared_ptr<const BisectionGround> ground_;
    const VertexColours* colours_ = nullptr; ///< Of the ground.
    terrain::BisectionMesher mesher_;
    nature::DetailedGround detailed_ground_;
    nature::NearDetailOptions detail_;
    bool has_texture_ = false;
    nature::ColourAtPoint colour_at_point_ = [this](const glm::dvec2& place_m, const glm::vec3& from_eye_m) {
        return colours_->at(place_m, from_eye_m);
    };
    nature::NearDetailView near_view_;
    nature::DetailedGround::Triangles drawn_mesh_; ///< mesh_ with its detail
    terrain::PaintOrder order_ = terrain::PaintOrder::BackToFront;
    terrain::ErrorTarget target_;
    double earth_radius_m_ = 0.0;
    terrain::GroundMesh mesh_;
    bool is_coloured_ = false;         ///< mesh_, in the ground's colours
    terrain::MeshView next_mesh_view_; ///< of the mesh that is made ahead
    bool has_mesh_begun_ = false;      ///< a mesh has been begun that nobody has asked for yet
    std::optional<glm::dvec3> last_eye_m_;
    std::optional<terrain::GroundPrefetcher> prefetcher_; ///< has a thread: made where frames follow one another
    BackgroundTask background_task_; ///< declared last, so that it is destroyed first: its work uses the others
};

} // namespace

std::unique_ptr<GroundMesher> BisectionGround::make_mesher() const {
    auto ground = std::static_pointer_cast<const BisectionGround>(shared_from_this());
    return std::make_unique<BisectionGroundMesher>(std::move(ground));
}

std::shared_ptr<const Ground> make_bisection_ground(terrain::GroundTiles ground, const scene::AirSettings& air,
    std::shared_ptr<const models::heights::RunwayStrip> runway) {
    return std::make_shared<BisectionGround>(
        std::make_shared<const terrain::GroundTiles>(std::move(ground)), air, std::move(runway));
}

} // namespace octant::visuals::landscape
