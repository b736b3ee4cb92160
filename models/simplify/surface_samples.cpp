// Samples of the original surface that track the error. Weighted by area they approximate the integral of the squared
// distance over the original. Lists of samples at triangles make the cost of a step independent of the size of the
// mesh.

#include "models/simplify/surface_samples.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace octant::models::simplify {

// Point-to-triangle distances for several samples at once. Simplification spends most of its time here: each collapse
// measures some dozens of samples against about a dozen triangles. The inner loop has no branches and is written once
// for vectors of 4 floats (any processor) and 8 floats (AVX2, chosen at run time). Each lane computes the same
// operations in the same order, thus results do not depend on the width.

namespace {

/// Vectors of four floats and four integers, which the compiler maps to any processor.
struct Narrow {
    using Floats = float __attribute__((vector_size(16)));
    using Ints = std::int32_t __attribute__((vector_size(16)));
    static constexpr std::size_t lanes = 4;
};

/// Vectors of eight floats and eight integers.
struct Wide {
    using Floats = float __attribute__((vector_size(32)));
    using Ints = std::int32_t __attribute__((vector_size(32)));
    static constexpr std::size_t lanes = 8;
};

template <typename V, typename T>
OCTANT_INLINE void load(V& out, const T* from) {
    std::memcpy(&out, from, sizeof(V));
}

template <typename V, typename T>
OCTANT_INLINE void store(const V& value, T* to) {
    std::memcpy(to, &value, sizeof(V));
}

/// The squared differences between the colours of samples and those at positions (x, y) of a triangle.
template <typename F>
OCTANT_INLINE void colour_errors(
    F& error2, SampleBlock& samples, std::size_t i, const FlatTriangle& t, const F& x, const F& y) {
    error2 = F{};
    const std::array<const float*, 3> colours = {&samples.red[i], &samples.green[i], &samples.blue[i]};
    for (std::size_t part = 0; part < 3; ++part) {
        F colour;
        load(colour, colours[part]);
        const F off = t.colour[part] + x * t.colour_x[part] + y * t.colour_y[part] - colour;
        error2 += off * off;
    }
}

/// Compares one triangle with the next few samples and keeps it where it is nearer. Without branches; each point's
/// result is the same whatever the width.
template <typename Width, bool coloured>
OCTANT_INLINE void nearest_to_one(SampleBlock& samples, std::size_t i, const FlatTriangle& t, std::int32_t index) {
    using F = typename Width::Floats;
    std::array<F, 3> place;
    load(place[0], &samples.x[i]);
    load(place[1], &samples.y[i]);
    load(place[2], &samples.z[i]);
    measure::FramePoints<F> found;
    measure::find_in_frame<coloured>(found, place, t);
    F known;
    load(known, &samples.distances2[i]);
    const auto is_nearer = found.distance2 < known;
    if constexpr (coloured) {
        const F foot_x = found.x - found.feet.away_x;
        const F foot_y = found.y - found.feet.away_y;
        F error2, known_error2;
        colour_errors(error2, samples, i, t, foot_x, foot_y);
        load(known_error2, &samples.colour_errors2[i]);
        store(F(is_nearer ? error2 : known_error2), &samples.colour_errors2[i]);
    }
    typename Width::Ints nearest;
    load(nearest, &samples.nearest[i]);
    nearest = is_nearer ? typename Width::Ints{} + index : nearest;
    store(nearest, &samples.nearest[i]);
    store(F(is_nearer ? found.distance2 : known), &samples.distances2[i]);
}

/// Compares all triangles with all samples.
template <typename Width, bool coloured>
OCTANT_INLINE void nearest_to_all(SampleBlock& samples, std::span<const FlatTriangle> triangles) {
    std::fill_n(samples.distances2.begin(), samples.size(), std::numeric_limits<float>::max());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < samples.size(); i += Width::lanes) {
            nearest_to_one<Width, coloured>(samples, i, triangles[t], static_cast<std::int32_t>(t));
        }
    }
}

#if defined(__x86_64__) && defined(__GNUC__)
#define OCTANT_HAS_WIDE_VECTORS 1

/// The same operations, eight samples at a time. AVX2 alone does not fuse multiplications and additions, so that the
/// bits are the same.
[[gnu::target("avx2")]] void find_nearest_wide(
    SampleBlock& samples, std::span<const FlatTriangle> triangles, bool coloured) {
    if (coloured) {
        nearest_to_all<Wide, true>(samples, triangles);
    } else {
        nearest_to_all<Wide, false>(samples, triangles);
    }
}

bool has_wide_vectors() {
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    return wide;
}
#endif

} // namespace

FlatTriangle flat(const std::array<glm::dvec3, 3>& corners) { return {measure::plane_frame(corners), {}, {}, {}}; }

FlatTriangle flat(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec3, 3>& corner_colours) {
    FlatTriangle t = flat(corners);
    const auto length = static_cast<double>(t.bx);
    const auto up = static_cast<double>(t.cy);
    const glm::dvec3 to_b = corner_colours[1] - corner_colours[0];
    const glm::dvec3 to_c = corner_colours[2] - corner_colours[0];
    const glm::dvec3 along_x = length > 0.0 ? to_b / length : glm::dvec3(0.0);
    const glm::dvec3 along_y = up > 1e-6 * length ? (to_c - along_x * static_cast<double>(t.cx)) / up : glm::dvec3(0.0);
    t.colour = measure::narrow(corner_colours[0]);
    t.colour_x = measure::narrow(along_x);
    t.colour_y = measure::narrow(along_y);
    return t;
}

void SampleBlock::make_room(std::size_t samples) {
    if (samples + 8 > x.size()) {
        const std::size_t room = 2 * samples + 8;
        for (auto* values : {&x, &y, &z, &weights, &red, &green, &blue, &distances2, &colour_errors2}) {
            values->resize(room);
        }
        numbers.resize(room);
        nearest.resize(room);
    }
}

void find_nearest(SampleBlock& samples, std::span<const FlatTriangle> triangles, bool coloured) {
    assert(!triangles.empty());
#if defined(OCTANT_HAS_WIDE_VECTORS)
    if (has_wide_vectors()) {
        find_nearest_wide(samples, triangles, coloured);
        return;
    }
#endif
    if (coloured) {
        nearest_to_all<Narrow, true>(samples, triangles);
    } else {
        nearest_to_all<Narrow, false>(samples, triangles);
    }
}

namespace {

/// The share of the area that vertices stand for where there are samples between them.
constexpr double vertex_share = 0.3;

/// The barycentric weights of point `i` of the R2 sequence (M. Roberts, 2018), folded into a triangle.
glm::dvec3 spread_weights(std::size_t i) {
    const double step = 0.5 + static_cast<double>(i);
    double u = std::fmod(step * 0.7548776662466927, 1.0);
    double v = std::fmod(step * 0.5698402909980532, 1.0);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {1.0 - u - v, u, v};
}

} // namespace

SurfaceSamples::SurfaceSamples(const WorkingSurface& original, std::size_t wanted) {
    const CollapsibleMesh& mesh = original.mesh;
    std::vector<double> areas(mesh.face_slots(), 0.0);
    std::vector<double> vertex_areas(mesh.vertex_slots(), 0.0);
    for (std::uint32_t face = 0; face < mesh.face_slots(); ++face) {
        areas[face] = 0.5 * glm::length(area_vector(original.corner_places(face)));
        for (const std::uint32_t vertex : mesh.corners(face)) { vertex_areas[vertex] += areas[face] / 3.0; }
    }
    make_face_room(mesh.face_slots());
    const std::size_t vertices = mesh.vertex_count();
    samples_.reserve(std::max(wanted, vertices));
    if (wanted <= vertices) {
        add_on_faces(original, areas, std::max<std::size_t>(wanted, 1), false);
        add_to_unsampled_shells(original, areas);
        return;
    }
    for (double& area : vertex_areas) { area *= vertex_share; }
    add_vertices(original, vertex_areas);
    add_on_faces(original, areas, std::max(wanted - vertices, wanted / 4), true);
}

void SurfaceSamples::add_vertices(const WorkingSurface& from, std::span<const double> areas) {
    for (std::uint32_t vertex = 0; vertex < areas.size(); ++vertex) {
        if (!from.mesh.has_vertex(vertex)) { continue; }
        const std::uint32_t face = from.mesh.face_at(vertex);
        glm::dvec3 weights(0.0);
        for (int i = 0; i < 3; ++i) {
            weights[i] = from.mesh.corners(face)[static_cast<std::size_t>(i)] == vertex ? 1.0 : 0.0;
        }
        add(from, face, weights, areas[vertex]);
    }
}

/// Adds points spread evenly over the area: point k at (k + 1/2) / count of the accumulated area. Where vertices are no
/// samples by themselves, the point of a small triangle is a corner, as corners are what sticks out.
void SurfaceSamples::add_on_faces(
    const WorkingSurface& from, std::span<const double> areas, std::size_t count, bool with_vertices) {
    double total = 0.0;
    for (const double area : areas) { total += area; }
    const double spacing = total / static_cast<double>(count);
    double end = 0.0;
    std::size_t placed = 0;
    for (std::uint32_t face = 0; face < areas.size(); ++face) {
        end += areas[face];
        const auto until = std::min(count, static_cast<std::size_t>(std::max(0.0, end / spacing + 0.5)));
        const std::size_t here = spacing > 0.0 && until > placed ? until - placed : 0;
        for (std::size_t i = 0; i < here; ++i) {
            glm::dvec3 weights = spread_weights(i);
            if (here == 1) {
                const bool is_small = !with_vertices && areas[face] < 0.5 * spacing;
                weights = glm::dvec3(is_small ? 0.0 : 1.0 / 3.0);
                weights[0] = is_small ? 1.0 : weights[0];
            }
            add(from, face, weights, (with_vertices ? 1.0 - vertex_share : 1.0) * spacing);
        }
        placed += here;
    }
}

/// Adds the middle of the largest triangle of each shell that has no sample.
void SurfaceSamples::add_to_unsampled_shells(const WorkingSurface& from, std::span<const double> areas) {
    const CollapsibleMesh& mesh = from.mesh;
    std::vector<bool> is_found(areas.size(), false);
    std::vector<std::uint32_t> shell;
    for (std::uint32_t start = 0; start < areas.size(); ++start) {
        if (is_found[start] || !mesh.has_face(start)) { continue; }
        is_found[start] = true;
        shell.assign(1, start);
        std::uint32_t largest = start;
        double area = 0.0;
        bool is_bare = true;
        for (std::size_t i = 0; i < shell.size(); ++i) {
            const std::uint32_t face = shell[i];
            area += areas[face];
            largest = areas[face] > areas[largest] ? face : largest;
            is_bare = is_bare && counts_[face] == 0;
            for (HalfEdge h = 3 * face; h < 3 * face + 3; ++h) {
                const HalfEdge twin = mesh.twin(h);
                if (twin != none && !is_found[face_of(twin)]) {
                    is_found[face_of(twin)] = true;
                    shell.push_back(face_of(twin));
                }
            }
        }
        if (is_bare) { add(from, largest, glm::dvec3(1.0 / 3.0), area); }
    }
}

/// Adds a sample on a triangle of the original.
void SurfaceSamples::add(const WorkingSurface& from, std::uint32_t face, const glm::dvec3& weights, double area) {
    const std::array<glm::dvec3, 3> corners = from.corner_places(face);
    const Triangle& vertices = from.mesh.corners(face);
    SurfaceSample sample;
    sample.place = measure::narrow(weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2]);
    sample.weight = static_cast<float>(area);
    if (from.coloured()) {
        colours_.push_back(
            measure::narrow(weights.x * from.colours[vertices[0]] + weights.y * from.colours[vertices[1]] +
                            weights.z * from.colours[vertices[2]]));
    }
    const auto number = static_cast<std::uint32_t>(samples_.size());
    sample.face = face;
    sample.triangle = face;
    sample.next = first_[face];
    samples_.push_back(sample);
    first_[face] = number;
    ++counts_[face];
}

void SurfaceSamples::gather(std::uint32_t face, SampleBlock& block) const {
    block.make_room(block.size() + counts_[face]);
    for_each(face, [&](std::uint32_t number) {
        const SurfaceSample& sample = samples_[number];
        if (coloured()) {
            const std::array<float, 3>& colour = colours_[number];
            block.red[block.size()] = colour[0];
            block.green[block.size()] = colour[1];
            block.blue[block.size()] = colour[2];
        }
        block.add(number, sample.place, sample.weight);
    });
}

void SurfaceSamples::assign(
    const SampleBlock& block, std::span<const std::uint32_t> emptied, std::span<const std::uint32_t> faces) {
    for (const std::uint32_t face : emptied) { clear(face); }
    for (std::size_t i = 0; i < block.size(); ++i) {
        SurfaceSample& sample = samples_[block.numbers[i]];
        const std::uint32_t face = faces[static_cast<std::size_t>(block.nearest[i])];
        sample.next = first_[face];
        first_[face] = block.numbers[i];
        sample.face = face;
        sample.distance2 = block.distances2[i];
        sample.colour_error2 = coloured() ? block.colour_errors2[i] : 0.0F;
        ++counts_[face];
        errors_[face] += error_of(sample);
    }
}

double SurfaceSamples::error_of(const SurfaceSample& sample) const {
    return static_cast<double>(sample.weight) *
           (penalty_.of(static_cast<double>(sample.distance2)) + static_cast<double>(sample.colour_error2));
}

void SurfaceSamples::clear(std::uint32_t face) {
    first_[face] = none;
    counts_[face] = 0;
    errors_[face] = 0.0;
    back_errors_[face] = 0.0;
}

void SurfaceSamples::put(std::uint32_t sample, std::uint32_t face, float distance2) {
    SurfaceSample& put = samples_[sample];
    put.next = first_[face];
    put.face = face;
    put.distance2 = distance2;
    first_[face] = sample;
    ++counts_[face];
    errors_[face] += error_of(put);
}

void SurfaceSamples::make_face_room(std::size_t count) {
    first_.resize(std::max(count, first_.size()), none);
    counts_.resize(first_.size(), 0);
    errors_.resize(first_.size(), 0.0);
    back_errors_.resize(first_.size(), 0.0);
}

void SurfaceSamples::assign_all(
    std::span<const std::uint32_t> faces, std::span<const float> distances2, const CollapsibleMesh& mesh) {
    const std::size_t face_slots = mesh.face_slots();
    // Fresh ones: there may have been far more triangles.
    first_ = std::vector<std::uint32_t>(face_slots, none);
    counts_ = std::vector<std::uint32_t>(face_slots, 0);
    errors_ = std::vector<double>(face_slots, 0.0);
    back_errors_ = std::vector<double>(face_slots, 0.0);
    from_faces_ = std::vector<std::array<BackwardFoot, 3>>(face_slots);
    from_vertices_ = std::vector<BackwardFoot>(mesh.vertex_slots());
    for (std::uint32_t number = 0; number < samples_.size(); ++number) {
        samples_[number].face = faces[number];
        samples_[number].distance2 = distances2[number];
    }
    sort();
}

void SurfaceSamples::sort() {
    std::ranges::fill(first_, none);
    std::ranges::fill(counts_, 0U);
    std::vector<std::uint32_t> ends(first_.size() + 1, 0);
    for (const SurfaceSample& sample : samples_) {
        ++counts_[sample.face];
        ++ends[sample.face + 1];
    }
    for (std::size_t face = 0; face < first_.size(); ++face) { ends[face + 1] += ends[face]; }
    const std::vector<SurfaceSample> before = std::move(samples_);
    const std::vector<std::array<float, 3>> colours = std::move(colours_);
    samples_.resize(before.size());
    colours_.resize(colours.size());
    for (std::uint32_t number = 0; number < before.size(); ++number) {
        const std::uint32_t face = before[number].face;
        const std::uint32_t place = ends[face]++;
        samples_[place] = before[number];
        samples_[place].next = first_[face];
        first_[face] = place;
        if (!colours.empty()) { colours_[place] = colours[number]; }
    }
    set_penalty(penalty_);
}

void SurfaceSamples::drop_lists() {
    first_ = {};
    counts_ = {};
    errors_ = {};
    back_errors_ = {};
}

void SurfaceSamples::set_penalty(const Penalty& penalty) {
    penalty_ = penalty;
    std::ranges::fill(errors_, 0.0);
    for (const SurfaceSample& sample : samples_) { errors_[sample.face] += error_of(sample); }
}

double SurfaceSamples::mean2() const {
    double sum = 0.0;
    double area = 0.0;
    for (const SurfaceSample& sample : samples_) {
        const auto weight = static_cast<double>(sample.weight);
        sum += weight * static_cast<double>(sample.distance2);
        area += weight;
    }
    return area > 0.0 ? sum / area : 0.0;
}

std::uint32_t nearest_face_from(const WorkingSurface& surface, std::uint32_t start, const std::array<float, 3>& place,
    float& distance2, std::span<const FlatTriangle> triangles) {
    const CollapsibleMesh& mesh = surface.mesh;
    std::uint32_t nearest = start;
    distance2 = std::numeric_limits<float>::max();
    std::uint32_t looked = none;
    while (nearest != looked) {
        looked = nearest;
        for (const std::uint32_t corner : mesh.corners(looked)) {
            mesh.around(corner, [&](HalfEdge h) {
                measure::FramePoints<float> found;
                if (triangles.empty()) {
                    measure::find_in_frame<false>(found, place, flat(surface.corner_places(face_of(h))));
                } else {
                    measure::find_in_frame<false>(found, place, triangles[face_of(h)]);
                }
                if (found.distance2 < distance2) {
                    distance2 = found.distance2;
                    nearest = face_of(h);
                }
            });
        }
    }
    return nearest;
}

} // namespace octant::models::simplify
