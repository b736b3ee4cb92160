// What an image generator answers: the questions of a host over the ground, and its message for a picture.

#include "sim/links/cigi_image_generator.h"
#include "sim/links/fix.h"

#include <cmath>

namespace octant::sim::links {

void CigiImageGenerator::answer_height(
    const CigiHeightRequest& request, std::uint8_t host_frame, WireWriter& message) const {
    const auto place = place_from(request.from_entity, request.entity, request.place);
    const auto surface = place && ground_ != nullptr ? ground_->below(*place) : std::nullopt;
    const CigiResponseHeader head{request.id, surface.has_value(), host_frame};
    const double hat_m = surface ? place->z - surface->place.z : 0.0;
    if (request.kind == CigiHeightKind::Extended) {
        add_extended_height_response(message, head, hat_m, surface.value_or(CigiSurfacePoint{}));
        return;
    }
    const double hot_m = surface ? surface->place.z : 0.0;
    add_height_response(message, head, request.kind, request.kind == CigiHeightKind::Hat ? hat_m : hot_m);
}

void CigiImageGenerator::answer_sight(
    const CigiLosRequest& request, std::uint8_t host_frame, WireWriter& message) const {
    const auto from = place_from(request.from_entity, request.entity, request.source);
    std::optional<glm::dvec3> to;
    if (from && ground_ != nullptr && request.is_vector) {
        const EulerAngles direction{request.azimuth_rad, request.elevation_rad, 0.0};
        glm::dmat3 turn = ned_from_body(direction);
        if (request.from_entity) { turn = ned_from_body(attitude_of(request.entity)) * turn; }
        to = ground_->moved(*from, turn * glm::dvec3(request.max_m, 0.0, 0.0));
    } else {
        const std::uint16_t entity = request.to_is_given ? request.to : request.entity;
        to = place_from(request.to_entity, entity, request.destination);
    }
    const bool known = from && to && ground_ != nullptr && ground_->below(*from);
    CigiLosResponse sight;
    if (known) {
        const auto met = ground_->first_hit(*from, *to);
        const bool counts = met && (!request.is_vector || met->range_m >= request.min_m);
        sight.visible = !counts;
        if (counts) {
            sight.range_m = met->range_m;
            sight.met = met->surface;
        } else if (!request.is_vector) {
            sight.range_m = ground_->distance_m(*from, *to);
            sight.met = CigiSurfacePoint{*to, 0.0, 0.0};
        }
    }
    add_los_response(message, {request.id, known, host_frame}, request.extended, sight);
}

/// Nothing is answered for what is no entity or not known.
void CigiImageGenerator::answer_position(const CigiPositionRequest& request, WireWriter& message) const {
    const auto place = place_of(request.object);
    if (request.object_class == 0 && place) {
        add_position(message, request.object, *place, attitude_of(request.object));
    }
}

void CigiImageGenerator::answer(const Answer& answer, WireWriter& message) const {
    if (const auto* height = std::get_if<CigiHeightRequest>(&answer.request)) {
        answer_height(*height, answer.host_frame, message);
    } else if (const auto* sight = std::get_if<CigiLosRequest>(&answer.request)) {
        answer_sight(*sight, answer.host_frame, message);
    } else {
        answer_position(std::get<CigiPositionRequest>(answer.request), message);
    }
}

std::vector<std::byte> CigiImageGenerator::message_for(std::uint32_t ig_frame, double time_s) {
    queue_periodic_requests();
    constexpr double second_in_ticks = 1e5;
    WireWriter message(ByteOrder::Big);
    add_start_of_frame(message, {ig_frame, control_.host_frame,
                                    static_cast<std::uint32_t>(std::llround(time_s * second_in_ticks) & 0xffffffffLL),
                                    has_host_ ? control_.mode : CigiMode::Standby, control_.database});
    while (!waiting_.empty() && message.size() + cigi_max_response_bytes <= max_message_bytes) {
        answer(waiting_.front(), message);
        waiting_.pop_front();
    }
    return message.take();
}

} // namespace octant::sim::links
