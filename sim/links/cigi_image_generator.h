#pragma once

#include "sim/links/cigi_host.h"
#include "sim/links/cigi_packets.h"

#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace octant::sim::links {

/// A part of an entity as its host has turned and moved it: a rotor, a flap, a store.
struct CigiPartPose {
    std::uint16_t entity = 0;
    std::uint8_t part = 0;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0}; ///< within the body's axes
    glm::dvec3 offset_m{0.0};            ///< along them
};

/// The articulated parts of a host's entities. Angles and offsets go on by the rates that it gives them.
class CigiArticulatedParts {
public:
    static constexpr std::size_t max_parts = 1024;

    /// Angles and offsets that the packet does not set stay as they are; a part that is not enabled is the model's own
    /// again.
    void take(const CigiArticulatedPart& part, double at_s);

    /// Lets a part that has been told of before go on by these rates.
    void take(const CigiRateControl& rate, double at_s);

    void forget(std::uint16_t entity);

    /// All of them at a time of the clock that take() has.
    std::vector<CigiPartPose> turned(double now_s) const;

private:
    struct Pose {
        glm::dvec3 offset_m{0.0};
        glm::dvec3 angles_rad{0.0}; ///< roll, pitch, yaw
    };

    struct Part {
        Pose pose; ///< at that time
        Pose per_s;
        double at_s = 0.0;
    };

    static Pose pose_at(const Part& part, double now_s);

    std::map<std::pair<std::uint16_t, std::uint8_t>, Part> parts_;
};

/// What a host may ask of the ground. Places: latitude and longitude in degrees, height in metres.
class CigiGround {
public:
    CigiGround() = default;
    virtual ~CigiGround() = default;
    CigiGround(const CigiGround&) = delete;
    CigiGround& operator=(const CigiGround&) = delete;
    CigiGround(CigiGround&&) = delete;
    CigiGround& operator=(CigiGround&&) = delete;

    /// The ground below or above a place; nothing outside the map.
    virtual std::optional<CigiSurfacePoint> below(const glm::dvec3& place) const = 0;

    /// Where a straight line first meets the ground, with the distance from its beginning.
    struct TerrainHit {
        double range_m = 0.0;
        CigiSurfacePoint surface;
    };

    virtual std::optional<TerrainHit> first_hit(const glm::dvec3& from, const glm::dvec3& to) const = 0;

    /// Length of the straight line between two places.
    virtual double distance_m(const glm::dvec3& from, const glm::dvec3& to) const = 0;

    /// The place that lies so many metres north, east and down of another.
    virtual glm::dvec3 moved(const glm::dvec3& place, const glm::dvec3& ned_m) const = 0;
};

/// An image generator's side of CIGI 3.3: keeps the host's entities and views, answers what he asks. Opens no sockets
/// and reads no clock.
class CigiImageGenerator {
public:
    static constexpr std::size_t max_entities = 256;
    static constexpr std::size_t max_views = 16;
    static constexpr std::size_t max_periodic = 256;
    static constexpr std::size_t max_waiting = 1024;
    static constexpr std::size_t max_message_bytes = 1472;

    /// Without a ground every question is answered as outside the database. It must outlive this.
    explicit CigiImageGenerator(const CigiGround* ground) : ground_(ground) {}

    /// Takes a message of the host that came at a time. Returns the entities that it moved, as fixes, by their numbers.
    DecodeResult take(Bytes message, std::vector<Fix>& moved, double arrival_s = 0.0);

    /// The message for a picture: Start of Frame, then answers as far as they fit; others wait.
    std::vector<std::byte> message_for(std::uint32_t ig_frame, double time_s);

    /// Whether a host has ever spoken.
    bool has_host() const { return has_host_; }

    std::uint32_t host_frame() const { return control_.host_frame; }

    CigiMode mode() const { return control_.mode; }

    /// Entities that are to be seen no more, since the last call.
    std::vector<std::uint16_t> take_removed() { return std::exchange(removed_, {}); }

    /// The newest of each kind, if the host has given any.
    const std::optional<CigiAtmosphere>& atmosphere() const { return atmosphere_; }

    const std::optional<CigiCelestial>& celestial() const { return celestial_; }

    const std::map<std::uint16_t, CigiViewControl>& views() const { return views_; }

    const std::map<std::uint16_t, CigiViewDefinition>& definitions() const { return definitions_; }

    const CigiArticulatedParts& parts() const { return parts_; }

    /// The type of an entity that is there.
    std::optional<std::uint16_t> type_of(std::uint16_t entity) const;

    /// Packets that were not understood, by opcode.
    const std::array<long, 256>& unknown() const { return unknown_; }

private:
    struct Entity {
        CigiEntityControl control;
        std::optional<CigiRateControl> rate;
    };

    struct Answer {
        std::variant<CigiHeightRequest, CigiLosRequest, CigiPositionRequest> request;
        std::uint8_t host_frame = 0;
    };

    void take(const CigiPacket& packet, double arrival_s, std::vector<std::uint16_t>& touched);
    void take_entity(const CigiEntityControl& control);
    void take_rate(const CigiRateControl& rate, double arrival_s, std::vector<std::uint16_t>& touched);
    void take_view(const CigiViewControl& view);
    void take_definition(const CigiViewDefinition& told);
    void ask(const CigiHeightRequest& request);
    void ask(const CigiLosRequest& request);
    void ask(const CigiPositionRequest& request);
    void wait(Answer answer);
    void queue_periodic_requests();
    std::optional<glm::dvec3> place_of(std::uint16_t entity, int depth = 0) const;
    EulerAngles attitude_of(std::uint16_t entity) const;
    std::optional<glm::dvec3> place_from(bool of_entity, std::uint16_t entity, const glm::dvec3& place) const;
    Fix fix_of(std::uint16_t number, const Entity& entity) const;
    void answer(const Answer& answer, WireWriter& message) const;
    void answer_height(const CigiHeightRequest&, std::uint8_t host_frame, WireWriter&) const;
    void answer_sight(const CigiLosRequest&, std::uint8_t host_frame, WireWriter&) const;
    void answer_position(const CigiPositionRequest&, WireWriter&) const;

    const CigiGround* ground_;
    bool has_host_ = false;
    CigiIgControl control_;
    std::map<std::uint16_t, Entity> entities_;
    CigiArticulatedParts parts_;
    std::map<std::uint16_t, CigiViewControl> views_;
    std::map<std::uint16_t, CigiViewDefinition> definitions_;
    std::map<std::uint16_t, CigiHeightRequest> heights_; ///< periodic
    std::map<std::uint16_t, CigiLosRequest> sights_;
    std::map<std::uint16_t, CigiPositionRequest> positions_;
    std::deque<Answer> waiting_;
    std::vector<std::uint16_t> removed_;
    std::optional<CigiAtmosphere> atmosphere_;
    std::optional<CigiCelestial> celestial_;
    std::array<long, 256> unknown_{};
    std::uint32_t frames_ = 0; ///< for periods
};

} // namespace octant::sim::links
