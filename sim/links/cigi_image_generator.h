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

/// An articulated part of an entity, such as a rotor or a flap, as its host has turned and moved it.
struct CigiPartPose {
    std::uint16_t entity = 0;
    std::uint8_t part = 0;
    glm::dquat turn{1.0, 0.0, 0.0, 0.0}; ///< in body axes
    glm::dvec3 offset_m{0.0};            ///< in body axes
};

/// The articulated parts of the entities of a host. Angles and offsets change with the rates that the host sets.
class CigiArticulatedParts {
public:
    static constexpr std::size_t max_parts = 1024;

    /// Applies a packet. Angles and offsets that it does not set stay; a part that it disables moves by itself again.
    void take(const CigiArticulatedPart& part, double at_s);

    /// Sets the rates of a part that take() knows.
    void take(const CigiRateControl& rate, double at_s);

    void forget(std::uint16_t entity);

    /// All parts at a time of the clock of take().
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

/// Ground that a host may query. Positions: latitude and longitude in degrees, height in metres.
class CigiGround {
public:
    CigiGround() = default;
    virtual ~CigiGround() = default;
    CigiGround(const CigiGround&) = delete;
    CigiGround& operator=(const CigiGround&) = delete;
    CigiGround(CigiGround&&) = delete;
    CigiGround& operator=(CigiGround&&) = delete;

    /// Height of the ground at a position; nothing outside the map.
    virtual std::optional<CigiSurfacePoint> below(const glm::dvec3& place) const = 0;

    /// First intersection of a straight line with the ground, with its distance from the start of the line.
    struct TerrainHit {
        double range_m = 0.0;
        CigiSurfacePoint surface;
    };

    virtual std::optional<TerrainHit> first_hit(const glm::dvec3& from, const glm::dvec3& to) const = 0;

    /// Straight distance between two positions.
    virtual double distance_m(const glm::dvec3& from, const glm::dvec3& to) const = 0;

    /// The position that is `ned_m` metres north, east and down of another one.
    virtual glm::dvec3 moved(const glm::dvec3& place, const glm::dvec3& ned_m) const = 0;
};

/// The image generator of CIGI 3.3: stores the entities and views of the host and answers its requests. Opens no
/// sockets and reads no clock.
class CigiImageGenerator {
public:
    static constexpr std::size_t max_entities = 256;
    static constexpr std::size_t max_views = 16;
    static constexpr std::size_t max_periodic = 256;
    static constexpr std::size_t max_waiting = 1024;
    static constexpr std::size_t max_message_bytes = 1472;

    /// `ground` must outlive this; null: every request is answered as outside the database.
    explicit CigiImageGenerator(const CigiGround* ground) : ground_(ground) {}

    /// Reads a message of the host. Returns the fixes of the entities that it moved, by entity number.
    DecodeResult take(Bytes message, std::vector<Fix>& moved, double arrival_s = 0.0);

    /// The message for one picture: Start of Frame, then answers as far as they fit; the others wait.
    std::vector<std::byte> message_for(std::uint32_t ig_frame, double time_s);

    /// True once a message of a host was read.
    bool has_host() const { return has_host_; }

    std::uint32_t host_frame() const { return control_.host_frame; }

    CigiMode mode() const { return control_.mode; }

    /// Entities removed since the last call.
    std::vector<std::uint16_t> take_removed() { return std::exchange(removed_, {}); }

    /// The newest packet of each kind, if the host has sent any.
    const std::optional<CigiAtmosphere>& atmosphere() const { return atmosphere_; }

    const std::optional<CigiCelestial>& celestial() const { return celestial_; }

    const std::map<std::uint16_t, CigiViewControl>& views() const { return views_; }

    const std::map<std::uint16_t, CigiViewDefinition>& definitions() const { return definitions_; }

    const CigiArticulatedParts& parts() const { return parts_; }

    /// Type of an existing entity.
    std::optional<std::uint16_t> type_of(std::uint16_t entity) const;

    /// Number of packets that were not understood, by opcode.
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
    void take_definition(const CigiViewDefinition& received);
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
    std::uint32_t frames_ = 0; ///< counts frames for periodic requests
};

} // namespace octant::sim::links
