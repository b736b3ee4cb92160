#include "models/meshfile/mesh_builder.h"

#include "models/polygons/polygon_outlines.h"
#include "models/repair/repair.h"
#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <utility>

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
std::pair<glm::dvec3, double> pixel_at(const PictureView& picture, const glm::dvec2& place) {
    const auto cell = [](double share, int count) {
        const double inside = share - std::floor(share);
        return std::min(static_cast<int>(inside * count), count - 1);
    };
    const auto row = static_cast<std::size_t>(cell(place.y, picture.height)) * static_cast<std::size_t>(picture.width);
    const std::uint8_t* pixel = &picture.rgba[4 * (row + static_cast<std::size_t>(cell(place.x, picture.width)))];
    return {glm::dvec3(pixel[0], pixel[1], pixel[2]) / 255.0, picture.ignores_alpha ? 1.0 : pixel[3] / 255.0};
}

bool hides_all(std::span<const std::uint8_t> rgba) {
    for (std::size_t at = 3; at < rgba.size(); at += 4) {
        if (rgba[at] != 255) { return false; }
    }
    return true;
}

int samples_of(const PictureView& picture, const std::array<glm::vec2, 3>& places) {
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
int for_each_sample(const PictureView& picture, const std::array<glm::vec2, 3>& places, const Visit& visit) {
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
void add_picture(const PictureView& picture, const std::array<glm::vec2, 3>& places, const glm::dvec3& tint,
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

bool names_shadow(std::string_view lower_name) {
    return lower_name.find("shadow") != lower_name.npos && lower_name.find("noshadow") == lower_name.npos;
}

std::optional<double> colour_fault(const glm::dvec3& colour) {
    for (int part = 0; part < 3; ++part) {
        if (!(colour[part] >= 0.0 && colour[part] <= 1.0)) { return colour[part]; }
    }
    return std::nullopt;
}

template <typename Read>
std::uint32_t BakedPictures::kept(const std::string& name, Read&& read) {
    const auto [at, is_new] = known_.try_emplace(name, none);
    if (is_new) {
        try {
            pictures_.push_back(read());
            at->second = static_cast<std::uint32_t>(pictures_.size() - 1);
        } catch (const Error& fault) {
            notes_.push_back(fmt::format("{}; its surfaces have their material's colour", fault.what()));
        }
    }
    return at->second;
}

BakedPictures::BakedPictures(fs::path mesh_file, const ReadOptions& options)
    : mesh_file_(std::move(mesh_file)), folder_(options.pictures_in), store_(options.textures) {}

std::uint32_t BakedPictures::picture(const std::string& name) {
    return kept(name, [&] {
        const fs::path file = picture_file(mesh_file_, name, folder_);
        if (std::error_code ignored; !fs::is_regular_file(file, ignored)) {
            throw_error_in(mesh_file_, fmt::format("expected a picture '{}', got none", printable(name)));
        }
        Picture made{.image = {}, .texture = {}, .name = file.string(), .bytes = {}};
        if (store_) {
            made.texture = store_->picture_in(file, extension_of(mesh_file_) == ".ac");
            made.is_opaque = made.texture->is_opaque;
        } else {
            made.image = std::make_shared<const heights::Image>(heights::read_image(file));
            made.is_opaque = hides_all(made.image->rgba);
        }
        return made;
    });
}

std::uint32_t BakedPictures::picture(const std::string& name, std::string_view bytes) {
    return kept(name, [&] {
        Picture made{.image = {}, .texture = {}, .name = name, .bytes = {}};
        if (store_) {
            made.texture = store_->picture_of(name, bytes);
            made.is_opaque = made.texture->is_opaque;
            made.bytes = std::make_shared<const std::string>(bytes);
        } else {
            made.image = std::make_shared<const heights::Image>(heights::image_from_bytes(name, bytes));
            made.is_opaque = hides_all(made.image->rgba);
        }
        return made;
    });
}

void BakedPictures::add_triangle(const PolygonPicture& picture, const std::array<glm::vec2, 3>& places) {
    triangles_.push_back({is_good(places) ? picture.picture : none, picture.alpha == TextureAlpha::Opaque,
        picture.alpha == TextureAlpha::Mask, places});
}

Material BakedPictures::shown_on(Material material, const PolygonPicture& shown) const {
    const Picture& picture = pictures_[shown.picture];
    if (!picture.bytes || material.picture.empty()) { material.picture = picture.name; }
    material.picture_bytes = picture.bytes;
    const bool is_opaque = picture.is_opaque || shown.alpha == TextureAlpha::Opaque;
    material.texture = {picture.texture, shown.wrap_u, shown.wrap_v,
        is_opaque ? TextureAlpha::Opaque : TextureAlpha::Mask, shown.threshold};
    return material;
}

PictureView BakedPictures::view_of(const TexturedTriangle& triangle) const {
    const Picture& picture = pictures_[triangle.picture];
    if (picture.texture) {
        const TextureLevel& finest = picture.texture->levels.front();
        return {finest.width, finest.height, finest.rgba, triangle.ignores_alpha};
    }
    return {picture.image->width, picture.image->height, picture.image->rgba, triangle.ignores_alpha};
}

std::vector<BakedPictures::Cover> BakedPictures::covers() const {
    constexpr double about = 0.15;
    std::vector<Cover> found;
    for (const TexturedTriangle& triangle : triangles_) {
        Cover& cover = found.emplace_back();
        if (triangle.picture == none || triangle.ignores_alpha || pictures_[triangle.picture].is_opaque) { continue; }
        double sum = 0.0;
        double least = 1.0;
        double most = 0.0;
        int graded = 0;
        const int samples = for_each_sample(
            view_of(triangle), triangle.places, [&](const glm::dvec3&, const glm::dvec3&, double there) {
                sum += there;
                least = std::min(least, there);
                most = std::max(most, there);
                graded += there > about && there < 1.0 - about ? 1 : 0;
            });
        cover.opacity = static_cast<float>(sum / samples);
        cover.is_uniform = most - least <= 2.0 * about;
        cover.is_graded = !triangle.is_cut && 2 * graded > samples;
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
            add_picture(view_of(triangles_[t]), triangles_[t].places, own, area, at);
        }
    }
    mesh.colours.assign(mesh.vertices_m.size(), Material().colour);
    for (std::size_t v = 0; v < firsts.size(); ++v) {
        const Sum& sum = sums[firsts[v]];
        if (sum.weight > 0.0) { mesh.colours[v] = glm::vec3(sum.colour / sum.weight); }
    }
    mesh.colours_are_means = store_ != nullptr;
}

namespace {

/// Lengths this near to 1 are left as they are, so that writing and reading changes no bit.
constexpr double unit_tolerance = 1e-6;

constexpr glm::dvec3 upwards(0.0, 0.0, 1.0);

/// Of a picture that is mostly transparent: less is a hole in it, more is glass where it is even or graded, as a
/// turning propeller's disc.
constexpr float glass_from = 0.05F;
constexpr float mostly_there = 0.5F;

bool is_glass(const BakedPictures::Cover& cover) {
    return (cover.is_uniform || cover.is_graded) && cover.opacity >= glass_from && cover.opacity < mostly_there;
}

} // namespace

MeshBuilder::MeshBuilder(const std::filesystem::path& path, const ReadOptions& options)
    : path_(path), options_(options), pictures_(path, options) {
    mesh_.name = path.stem().string();
}

std::uint32_t MeshBuilder::add_vertex(const glm::dvec3& position_m) {
    mesh_.vertices_m.push_back(position_m);
    return static_cast<std::uint32_t>(mesh_.vertices_m.size() - 1);
}

void MeshBuilder::set_colour(std::uint32_t vertex, const glm::vec3& colour) {
    if (mesh_.colours.size() <= vertex) { mesh_.colours.resize(std::size_t{vertex} + 1, glm::vec3(1.0F)); }
    mesh_.colours[vertex] = colour;
}

std::uint32_t MeshBuilder::add_normal(const glm::dvec3& normal) {
    const double length = glm::length(normal);
    const bool good = std::isfinite(length) && length > 0.0;
    const bool unit = std::abs(length - 1.0) < unit_tolerance;
    mesh_.normals.push_back(good ? glm::vec3(unit ? normal : normal / length) : glm::vec3(0.0F));
    faulty_normals_.push_back(!good);
    return static_cast<std::uint32_t>(mesh_.normals.size() - 1);
}

std::uint32_t MeshBuilder::add_texture_coordinates(const glm::vec2& coordinates) {
    mesh_.texture_coordinates.push_back(coordinates);
    return static_cast<std::uint32_t>(mesh_.texture_coordinates.size() - 1);
}

/// Where a corner lies on its picture, in shares from the upper left corner.
glm::vec2 MeshBuilder::on_picture(const CornerIndices& corner) const {
    if (corner.texture == invalid_index) { return glm::vec2(0.0F); }
    const glm::vec2& coordinates = mesh_.texture_coordinates[corner.texture];
    return {coordinates.x, 1.0F - coordinates.y};
}

std::uint32_t MeshBuilder::add_material(Material material) {
    mesh_.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(mesh_.materials.size() - 1);
}

std::uint32_t MeshBuilder::face_colour_material(const glm::vec3& colour) {
    const auto [at, is_new] = face_colours_.try_emplace({colour.x, colour.y, colour.z}, invalid_index);
    if (is_new) { at->second = add_material({fmt::format("face colour {}", face_colours_.size()), colour}); }
    return at->second;
}

/// The material of triangles that the file gives this material and this picture.
std::uint32_t MeshBuilder::shown_material(std::uint32_t material, const PolygonPicture& picture) {
    if (!options_.textures || picture.picture == BakedPictures::none) { return material; }
    const auto [at, is_new] = shown_materials_.try_emplace({material, picture}, invalid_index);
    if (is_new) {
        Material own = material == invalid_index ? Material{.name = "picture", .colour = glm::vec3(1.0F)}
                                                 : mesh_.materials[material];
        at->second = add_material(pictures_.shown_on(std::move(own), picture));
    }
    return at->second;
}

void MeshBuilder::add_polygon(
    std::span<const CornerIndices> corners, std::uint32_t material, const PolygonPicture& picture) {
    assert(corners.size() >= 3 && corners.size() <= max_polygon_corners);
    const std::uint32_t shown = shown_material(material, picture);
    const auto add = [&](const std::array<CornerIndices, 3>& triangle) {
        add_triangle(triangle, shown);
        if (options_.pictures) {
            pictures_.add_triangle(
                picture, {on_picture(triangle[0]), on_picture(triangle[1]), on_picture(triangle[2])});
        }
    };
    if (corners.size() == 3) {
        add({corners[0], corners[1], corners[2]});
        return;
    }
    places_m_.clear();
    for (const CornerIndices& corner : corners) { places_m_.push_back(mesh_.vertices_m[corner.vertex]); }
    for (const auto& piece : polygons::triangulate_polygon(places_m_)) {
        add({corners[piece[0]], corners[piece[1]], corners[piece[2]]});
    }
}

void MeshBuilder::add_triangle(const std::array<CornerIndices, 3>& corners, std::uint32_t material) {
    const auto& [a, b, c] = corners;
    mesh_.triangles.push_back({a.vertex, b.vertex, c.vertex});
    mesh_.corner_normals.push_back({a.normal, b.normal, c.normal});
    mesh_.corner_texture_coordinates.push_back({a.texture, b.texture, c.texture});
    mesh_.triangle_materials.push_back(material);
    two_sided_.push_back(is_two_sided_);
    smoothings_.push_back(smoothing_);
    groups_.push_back(group_);
    has_normals_ = has_normals_ || a.normal != invalid_index || b.normal != invalid_index || c.normal != invalid_index;
    has_texture_coordinates_ = has_texture_coordinates_ || a.texture != invalid_index;
    has_materials_ = has_materials_ || material != invalid_index;
}

void MeshBuilder::note_undrawn() {
    if (undrawn_.empty()) { return; }
    std::string kinds;
    for (const auto& [kind, count] : undrawn_) {
        kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
    }
    add_note(fmt::format("{}: pictures that are not drawn, by what they are for: {}", path_.string(), kinds));
}

TriangleMesh MeshBuilder::finish() {
    if (mesh_.triangles.empty()) { throw_error_in(path_, "expected at least one triangle, got none"); }
    note_undrawn();
    if (!mesh_.colours.empty()) { mesh_.colours.resize(mesh_.vertices_m.size(), glm::vec3(1.0F)); }
    finish_part();
    return std::move(mesh_);
}

void MeshBuilder::finish_part() {
    finish_normals();
    finish_texture_coordinates();
    finish_materials();
    leave_out_transparent();
    if (is_clear_) {
        give_materials_opacity();
        blend_textures();
    }
    bake_pictures();
    finish_backs();
}

/// The alpha of pictures on transparent surfaces is the share that they cover.
void MeshBuilder::blend_textures() {
    for (Material& material : mesh_.materials) {
        if (material.texture.alpha == TextureAlpha::Mask) { material.texture.alpha = TextureAlpha::Blend; }
    }
}

float MeshBuilder::opacity_of(std::size_t triangle) const {
    const std::uint32_t material = mesh_.triangle_materials[triangle];
    const bool has_glass = !covers_.empty() && is_glass(covers_[triangle]);
    return (material == invalid_index ? 1.0F : mesh_.materials[material].opacity) *
           (has_glass ? covers_[triangle].opacity : 1.0F);
}

void MeshBuilder::find_opacities() {
    if (!pictures_.is_empty() && mesh_.colours.empty() && covers_.empty()) { covers_ = pictures_.covers(); }
}

bool MeshBuilder::is_transparent(std::size_t triangle) const { return opacity_of(triangle) < opaque_from_opacity; }

void MeshBuilder::drop_invisible() {
    std::vector<bool> gone;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) { gone.push_back(opacity_of(t) < seen_from_opacity); }
    take_out(gone);
}

/// Returns a finished mesh of the triangles for which `is_kept(index)` is true.
template <typename Kept>
TriangleMesh MeshBuilder::part_of(const Kept& is_kept, std::vector<std::string>& notes, bool is_clear) const {
    std::vector<bool> gone;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) { gone.push_back(!is_kept(t)); }
    if (std::ranges::find(gone, false) == gone.end()) { return {}; }
    MeshBuilder part(*this);
    part.mesh_.notes.clear();
    part.take_out(gone);
    part.is_part_ = true;
    part.is_clear_ = is_clear;
    part.finish_part();
    erase_unused_vertices(part.mesh_);
    for (std::string& note : std::exchange(part.mesh_.notes, {})) {
        if (std::ranges::find(notes, note) == notes.end()) { notes.push_back(std::move(note)); }
    }
    return std::move(part.mesh_);
}

MeshParts MeshBuilder::finish_parts() {
    if (mesh_.triangles.empty()) { throw_error_in(path_, "expected at least one triangle, got none"); }
    note_undrawn();
    find_opacities();
    drop_invisible();
    if (!mesh_.colours.empty()) { mesh_.colours.resize(mesh_.vertices_m.size(), glm::vec3(1.0F)); }
    MeshParts parts;
    std::vector<std::string> notes = mesh_.notes;
    parts.body = part_of([&](std::size_t t) { return groups_[t] == invalid_index && !is_transparent(t); }, notes);
    if (!options_.groups.empty()) { // each part is cut out of a copy: of the groups alone, which are small
        std::vector<bool> gone(mesh_.triangles.size());
        for (std::size_t t = 0; t < gone.size(); ++t) { gone[t] = groups_[t] == invalid_index || is_transparent(t); }
        MeshBuilder grouped(*this);
        grouped.take_out(gone);
        erase_unused_vertices(grouped.mesh_);
        for (std::uint32_t group = 0; group < options_.groups.size(); ++group) {
            parts.groups.push_back(grouped.part_of([&](std::size_t t) { return grouped.groups_[t] == group; }, notes));
        }
    }
    parts.clear = part_of([&](std::size_t t) { return is_transparent(t); }, notes, true);
    parts.body.name = path_.stem().string();
    parts.body.notes = std::move(notes);
    return parts;
}

/// Gives the materials of transparent triangles the opacity that these have by material and picture. Where textures are
/// kept the alpha of a picture is blended texel by texel and no part of it.
void MeshBuilder::give_materials_opacity() {
    constexpr float step = 1.0F / 64.0F;    // of opacities by pictures, so that few materials are made
    constexpr float nearly_opaque = 0.998F; // an opacity of 1 would say that nothing is blended
    if (mesh_.materials.empty()) {
        add_material({.name = "default"});
        mesh_.triangle_materials.assign(mesh_.triangles.size(), 0);
    }
    std::map<std::pair<std::uint32_t, float>, std::uint32_t> known;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        std::uint32_t& material = mesh_.triangle_materials[t];
        const Material& own = mesh_.materials[material];
        float opacity = std::min(own.opacity, nearly_opaque);
        if (own.texture.picture == nullptr && opacity_of(t) < own.opacity) {
            opacity = std::max(std::round(opacity_of(t) / step), 1.0F) * step;
        }
        if (opacity == own.opacity) { continue; }
        const auto [at, is_new] = known.try_emplace({material, opacity}, invalid_index);
        if (is_new) {
            Material more = own;
            more.opacity = opacity;
            at->second = add_material(std::move(more));
        }
        material = at->second;
    }
}

void MeshBuilder::take_out(const std::vector<bool>& gone) {
    erase_triangles(mesh_, gone);
    const auto take = [&gone](auto& list) {
        std::size_t t = 0;
        std::erase_if(list, [&](const auto&) { return gone[t++]; });
    };
    take(two_sided_);
    take(smoothings_);
    take(groups_);
    if (!covers_.empty()) { take(covers_); }
    if (options_.pictures) { pictures_.take_out(gone); }
}

void MeshBuilder::finish_backs() {
    const bool any = std::ranges::find(two_sided_, true) != two_sided_.end();
    const std::size_t added = options_.backs && any ? repair::add_back_faces(mesh_, two_sided_) : 0;
    if (added > 0) {
        mesh_.notes.push_back(fmt::format("{}: {} triangles of two-sided sheets got a back", path_.string(), added));
    }
}

void MeshBuilder::leave_out_transparent() {
    if (pictures_.is_empty() || !mesh_.colours.empty()) { return; }
    find_opacities();
    std::vector<bool> gone;
    for (const BakedPictures::Cover& cover : covers_) {
        const bool is_hole = cover.opacity < mostly_there && !(is_part_ && is_glass(cover));
        const bool is_drawn_with_holes = options_.textures && !cover.is_uniform && cover.opacity >= glass_from;
        gone.push_back(is_hole && !is_drawn_with_holes);
    }
    const auto count = static_cast<std::size_t>(std::ranges::count(gone, true));
    const bool is_all = count == gone.size();
    if (count == 0 || (is_all && !is_part_)) { return; }
    take_out(gone);
    mesh_.notes.push_back(
        fmt::format("{}: {} triangles whose picture is mostly transparent are left out", path_.string(), count));
}

void MeshBuilder::bake_pictures() {
    for (const std::string& note : pictures_.notes()) { mesh_.notes.push_back(note); }
    if (!pictures_.is_empty() && mesh_.colours.empty()) { pictures_.bake(mesh_); }
}

void MeshBuilder::finish_normals() {
    if (std::ranges::any_of(smoothings_, [](const Smoothing& one) { return one.group != Smoothing::unknown; })) {
        add_smooth_normals(mesh_, smoothings_);
        has_normals_ = true;
    }
    if (!has_normals_) {
        mesh_.normals.clear();
        mesh_.corner_normals = std::vector<Triangle>(); // It was as large as the triangles.
        return;
    }
    const auto is_faulty = [&](std::uint32_t normal) {
        return normal == invalid_index || (normal < faulty_normals_.size() && faulty_normals_[normal]);
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        Triangle& corners = mesh_.corner_normals[t];
        if (std::ranges::none_of(corners, is_faulty)) { continue; }
        const auto own = static_cast<std::uint32_t>(mesh_.normals.size());
        mesh_.normals.emplace_back(normal_of(mesh_, mesh_.triangles[t], upwards));
        std::ranges::replace_if(corners, is_faulty, own);
    }
    // Faulty normals go: no triangle points to them any more.
    for (std::size_t n = 0; n < faulty_normals_.size(); ++n) {
        if (faulty_normals_[n]) { mesh_.normals[n] = glm::vec3(0.0F, 0.0F, 1.0F); }
    }
}

void MeshBuilder::finish_texture_coordinates() {
    if (!has_texture_coordinates_) {
        mesh_.texture_coordinates.clear();
        mesh_.corner_texture_coordinates = std::vector<Triangle>(); // As large as the triangles.
        return;
    }
    const auto is_missing = [&](std::uint32_t index) {
        return index == invalid_index || !std::isfinite(mesh_.texture_coordinates[index].x) ||
               !std::isfinite(mesh_.texture_coordinates[index].y);
    };
    std::vector<bool> used(mesh_.texture_coordinates.size(), false);
    for (Triangle& corners : mesh_.corner_texture_coordinates) {
        if (std::ranges::any_of(corners, is_missing)) {
            corners = {invalid_index, invalid_index, invalid_index};
            continue;
        }
        for (const std::uint32_t corner : corners) { used[corner] = true; }
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) {
            mesh_.texture_coordinates[i] = glm::vec2(0.0F); // Perhaps not finite.
        }
    }
}

void MeshBuilder::finish_materials() {
    if (!has_materials_) {
        mesh_.materials.clear();
        mesh_.triangle_materials = std::vector<std::uint32_t>();
        return;
    }
    std::uint32_t fallback = invalid_index;
    for (std::uint32_t& material : mesh_.triangle_materials) {
        if (material == invalid_index) {
            fallback = fallback == invalid_index ? add_material({.name = "default"}) : fallback;
            material = fallback;
        }
    }
}

} // namespace octant::models::meshfile
