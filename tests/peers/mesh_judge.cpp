// Judges simplified meshes against their original by sampling: octant-mesh-judge ORIGINAL.obj RESULT.obj... Shares no
// code with the simplifiers: its own reader, nearest-point search and topology counts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>

#include "peers.h"

using namespace octant::tests::peers;

namespace {

using Vec = std::array<double, 3>;

Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vec operator*(const Vec& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec cross(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Triangle {
    Vec a, b, c;

    Vec normal() const { return cross(b - a, c - a); } ///< as long as twice the area
};

Vec nearest_on_segment(const Vec& p, const Vec& a, const Vec& b) {
    const Vec ab = b - a;
    const double length2 = dot(ab, ab);
    const double t = length2 > 0.0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    return a + ab * t;
}

double squared_distance(const Vec& p, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const Vec n = triangle.normal();
    const double n2 = dot(n, n);
    if (n2 > 0.0) {
        const bool inside = dot(cross(b - a, p - a), n) >= 0.0 && dot(cross(c - b, p - b), n) >= 0.0 &&
                            dot(cross(a - c, p - c), n) >= 0.0;
        if (inside) {
            const double height = dot(p - a, n);
            return height * height / n2;
        }
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Vec& q : {nearest_on_segment(p, a, b), nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)}) {
        least = std::min(least, dot(p - q, p - q));
    }
    return least;
}

/// A tree of boxes over the triangles of a mesh.
class Surface {
public:
    explicit Surface(const PeerMesh& mesh) : order_(mesh.triangles.size()) {
        for (const auto& [a, b, c] : mesh.triangles) {
            triangles_.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
        }
        std::iota(order_.begin(), order_.end(), 0U);
        nodes_.reserve(2 * order_.size());
        build(0, order_.size());
    }

    const Triangle& triangle(std::size_t i) const { return triangles_[i]; }

    /// The nearest triangle and its squared distance. `guess` is any triangle; a near one saves time.
    std::pair<std::size_t, double> nearest(const Vec& p, std::size_t guess) const {
        std::pair<std::size_t, double> best{guess, squared_distance(p, triangles_[guess])};
        nearest_in(0, p, best);
        return best;
    }

    /// True if a triangle within a distance has a normal that does not oppose `normal`.
    bool has_agreeing(const Vec& p, double distance, const Vec& normal) const {
        return has_agreeing_in(0, p, distance * distance, normal);
    }

private:
    struct Node {
        Vec min, max;
        std::size_t first = 0, last = 0; ///< of order_
        std::size_t right = 0;           ///< 0: a leaf; the left child is the next node
    };

    std::size_t build(std::size_t first, std::size_t last) {
        const std::size_t index = nodes_.size();
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Node node{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, first, last};
        for (std::size_t i = first; i < last; ++i) {
            const Triangle& triangle = triangles_[order_[i]];
            for (const Vec& corner : {triangle.a, triangle.b, triangle.c}) {
                for (std::size_t k = 0; k < 3; ++k) {
                    node.min[k] = std::min(node.min[k], corner[k]);
                    node.max[k] = std::max(node.max[k], corner[k]);
                }
            }
        }
        nodes_.push_back(node);
        if (last - first > 4) {
            const Vec size = node.max - node.min;
            const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
            const auto centre = [&](std::size_t i) {
                return triangles_[i].a[axis] + triangles_[i].b[axis] + triangles_[i].c[axis];
            };
            const std::size_t middle = (first + last) / 2;
            const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
            std::nth_element(
                at(first), at(middle), at(last), [&](std::size_t i, std::size_t j) { return centre(i) < centre(j); });
            build(first, middle);
            nodes_[index].right = build(middle, last);
        }
        return index;
    }

    static double squared_distance_to_box(const Vec& p, const Node& node) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double d = std::max({node.min[k] - p[k], 0.0, p[k] - node.max[k]});
            sum += d * d;
        }
        return sum;
    }

    void nearest_in(std::size_t index, const Vec& p, std::pair<std::size_t, double>& best) const {
        const Node& node = nodes_[index];
        if (node.right == 0) {
            for (std::size_t i = node.first; i < node.last; ++i) {
                const double d2 = squared_distance(p, triangles_[order_[i]]);
                if (d2 < best.second) { best = {order_[i], d2}; }
            }
            return;
        }
        std::array children = {index + 1, node.right};
        std::array distances = {
            squared_distance_to_box(p, nodes_[children[0]]), squared_distance_to_box(p, nodes_[children[1]])};
        if (distances[1] < distances[0]) {
            std::swap(children[0], children[1]);
            std::swap(distances[0], distances[1]);
        }
        for (std::size_t k = 0; k < 2; ++k) {
            if (distances.at(k) < best.second) { nearest_in(children.at(k), p, best); }
        }
    }

    bool has_agreeing_in(std::size_t index, const Vec& p, double limit2, const Vec& normal) const {
        const Node& node = nodes_[index];
        if (squared_distance_to_box(p, node) > limit2) { return false; }
        if (node.right != 0) {
            return has_agreeing_in(index + 1, p, limit2, normal) || has_agreeing_in(node.right, p, limit2, normal);
        }
        for (std::size_t i = node.first; i < node.last; ++i) {
            const Triangle& triangle = triangles_[order_[i]];
            if (dot(triangle.normal(), normal) >= 0.0 && squared_distance(p, triangle) <= limit2) { return true; }
        }
        return false;
    }

    std::vector<Triangle> triangles_;
    std::vector<std::size_t> order_;
    std::vector<Node> nodes_;
};

/// Vertices of equal position become one; triangles that lose a corner by this go.
PeerMesh welded(const PeerMesh& mesh) {
    std::map<Vec, std::uint32_t> places;
    std::vector<std::uint32_t> new_index;
    PeerMesh made;
    for (const Vec& vertex : mesh.vertices) {
        const auto [place, added] = places.emplace(vertex, static_cast<std::uint32_t>(made.vertices.size()));
        if (added) { made.vertices.push_back(vertex); }
        new_index.push_back(place->second);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::array<std::uint32_t, 3> now{new_index[a], new_index[b], new_index[c]};
        if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0]) { made.triangles.push_back(now); }
    }
    return made;
}

struct Topology {
    std::size_t open_edges = 0;
    std::size_t non_manifold_edges = 0; ///< with three triangles or more
    std::size_t shells = 0;             ///< parts joined by vertices
    /// By triangle: which part joined by edges of two triangles that are oriented alike.
    std::vector<std::uint32_t> patches;
};

/// An edge as one triangle has it.
struct EdgeUse {
    std::uint32_t low, high, triangle;
    bool rising; ///< the triangle runs from the lower vertex to the higher one
};

std::vector<EdgeUse> edge_uses(const PeerMesh& mesh) {
    std::vector<EdgeUse> uses;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangles[i].at(k);
            const std::uint32_t b = mesh.triangles[i].at((k + 1) % 3);
            uses.push_back({std::min(a, b), std::max(a, b), i, a < b});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
        return std::tie(x.low, x.high, x.triangle) < std::tie(y.low, y.high, y.triangle);
    });
    return uses;
}

std::size_t count_shells(const PeerMesh& mesh) {
    std::vector<std::uint32_t> parents(mesh.vertices.size());
    std::iota(parents.begin(), parents.end(), 0U);
    const auto root = [&](std::uint32_t vertex) {
        while (parents[vertex] != vertex) { vertex = parents[vertex] = parents[parents[vertex]]; }
        return vertex;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        parents[root(b)] = root(a);
        parents[root(c)] = root(a);
    }
    std::set<std::uint32_t> roots;
    for (const auto& triangle : mesh.triangles) { roots.insert(root(triangle[0])); }
    return roots.size();
}

Topology topology(const PeerMesh& mesh) {
    Topology found;
    const std::vector<EdgeUse> uses = edge_uses(mesh);
    std::vector<std::vector<std::uint32_t>> neighbours(mesh.triangles.size());
    for (std::size_t i = 0; i < uses.size();) {
        const std::size_t first = i;
        while (i < uses.size() && uses[i].low == uses[first].low && uses[i].high == uses[first].high) { ++i; }
        found.open_edges += i - first == 1 ? 1U : 0U;
        found.non_manifold_edges += i - first > 2 ? 1U : 0U;
        if (i - first == 2 && uses[first].rising != uses[first + 1].rising) {
            neighbours[uses[first].triangle].push_back(uses[first + 1].triangle);
            neighbours[uses[first + 1].triangle].push_back(uses[first].triangle);
        }
    }
    constexpr std::uint32_t none = ~std::uint32_t{0};
    found.patches.assign(mesh.triangles.size(), none);
    std::uint32_t patch = 0;
    for (std::uint32_t start = 0; start < mesh.triangles.size(); ++start) {
        if (found.patches[start] != none) { continue; }
        std::vector<std::uint32_t> open{start};
        found.patches[start] = patch;
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            open.pop_back();
            for (const std::uint32_t next : neighbours[at]) {
                if (found.patches[next] == none) {
                    found.patches[next] = patch;
                    open.push_back(next);
                }
            }
        }
        ++patch;
    }
    found.shells = count_shells(mesh);
    return found;
}

struct Sample {
    Vec point;
    std::size_t triangle;
};

/// So many points, uniform by area, in the order of the triangles.
std::vector<Sample> area_samples(const Surface& surface, std::size_t triangles, std::size_t count) {
    std::vector<double> areas(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        const Vec normal = surface.triangle(i).normal();
        areas[i] = std::sqrt(dot(normal, normal));
    }
    const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
    std::mt19937_64 random(1);
    const auto unit = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    std::vector<Sample> samples;
    double before = 0.0;
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < count && total > 0.0; ++i) {
        const double place = total * (static_cast<double>(i) + unit()) / static_cast<double>(count);
        while (triangle + 1 < triangles && before + areas[triangle] < place) { before += areas[triangle++]; }
        const Triangle& t = surface.triangle(triangle);
        const double u = std::sqrt(unit());
        const double v = unit();
        samples.push_back({t.a * (1.0 - u) + t.b * (u * (1.0 - v)) + t.c * (u * v), triangle});
    }
    return samples;
}

struct Distances {
    double rms = 0.0;
    double max = 0.0;
    std::vector<std::pair<std::size_t, double>> nearest; ///< by sample: triangle and distance
};

constexpr std::size_t sample_count = 200'000;

/// From the samples and, for the maximum, the vertices of a mesh to a surface.
Distances distances(const std::vector<Sample>& samples, const PeerMesh& mesh, const Surface& to) {
    Distances found;
    double sum = 0.0;
    std::size_t guess = 0;
    for (const Sample& sample : samples) {
        const auto [triangle, d2] = to.nearest(sample.point, guess);
        guess = triangle;
        sum += d2;
        found.max = std::max(found.max, d2);
        found.nearest.emplace_back(triangle, std::sqrt(d2));
    }
    for (const Vec& vertex : mesh.vertices) {
        const auto [triangle, d2] = to.nearest(vertex, guess);
        guess = triangle;
        found.max = std::max(found.max, d2);
    }
    found.rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(samples.size(), 1)));
    found.max = std::sqrt(found.max);
    return found;
}

double diagonal(const PeerMesh& mesh) {
    Vec min = mesh.vertices.front();
    Vec max = min;
    for (const Vec& vertex : mesh.vertices) {
        for (std::size_t k = 0; k < 3; ++k) {
            min[k] = std::min(min[k], vertex[k]);
            max[k] = std::max(max[k], vertex[k]);
        }
    }
    return std::sqrt(dot(max - min, max - min));
}

struct Original {
    PeerMesh mesh;
    Surface surface;
    std::vector<Sample> samples;
    Topology parts;
    double diagonal;

    explicit Original(PeerMesh read)
        : mesh(std::move(read)), surface(mesh), samples(area_samples(surface, mesh.triangles.size(), sample_count)),
          parts(topology(mesh)), diagonal(::diagonal(mesh)) {}
};

struct Result {
    PeerMesh mesh;
    Surface surface;
    Topology parts;
    std::vector<Sample> samples;

    explicit Result(PeerMesh read)
        : mesh(std::move(read)), surface(mesh), parts(topology(mesh)),
          samples(area_samples(surface, mesh.triangles.size(), sample_count)) {}
};

/// The share of a result's area that opposes the nearest original surface and has no original surface of its direction
/// at hand: none within `tolerance` more than the nearest distance. Without the tolerance, walls thinner than the error
/// would count, where the nearest surface is the other side. A patch of the result that opposes a patch of the original
/// in most of their common area is oriented otherwise there, not folded.
double folded_share(const Original& original, const Result& result, const Distances& back, double tolerance) {
    struct Seen {
        std::size_t opposed = 0;
        std::size_t agreed = 0;
    };

    std::map<std::pair<std::uint32_t, std::uint32_t>, Seen> seen; // by patches: result, original
    for (std::size_t i = 0; i < result.samples.size(); ++i) {
        const Sample& sample = result.samples[i];
        const auto& [nearest, distance] = back.nearest[i];
        const Vec normal = result.surface.triangle(sample.triangle).normal();
        const bool opposes = dot(original.surface.triangle(nearest).normal(), normal) < 0.0;
        const Vec other = opposes ? normal : normal * -1.0;
        if (!original.surface.has_agreeing(sample.point, distance + tolerance, other)) {
            const auto patches = std::pair{result.parts.patches[sample.triangle], original.parts.patches[nearest]};
            ++(opposes ? seen[patches].opposed : seen[patches].agreed);
        }
    }
    std::size_t folded = 0;
    for (const auto& [patches, count] : seen) { folded += std::min(count.opposed, count.agreed); }
    return static_cast<double>(folded) / static_cast<double>(sample_count);
}

void judge(const Original& original, const std::string& path) {
    PeerMesh mesh;
    try {
        mesh = welded(read_obj(path));
    } catch (const std::runtime_error&) { // no faces: nothing is left of the mesh
    }
    if (mesh.triangles.empty()) {
        std::printf("{\"file\": \"%s\", \"faces\": 0}\n", path.c_str());
        return;
    }
    const Result result(std::move(mesh));
    const Distances forth = distances(original.samples, original.mesh, result.surface);
    const Distances back = distances(result.samples, result.mesh, original.surface);
    const double rms = std::max(forth.rms, back.rms);
    const double tolerance = 2.0 * rms + 1e-7 * original.diagonal;
    const double folded = folded_share(original, result, back, tolerance);
    const double unit = 1.0 / original.diagonal;
    std::printf("{\"file\": \"%s\", \"faces\": %zu, \"vertices\": %zu, \"diagonal\": %.9g, "
                "\"rms\": %.6g, \"max\": %.6g, \"rms_forth\": %.6g, \"rms_back\": %.6g, \"max_forth\": "
                "%.6g, "
                "\"max_back\": %.6g, \"folded\": %.6g, \"open_edges\": %zu, \"non_manifold_edges\": %zu, "
                "\"shells\": %zu, \"faces_before\": %zu, \"open_edges_before\": %zu, "
                "\"non_manifold_edges_before\": %zu, \"shells_before\": %zu}\n",
        path.c_str(), result.mesh.triangles.size(), result.mesh.vertices.size(), original.diagonal, rms * unit,
        std::max(forth.max, back.max) * unit, forth.rms * unit, back.rms * unit, forth.max * unit, back.max * unit,
        folded, result.parts.open_edges, result.parts.non_manifold_edges, result.parts.shells,
        original.mesh.triangles.size(), original.parts.open_edges, original.parts.non_manifold_edges,
        original.parts.shells);
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fputs("octant-mesh-judge ORIGINAL.obj RESULT.obj...\n"
                   "Prints one JSON object per result: distances as fractions of the original's diagonal "
                   "by 200,000 points of each\nsurface and all vertices, the share of the result's area "
                   "that opposes the nearest original surface, edges, shells.\n",
            stderr);
        return 2;
    }
    try {
        const Original original(welded(read_obj(argv[1])));
        for (int i = 2; i < argc; ++i) { judge(original, argv[i]); }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "octant-mesh-judge: %s\n", error.what());
        return 2;
    }
    return 0;
}
