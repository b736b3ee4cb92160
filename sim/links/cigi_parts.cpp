#include "sim/links/cigi_parts.h"

#include "sim/links/earth.h"

#include <algorithm>

namespace octant::sim::links {

glm::dvec3 CigiParts::angles_at(const Part& part, double now_s) {
    return part.angles_rad + std::max(now_s - part.at_s, 0.0) * part.radps;
}

void CigiParts::take(const CigiPart& told, double at_s) {
    const std::pair key(told.entity, told.part);
    if (!told.enabled) {
        parts_.erase(key);
        return;
    }
    if (parts_.size() == most_parts && !parts_.contains(key)) {
        return;
    }
    Part& part = parts_[key];
    const glm::dvec3 before_rad = angles_at(part, at_s);
    const glm::dvec3 told_rad(told.angles.roll_rad, told.angles.pitch_rad, told.angles.heading_rad);
    for (int i = 0; i < 3; ++i) {
        part.angles_rad[i] = told.sets[i] ? told_rad[i] : before_rad[i];
    }
    part.at_s = at_s;
}

void CigiParts::take(const CigiRate& rate, double at_s) {
    const auto known = parts_.find({rate.entity, rate.part});
    if (known != parts_.end()) {
        known->second.angles_rad = angles_at(known->second, at_s);
        known->second.at_s = at_s;
        known->second.radps = rate.radps;
    }
}

void CigiParts::forget(std::uint16_t entity) {
    std::erase_if(parts_, [entity](const auto& part) { return part.first.first == entity; });
}

std::vector<CigiTurnedPart> CigiParts::turned(double now_s) const {
    std::vector<CigiTurnedPart> turned;
    turned.reserve(parts_.size());
    for (const auto& [key, part] : parts_) {
        const glm::dvec3 angles_rad = angles_at(part, now_s);
        const glm::dmat3 turn = ned_from_body({angles_rad.z, angles_rad.y, angles_rad.x});
        turned.push_back({key.first, key.second, glm::quat_cast(turn)});
    }
    return turned;
}

} // namespace octant::sim::links
