#pragma once

#include "sim/base/plane.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace octant::visuals::draworder {

/// A convex region of eye points with a volume, bounded or not: the intersection of half-spaces. It
/// is held as the homogeneous cone over it, by what generates that cone: points (x, y, z, 1) up to
/// a factor, directions (x, y, z, 0), and lines, which are directions both ways.
///
/// Lengths are in a unit of about the radius of the model; tolerances are 1e-10 of it.
class EyeRegion {
public:
    /// The number of planes by which a region may have been cut.
    static constexpr std::size_t most_planes = 126;

    /// A point within this height of a plane counts as on it.
    static constexpr double on_plane = 1e-10;

    /// All of space.
    static EyeRegion everywhere();

    /// The part in front of a plane with a unit normal; nothing when that has no volume. There may
    /// be at most most_planes cuts one after another (asserted).
    std::optional<EyeRegion> cut(const Plane& plane) const;

    /// Whether cut() would leave something.
    bool reaches_front_of(const Plane& plane) const;

    /// Appends the generators of the region, each of length 1 in four dimensions and with w >= 0. A
    /// line is appended as two opposite directions.
    void append_generators(std::vector<glm::dvec4>& generators) const;

    /// A point inside, always the same for the same region.
    glm::dvec3 some_eye() const;

    /// The planes that bound the region, without redundant ones, in the order of the cuts.
    std::vector<Plane> planes() const;

private:
    /// A set of facets, by their indices in facets_.
    struct Facets {
        std::array<std::uint64_t, (most_planes + 2) / 64> words{};

        bool has(std::size_t facet) const {
            return ((words[facet / 64] >> (facet % 64)) & 1U) != 0;
        }

        void add(std::size_t facet) { words[facet / 64] |= std::uint64_t{1} << (facet % 64); }

        Facets operator&(const Facets& other) const;
        bool operator==(const Facets&) const = default;

        bool any() const { return words != Facets{}.words; }

        bool more_than_one() const;
    };

    /// A generating point or direction, and the facets on which it lies.
    struct Ray {
        glm::dvec4 at{0.0};
        Facets on;
    };

    EyeRegion() = default;
    /// The part in front of a plane that crosses line `line`.
    EyeRegion cut_across_line(const glm::dvec4& front, std::size_t line) const;
    /// The part in front of a plane that all lines are parallel to; `heights` are those of the
    /// rays.
    EyeRegion cut_rays(const glm::dvec4& front, const std::vector<double>& heights) const;
    void straighten();
    /// Whether two rays span an edge of the cone.
    bool adjacent(std::size_t a, std::size_t b) const;

    std::vector<Ray> rays_;
    std::vector<glm::dvec4> lines_;
    std::vector<glm::dvec4> facets_; ///< Half-spaces as (normal, offset); the first one is w >= 0.
};

} // namespace octant::visuals::draworder
