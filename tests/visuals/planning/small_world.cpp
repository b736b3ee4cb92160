#include "small_world.h"

#include "models/polygons/obj_reader.h"
#include "visuals/draworder/octant_order.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace octant::tests {

namespace landscape = visuals::landscape;
namespace planning = visuals::planning;
namespace scene = visuals::scene;

namespace {

class CellGround final : public landscape::Ground {
public:
    CellGround(int cells, double cell_m, Height height) : cells_(cells), cell_m_(cell_m), height_(std::move(height)) {}

    int cells() const { return cells_; }

    double cell_m() const { return cell_m_; }

    std::optional<double> height_at(double x_m, double y_m) const override {
        const double half_m = half_extent_m().x;
        if (std::abs(x_m) >= half_m || std::abs(y_m) >= half_m) { return std::nullopt; }
        return height_(x_m, y_m);
    }

    /// World place of a corner of the cells.
    glm::dvec3 corner_m(int column, int row) const {
        const glm::dvec2 at_m = glm::dvec2(column, row) * cell_m_ - half_extent_m();
        return glm::dvec3(at_m, height_(at_m.x, at_m.y));
    }

    glm::dvec2 half_extent_m() const override { return glm::dvec2(0.5 * cells_ * cell_m_); }

    double mean_height_m() const override { return 0.0; }

    glm::vec3 mean_colour() const override { return glm::vec3(0.5F); }

private:
    std::unique_ptr<landscape::GroundMesher> make_mesher() const override;

    int cells_;
    double cell_m_;
    Height height_;
};

class CellMesher final : public landscape::GroundMesher {
public:
    explicit CellMesher(std::shared_ptr<const CellGround> ground)
        : ground_(std::move(ground)), cells_(ground_->cells()) {}

    const landscape::Ground& ground() const override { return *ground_; }

    scene::TriangleDraw triangles(const landscape::MeshRequest& request, landscape::GroundCounts& counts) override {
        eye_m_ = request.camera.eye_m;
        vertices_.clear();
        indices_.clear();
        for (int row = 0; row <= cells_; ++row) {
            for (int column = 0; column <= cells_; ++column) {
                vertices_.push_back({glm::vec3(ground_->corner_m(column, row) - eye_m_), 0xff808080U});
            }
        }
        for (const int row : far_to_near(eye_m_.y)) {
            for (const int column : far_to_near(eye_m_.x)) { add_cell(row, column); }
        }
        counts = {static_cast<int>(indices_.size() / 3), 0, 0.0};
        return {vertices_, indices_};
    }

    void triangles_in(const BoxTest& wanted, std::vector<std::uint32_t>& triangles) const override {
        for (std::uint32_t i = 0; i < indices_.size() / 3; ++i) {
            const auto corner_m = [&](std::uint32_t corner) {
                return glm::dvec3(vertices_[indices_[3 * i + corner]].position_m) + eye_m_;
            };
            if (wanted(glm::min(glm::min(corner_m(0), corner_m(1)), corner_m(2)),
                    glm::max(glm::max(corner_m(0), corner_m(1)), corner_m(2)))) {
                triangles.push_back(i);
            }
        }
    }

private:
    std::vector<int> far_to_near(double eye_m) const {
        const auto eye_cell = static_cast<int>(std::floor(eye_m / ground_->cell_m() + 0.5 * cells_));
        std::vector<int> order;
        for (int i = 0; i < cells_; ++i) { order.push_back(i); }
        std::ranges::stable_sort(order, [&](int a, int b) { return std::abs(a - eye_cell) > std::abs(b - eye_cell); });
        return order;
    }

    /// South-west, south-east, north-east; south-west, north-east, north-west: the one on the eye's side of the
    /// diagonal last.
    void add_cell(int row, int column) {
        const auto at = [&](int r, int c) { return static_cast<std::uint32_t>(r * (cells_ + 1) + c); };
        const std::uint32_t sw = at(row, column);
        const std::uint32_t se = at(row, column + 1);
        const std::uint32_t ne = at(row + 1, column + 1);
        const std::uint32_t nw = at(row + 1, column);
        const glm::vec3 corner = vertices_[sw].position_m;
        const bool eye_north_west = -corner.y > -corner.x;
        if (eye_north_west) {
            indices_.insert(indices_.end(), {sw, se, ne, sw, ne, nw});
        } else {
            indices_.insert(indices_.end(), {sw, ne, nw, sw, se, ne});
        }
    }

    std::shared_ptr<const CellGround> ground_;
    int cells_;
    glm::dvec3 eye_m_{0.0};
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

std::unique_ptr<landscape::GroundMesher> CellGround::make_mesher() const {
    return std::make_unique<CellMesher>(std::static_pointer_cast<const CellGround>(shared_from_this()));
}

class TriangleGround final : public landscape::Ground {
public:
    explicit TriangleGround(std::vector<GroundTriangle> triangles) : triangles_(std::move(triangles)) {}

    const std::vector<GroundTriangle>& triangles() const { return triangles_; }

    std::optional<double> height_at(double /*x_m*/, double /*y_m*/) const override { return 0.0; }

    glm::dvec2 half_extent_m() const override { return glm::dvec2(1000.0); }

    double mean_height_m() const override { return 0.0; }

    glm::vec3 mean_colour() const override { return glm::vec3(0.5F); }

private:
    std::unique_ptr<landscape::GroundMesher> make_mesher() const override;

    std::vector<GroundTriangle> triangles_;
};

class TriangleMesher final : public landscape::GroundMesher {
public:
    explicit TriangleMesher(std::shared_ptr<const TriangleGround> ground) : ground_(std::move(ground)) {}

    const landscape::Ground& ground() const override { return *ground_; }

    scene::TriangleDraw triangles(const landscape::MeshRequest& request, landscape::GroundCounts& counts) override {
        vertices_.clear();
        indices_.clear();
        for (const GroundTriangle& triangle : ground_->triangles()) {
            for (const glm::dvec3& corner_m : triangle) {
                indices_.push_back(static_cast<std::uint32_t>(vertices_.size()));
                vertices_.push_back({glm::vec3(corner_m - request.camera.eye_m), 0xff808080U});
            }
        }
        counts = {static_cast<int>(ground_->triangles().size()), 0, 0.0};
        return {vertices_, indices_};
    }

    void triangles_in(const BoxTest& /*wanted*/, std::vector<std::uint32_t>& triangles) const override {
        for (std::uint32_t i = 0; i < ground_->triangles().size(); ++i) { triangles.push_back(i); }
    }

private:
    std::shared_ptr<const TriangleGround> ground_;
    std::vector<models::ColourVertex> vertices_;
    std::vector<std::uint32_t> indices_;
};

std::unique_ptr<landscape::GroundMesher> TriangleGround::make_mesher() const {
    return std::make_unique<TriangleMesher>(std::static_pointer_cast<const TriangleGround>(shared_from_this()));
}

} // namespace

std::shared_ptr<const landscape::Ground> triangle_ground(std::vector<GroundTriangle> triangles) {
    return std::make_shared<TriangleGround>(std::move(triangles));
}

glm::dquat PlaceDice::attitude() {
    const glm::dvec4 q(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
    return glm::normalize(glm::dquat(q.x, q.y, q.z, q.w + 1e-3));
}

std::shared_ptr<const landscape::Ground> cell_ground(int cells, double cell_m, const Height& height) {
    return std::make_shared<CellGround>(cells, cell_m, height);
}

models::polygons::PolygonModel box_model(const glm::dvec3& half_m) {
    models::polygons::PolygonModel model;
    model.name = "box";
    model.materials.emplace_back();
    model.parts.emplace_back("default");
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 normal(0.0);
            glm::dvec3 right(0.0);
            normal[axis] = side;
            right[(axis + 1) % 3] = 1.0;
            const glm::dvec3 up = glm::cross(normal, right);
            const auto first = static_cast<std::uint32_t>(model.vertices_m.size());
            model.polygons.push_back({first, 4, 0, 0});
            for (const glm::dvec3& corner : {-right - up, right - up, right + up, up - right}) {
                model.corner_vertices.push_back(static_cast<std::uint32_t>(model.vertices_m.size()));
                model.vertices_m.push_back(half_m * (normal + corner));
            }
        }
    }
    return model;
}

planning::AircraftModel convex_aircraft(models::polygons::PolygonModel model) {
    visuals::draworder::DrawOrder order = visuals::draworder::file_order(model);
    return planning::aircraft_model(std::move(model), std::move(order), glm::dvec3(0.0));
}

planning::AircraftModel concave_aircraft(double scale) {
    models::polygons::PolygonModel model =
        models::polygons::read_obj(std::filesystem::path(OCTANT_SOURCE_DIR) / "models" / "concave.obj");
    for (glm::dvec3& vertex_m : model.vertices_m) { vertex_m *= scale; }
    visuals::draworder::DrawOrder order(visuals::draworder::paper_orders(model));
    return planning::aircraft_model(std::move(model), std::move(order), glm::dvec3(0.0));
}

sim::AircraftState state_at(const glm::dvec3& position_m, const glm::dquat& attitude) {
    sim::AircraftState state;
    state.position_m = position_m;
    state.body_to_world = attitude;
    return state;
}

scene::Settings plain_settings() {
    scene::Settings settings;
    settings.view.size_px = {640, 480};
    settings.air.sky = false;
    settings.surface.shadows = false;
    return settings;
}

} // namespace octant::tests
