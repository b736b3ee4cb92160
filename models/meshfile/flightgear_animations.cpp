#include "models/meshfile/flightgear_animations.h"

#include "models/meshfile/flightgear_conditions.h"
#include "models/meshfile/flightgear_numbers.h"
#include "sim/base/error.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace octant::models::meshfile {

namespace {

using Names = std::set<std::string>;
using Groups = std::map<std::string, Names>;

void add_names(const XmlElement& animation, Names& names) {
    if (animation.find("object-name") == nullptr) {
        names.insert("");
    }
    for (const XmlElement& named : animation.children) {
        if (named.name == "object-name") {
            names.insert(named.text);
        }
    }
}

/// Animations without a type give several objects one name.
Groups groups_in(const XmlElement& root) {
    Groups groups;
    for (const XmlElement& child : root.children) {
        const std::string name(child.text_of("name"));
        if (child.name == "animation" && child.text_of("type").empty() && !name.empty()) {
            add_names(child, groups[name]);
            groups[name].erase(""); // of a group without members
        }
    }
    return groups;
}

/// Adds the members of all groups that are named, and of groups among them.
void expand(Names& names, const Groups& groups) {
    for (std::size_t before = 0; before != names.size();) {
        before = names.size();
        for (const auto& [group, members] : groups) {
            if (names.contains(group)) {
                names.insert(members.begin(), members.end());
            }
        }
    }
}

bool is_shadow(const std::string& name) {
    std::string lower = name;
    std::ranges::transform(
        lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower.find("shadow") != lower.npos && lower.find("noshadow") == lower.npos;
}

/// Sheets that FlightGear's older models move along the ground below them.
void add_shadows(const XmlElement& animation, Names& hidden) {
    Names names;
    add_names(animation, names);
    std::ranges::copy_if(names, std::inserter(hidden, hidden.end()), is_shadow);
}

/// Turns of objects about the same axis become one: each costs a reading of the mesh.
void add_turn(FlightGearRotation turn, std::vector<FlightGearRotation>& turns) {
    const auto found = std::ranges::find_if(turns, [&](const FlightGearRotation& other) {
        return other.objects.empty() == turn.objects.empty() &&
               other.about.point_m == turn.about.point_m &&
               other.about.direction == turn.about.direction &&
               other.about.turns_per_s == turn.about.turns_per_s;
    });
    if (found != turns.end()) {
        found->objects.merge(turn.objects);
    } else {
        turns.push_back(std::move(turn));
    }
}

/// What `read(file, animation)` gives; nothing for one whose numbers are faulty.
template <typename Read>
auto unless_faulty(
    const Read& read,
    const std::filesystem::path& file,
    const XmlElement& animation,
    std::vector<std::string>& notes) -> decltype(read(file, animation)) {
    try {
        return read(file, animation);
    } catch (const Error& fault) {
        notes.push_back(fmt::format("{}; what it moves is left at rest", fault.what()));
        return std::nullopt;
    }
}

/// Whether an animation hides what it names from an eye outside, at rest. Ranges that begin within
/// some metres hide a pilot from his own eye; those that begin at a level of detail hold coarser
/// levels, which are not needed: the finest one is refined. One whose numbers are faulty hides
/// nothing.
bool hides(
    const std::filesystem::path& file,
    const XmlElement& animation,
    std::vector<std::string>& notes) {
    const std::string_view kind = animation.text_of("type");
    if (kind != "range") {
        return kind == "light" || !holds_at_rest(animation);
    }
    try {
        constexpr double eye_outside_m = 10.0;
        return animation.find("min-property") != nullptr ||
               number_in(file, animation, "min-m") > eye_outside_m;
    } catch (const Error& fault) {
        notes.push_back(fmt::format("{}; what it names is always shown", fault.what()));
        return false;
    }
}

} // namespace

const RotationAxis* FlightGearAnimations::axis_of(const std::string& object) const {
    const auto found = std::ranges::find_if(turns, [&](const FlightGearRotation& turn) {
        return object.empty() ? turn.objects.empty() : turn.objects.contains(object);
    });
    return found == turns.end() ? nullptr : &found->about;
}

AffineTransform FlightGearAnimations::place_of(const std::string& object) const {
    AffineTransform place;
    for (const FlightGearRestPlacement& move : moves) {
        if (move.objects.contains(object) && axis_of(object) == nullptr) {
            place = place.of(move.placement);
        }
    }
    return place;
}

FlightGearAnimations
flightgear_animations(const std::filesystem::path& file, const XmlElement& root) {
    const Groups groups = groups_in(root);
    FlightGearAnimations animated;
    for (const XmlElement& child : root.children) {
        const std::string kind(child.text_of("type"));
        if (child.name != "animation" || kind.empty()) {
            continue;
        }
        if (kind == "range" || kind == "select" || kind == "light") {
            if (hides(file, child, animated.notes)) {
                add_names(child, animated.hidden);
            }
        } else if (auto turn = unless_faulty(rotation_in_flight, file, child, animated.notes)) {
            expand(turn->objects, groups);
            add_turn(std::move(*turn), animated.turns);
        } else {
            ++animated.at_rest[kind];
            if (kind == "translate" || kind == "rotate") {
                add_shadows(child, animated.hidden);
            }
            if (auto move = unless_faulty(placement_at_rest, file, child, animated.notes)) {
                expand(move->objects, groups);
                animated.moves.push_back(std::move(*move));
            }
        }
    }
    expand(animated.hidden, groups);
    return animated;
}

} // namespace octant::models::meshfile
