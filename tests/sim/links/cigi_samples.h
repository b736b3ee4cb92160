#pragma once

#include "sim/base/units.h"
#include "sim/links/cigi_host.h"
#include "sim/links/cigi_image_generator.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

/// What the tests of CIGI share: a ground, messages of a host, and answers taken apart.
namespace octant::sim::links::test {

/// On the flat earth of FlatGround.
inline constexpr double m_per_degree = 1e5;

/// A flat ground at 100 m with a wall 300 m high from 2 E on; its edge is at 3 degrees.
class FlatGround final : public CigiGround {
public:
    std::optional<CigiSurfacePoint> below(const glm::dvec3& place) const override {
        if (std::abs(place.x) > 3.0 || std::abs(place.y) > 3.0) { return std::nullopt; }
        return CigiSurfacePoint{{place.x, place.y, place.y < 2.0 ? 100.0 : 300.0}, 0.0, 0.5 * pi};
    }

    std::optional<TerrainHit> first_hit(const glm::dvec3& from, const glm::dvec3& to) const override {
        constexpr int steps = 10000;
        for (int i = 0; i <= steps; ++i) {
            const glm::dvec3 at = from + (static_cast<double>(i) / steps) * (to - from);
            const auto surface = below(at);
            if (surface && at.z < surface->place.z) { return TerrainHit{distance_m(from, at), *surface}; }
        }
        return std::nullopt;
    }

    double distance_m(const glm::dvec3& from, const glm::dvec3& to) const override {
        const glm::dvec3 scale(m_per_degree, m_per_degree, 1.0);
        return glm::length((to - from) * scale);
    }

    glm::dvec3 moved(const glm::dvec3& place, const glm::dvec3& ned_m) const override {
        return place + glm::dvec3(ned_m.x / m_per_degree, ned_m.y / m_per_degree, -ned_m.z);
    }
};

/// A host's message in either byte order.
class HostMessage {
public:
    HostMessage(ByteOrder order, std::uint32_t host_frame) : writer_(order) {
        begin(1, 24);
        set(2, std::uint8_t{3});
        set(4, std::uint8_t{0x31}); // operate, minor version 3
        set(6, std::uint16_t{0x8000});
        set(8, host_frame);
    }

    HostMessage& begin(std::uint8_t opcode, std::uint8_t size) {
        at_ = writer_.size();
        writer_.add_zeros(size);
        writer_.set(at_, opcode);
        writer_.set(at_ + 1, size);
        return *this;
    }

    template <class Number>
    HostMessage& set(std::size_t offset, Number value) {
        writer_.set(at_ + offset, value);
        return *this;
    }

    HostMessage& entity(std::uint16_t number, double lat, double lon, double alt) {
        return begin(2, 48)
            .set(2, number)
            .set(4, std::uint8_t{1})
            .set(20, 90.0F)
            .set(24, lat)
            .set(32, lon)
            .set(40, alt);
    }

    HostMessage& height(std::uint16_t id, std::uint8_t kind, std::uint8_t period, double lat) {
        return begin(24, 32).set(2, id).set(4, kind).set(5, period).set(8, lat).set(24, 500.0);
    }

    Bytes bytes() const { return writer_.bytes(); }

private:
    WireWriter writer_;
    std::size_t at_ = 0;
};

struct Packet {
    int opcode = 0;
    WireReader reader;
};

/// The packets of an answer.
inline std::vector<Packet> parts_of(const std::vector<std::byte>& message) {
    std::vector<Packet> parts;
    for (Bytes rest = message; rest.size() >= 2;) {
        const auto size = std::to_integer<std::size_t>(rest[1]);
        REQUIRE(size <= rest.size());
        parts.push_back({std::to_integer<int>(rest[0]), WireReader(rest.first(size), ByteOrder::Big)});
        rest = rest.subspan(size);
    }
    return parts;
}

/// An entity, a frustum and a view from it, and the message that says so after IG Control.
struct HostScene {
    CigiEntityControl entity;
    CigiViewDefinition frustum;
    CigiViewControl view;

    HostScene() {
        entity.entity = 3;
        entity.state = 1;
        entity.type = 12;
        entity.attitude = {rad_from_deg(275.0), rad_from_deg(5.0), rad_from_deg(-30.0)};
        entity.place = {47.25, -8.5, 1234.5};
        frustum.view = 6;
        frustum.left_rad = rad_from_deg(-31.0);
        frustum.right_rad = rad_from_deg(32.0);
        frustum.top_rad = rad_from_deg(20.0);
        frustum.bottom_rad = rad_from_deg(-21.0);
        view.view = 6;
        view.entity = 3;
        view.offset_m = {-40.5, 0.25, -8.0};
        view.angles = {rad_from_deg(10.0), rad_from_deg(-12.0), rad_from_deg(1.0)};
    }

    void add_to(WireWriter& message, const CigiIgControl& control) const {
        add_ig_control(message, control);
        add_entity(message, entity);
        add_view_definition(message, frustum);
        add_view_control(message, view);
    }
};

} // namespace octant::sim::links::test
