#include "tests/flightpaths/generated_tracks.h"

#include "sim/base/axes.h"
#include "sim/base/earth_frame.h"
#include "sim/base/units.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>

namespace octant::tests {

namespace {

constexpr double turn = 6.283185307179586;
constexpr double degree = turn / 360.0;
constexpr double weight_mps2 = 9.80665;
constexpr double step_s = 0.02;

/// Random numbers that are the same everywhere.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ULL + 0x1234567ULL) {}

    double between(double low, double high) { return low + (high - low) * share(); }

    double share() {
        state_ += 0x9E3779B97F4A7C15ULL;
        std::uint64_t bits = state_;
        bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
        bits ^= bits >> 31U;
        return static_cast<double>(bits >> 11U) / 9007199254740992.0;
    }

    double normal() { return std::sqrt(-2.0 * std::log(1.0 - share())) * std::cos(turn * share()); }

private:
    std::uint64_t state_;
};

/// A value that goes to its target like a damped spring.
struct Sluggish {
    double value = 0.0;
    double rate = 0.0;
    double natural_radps = 1.0;
    double fastest = 1e9;

    void step(double target) {
        rate += (natural_radps * natural_radps * (target - value) - 2.0 * natural_radps * rate) * step_s;
        rate = std::clamp(rate, -fastest, fastest);
        value += rate * step_s;
    }
};

/// What the pilot wants for a time.
struct Order {
    double lasts_s = 0.0;
    double bank_deg = 0.0;
    double climb_mps = 0.0;
    double speed_mps = 0.0;
    double turn_degps = 0.0; ///< on the ground and of rotorcraft
};

/// A wing: angle of attack by lift, from its own numbers.
struct Airframe {
    double cruise_mps = 55.0;
    double cruise_lift = 0.35;
    double lift_slope = 5.2;
    double zero_lift_deg = -2.2;
    /// What flaps add to the lift, as an angle, when they are all out.
    double flaps_deg = 5.0;
    bool rotor = false;
    double drag_per_s = 0.018;
};

class Flight {
public:
    Flight(const Airframe& airframe, const glm::dvec2& wind_mps, double heading_deg, std::vector<TrueState>& truth)
        : airframe_(airframe), wind_mps_(wind_mps), heading_rad_(heading_deg * degree), truth_(truth) {
        bank_.natural_radps = 1.6;
        bank_.fastest = 25.0 * degree;
        climb_.natural_radps = 0.9;
        climb_.fastest = 3.0;
        speed_.natural_radps = 0.5;
        speed_.fastest = 2.5;
        turn_.natural_radps = 1.0;
    }

    void begin_in_flight(double height_m, double speed_mps) {
        position_m_.z = height_m;
        speed_.value = speed_mps;
        on_ground_ = false;
    }

    void carry_out(const Order& order) {
        const auto steps = static_cast<int>(order.lasts_s / step_s);
        for (int i = 0; i < steps; ++i) { on_ground_ ? roll(order) : airframe_.rotor ? hover(order) : fly(order); }
    }

    /// Accelerates until it flies at this speed.
    void take_off(double speed_mps) {
        while (speed_.value < speed_mps) { roll({.speed_mps = speed_mps * 1.3}); }
        leave_ground();
    }

    void leave_ground() {
        on_ground_ = false;
        const glm::dvec2 air_mps = ground_velocity_mps() - wind_mps_;
        if (airframe_.rotor) { return; }
        // Take-offs are along the wind's line: the nose stays where it was.
        speed_.value = glm::length(air_mps);
        heading_rad_ = std::atan2(air_mps.x, air_mps.y);
    }

    /// Sinks to the ground at height 0, and stops there.
    void land(double speed_mps) {
        while (position_m_.z > 0.0) {
            const double sink_mps = std::min(3.0, 0.4 + 0.25 * position_m_.z);
            const Order order{.climb_mps = -sink_mps, .speed_mps = speed_mps};
            airframe_.rotor ? hover(order) : fly(order);
        }
        const glm::dvec2 ground_mps = airframe_.rotor ? ground_velocity_mps() : ground_velocity_mps() + wind_mps_;
        position_m_.z = 0.0;
        climb_ = {.natural_radps = climb_.natural_radps, .fastest = climb_.fastest};
        on_ground_ = true;
        speed_.value = glm::length(ground_mps);
        if (!airframe_.rotor) { heading_rad_ = std::atan2(ground_mps.x, ground_mps.y); }
    }

private:
    glm::dvec2 ground_velocity_mps() const {
        return speed_.value * glm::dvec2(std::sin(heading_rad_), std::cos(heading_rad_));
    }

    void write(const glm::dvec3& velocity_mps, double pitch_rad, double roll_rad) {
        position_m_ += velocity_mps * step_s;
        truth_.push_back({static_cast<double>(truth_.size()) * step_s, position_m_, velocity_mps, heading_rad_ / degree,
            pitch_rad / degree, roll_rad / degree, on_ground_});
    }

    void roll(const Order& order) {
        speed_.step(order.speed_mps);
        speed_.value = std::max(0.0, speed_.value);
        turn_.step(speed_.value > 1.0 ? order.turn_degps * degree : 0.0);
        heading_rad_ += turn_.value * step_s;
        write(glm::dvec3(ground_velocity_mps(), 0.0), 0.0, 0.0);
    }

    void fly(const Order& order) {
        bank_.step(order.bank_deg * degree);
        climb_.step(order.climb_mps);
        speed_.step(order.speed_mps);
        const double airspeed_mps = std::sqrt(speed_.value * speed_.value + climb_.value * climb_.value);
        const double lift_mps2 = (weight_mps2 + climb_.rate) / std::cos(bank_.value);
        heading_rad_ += lift_mps2 * std::sin(bank_.value) / speed_.value * step_s;
        const double ratio = airframe_.cruise_mps / airspeed_mps;
        const double lift = airframe_.cruise_lift * lift_mps2 / weight_mps2 * ratio * ratio;
        // Flaps come out between 0.9 and 0.6 of the cruising speed.
        const double flaps = std::clamp((0.9 - speed_.value / airframe_.cruise_mps) / 0.3, 0.0, 1.0);
        const double attack_rad =
            lift / airframe_.lift_slope + (airframe_.zero_lift_deg - flaps * airframe_.flaps_deg) * degree;
        const double path_rad = std::asin(climb_.value / airspeed_mps);
        write(glm::dvec3(ground_velocity_mps() + wind_mps_, climb_.value),
            path_rad + attack_rad * std::cos(bank_.value), bank_.value);
    }

    /// Thrust carries it, accelerates it and overcomes its drag.
    void hover(const Order& order) {
        turn_.step(order.turn_degps * degree);
        heading_rad_ += turn_.value * step_s;
        speed_.step(order.speed_mps);
        climb_.step(order.climb_mps);
        const glm::dvec2 ahead(std::sin(heading_rad_), std::cos(heading_rad_));
        const double forward_mps2 = speed_.rate + airframe_.drag_per_s * (speed_.value - glm::dot(wind_mps_, ahead));
        const glm::dvec2 right(ahead.y, -ahead.x);
        const double side_mps2 = speed_.value * turn_.value - airframe_.drag_per_s * glm::dot(wind_mps_, right);
        const double up_mps2 = weight_mps2 + climb_.rate;
        const double pitch_rad = -std::atan2(forward_mps2, up_mps2);
        write(glm::dvec3(ground_velocity_mps(), climb_.value), pitch_rad,
            std::atan2(side_mps2, std::hypot(up_mps2, forward_mps2)));
    }

    Airframe airframe_;
    glm::dvec2 wind_mps_;
    glm::dvec3 position_m_{0.0};
    double heading_rad_ = 0.0;
    bool on_ground_ = true;
    Sluggish bank_;
    Sluggish climb_;
    Sluggish speed_;
    Sluggish turn_;
    std::vector<TrueState>& truth_;
};

Airframe some_airframe(Dice& dice) {
    Airframe airframe;
    airframe.cruise_mps = dice.between(45.0, 75.0);
    airframe.cruise_lift = dice.between(0.28, 0.42);
    airframe.lift_slope = dice.between(4.8, 5.6);
    airframe.zero_lift_deg = dice.between(-2.8, -1.2);
    airframe.flaps_deg = dice.between(3.0, 6.0);
    return airframe;
}

double either(Dice& dice, double value) { return dice.share() < 0.5 ? -value : value; }

/// The heading into a wind.
double against_deg(const glm::dvec2& wind_mps) { return std::atan2(-wind_mps.x, -wind_mps.y) / degree; }

void fly_parked(Flight& flight, Dice& dice) { flight.carry_out({.lasts_s = dice.between(60.0, 400.0)}); }

void fly_taxi(Flight& flight, Dice& dice, const Airframe& airframe) {
    flight.carry_out({.lasts_s = dice.between(20.0, 60.0)});
    for (int i = 0; i < 3; ++i) {
        flight.carry_out({.lasts_s = dice.between(15.0, 30.0), .speed_mps = dice.between(4.0, 9.0)});
        flight.carry_out({.lasts_s = 9.0, .speed_mps = 5.0, .turn_degps = either(dice, 10.0)});
    }
    flight.carry_out({.lasts_s = 30.0, .speed_mps = 0.0});
    flight.take_off(0.55 * airframe.cruise_mps);
    flight.carry_out({.lasts_s = 60.0, .climb_mps = 4.0, .speed_mps = 0.75 * airframe.cruise_mps});
    flight.carry_out({.lasts_s = dice.between(20.0, 60.0),
        .bank_deg = either(dice, 20.0),
        .climb_mps = 3.0,
        .speed_mps = 0.8 * airframe.cruise_mps});
}

void fly_circuit(Flight& flight, Dice& dice, const Airframe& airframe) {
    const double side = either(dice, 1.0);
    const auto quarter = [&](double bank_deg, double climb_mps, double speed_mps) {
        const double rate_radps = weight_mps2 * std::tan(bank_deg * degree) / speed_mps;
        flight.carry_out({.lasts_s = 0.25 * turn / rate_radps,
            .bank_deg = side * bank_deg,
            .climb_mps = climb_mps,
            .speed_mps = speed_mps});
    };
    const double cruise_mps = airframe.cruise_mps;
    flight.carry_out({.lasts_s = dice.between(15.0, 40.0)});
    flight.take_off(0.55 * cruise_mps);
    flight.carry_out({.lasts_s = 40.0, .climb_mps = 4.0, .speed_mps = 0.7 * cruise_mps});
    quarter(22.0, 3.5, 0.75 * cruise_mps);
    flight.carry_out({.lasts_s = 25.0, .climb_mps = 2.0, .speed_mps = 0.85 * cruise_mps});
    quarter(25.0, 0.0, 0.9 * cruise_mps);
    flight.carry_out({.lasts_s = dice.between(40.0, 90.0), .speed_mps = 0.9 * cruise_mps});
    quarter(25.0, -1.5, 0.75 * cruise_mps);
    flight.carry_out({.lasts_s = 25.0, .climb_mps = -2.5, .speed_mps = 0.65 * cruise_mps});
    quarter(25.0, -2.5, 0.62 * cruise_mps);
    flight.land(0.6 * cruise_mps);
    flight.carry_out({.lasts_s = 25.0, .speed_mps = 6.0});
    flight.carry_out({.lasts_s = 9.0, .speed_mps = 5.0, .turn_degps = 10.0 * side});
    flight.carry_out({.lasts_s = 20.0, .speed_mps = 5.0});
    flight.carry_out({.lasts_s = 40.0, .speed_mps = 0.0});
}

void fly_cruise(Flight& flight, Dice& dice, const Airframe& airframe) {
    flight.begin_in_flight(dice.between(800.0, 3000.0), airframe.cruise_mps);
    for (int i = 0; i < 6; ++i) {
        const double speed_mps = airframe.cruise_mps * dice.between(0.85, 1.1);
        flight.carry_out(
            {.lasts_s = dice.between(40.0, 120.0), .climb_mps = dice.between(-3.0, 3.0), .speed_mps = speed_mps});
        flight.carry_out({.lasts_s = dice.between(8.0, 30.0),
            .bank_deg = either(dice, dice.between(10.0, 30.0)),
            .speed_mps = speed_mps});
    }
}

void fly_circling(Flight& flight, Dice& dice, const Airframe& airframe) {
    flight.begin_in_flight(1200.0, airframe.cruise_mps);
    for (int i = 0; i < 3; ++i) {
        flight.carry_out({.lasts_s = dice.between(30.0, 80.0),
            .climb_mps = dice.between(-3.0, -1.0),
            .speed_mps = dice.between(1.1, 1.5) * airframe.cruise_mps});
        flight.carry_out({.lasts_s = dice.between(80.0, 200.0),
            .bank_deg = either(dice, dice.between(25.0, 40.0)),
            .climb_mps = dice.between(0.5, 3.0),
            .speed_mps = airframe.cruise_mps});
    }
}

void fly_steep_turns(Flight& flight, Dice& dice, const Airframe& airframe) {
    flight.begin_in_flight(1500.0, airframe.cruise_mps);
    for (int i = 0; i < 6; ++i) {
        flight.carry_out({.lasts_s = dice.between(5.0, 15.0),
            .climb_mps = dice.between(-6.0, 6.0),
            .speed_mps = 1.05 * airframe.cruise_mps});
        flight.carry_out({.lasts_s = dice.between(10.0, 35.0),
            .bank_deg = either(dice, dice.between(40.0, 60.0)),
            .speed_mps = 1.05 * airframe.cruise_mps});
    }
}

/// Rotorcraft: `fast_mps` is the fastest.
void fly_rotorcraft(Flight& flight, Dice& dice, double fast_mps, double climb_mps) {
    flight.carry_out({.lasts_s = dice.between(15.0, 40.0)});
    flight.leave_ground();
    flight.carry_out({.lasts_s = 10.0, .climb_mps = climb_mps});
    flight.carry_out({.lasts_s = dice.between(10.0, 30.0)});
    for (int i = 0; i < 4; ++i) {
        const double speed_mps = fast_mps * dice.between(0.4, 1.0);
        flight.carry_out({.lasts_s = dice.between(20.0, 40.0),
            .climb_mps = dice.between(0.0, 0.5) * climb_mps,
            .speed_mps = speed_mps});
        flight.carry_out(
            {.lasts_s = dice.between(8.0, 20.0), .speed_mps = speed_mps, .turn_degps = either(dice, 250.0 / fast_mps)});
    }
    flight.carry_out({.lasts_s = 20.0, .speed_mps = 0.5 * fast_mps});
    flight.carry_out({.lasts_s = dice.between(20.0, 40.0)});
    flight.land(0.0);
    flight.carry_out({.lasts_s = 30.0});
}

/// One line of the log.
std::string line_of(double time_s, const glm::dvec3& place_m) {
    static const TransverseMercator frame(GeoPosition{47.0, 8.0});
    const GeoPosition at = frame.geo_from_local(glm::dvec2(place_m));
    return fmt::format("{:.3f},{:.8f},{:.8f},{:.3f}\n", time_s, at.latitude_deg, at.longitude_deg, place_m.z);
}

bool is_in_a_gap(double time_s, const GeneratedTrack& track) {
    return std::ranges::any_of(track.gaps_s, [&](const auto& gap) { return time_s > gap[0] && time_s < gap[1]; });
}

void choose_gaps(GeneratedTrack& track, Dice& dice) {
    const double length_s = track.truth.back().time_s;
    for (int i = 0; i < track.logger.gaps; ++i) {
        const double from_s = length_s * (i + dice.between(0.3, 0.6)) / track.logger.gaps;
        track.gaps_s.push_back({from_s, from_s + track.logger.gap_s});
    }
}

void write_log(GeneratedTrack& track, Dice& dice) {
    const Logger& logger = track.logger;
    choose_gaps(track, dice);
    track.log = "time,lat,lon,alt_m\n";
    bool first = true;
    for (double time_s = 0.0; time_s <= track.truth.back().time_s; time_s += logger.step_s) {
        const TrueState& state = track.truth[static_cast<std::size_t>(std::lround(time_s / step_s))];
        glm::dvec3 place_m =
            state.position_m + glm::dvec3(dice.normal() * logger.noise_m, dice.normal() * logger.noise_m,
                                   dice.normal() * logger.vertical_noise_m);
        if (logger.height_step_m > 0.0) {
            place_m.z = logger.height_step_m * std::round(place_m.z / logger.height_step_m);
        }
        if (!first && dice.share() < logger.wild) { place_m.x += either(dice, dice.between(100.0, 500.0)); }
        if ((!first && dice.share() < logger.lost) || is_in_a_gap(time_s, track)) { continue; }
        if (first) { track.origin_m = glm::dvec2(place_m); }
        first = false;
        track.log += line_of(state.time_s, place_m);
        if (dice.share() < logger.doubled) { track.log += line_of(state.time_s, place_m); }
    }
}

Logger logger_of(std::string_view kind, Dice& dice) {
    Logger logger;
    if (kind == "25 ft, 5 s") {
        logger = {.step_s = 5.0, .noise_m = 3.0, .vertical_noise_m = 0.5, .height_step_m = 7.62, .lost = 0.1};
    }
    if (kind == "gaps") {
        logger = {.lost = 0.05, .doubled = 0.05, .wild = 0.01, .gaps = 4, .gap_s = dice.between(8.0, 25.0)};
    }
    if (kind == "drone") { logger = {.step_s = 0.2, .noise_m = 0.3, .vertical_noise_m = 0.3}; }
    if (kind == "helicopter") { logger = {.noise_m = dice.between(0.3, 1.0), .vertical_noise_m = 0.6}; }
    return logger;
}

void fly_kind(Flight& flight, Dice& dice, const Airframe& airframe, std::string_view kind) {
    if (kind == "parked") { return fly_parked(flight, dice); }
    if (kind == "taxi") { return fly_taxi(flight, dice, airframe); }
    if (kind == "circuit" || kind == "gaps") { return fly_circuit(flight, dice, airframe); }
    if (kind == "circling") { return fly_circling(flight, dice, airframe); }
    if (kind == "steep turns") { return fly_steep_turns(flight, dice, airframe); }
    if (kind == "helicopter") { return fly_rotorcraft(flight, dice, dice.between(35.0, 60.0), 2.5); }
    if (kind == "drone") { return fly_rotorcraft(flight, dice, dice.between(6.0, 14.0), 2.5); }
    fly_cruise(flight, dice, airframe);
}

} // namespace

GeneratedTrack generated_track(std::string_view kind, int seed) {
    Dice dice(static_cast<std::uint64_t>(seed) * 131U + kind.size() * 7U + static_cast<unsigned char>(kind[1]));
    GeneratedTrack track;
    track.kind = kind;
    track.seed = seed;
    track.logger = logger_of(kind, dice);
    track.circles = kind == "circling" || kind == "steep turns";
    Airframe airframe = some_airframe(dice);
    airframe.rotor = kind == "helicopter" || kind == "drone";
    airframe.drag_per_s = kind == "drone" ? dice.between(0.15, 0.25) : dice.between(0.012, 0.024);
    const double wind_mps = airframe.rotor ? dice.between(0.0, 4.0) : dice.between(0.0, 12.0);
    const double to_deg = dice.between(0.0, 360.0);
    track.wind_mps = wind_mps * glm::dvec2(std::sin(to_deg * degree), std::cos(to_deg * degree));
    Flight flight(airframe, track.wind_mps, against_deg(track.wind_mps), track.truth);
    fly_kind(flight, dice, airframe, kind);
    write_log(track, dice);
    return track;
}

namespace {

/// The truth at a time.
TrueState true_state(const GeneratedTrack& track, double time_s) {
    const double place = std::clamp(time_s / step_s, 0.0, static_cast<double>(track.truth.size() - 1));
    const auto i = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(i);
    TrueState state = track.truth[i];
    const TrueState& next = track.truth[std::min(i + 1, track.truth.size() - 1)];
    state.position_m += share * (next.position_m - state.position_m);
    return state;
}

double apart_deg(double a_rad, double b_deg) { return deg_from_rad(wrapped_to_pi(a_rad - rad_from_deg(b_deg))); }

bool is_near_a_gap(double time_s, const GeneratedTrack& track) {
    return std::ranges::any_of(
        track.gaps_s, [&](const auto& gap) { return time_s > gap[0] - 1.5 && time_s < gap[1] + 1.5; });
}

void square_and_most(double value, double& squares, double& most) {
    squares += value * value;
    most = std::max(most, std::abs(value));
}

void take_roots(TrackFigures& figures, double headings) {
    for (double* squares :
        {&figures.horizontal_rms_m, &figures.vertical_rms_m, &figures.pitch_rms_deg, &figures.roll_rms_deg}) {
        *squares = std::sqrt(*squares / std::max(1.0, figures.frames));
    }
    figures.heading_rms_deg = std::sqrt(figures.heading_rms_deg / std::max(1.0, headings));
}

} // namespace

TrackFigures figures_of(const GeneratedTrack& track, const sim::Trajectory& flown) {
    TrackFigures figures;
    double headings = 0.0;
    glm::dvec3 last_m(0.0);
    for (long frame = 0; static_cast<double>(frame) / 60.0 <= flown.end_s(); ++frame) {
        const double time_s = static_cast<double>(frame) / 60.0;
        const sim::AircraftState state = flown.state_at(time_s);
        const TrueState truth = true_state(track, time_s);
        const double speed_mps = glm::length(truth.velocity_mps);
        if (frame > 0 && speed_mps > 1.0) {
            const double ahead_m = glm::dot(state.position_m - last_m, truth.velocity_mps) / speed_mps;
            figures.backwards_m = std::max(figures.backwards_m, -ahead_m);
        }
        last_m = state.position_m;
        if (is_near_a_gap(time_s, track)) { continue; }
        figures.frames += 1.0;
        const glm::dvec3 wrong_m = state.position_m + glm::dvec3(track.origin_m, 0.0) - truth.position_m;
        square_and_most(glm::length(glm::dvec2(wrong_m)), figures.horizontal_rms_m, figures.horizontal_most_m);
        square_and_most(wrong_m.z, figures.vertical_rms_m, figures.vertical_most_m);
        const EulerAngles angles = euler_from_body_to_world(state.body_to_world);
        square_and_most(apart_deg(angles.pitch_rad, truth.pitch_deg), figures.pitch_rms_deg, figures.pitch_most_deg);
        square_and_most(apart_deg(angles.roll_rad, truth.roll_deg), figures.roll_rms_deg, figures.roll_most_deg);
        if (speed_mps > 3.0) {
            const double heading_deg = apart_deg(angles.heading_rad, truth.heading_deg);
            figures.heading_rms_deg += heading_deg * heading_deg;
            headings += 1.0;
        }
    }
    take_roots(figures, headings);
    return figures;
}

TrackFigures figures_of_all(const std::vector<TrackFigures>& figures) {
    TrackFigures all;
    for (const TrackFigures& one : figures) {
        all.frames += one.frames;
        for (const auto rms : {&TrackFigures::horizontal_rms_m, &TrackFigures::vertical_rms_m,
                 &TrackFigures::pitch_rms_deg, &TrackFigures::roll_rms_deg, &TrackFigures::heading_rms_deg}) {
            all.*rms += one.*rms * one.*rms / static_cast<double>(figures.size());
        }
        for (const auto most : {&TrackFigures::horizontal_most_m, &TrackFigures::vertical_most_m,
                 &TrackFigures::pitch_most_deg, &TrackFigures::roll_most_deg, &TrackFigures::backwards_m}) {
            all.*most = std::max(all.*most, one.*most);
        }
    }
    for (const auto rms : {&TrackFigures::horizontal_rms_m, &TrackFigures::vertical_rms_m, &TrackFigures::pitch_rms_deg,
             &TrackFigures::roll_rms_deg, &TrackFigures::heading_rms_deg}) {
        all.*rms = std::sqrt(all.*rms);
    }
    return all;
}

} // namespace octant::tests
