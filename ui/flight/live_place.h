#pragma once

#include "sim/base/geo_place.h"
#include "sim/links/fix.h"
#include "sim/links/live_vehicle.h"
#include "ui/world/world.h"

#include <glm/vec3.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace octant::ui::flight {

/// Whose heights count where senders bring a ground of their own.
enum class LiveHeight {
    /// Theirs above the sea.
    Msl,
    /// Theirs above ground, over ours.
    Agl,
    /// Theirs above the sea, moved once so that the first fix is as high above our ground.
    Offset
};

inline constexpr std::string_view live_height_names = "msl, agl or offset";

/// The mode of a name, nothing for another one; and back.
std::optional<LiveHeight> live_height_from(std::string_view name);
std::string_view name_of(LiveHeight height);

/// Where fixes lie over the ground of a run. On ground with a place of its own they lie there; else
/// the first fix is laid over the flight's place and the others around it; but fixes that would lie
/// on the map if its middle were 0 N, 0 E mean that, as another octant does on such a ground.
class LivePlace {
public:
    /// The world must outlive this. Without a height it is Msl over ground that knows its place,
    /// else Offset; hosts of CIGI always mean Msl then.
    LivePlace(const world::World& world, std::optional<LiveHeight> height);

    glm::dvec3 world_from(const sim::links::VehicleKey& key, const sim::links::Fix& fix);

    /// Where the world's origin lies on the earth; nothing until that is known.
    const std::optional<GeoPlace>& origin() const { return origin_; }

    LiveHeight height() const { return height_; }

    /// What a person should be told, a line each; those of the newest fix.
    std::vector<std::string> lines() const;

private:
    std::optional<double> ground_m(const glm::dvec2& at_m) const;
    double height_of(
        const sim::links::VehicleKey& key, const sim::links::Fix& fix, const glm::dvec2& at_m);

    const world::World& world_;
    bool height_is_chosen_;
    LiveHeight height_;
    std::optional<GeoPlace> origin_;
    std::map<sim::links::VehicleKey, double> offsets_m_;
    bool off_the_map_ = false;
    /// The heights of their ground and of ours at the newest fix.
    double their_ground_m_ = 0.0;
    double our_ground_m_ = 0.0;
    bool grounds_differ_ = false;
};

} // namespace octant::ui::flight
