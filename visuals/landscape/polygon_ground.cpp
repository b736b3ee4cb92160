#include "models/colour_vertex.h"
#include "visuals/landscape/ground.h"
#include "visuals/landscape/ground_mesher.h"
#include "visuals/landscape/ground_palette.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace octant::visuals::landscape {

namespace {

/// Corners, colours and triangles of the polygons, world axes.
class PolygonGround final : public Ground {
public:
    /// Around a triangle, world axes.
    struct Box {
        glm::dvec3 min_m;
        glm::dvec3 max_m;
    };

    PolygonGround(const models::polygons::PolygonModel& model, const scene::AirSettings& air) : air_(air) {
        const nature::Daylight day = daylight_of(air);
        for (std::size_t i = 0; i < model.polygons.size(); ++i) {
            const glm::vec3 normal(world_from_body(models::polygons::normal_of(model, i)));
            const glm::vec3 colour = model.materials[model.polygons[i].material].colour * illumination(normal, day);
            const auto first = static_cast<std::uint32_t>(corners_m_.size());
            for (const std::uint32_t vertex : model.corners(i)) {
                corners_m_.push_back(world_from_body(model.vertices_m[vertex]));
                colours_.push_back(models::packed_colour(colour));
                half_extent_m_ = glm::max(half_extent_m_, glm::abs(glm::dvec2(corners_m_.back())));
            }
            for (std::uint32_t corner = 2; corner < model.polygons[i].corner_count; ++corner) {
                add_triangle(first, first + corner - 1, first + corner);
            }
            mean_colour_ += colour / static_cast<float>(model.polygons.size());
        }
        polygons_ = static_cast<int>(model.polygons.size());
        if (model.polygons.empty()) { half_extent_m_ = glm::dvec2(1e6); }
    }

    std::span<const glm::dvec3> corners_m() const { return corners_m_; }

    /// One a corner.
    std::span<const std::uint32_t> colours() const { return colours_; }

    std::span<const std::uint32_t> indices() const { return indices_; }

    /// One a triangle.
    std::span<const Box> boxes() const { return boxes_; }

    int polygons() const { return polygons_; }

    bool has_colour_settings(const scene::AirSettings& settings) const override { return same_colours(settings, air_); }

    std::optional<double> height_at(double x_m, double y_m) const override {
        const bool inside = std::abs(x_m) <= half_extent_m_.x && std::abs(y_m) <= half_extent_m_.y;
        return inside ? std::optional<double>(0.0) : std::nullopt;
    }

    glm::dvec2 half_extent_m() const override { return half_extent_m_; }

    double mean_height_m() const override { return polygons_ > 0 ? 0.0 : std::numeric_limits<double>::infinity(); }

    glm::vec3 mean_colour() const override { return mean_colour_; }

private:
    std::unique_ptr<GroundMesher> make_mesher() const override;

    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices_.insert(indices_.end(), {a, b, c});
        const glm::dvec3& a_m = corners_m_[a];
        const glm::dvec3& b_m = corners_m_[b];
        const glm::dvec3& c_m = corners_m_[c];
        boxes_.push_back({glm::min(a_m, glm::min(b_m, c_m)), glm::max(a_m, glm::max(b_m, c_m))});
    }

    static glm::dvec3 world_from_body(const glm::dvec3& v) { return {v.y, v.x, -v.z}; }

    scene::AirSettings air_;
    std::vector<glm::dvec3> corners_m_;
    std::vector<std::uint32_t> colours_;
    std::vector<std::uint32_t> indices_;
    std::vector<Box> boxes_;
    glm::dvec2 half_extent_m_{0.0};
    glm::vec3 mean_colour_{0.0F};
    int polygons_ = 0;
};

/// All polygons in every frame, with the eye subtracted.
class PolygonGroundMesher final : public GroundMesher {
public:
    explicit PolygonGroundMesher(std::shared_ptr<const PolygonGround> ground) : ground_(std::move(ground)) {
        for (const std::uint32_t colour : ground_->colours()) { vertices_.push_back({glm::vec3(0.0F), colour}); }
    }

    const Ground& ground() const override { return *ground_; }

    scene::TriangleDraw triangles(const MeshRequest& request, GroundCounts& counts) override {
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            vertices_[i].position_m = glm::vec3(ground_->corners_m()[i] - request.camera.eye_m);
        }
        counts = {static_cast<int>(ground_->indices().size() / 3), ground_->polygons(), 0.0};
        return {vertices_, ground_->indices()};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        const std::span<const PolygonGround::Box> boxes = ground_->boxes();
        for (std::uint32_t i = 0; i < boxes.size(); ++i) {
            if (wanted(boxes[i].min_m, boxes[i].max_m)) { triangles.push_back(i); }
        }
    }

private:
    std::shared_ptr<const PolygonGround> ground_;
    std::vector<models::ColourVertex> vertices_;
};

std::unique_ptr<GroundMesher> PolygonGround::make_mesher() const {
    return std::make_unique<PolygonGroundMesher>(std::static_pointer_cast<const PolygonGround>(shared_from_this()));
}

} // namespace

std::shared_ptr<const Ground> make_polygon_ground(
    models::polygons::PolygonModel polygons, const scene::AirSettings& air) {
    return std::make_shared<PolygonGround>(polygons, air);
}

} // namespace octant::visuals::landscape
