#include "sim/links/cigi_articulated_parts.h"

#include "sim/links/earth.h"

#include <algorithm>

namespace octant::sim::links {

CigiArticulatedParts::Pose CigiArticulatedParts::pose_at(const Part& part, double now_s) {
    const double passed_s = std::max(now_s - part.at_s, 0.0);
    return {
        part.pose.offset_m + passed_s * part.per_s.offset_m,
        part.pose.angles_rad + passed_s * part.per_s.angles_rad};
}

void CigiArticulatedParts::take(const CigiArticulatedPart& told, double at_s) {
    const std::pair key(told.entity, told.part);
    if (!told.enabled) {
        parts_.erase(key);
        return;
    }
    if (parts_.size() == max_parts && !parts_.contains(key)) {
        return;
    }
    Part& part = parts_[key];
    part.pose = pose_at(part, at_s);
    const glm::dvec3 told_rad(told.angles.roll_rad, told.angles.pitch_rad, told.angles.heading_rad);
    for (int i = 0; i < 3; ++i) {
        part.pose.offset_m[i] = told.moves[i] ? told.offset_m[i] : part.pose.offset_m[i];
        part.pose.angles_rad[i] = told.sets[i] ? told_rad[i] : part.pose.angles_rad[i];
    }
    part.at_s = at_s;
}

void CigiArticulatedParts::take(const CigiRateControl& rate, double at_s) {
    const auto known = parts_.find({rate.entity, rate.part});
    if (known != parts_.end()) {
        known->second.pose = pose_at(known->second, at_s);
        known->second.at_s = at_s;
        known->second.per_s = {rate.mps, rate.radps};
    }
}

void CigiArticulatedParts::forget(std::uint16_t entity) {
    std::erase_if(parts_, [entity](const auto& part) { return part.first.first == entity; });
}

std::vector<CigiPartPose> CigiArticulatedParts::turned(double now_s) const {
    std::vector<CigiPartPose> turned;
    turned.reserve(parts_.size());
    for (const auto& [key, part] : parts_) {
        const Pose pose = pose_at(part, now_s);
        const glm::dmat3 turn =
            ned_from_body({pose.angles_rad.z, pose.angles_rad.y, pose.angles_rad.x});
        turned.push_back({key.first, key.second, glm::quat_cast(turn), pose.offset_m});
    }
    return turned;
}

} // namespace octant::sim::links
