#include "sim/base/error.h"
#include "ui/reader/library_readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Material>
#include <osg/NodeVisitor>
#include <osg/TexGen>
#include <osg/Texture2D>
#include <osg/TriangleIndexFunctor>
#include <osgDB/ReadFile>
#include <string>
#include <tuple>
#include <vector>

namespace octant::ui::reader {

namespace {

using models::invalid_index;
using models::meshfile::CornerIndices;
using models::meshfile::MeshBuilder;
using models::meshfile::PolygonPicture;

/// Collects the triangles of a geometry by their vertices.
struct Triangles {
    std::vector<std::array<unsigned, 3>> corners;

    void operator()(unsigned a, unsigned b, unsigned c) {
        if (a != b && b != c && c != a) { corners.push_back({a, b, c}); }
    }
};

class MeshCollector : public osg::NodeVisitor {
public:
    MeshCollector(MeshBuilder& mesh, osg::NodeVisitor::TraversalMode children)
        : osg::NodeVisitor(children), mesh_(mesh) {}

    /// The level that is for the nearest eye.
    void apply(osg::LOD& levels) override {
        unsigned nearest = 0;
        for (unsigned i = 1; i < levels.getNumChildren(); ++i) {
            const bool by_distance = levels.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT;
            const bool nearer = by_distance ? levels.getMinRange(i) < levels.getMinRange(nearest)
                                            : levels.getMaxRange(i) > levels.getMaxRange(nearest);
            nearest = nearer ? i : nearest;
        }
        if (nearest < levels.getNumChildren()) { levels.getChild(nearest)->accept(*this); }
    }

    void apply(osg::Geometry& geometry) override {
        const auto* places = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
        if (places == nullptr || places->empty()) { return; }
        osg::TriangleIndexFunctor<Triangles> triangles;
        geometry.accept(triangles);
        const osg::Matrix to_world = osg::computeLocalToWorld(getNodePath());
        const auto first = static_cast<std::uint32_t>(mesh_.vertex_count());
        for (const osg::Vec3& place : *places) {
            const osg::Vec3d at = osg::Vec3d(place) * to_world;
            if (!(std::abs(at.x()) + std::abs(at.y()) + std::abs(at.z()) < models::meshfile::max_coordinate)) {
                throw Error("expected finite places, got others");
            }
            mesh_.add_vertex({at.x(), at.y(), at.z()});
        }
        add(geometry, triangles.corners, first, places->size());
    }

private:
    void add(const osg::Geometry& geometry, const std::vector<std::array<unsigned, 3>>& triangles, std::uint32_t first,
        std::size_t count) {
        const PolygonPicture picture = picture_of(geometry);
        const auto* on_picture = dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0));
        const bool pictured =
            picture.picture != PolygonPicture::none && on_picture != nullptr && on_picture->size() >= count;
        for (const auto& triangle : triangles) {
            std::array<CornerIndices, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                if (triangle.at(k) >= count) { return; }
                corners.at(k).vertex = first + triangle.at(k);
                if (pictured) {
                    const osg::Vec2& place = (*on_picture)[triangle.at(k)];
                    corners.at(k).texture = mesh_.add_texture_coordinates({place.x(), place.y()});
                }
            }
            mesh_.add_polygon(corners, material_of(geometry, triangle[0]), pictured ? picture : PolygonPicture());
        }
    }

    /// The nearest state above a geometry that has an attribute.
    template <typename Find>
    auto nearest_state(const osg::Geometry& geometry, Find&& find) const {
        auto found = find(geometry.getStateSet());
        const osg::NodePath& path = getNodePath();
        for (auto node = path.rbegin(); found == nullptr && node != path.rend(); ++node) {
            found = find((*node)->getStateSet());
        }
        return found;
    }

    /// Of pictures that lie on a surface; those that it mirrors, whose places follow from the view, are none.
    PolygonPicture picture_of(const osg::Geometry& geometry) {
        if (!mesh_.uses_pictures()) { return {}; }
        const auto* mirrored = nearest_state(geometry, [](const osg::StateSet* state) {
            return state == nullptr ? nullptr : state->getTextureAttribute(0, osg::StateAttribute::TEXGEN);
        });
        if (mirrored != nullptr) { return {}; }
        const osg::Texture2D* texture = nearest_state(geometry, [](const osg::StateSet* state) {
            return state == nullptr ? nullptr
                                    : dynamic_cast<const osg::Texture2D*>(
                                          state->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
        });
        const osg::Image* image = texture == nullptr ? nullptr : texture->getImage();
        if (image == nullptr || image->getFileName().empty()) { return {}; }
        const auto wrap_of = [&](osg::Texture::WrapParameter side) {
            const osg::Texture::WrapMode mode = texture->getWrap(side);
            return mode == osg::Texture::REPEAT   ? models::TextureWrap::Repeat
                   : mode == osg::Texture::MIRROR ? models::TextureWrap::Mirror
                                                  : models::TextureWrap::Clamp;
        };
        return {.picture = mesh_.pictures().picture(image->getFileName()),
            .wrap_u = wrap_of(osg::Texture::WRAP_S),
            .wrap_v = wrap_of(osg::Texture::WRAP_T)};
    }

    /// The colour of a vertex, else that of the material, as a material of the mesh.
    std::uint32_t material_of(const osg::Geometry& geometry, unsigned vertex) {
        osg::Vec4 colour(0.7F, 0.7F, 0.7F, 1.0F);
        const osg::Material* material = nearest_state(geometry, [](const osg::StateSet* state) {
            return state == nullptr
                       ? nullptr
                       : dynamic_cast<const osg::Material*>(state->getAttribute(osg::StateAttribute::MATERIAL));
        });
        if (material != nullptr) { colour = material->getDiffuse(osg::Material::FRONT); }
        const auto* colours = dynamic_cast<const osg::Vec4Array*>(geometry.getColorArray());
        if (colours != nullptr && !colours->empty() &&
            (material == nullptr || material->getColorMode() != osg::Material::OFF)) {
            const bool each = colours->getBinding() == osg::Array::BIND_PER_VERTEX;
            colour = (*colours)[each ? std::min<std::size_t>(vertex, colours->size() - 1) : 0];
        }
        constexpr float steps = 63.0F;
        const auto part = [](float value) {
            return static_cast<int>(std::min(std::max(value, 0.0F), 1.0F) * steps + 0.5F);
        };
        const std::array<int, 3> key{part(colour.r()), part(colour.g()), part(colour.b())};
        const auto [at, is_new] = materials_.try_emplace(key, invalid_index);
        if (is_new) {
            at->second = mesh_.add_material({.name = fmt::format("colour-{}", materials_.size()),
                .colour = glm::vec3(key[0], key[1], key[2]) / steps});
        }
        return at->second;
    }

    MeshBuilder& mesh_;
    std::map<std::array<int, 3>, std::uint32_t> materials_;
};

} // namespace

void read_by_osg(const std::filesystem::path& file, MeshBuilder& mesh) {
    const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file.string());
    if (!node) { throw_error_in(file, "expected a scene that OpenSceneGraph can read, got none"); }
    MeshCollector shown(mesh, osg::NodeVisitor::TRAVERSE_ACTIVE_CHILDREN);
    node->accept(shown);
    if (mesh.is_empty()) { // of switches that are all off
        MeshCollector all(mesh, osg::NodeVisitor::TRAVERSE_ALL_CHILDREN);
        node->accept(all);
    }
}

} // namespace octant::ui::reader
