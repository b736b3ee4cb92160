// The cost that orders all steps: Y. Kim, B. U. Lee, "Error measure for vertex simplification", 2005, section II.2,
// distance to triangles in both directions, but against the original surface instead of the mesh before: from samples
// of it, and back to it by a walk over its triangles from the last known nearest point (nearest_from); by a tree only
// where measured densely. The way back counts more where the original faces against the triangle, so that no
// triangle folds over.
//
// VertexFit holds the normal equations of one vertex. A point at distance d from the surface wants the surface to move
// by d along the direction to the point; the vertex takes part in that by its barycentric weight. Three equations
// result, slightly damped (Levenberg-Marquardt), so that a vertex in a flat surrounding does not slide.
#include "models/simplify/local_error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace octant::models::simplify {

namespace {

/// The weight of the distance along the triangle; the distance across it has the weight 1. 0 would be a Gauss-Newton
/// step (point-to-plane); 1 the slower convergence of iterated closest points.
constexpr double sideways = 0.1;

/// The point of a triangle nearest to a point of its plane, in the plane's coordinates.
struct FlatFoot {
    double x = 0.0;
    double y = 0.0;
    bool inside = true;
};

/// The point of a triangle nearest to the point (x, y) of its plane.
FlatFoot foot_of(double x, double y, const FlatTriangle& t) {
    const double bx = static_cast<double>(t.bx);
    const double cx = static_cast<double>(t.cx);
    const double cy = static_cast<double>(t.cy);
    if (y >= 0.0 && (cx - bx) * y - cy * (x - bx) >= 0.0 && cy * x - cx * y >= 0.0) { return {x, y, true}; }
    FlatFoot foot;
    double best2 = std::numeric_limits<double>::infinity();
    // The edge from (ax, ay) along (ex, ey).
    const auto take = [&](double ax, double ay, double ex, double ey, float per_length2) {
        const double share = ((x - ax) * ex + (y - ay) * ey) * static_cast<double>(per_length2);
        const double along = std::clamp(share, 0.0, 1.0);
        const double fx = ax + along * ex;
        const double fy = ay + along * ey;
        const double away2 = (x - fx) * (x - fx) + (y - fy) * (y - fy);
        if (away2 < best2) {
            best2 = away2;
            foot = {fx, fy, false};
        }
    };
    take(0.0, 0.0, bx, 0.0, t.per_ab2);
    take(bx, 0.0, cx - bx, cy, t.per_bc2);
    take(0.0, 0.0, cx, cy, t.per_ca2);
    return foot;
}

} // namespace

void VertexFit::add(const glm::dvec3& off, const glm::dvec3& normal, double share, double weight) {
    const double length2 = glm::dot(off, off);
    const glm::dvec3 direction = length2 > 1e-16 ? off / std::sqrt(length2) : normal;
    matrix_.add_plane(direction, 0.0, weight * share * share);
    const double along = sideways * weight * share * share;
    matrix_.xx += along;
    matrix_.yy += along;
    matrix_.zz += along;
    right_side_ += ((1.0 + sideways) * weight * share) * off;
}

void VertexFit::add_colour(
    const glm::dvec3& off, const std::array<glm::dvec3, 3>& gradient, double share, double weight) {
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& slope = gradient[static_cast<std::size_t>(i)];
        matrix_.add_plane(slope, 0.0, weight * share * share);
        right_side_ -= (weight * share * off[i]) * slope;
    }
    colour_weight_ += weight * share * share;
    colour_sum_ += (weight * share) * off;
}

glm::dvec3 VertexFit::way() const {
    Quadric held = matrix_;
    const double hold = 1e-3 * matrix_.trace();
    held.xx += hold;
    held.yy += hold;
    held.zz += hold;
    return solved(held, right_side_, glm::dvec3(0.0));
}

glm::dvec3 VertexFit::colour_change() const {
    return colour_weight_ > 0.0 ? colour_sum_ / colour_weight_ : glm::dvec3(0.0);
}

namespace {

/// Adds sample `i` of a block after find_nearest; `t` is its nearest triangle.
void add_sample(
    VertexFit& fit, const SampleBlock& samples, std::size_t i, const FlatTriangle& t, double weight, bool coloured) {
    const glm::dvec3 d(static_cast<double>(samples.x[i]) - static_cast<double>(t.origin[0]),
        static_cast<double>(samples.y[i]) - static_cast<double>(t.origin[1]),
        static_cast<double>(samples.z[i]) - static_cast<double>(t.origin[2]));
    const glm::dvec3 x_axis = widen(t.x_axis);
    const glm::dvec3 y_axis = widen(t.y_axis);
    const FlatFoot foot = foot_of(glm::dot(d, x_axis), glm::dot(d, y_axis), t);
    const double c = t.cy > 0.0F ? foot.y / static_cast<double>(t.cy) : 0.0;
    const double b = t.bx > 0.0F ? (foot.x - c * static_cast<double>(t.cx)) / static_cast<double>(t.bx) : 0.0;
    const double share = std::clamp(1.0 - b - c, 0.0, 1.0);
    if (share <= 0.0) { return; }
    const glm::dvec3 off = d - foot.x * x_axis - foot.y * y_axis;
    fit.add(off, widen(t.normal), share, weight);
    if (coloured) {
        const glm::dvec3 colour(samples.red[i], samples.green[i], samples.blue[i]);
        const glm::dvec3 along_x = widen(t.colour_x);
        const glm::dvec3 along_y = widen(t.colour_y);
        const glm::dvec3 here = widen(t.colour) + foot.x * along_x + foot.y * along_y;
        std::array<glm::dvec3, 3> gradient{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
        for (int part = 0; foot.inside && part < 3; ++part) {
            gradient[static_cast<std::size_t>(part)] = along_x[part] * x_axis + along_y[part] * y_axis;
        }
        fit.add_colour(colour - here, gradient, share, weight);
    }
}

/// The shares of a triangle's area for which three points on it and its corners stand. The points alone would do for
/// the mean (Gauss), but the largest distance mostly is that of a vertex.
constexpr double point_share = 0.3;
constexpr double corner_share = 0.1 / 3.0;
constexpr double near_weight = 2.0 / 3.0;
constexpr double far_weight = 1.0 / 6.0;

/// The point that is nearest to a corner.
glm::dvec3 point_at(const std::array<glm::dvec3, 3>& corners, std::size_t corner) {
    return near_weight * corners[corner] + far_weight * (corners[(corner + 1) % 3] + corners[(corner + 2) % 3]);
}

} // namespace

void LocalError::gather(std::span<const std::uint32_t> faces) {
    block_.clear();
    gathered_.assign(faces.begin(), faces.end());
    current_forward_error_ = 0.0;
    current_backward_error_ = 0.0;
    for (const std::uint32_t face : faces) { samples_.prefetch(face); }
    for (const std::uint32_t face : faces) {
        samples_.gather(face, block_);
        current_forward_error_ += samples_.error(face) - samples_.back_error(face);
        current_backward_error_ += samples_.back_error(face);
    }
    area_ = 0.0;
    for (std::size_t i = 0; i < block_.size(); ++i) { area_ += static_cast<double>(block_.weights[i]); }
}

void LocalError::set_ring(std::span<const RingFace> ring, const glm::dvec3& place, const glm::dvec3& colour) {
    triangles_.clear();
    near_.clear();
    turns_.clear();
    moving_ = ring.empty() ? none : surface_.mesh.origin(ring.front().half_edge);
    for (const RingFace& face : ring) {
        const std::uint32_t next = surface_.mesh.target(face.half_edge);
        const std::uint32_t last = surface_.mesh.origin(previous_of(face.half_edge));
        triangles_.push_back({{none, next, last}, moved_corners(surface_, face, place),
            {colour, surface_.colour_of(next), surface_.colour_of(last)}});
        near_.push_back(face.face);
        turns_.push_back(face.half_edge % 3);
        for (const BackwardFoot& from : samples_.from_face(face.face)) {
            if (from.foot.triangle != none) { original_.prefetch(from.foot.triangle); }
        }
    }
    flatten();
}

void LocalError::move_corner(const glm::dvec3& place, const glm::dvec3& colour) {
    for (ColouredTriangle& triangle : triangles_) {
        triangle.places[0] = place;
        triangle.colours[0] = colour;
    }
    flatten();
}

void LocalError::set_triangles(std::span<const ColouredTriangle> triangles, std::span<const std::uint32_t> near) {
    triangles_.assign(triangles.begin(), triangles.end());
    near_.assign(near.begin(), near.end());
    turns_.assign(near.size(), 0);
    moving_ = none;
    flatten();
}

void LocalError::flatten() {
    flat_.clear();
    for (const ColouredTriangle& triangle : triangles_) {
        flat_.push_back(surface_.coloured() ? flat(triangle.places, triangle.colours) : flat(triangle.places));
    }
}

double LocalError::forward_error() {
    if (block_.size() == 0) { return 0.0; }
    find_nearest(block_, flat_, samples_.coloured());
    work_done_ += work();
    const Penalty& penalty = samples_.penalty();
    double sum = 0.0;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        sum += static_cast<double>(block_.weights[i]) * penalty.of(static_cast<double>(block_.distances2[i]));
    }
    if (samples_.coloured()) {
        for (std::size_t i = 0; i < block_.size(); ++i) {
            sum += static_cast<double>(block_.weights[i]) * static_cast<double>(block_.colour_errors2[i]);
        }
    }
    return sum;
}

BackwardFoot LocalError::backward_foot(const OriginalPoint& start, const glm::dvec3& place) const {
    BackwardFoot found;
    double distance2 = 0.0;
    found.foot = original_.nearest_from(start.triangle, place, distance2);
    found.distance2 = static_cast<float>(distance2);
    return found;
}

double LocalError::backward_error(double limit) {
    const Penalty& penalty = samples_.penalty();
    back_errors_.assign(triangles_.size(), 0.0);
    from_points_.resize(triangles_.size());
    max_back2_ = 0.0;
    back_points_.clear();
    if (!triangles_.empty() && triangles_[0].vertices[0] == none) {
        const BackwardFoot& near = moving_ != none ? samples_.from_vertex(moving_) : samples_.from_face(near_[0])[0];
        from_moving_ = backward_foot(near.foot, triangles_[0].places[0]);
        max_back2_ = is_dense_ ? 0.0 : static_cast<double>(from_moving_.distance2);
    }
    double sum = 0.0;
    for (std::size_t t = 0; t < triangles_.size() && sum <= limit; ++t) {
        const std::array<glm::dvec3, 3>& corners = triangles_[t].places;
        const glm::dvec3 normal = area_vector(corners);
        const double area = 0.5 * glm::length(normal);
        double mean = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            BackwardFoot& from = from_points_[t][i];
            from = backward_foot(samples_.from_face(near_[t])[(turns_[t] + i) % 3].foot, point_at(corners, i));
            if (glm::dot(original_.normal(from.foot.triangle), normal) < 0.0) {
                from.distance2 += static_cast<float>(area);
            }
            const auto distance2 = static_cast<double>(from.distance2);
            max_back2_ = std::max(max_back2_, is_dense_ ? 0.0 : distance2);
            mean += point_share * penalty.of(distance2);
        }
        for (const std::uint32_t vertex : triangles_[t].vertices) {
            const BackwardFoot& from = vertex == none ? from_moving_ : samples_.from_vertex(vertex);
            mean += corner_share * penalty.of(static_cast<double>(from.distance2));
        }
        if (is_dense_) { measure_densely(static_cast<std::uint32_t>(t)); }
        back_errors_[t] = area * mean;
        sum += back_errors_[t];
    }
    return sum;
}

void LocalError::measure_densely() {
    is_dense_ = true;
    const CollapsibleMesh& mesh = surface_.mesh;
    face_changed_.assign(mesh.face_slots(), 0);
    std::vector<Triangle> triangles;
    present_faces_.clear();
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (mesh.has_face(face)) {
            triangles.push_back(mesh.corners(face));
            present_faces_.push_back(face);
        }
    }
    present_tree_ = std::make_unique<const measure::TriangleBvh>(surface_.places, triangles);
}

/// A way back, or a shorter one if there is one on the whole original.
BackwardFoot LocalError::checked(const BackwardFoot& from, const glm::dvec3& place) const {
    if (static_cast<double>(from.distance2) <= trusted2_) { return from; }
    const measure::NearestOnMesh found = original_.nearest(place);
    if (found.distance2 >= static_cast<double>(from.distance2)) { return from; }
    return {{measure::narrow(found.point), found.triangle}, static_cast<float>(found.distance2)};
}

/// Measures from points of the edges of a new triangle, and collects all points of it.
void LocalError::measure_densely(std::uint32_t t) {
    const std::array<glm::dvec3, 3>& corners = triangles_[t].places;
    const std::array<BackwardFoot, 3>& inside = from_points_[t];
    const auto add = [&](const BackwardFoot& from, const glm::dvec3& place, double share) {
        const BackwardFoot shortest = checked(from, place);
        back_points_.push_back({widen(shortest.foot.place) - place, t, share});
        max_back2_ = std::max(max_back2_, static_cast<double>(shortest.distance2));
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = triangles_[t].vertices[i];
        add(vertex == none ? from_moving_ : samples_.from_vertex(vertex), corners[i], i == 0 ? 1.0 : 0.0);
        add(inside[i], point_at(corners, i), i == 0 ? near_weight : far_weight);
        const std::size_t next = (i + 1) % 3;
        for (const double along : {0.25, 0.5, 0.75}) {
            const glm::dvec3 place = (1.0 - along) * corners[i] + along * corners[next];
            const double share = i == 0 ? 1.0 - along : next == 0 ? along : 0.0;
            add(backward_foot(inside[along > 0.5 ? next : i].foot, place), place, share);
        }
    }
}

glm::dvec3 LocalError::max_error_step() {
    constexpr double others = 0.02; // So much even the nearest points weigh, of the farthest ones.
    VertexFit fit;
    const double max2 = std::max(max_distance2(), 1e-30);
    const auto weight = [&](double distance2) { return others + (distance2 / max2) * (distance2 / max2); };
    for (std::size_t i = 0; i < block_.size(); ++i) {
        const FlatTriangle& triangle = flat_[static_cast<std::size_t>(block_.nearest[i])];
        const double share = weight(static_cast<double>(block_.distances2[i]));
        add_sample(fit, block_, i, triangle, share, false);
    }
    for (const BackPoint& point : back_points_) {
        const glm::dvec3 normal = area_vector(triangles_[point.triangle].places);
        const double length = glm::length(normal);
        if (length > 0.0) {
            const double share = weight(glm::dot(point.off, point.off));
            fit.add(point.off, normal / length, point.share, share);
        }
    }
    return fit.way();
}

/// A triangle of the original from which to look for the foot of a point on a present triangle: that of the nearest
/// sample in the lists around it that faces its way. Of very many triangles around it some are left out.
std::uint32_t LocalError::start_near(std::uint32_t face, const glm::dvec3& place) {
    constexpr std::size_t max_looked = 256;
    constexpr double against = 100.0; // A factor of the squared distance.
    const CollapsibleMesh& mesh = surface_.mesh;
    const glm::dvec3 normal = area_vector(surface_.corner_places(face));
    std::uint32_t start = 0;
    double least2 = std::numeric_limits<double>::infinity();
    face_marks_.resize(mesh.face_slots(), 0);
    face_marks_[face] = ++face_mark_;
    start_candidates_.assign(1, face);
    for (std::size_t i = 0; i < start_candidates_.size(); ++i) {
        samples_.for_each(start_candidates_[i], [&](std::uint32_t number) {
            const SurfaceSample& sample = samples_[number];
            const bool faces_it = glm::dot(original_.normal(sample.triangle), normal) > 0.0;
            const glm::dvec3 off = widen(sample.place) - place;
            const double away2 = glm::dot(off, off) * (faces_it ? 1.0 : against);
            if (away2 < least2) {
                least2 = away2;
                start = sample.triangle;
            }
        });
        if (std::isfinite(least2) && (i > 0 || start_candidates_.size() >= max_looked)) { continue; }
        for (const std::uint32_t corner : mesh.corners(start_candidates_[i])) {
            mesh.around(corner, [&](HalfEdge h) {
                if (face_marks_[face_of(h)] != face_mark_ &&
                    (start_candidates_.size() < max_looked || !std::isfinite(least2))) {
                    face_marks_[face_of(h)] = face_mark_;
                    start_candidates_.push_back(face_of(h));
                }
            });
        }
    }
    return start;
}

/// Measures from the samples in the list of a present triangle, colours included.
void LocalError::measure_colours(std::uint32_t face) {
    const Triangle& corners = surface_.mesh.corners(face);
    for (std::size_t i = 0; i < 3; ++i) { triangles_[0].colours[i] = surface_.colours[corners[i]]; }
    flatten();
    block_.clear();
    samples_.gather(face, block_);
    forward_error();
    samples_.assign(block_, {&face, 1}, {&face, 1});
}

double LocalError::measure_all_back() {
    const CollapsibleMesh& mesh = surface_.mesh;
    const auto start_from = [&](BackwardFoot& from, std::uint32_t face, const glm::dvec3& place) {
        if (from.foot.triangle == none) { from.foot.triangle = start_near(face, place); }
    };
    double most2 = 0.0;
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_slots(); ++vertex) {
        if (mesh.has_vertex(vertex)) {
            BackwardFoot& from = samples_.from_vertex(vertex);
            start_from(from, mesh.face_at(vertex), surface_.places[vertex]);
            from = backward_foot(from.foot, surface_.places[vertex]);
            most2 = std::max(most2, static_cast<double>(from.distance2));
        }
    }
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        if (mesh.has_face(face)) {
            const std::array<glm::dvec3, 3> corners = surface_.corner_places(face);
            for (std::size_t i = 0; i < 3; ++i) { start_from(samples_.from_face(face)[i], face, point_at(corners, i)); }
            triangles_.assign(1, {mesh.corners(face), corners, {}});
            near_.assign(1, face);
            turns_.assign(1, 0);
            backward_error();
            if (samples_.coloured()) { measure_colours(face); }
            samples_.from_face(face) = from_points_[0];
            samples_.set_back_error(face, back_errors_[0]);
            most2 = std::max(most2, max_back2_);
        }
    }
    return most2;
}

double LocalError::measured(double limit) {
    const double there = forward_error();
    return there > limit ? there : there + backward_error(limit - there);
}

double LocalError::max_there2() {
    float max2 = 0.0F;
    for (std::size_t i = 0; i < block_.size(); ++i) {
        float& distance2 = block_.distances2[i];
        if (is_dense_ && distance2 > max2 && static_cast<double>(distance2) > trusted2_) {
            const measure::NearestOnMesh found =
                present_tree_->nearest(glm::dvec3(block_.x[i], block_.y[i], block_.z[i]));
            const std::uint32_t face = present_faces_[found.triangle];
            if (face_changed_[face] == 0 && std::ranges::find(gathered_, face) == gathered_.end()) {
                distance2 = std::min(distance2, static_cast<float>(found.distance2));
            }
        }
        max2 = std::max(max2, distance2);
    }
    return static_cast<double>(max2);
}

double LocalError::work() const {
    constexpr double work_of_foot = 40.0; // In distances to triangles.
    const auto triangles = static_cast<double>(triangles_.size());
    return triangles * (static_cast<double>(block_.size()) + 3.0 * work_of_foot);
}

VertexFit LocalError::fit(bool with_back) const {
    VertexFit fit;
    const Penalty& penalty = samples_.penalty();
    for (std::size_t i = 0; i < block_.size(); ++i) {
        const double weight =
            static_cast<double>(block_.weights[i]) * penalty.weight(static_cast<double>(block_.distances2[i]));
        const FlatTriangle& triangle = flat_[static_cast<std::size_t>(block_.nearest[i])];
        add_sample(fit, block_, i, triangle, weight, samples_.coloured());
    }
    double around = 0.0;
    for (std::size_t t = 0; with_back && t < triangles_.size(); ++t) {
        const glm::dvec3 normal = area_vector(triangles_[t].places);
        const double length = glm::length(normal);
        if (length > 0.0) {
            for (std::size_t i = 0; i < 3; ++i) {
                const BackwardFoot& from = samples_.from_face(near_[t])[(turns_[t] + i) % 3];
                const glm::dvec3 off = widen(from.foot.place) - point_at(triangles_[t].places, i);
                const double weight = 0.5 * length * penalty.weight(glm::dot(off, off));
                fit.add(off, normal / length, i == 0 ? near_weight : far_weight, point_share * weight);
            }
            around += 0.5 * length;
        }
    }
    if (with_back && moving_ != none && around > 0.0) {
        const BackwardFoot& from = samples_.from_vertex(moving_);
        const glm::dvec3 off = widen(from.foot.place) - triangles_[0].places[0];
        const glm::dvec3 normal = original_.normal(from.foot.triangle);
        const double length = glm::length(normal);
        if (length > 0.0) {
            const double weight = corner_share * around * penalty.weight(glm::dot(off, off));
            fit.add(off, normal / length, 1.0, weight);
        }
    }
    return fit;
}

void LocalError::keep(
    std::span<const std::uint32_t> emptied, std::span<const std::uint32_t> faces, std::uint32_t vertex) {
    if (is_dense_) {
        for (const std::span<const std::uint32_t> list : {emptied, faces}) {
            for (const std::uint32_t face : list) { face_changed_[face] = 1; }
        }
    }
    samples_.assign(block_, emptied, faces);
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const std::uint32_t first = triangles_[t].vertices[0];
        const Triangle corners = surface_.mesh.corners(faces[t]);
        std::size_t turn = moving_ != none ? turns_[t] : 0;
        while (moving_ == none && turn < 2 && corners[turn] != (first == none ? vertex : first)) { ++turn; }
        for (std::size_t i = 0; i < 3; ++i) { samples_.from_face(faces[t])[(turn + i) % 3] = from_points_[t][i]; }
        samples_.set_back_error(faces[t], back_errors_[t]);
    }
    if (vertex != none) { samples_.from_vertex(vertex) = from_moving_; }
}

} // namespace octant::models::simplify
