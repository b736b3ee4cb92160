#pragma once

#include "sim/base/transverse_mercator.h"
#include "sim/links/fix.h"
#include "sim/links/live_traffic.h"
#include "ui/world/world.h"

#include <glm/vec2.hpp>

#include <map>
#include <optional>
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

inline constexpr std::string_view live_height_mode_names = "msl, agl or offset";

/// The mode of a name, nothing for another one; and back.
std::optional<LiveHeightMode> live_height_mode_from(std::string_view name);
std::string_view name_of(LiveHeightMode height);

/// Where fixes lie over the ground of a run. On ground with a place of its own they lie there; else
/// the first fix is laid over the flight's place and the others around it; but fixes that would lie
/// on the map if its middle were 0 N, 0 E mean that, as another octant does on such a ground.
class LiveGeoreference {
public:
    /// The world must outlive this. Without a height it is Msl over ground that knows its place,
    /// else Offset; hosts of CIGI always mean Msl then.
    LiveGeoreference(const world::World& world, std::optional<LiveHeightMode> height);

    sim::links::WorldPosition
    world_position(const sim::links::VehicleKey& key, const sim::links::Fix& fix);

    /// How the world lies on the earth; null until that is known.
    const EarthFrame* frame() const { return assigned_frame_ ? &*assigned_frame_ : world_.ground_frame.get(); }

    /// Where the world's origin lies on the earth; nothing until that is known.
    std::optional<GeoPosition> origin() const {
        return frame() == nullptr ? std::nullopt : std::optional(frame()->origin());
    }

    LiveHeightMode height() const { return height_; }

    /// What a person should be told, a line each; those of the newest fix.
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
        const sim::links::VehicleKey& key,
        const sim::links::Fix& fix,
        const glm::dvec2& at_m,
        double ours_m);
    glm::dvec3 over_ground(
        const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m);
    double height_of(
        const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m);

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

} // namespace octant::ui::flight
