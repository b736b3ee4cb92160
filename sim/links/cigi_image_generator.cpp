#include "sim/links/cigi_image_generator.h"

#include "sim/links/fix.h"

#include <algorithm>
#include <cmath>

namespace octant::sim::links {

CigiArticulatedParts::Pose CigiArticulatedParts::pose_at(const Part& part, double now_s) {
    const double passed_s = std::max(now_s - part.at_s, 0.0);
    return {
        part.pose.offset_m + passed_s * part.per_s.offset_m, part.pose.angles_rad + passed_s * part.per_s.angles_rad};
}

void CigiArticulatedParts::take(const CigiArticulatedPart& received, double at_s) {
    const std::pair key(received.entity, received.part);
    if (!received.enabled) {
        parts_.erase(key);
        return;
    }
    if (parts_.size() == max_parts && !parts_.contains(key)) { return; }
    Part& part = parts_[key];
    part.pose = pose_at(part, at_s);
    const glm::dvec3 received_rad(received.angles.roll_rad, received.angles.pitch_rad, received.angles.heading_rad);
    for (int i = 0; i < 3; ++i) {
        part.pose.offset_m[i] = received.moves[i] ? received.offset_m[i] : part.pose.offset_m[i];
        part.pose.angles_rad[i] = received.sets[i] ? received_rad[i] : part.pose.angles_rad[i];
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
        const glm::dmat3 turn = ned_from_body({pose.angles_rad.z, pose.angles_rad.y, pose.angles_rad.x});
        turned.push_back({key.first, key.second, glm::quat_cast(turn), pose.offset_m});
    }
    return turned;
}

namespace {

constexpr std::uint8_t low_bits(std::uint32_t frame) { return static_cast<std::uint8_t>(frame & 0xfU); }

/// Inserts or replaces a numbered value; refuses new numbers beyond a limit.
template <class Value>
bool keep(std::map<std::uint16_t, Value>& kept, std::uint16_t id, Value value, std::size_t most) {
    if (kept.size() >= most && !kept.contains(id)) { return false; }
    kept.insert_or_assign(id, std::move(value));
    return true;
}

} // namespace

DecodeResult CigiImageGenerator::take(Bytes message, std::vector<Fix>& moved, double arrival_s) {
    moved.clear();
    std::vector<CigiPacket> packets;
    const DecodeResult result = decode_cigi(message, packets);
    if (result.fault != PacketError::None) { return result; }
    has_host_ = true;
    std::vector<std::uint16_t> touched;
    for (const CigiPacket& packet : packets) { take(packet, arrival_s, touched); }
    std::ranges::sort(touched);
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const std::uint16_t number : touched) {
        const auto entity = entities_.find(number);
        if (entity == entities_.end()) { continue; }
        const Fix fix = fix_of(number, entity->second);
        if (error_of_fix(fix) == PacketError::None) { moved.push_back(fix); }
    }
    return result;
}

void CigiImageGenerator::take(const CigiPacket& packet, double arrival_s, std::vector<std::uint16_t>& touched) {
    if (const auto* control = std::get_if<CigiIgControl>(&packet)) {
        control_ = *control;
    } else if (const auto* entity = std::get_if<CigiEntityControl>(&packet)) {
        take_entity(*entity);
        touched.push_back(entity->entity);
    } else if (const auto* clamped = std::get_if<CigiClampedEntity>(&packet)) {
        CigiEntityControl placed;
        if (const auto known = entities_.find(clamped->entity); known != entities_.end()) {
            placed = known->second.control;
        }
        placed.entity = clamped->entity;
        placed.state = 1;
        placed.clamp = 1;
        placed.attitude = {clamped->heading_rad, 0.0, 0.0};
        placed.place = clamped->place;
        take_entity(placed);
        touched.push_back(clamped->entity);
    } else if (const auto* rate = std::get_if<CigiRateControl>(&packet)) {
        take_rate(*rate, arrival_s, touched);
    } else if (const auto* part = std::get_if<CigiArticulatedPart>(&packet)) {
        if (entities_.contains(part->entity)) { parts_.take(*part, arrival_s); }
    } else if (const auto* atmosphere = std::get_if<CigiAtmosphere>(&packet)) {
        atmosphere_ = *atmosphere;
    } else if (const auto* celestial = std::get_if<CigiCelestial>(&packet)) {
        celestial_ = *celestial;
    } else if (const auto* view = std::get_if<CigiViewControl>(&packet)) {
        take_view(*view);
    } else if (const auto* definition = std::get_if<CigiViewDefinition>(&packet)) {
        take_definition(*definition);
    } else if (const auto* height = std::get_if<CigiHeightRequest>(&packet)) {
        ask(*height);
    } else if (const auto* sight = std::get_if<CigiLosRequest>(&packet)) {
        ask(*sight);
    } else if (const auto* position = std::get_if<CigiPositionRequest>(&packet)) {
        ask(*position);
    } else if (const auto* unknown = std::get_if<CigiUnknownPacket>(&packet)) {
        ++unknown_[unknown->opcode];
    }
}

void CigiImageGenerator::take_rate(const CigiRateControl& rate, double arrival_s, std::vector<std::uint16_t>& touched) {
    const auto known = entities_.find(rate.entity);
    if (known == entities_.end()) { return; }
    if (rate.of_part) {
        parts_.take(rate, arrival_s);
    } else {
        known->second.rate = rate;
        touched.push_back(rate.entity);
    }
}

/// A view control of a group applies to each view defined as its member.
void CigiImageGenerator::take_view(const CigiViewControl& view) {
    if (view.group == 0) {
        keep(views_, view.view, view, max_views);
        return;
    }
    for (const auto& [number, definition] : definitions_) {
        if (definition.group == view.group) {
            CigiViewControl member = view;
            member.view = number;
            keep(views_, number, member, max_views);
        }
    }
}

/// Sides that the packet does not set stay.
void CigiImageGenerator::take_definition(const CigiViewDefinition& received) {
    CigiViewDefinition definition = received;
    if (const auto known = definitions_.find(received.view); known != definitions_.end()) {
        const CigiViewDefinition& before = known->second;
        definition.sets = glm::bvec4(received.sets.x || before.sets.x, received.sets.y || before.sets.y,
            received.sets.z || before.sets.z, received.sets.w || before.sets.w);
        definition.left_rad = received.sets.x ? received.left_rad : before.left_rad;
        definition.right_rad = received.sets.y ? received.right_rad : before.right_rad;
        definition.top_rad = received.sets.z ? received.top_rad : before.top_rad;
        definition.bottom_rad = received.sets.w ? received.bottom_rad : before.bottom_rad;
    }
    keep(definitions_, received.view, definition, max_views);
}

std::optional<std::uint16_t> CigiImageGenerator::type_of(std::uint16_t entity) const {
    const auto known = entities_.find(entity);
    return known == entities_.end() ? std::nullopt : std::optional(known->second.control.type);
}

void CigiImageGenerator::take_entity(const CigiEntityControl& control) {
    if (control.state != 1) {
        parts_.forget(control.entity);
        if (entities_.erase(control.entity) > 0) { removed_.push_back(control.entity); }
        return;
    }
    const auto known = entities_.find(control.entity);
    if (known != entities_.end()) {
        known->second.control = control;
    } else {
        keep(entities_, control.entity, Entity{control, {}}, max_entities);
    }
}

void CigiImageGenerator::wait(Answer answer) {
    if (waiting_.size() < max_waiting) { waiting_.push_back(std::move(answer)); }
}

// A period of 0 requests once and ends the periodic request of the same number.
void CigiImageGenerator::ask(const CigiHeightRequest& request) {
    heights_.erase(request.id);
    if (request.period == 0 || !keep(heights_, request.id, request, max_periodic)) {
        wait({request, low_bits(control_.host_frame)});
    }
}

void CigiImageGenerator::ask(const CigiLosRequest& request) {
    sights_.erase(request.id);
    if (request.period == 0 || !keep(sights_, request.id, request, max_periodic)) {
        wait({request, low_bits(control_.host_frame)});
    }
}

void CigiImageGenerator::ask(const CigiPositionRequest& request) {
    positions_.erase(request.object);
    if (!request.continuous || !keep(positions_, request.object, request, max_periodic)) {
        wait({request, low_bits(control_.host_frame)});
    }
}

/// Repeats the periodic requests that are due in this frame, with the host frame of the last IG Control.
void CigiImageGenerator::queue_periodic_requests() {
    const std::uint8_t host_frame = low_bits(control_.host_frame);
    for (const auto& [id, request] : heights_) {
        if (frames_ % request.period == 0) { wait({request, host_frame}); }
    }
    for (const auto& [id, request] : sights_) {
        if (frames_ % request.period == 0) { wait({request, host_frame}); }
    }
    for (const auto& [id, request] : positions_) { wait({request, host_frame}); }
    ++frames_;
}

/// World position of an entity with its parents; nothing if a parent is unknown or there are too many.
std::optional<glm::dvec3> CigiImageGenerator::place_of(std::uint16_t entity, int depth) const {
    constexpr int max_parents = 8;
    const auto known = entities_.find(entity);
    if (known == entities_.end() || depth > max_parents) { return std::nullopt; }
    const CigiEntityControl& control = known->second.control;
    glm::dvec3 place = control.place;
    if (control.attached) {
        const auto parent = place_of(control.parent, depth + 1);
        if (!parent || ground_ == nullptr) { return std::nullopt; }
        return ground_->moved(*parent, ned_from_body(attitude_of(control.parent)) * control.place);
    }
    if (control.clamp != 0 && ground_ != nullptr) {
        if (const auto surface = ground_->below(place)) { place.z += surface->place.z; }
    }
    return place;
}

EulerAngles CigiImageGenerator::attitude_of(std::uint16_t entity) const {
    glm::dmat3 turn(1.0);
    constexpr int max_parents = 8;
    for (int depth = 0; depth <= max_parents; ++depth) {
        const auto known = entities_.find(entity);
        if (known == entities_.end()) { break; }
        turn = ned_from_body(known->second.control.attitude) * turn;
        if (!known->second.control.attached) { break; }
        entity = known->second.control.parent;
    }
    return euler_from_ned_from_body(turn);
}

std::optional<glm::dvec3> CigiImageGenerator::place_from(
    bool of_entity, std::uint16_t entity, const glm::dvec3& place) const {
    if (!of_entity) { return place; }
    const auto from = place_of(entity);
    if (!from || ground_ == nullptr) { return std::nullopt; }
    return ground_->moved(*from, ned_from_body(attitude_of(entity)) * place);
}

Fix CigiImageGenerator::fix_of(std::uint16_t number, const Entity& entity) const {
    Fix fix;
    const auto place = place_of(number);
    constexpr double nowhere_deg = 1000.0;
    const glm::dvec3 at = place.value_or(glm::dvec3(nowhere_deg));
    fix.vehicle = number;
    fix.latitude_deg = at.x;
    fix.longitude_deg = at.y;
    fix.altitude_m = at.z;
    fix.attitude = attitude_of(number);
    if (entity.rate) {
        const glm::dmat3 turn = ned_from_body(fix.attitude);
        fix.velocity_ned_mps = entity.rate->local ? turn * entity.rate->mps : entity.rate->mps;
        fix.body_rates_radps = entity.rate->radps;
        fix.velocity_is_commanded = true;
    }
    if (control_.timestamp_valid) {
        constexpr double second_in_ticks = 1e5;
        fix.ticks = control_.timestamp;
        fix.tick_s = 1.0 / second_in_ticks;
    }
    return fix;
}

} // namespace octant::sim::links
