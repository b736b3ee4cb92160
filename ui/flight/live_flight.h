#pragma once

#include "sim/base/earth_frame.h"
#include "sim/links/cigi_image_generator.h"
#include "sim/links/cigi_packets.h"
#include "sim/links/fix.h"
#include "sim/links/live_traffic.h"
#include "ui/flight/session.h"
#include "ui/flight/simulation.h"
#include "ui/report/frame_record.h"
#include "ui/settings/settings_text.h"
#include "ui/world/world.h"
#include "visuals/scene/settings.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::flight {

/// Whose heights count where senders bring a ground of their own.
enum class LiveHeightMode {
    /// Theirs above the sea.
    Msl,
    /// Theirs above ground, over ours.
    Agl,
    /// Theirs above the sea, moved so that it begins as high above our ground.
    Offset
};

/// Where fixes lie over the ground of a run. On georeferenced ground they lie where that has their positions. Else the
/// first fix is placed at the flight's place and the others around it; but fixes within the map when its centre is
/// taken as 0 N, 0 E, as another octant sends from generated ground, are placed there.
class LiveGeoreference {
public:
    /// The world must outlive this. Without a height it is Msl over ground that knows its place, else Offset; hosts of
    /// CIGI always mean Msl then.
    LiveGeoreference(const world::World& world, std::optional<LiveHeightMode> height);

    sim::links::WorldPosition world_position(const sim::links::VehicleKey& key, const sim::links::Fix& fix);

    /// The world's axes on the earth; null until they are known.
    const EarthFrame* frame() const { return assigned_frame_ ? &*assigned_frame_ : world_.ground.frame.get(); }

    /// Where the world's origin lies on the earth; nothing until that is known.
    std::optional<GeoPosition> origin() const {
        return frame() == nullptr ? std::nullopt : std::optional(frame()->origin());
    }

    LiveHeightMode height() const { return height_; }

    /// Messages for the user about the newest fix, a line each.
    std::vector<std::string> lines() const;

private:
    /// How far a vehicle is moved up.
    struct Offset {
        glm::dvec2 last_at_m{0.0};
        /// Fixes that it had moved in.
        int moves = 0;
        double added_m = 0.0;
    };

    std::optional<double> ground_m(const glm::dvec2& at_m) const;
    void georeference_generated_ground(const GeoPosition& first);
    void compare_grounds(const sim::links::Fix& fix, std::optional<double> ours_m);
    double offset_m(
        const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m, double ours_m);
    glm::dvec3 over_ground(const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m);
    double height_of(const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m);

    const world::World& world_;
    bool height_mode_is_given_;
    LiveHeightMode height_;
    /// Of ground without a place of its own.
    std::optional<TransverseMercator> assigned_frame_;
    std::map<sim::links::VehicleKey, Offset> offsets_;
    bool off_the_map_ = false;
    /// How far the newest fix is under our ground.
    double under_ground_m_ = 0.0;
    /// The heights of their ground and of ours at the newest fix.
    double their_ground_m_ = 0.0;
    double our_ground_m_ = 0.0;
    bool grounds_differ_ = false;
    /// Whether heights above ground are asked for that the newest fix has not.
    bool agl_unknown_ = false;
};

/// Air as a host of CIGI has it: its visibility, from 50 m to 500 km, and the time of day at that longitude by its
/// universal time; all else as in `defaults`. Without a place its time is taken as local solar time.
visuals::scene::AirSettings air_from_cigi(visuals::scene::AirSettings defaults,
    const std::optional<sim::links::CigiAtmosphere>& atmosphere,
    const std::optional<sim::links::CigiCelestial>& celestial, const std::optional<GeoPosition>& place);

/// Which of several pictures side by side this one is: left and right are turned by its own width.
enum class LiveChannel { Left, Front, Right };

/// How motion from outside is shown.
struct LiveOptions {
    double delay_s = 0.0;
    std::optional<LiveHeightMode> height;
    /// One picture for each packet that moves something, of the state in that packet.
    bool step = false;
    LiveChannel channel = LiveChannel::Front;
    /// Which of a CIGI host's views is shown; nothing: the one of the lowest number.
    std::optional<int> view;
    /// The types of a CIGI host's entities, and an aircraft of the world that has the shape of each.
    std::map<std::uint16_t, std::size_t> shapes;
};

/// Flies the aircraft of a world by packets: the vehicle that came first is the first aircraft, and so on, but a CIGI
/// host's entity N is aircraft N, counted from 0, where there are as many, or one of the shape that its type has;
/// aircraft that nobody flies yet are not seen, the first one waits at its place. Reads no clock: the same packets and
/// times give the same states.
class LiveFlight final : public StateSource {
public:
    /// The world must outlive it.
    LiveFlight(const LiveOptions& options, const world::World& world);

    /// Takes the next packet in the order in which they came.
    sim::links::LiveTraffic::PacketOutcome take(const sim::links::Datagram& packet) { return traffic_.take(packet); }

    void states_at(double time_s, std::span<sim::AircraftState> states) override;

    /// Messages for the user, a line each.
    std::vector<std::string> lines() const;

    /// Fills in what came since the last frame that was filled in. `finished_s` is when its picture was finished, on
    /// the clock of the packets.
    void fill_in(report::FrameRecord& record, double finished_s);

    /// Those messages that are new since the last call.
    std::vector<std::string> take_new_messages() { return traffic_.take_new_messages(); }

    bool is_flown(std::size_t aircraft) const override;

    const EarthFrame* frame() const override { return place_.frame(); }

    /// The message that CIGI hosts get for a picture.
    std::vector<std::byte> cigi_message(std::uint32_t picture, double time_s) {
        return traffic_.cigi().message_for(picture, time_s);
    }

    visuals::scene::Camera camera(std::size_t view, std::span<const sim::AircraftState> states,
        const visuals::scene::Camera& default_camera, double aspect) const override;

    std::span<const visuals::planning::ArticulatedPart> articulated_parts() const override { return turned_; }

    /// Sets width over height of the pictures to come.
    void set_aspect(double aspect) { aspect_ = aspect; }

    /// `own` with the air that a CIGI host has sent.
    visuals::scene::AirSettings air_of(const visuals::scene::AirSettings& own) const;

    /// Whether each packet that moves something is one picture.
    bool is_stepped() const { return options_.step; }

    const sim::links::LiveTraffic& traffic() const { return traffic_; }

    const LiveGeoreference& place() const { return place_; }

private:
    /// Which aircraft shows a vehicle.
    struct VehicleSlot {
        std::size_t aircraft = 0;
        /// The type of an entity; nothing for other vehicles.
        std::optional<std::uint16_t> type;
    };

    std::optional<std::uint16_t> cigi_view(std::size_t view) const;
    std::optional<visuals::scene::Camera> camera_of_view(
        std::uint16_t number, std::span<const sim::AircraftState> states, double aspect) const;
    std::optional<std::string> frustum_line() const;
    std::size_t free_aircraft(const sim::links::VehicleKey& key, std::optional<std::uint16_t> type) const;
    void assign_aircraft(std::size_t vehicles);
    std::optional<std::size_t> aircraft_of(std::uint16_t entity) const;
    void turn_parts(double time_s);

    LiveOptions options_;
    const world::World& world_;
    LiveGeoreference place_;
    std::unique_ptr<const sim::links::CigiGround> cigi_ground_;
    sim::links::LiveTraffic traffic_;
    sim::links::TrafficCounts reported_counts_;
    /// The time of the newest packet in the last frame.
    double newest_s_ = -1.0;
    /// By vehicle, as far as they are shown.
    std::vector<VehicleSlot> slots_;
    std::vector<visuals::planning::ArticulatedPart> turned_;
    /// Width over height of the pictures.
    double aspect_ = 1.0;
    std::vector<sim::AircraftState> vehicle_states_;
};

// What a live flight changes in its session in addition to the aircraft.

/// To be called before each picture: gives the flight the aspect ratio of the session's pictures, and the session the
/// visibility that a CIGI host has sent.
void apply_host_visibility(LiveFlight& live, Session& session);

/// After apply_host_visibility(): brings the sun to the time of day that a CIGI host has sent; in steps at once, else
/// by Session::follow_time_of_day(). Returns the time that pictures show from this one on, where it is another one.
std::optional<std::string> apply_host_time_of_day(const LiveFlight& live, Session& session);

/// For a flight that is repeated: brings the sun to the time of day that apply_host_time_of_day() gave then.
void set_time_of_day(const std::string& time_of_day, Session& session);

} // namespace octant::ui::flight

namespace octant::ui::settings {

template <>
inline constexpr std::array enum_names<flight::LiveHeightMode>{EnumName{flight::LiveHeightMode::Msl, "msl"},
    EnumName{flight::LiveHeightMode::Agl, "agl"}, EnumName{flight::LiveHeightMode::Offset, "offset"}};

template <>
inline constexpr std::array enum_names<flight::LiveChannel>{EnumName{flight::LiveChannel::Left, "left"},
    EnumName{flight::LiveChannel::Front, "front"}, EnumName{flight::LiveChannel::Right, "right"}};

} // namespace octant::ui::settings
