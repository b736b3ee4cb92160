#include "models/meshfile/baked_pictures.h"

#include "models/repair/vertex_welding.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace octant::models::meshfile {

namespace {

namespace fs = std::filesystem;

/// Samples along a triangle's side: one for so many pixels, within bounds.
constexpr double pixels_a_sample = 3.0;
constexpr int min_samples = 4;
constexpr int max_samples = 24;

struct Sum {
    glm::dvec3 colour{0.0};
    double weight = 0.0;

    void add(const glm::dvec3& more, double by) {
        colour += by * more;
        weight += by;
    }
};

/// The colour of the pixel at a place, and how much of it is there, 0..1.
std::pair<glm::dvec3, double> pixel_at(const heights::Image& picture, const glm::dvec2& place) {
    const auto cell = [](double share, int count) {
        const double inside = share - std::floor(share);
        return std::min(static_cast<int>(inside * count), count - 1);
    };
    const std::uint8_t* pixel = picture.pixel(cell(place.x, picture.width), cell(place.y, picture.height));
    return {glm::dvec3(pixel[0], pixel[1], pixel[2]) / 255.0, pixel[3] / 255.0};
}

bool hides_all(const heights::Image& picture) {
    for (std::size_t at = 3; at < picture.rgba.size(); at += 4) {
        if (picture.rgba[at] != 255) { return false; }
    }
    return true;
}

int samples_of(const heights::Image& picture, const std::array<glm::vec2, 3>& places) {
    double longest_px = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 side(places.at((k + 1) % 3) - places.at(k));
        longest_px = std::max(longest_px, std::hypot(side.x * picture.width, side.y * picture.height));
    }
    const double wanted = std::isfinite(longest_px) ? longest_px / pixels_a_sample : 1.0;
    return static_cast<int>(std::clamp<double>(wanted, min_samples, max_samples));
}

/// Calls `visit(share, colour, there)` for samples spread over a triangle: the shares of its corners, the picture's
/// colour, and how much of it is there, 0..1. Returns the number of samples.
template <typename Visit>
int for_each_sample(const heights::Image& picture, const std::array<glm::vec2, 3>& places, const Visit& visit) {
    const int steps = samples_of(picture, places);
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; i + j < steps; ++j) {
            const glm::dvec3 share((i + 1.0 / 3.0) / steps, (j + 1.0 / 3.0) / steps, 1.0 - (i + j + 2.0 / 3.0) / steps);
            const glm::dvec2 place =
                share.x * glm::dvec2(places[0]) + share.y * glm::dvec2(places[1]) + share.z * glm::dvec2(places[2]);
            const auto [colour, there] = pixel_at(picture, place);
            visit(share, colour, there);
        }
    }
    return steps * (steps + 1) / 2;
}

/// Adds what a triangle shows around each of its corners.
void add_picture(const heights::Image& picture, const std::array<glm::vec2, 3>& places, const glm::dvec3& tint,
    double area, const std::array<Sum*, 3>& sums) {
    const int steps = samples_of(picture, places);
    const double weight = 2.0 * area / (static_cast<double>(steps) * (steps + 1));
    for_each_sample(picture, places, [&](const glm::dvec3& share, const glm::dvec3& colour, double there) {
        for (int k = 0; k < 3; ++k) {
            sums.at(static_cast<std::size_t>(k))->add(tint * colour, weight * there * share[k] * share[k]);
        }
    });
}

bool is_good(const std::array<glm::vec2, 3>& places) {
    constexpr float far = 1e6F;
    return std::ranges::all_of(
        places, [](const glm::vec2& place) { return std::abs(place.x) < far && std::abs(place.y) < far; });
}

} // namespace

fs::path picture_file(const fs::path& mesh_file, const std::string& name, const fs::path& folder) {
    std::string slashes = name;
    std::ranges::replace(slashes, '\\', '/');
    std::error_code ignored;
    const fs::path beside = mesh_file.parent_path();
    for (const fs::path& from : {folder.empty() ? beside : folder, beside}) {
        for (const fs::path& file : {from / slashes, from / fs::path(slashes).filename()}) {
            if (fs::is_regular_file(file, ignored)) { return file; }
        }
    }
    return beside / slashes;
}

template <typename Read>
std::uint32_t BakedPictures::kept(const std::string& name, Read&& read) {
    const auto [at, is_new] = known_.try_emplace(name, none);
    if (is_new) {
        try {
            pictures_.push_back(std::make_shared<const heights::Image>(read()));
            is_opaque_.push_back(hides_all(*pictures_.back()));
            at->second = static_cast<std::uint32_t>(pictures_.size() - 1);
        } catch (const Error& fault) {
            notes_.push_back(fmt::format("{}; its surfaces have their material's colour", fault.what()));
        }
    }
    return at->second;
}

std::uint32_t BakedPictures::picture(const std::string& name) {
    return kept(name, [&] {
        const fs::path file = picture_file(mesh_file_, name, folder_);
        if (std::error_code ignored; fs::is_regular_file(file, ignored)) { return heights::read_image(file); }
        throw_error_in(mesh_file_, fmt::format("expected a picture '{}', got none", printable(name)));
    });
}

std::uint32_t BakedPictures::picture(const std::string& name, std::string_view bytes) {
    return kept(name, [&] { return heights::image_from_bytes(name, bytes); });
}

void BakedPictures::add_triangle(std::uint32_t picture, const std::array<glm::vec2, 3>& places) {
    triangles_.push_back({is_good(places) ? picture : none, places});
}

std::vector<BakedPictures::Cover> BakedPictures::covers() const {
    constexpr double about = 0.15;
    std::vector<Cover> found;
    for (const TexturedTriangle& triangle : triangles_) {
        Cover& cover = found.emplace_back();
        if (triangle.picture == none || is_opaque_[triangle.picture]) { continue; }
        double sum = 0.0;
        double least = 1.0;
        double most = 0.0;
        const int samples = for_each_sample(
            *pictures_[triangle.picture], triangle.places, [&](const glm::dvec3&, const glm::dvec3&, double there) {
                sum += there;
                least = std::min(least, there);
                most = std::max(most, there);
            });
        cover.opacity = static_cast<float>(sum / samples);
        cover.is_uniform = most - least <= 2.0 * about;
    }
    return found;
}

void BakedPictures::take_out(const std::vector<bool>& gone) {
    std::size_t t = 0;
    std::erase_if(triangles_, [&](const TexturedTriangle&) { return gone[t++]; });
}

void BakedPictures::bake(TriangleMesh& mesh) const {
    assert(triangles_.size() == mesh.triangles.size());
    const std::vector<bool> all(mesh.vertices_m.size(), true);
    const std::vector<std::uint32_t> firsts = repair::first_duplicates(mesh.vertices_m, {}, all);
    std::vector<Sum> sums(mesh.vertices_m.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& corners = mesh.triangles[t];
        const double area = 0.5 * glm::length(area_vector(mesh, corners));
        const glm::dvec3 own(material_colour(mesh, t));
        const std::array<Sum*, 3> at{&sums[firsts[corners[0]]], &sums[firsts[corners[1]]], &sums[firsts[corners[2]]]};
        if (triangles_[t].picture == none) {
            for (Sum* sum : at) { sum->add(own, area / 6.0); }
        } else {
            add_picture(*pictures_[triangles_[t].picture], triangles_[t].places, own, area, at);
        }
    }
    mesh.colours.assign(mesh.vertices_m.size(), Material().colour);
    for (std::size_t v = 0; v < firsts.size(); ++v) {
        const Sum& sum = sums[firsts[v]];
        if (sum.weight > 0.0) { mesh.colours[v] = glm::vec3(sum.colour / sum.weight); }
    }
}

} // namespace octant::models::meshfile
