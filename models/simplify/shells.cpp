#include "models/simplify/shells.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace octant::models::simplify {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

Shells::Shells(WorkingSurface& surface, std::span<const std::uint32_t> face_numbers, SurfaceSamples& samples,
    const OriginalSurface& original, double max_distance)
    : surface_(surface), samples_(samples), original_(original), max_distance_(max_distance),
      of_face_(surface_.mesh.face_slots(), none), of_original_(original.size(), none) {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t triangle = 0; triangle < of_original_.size(); ++triangle) {
        if (of_original_[triangle] != none) { continue; }
        const auto shell = static_cast<std::uint32_t>(faces_.size());
        faces_.emplace_back();
        of_original_[triangle] = shell;
        waiting.assign(1, triangle);
        while (!waiting.empty()) {
            const std::uint32_t here = waiting.back();
            waiting.pop_back();
            for (const std::uint32_t beyond : original.beyond(here)) {
                if (beyond != none && of_original_[beyond] == none) {
                    of_original_[beyond] = shell;
                    waiting.push_back(beyond);
                }
            }
        }
    }
    face_counts_.assign(faces_.size(), 0);
    for (std::uint32_t face = 0; face < of_face_.size(); ++face) {
        if (surface_.mesh.has_face(face)) {
            of_face_[face] = of_original_[face_numbers[face]];
            faces_[of_face_[face]].push_back(face);
            ++face_counts_[of_face_[face]];
        }
    }
    count_left_ = faces_.size() - static_cast<std::size_t>(std::ranges::count(face_counts_, 0U));
    if (count_left_ < 2) { return; }
    sample_near_.assign(of_original_.size(), none);
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        const std::uint32_t triangle = samples[sample].triangle;
        if (sample_near_[triangle] == none) {
            sample_near_[triangle] = sample;
            waiting.push_back(triangle);
        }
    }
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        for (const std::uint32_t beyond : original.beyond(waiting[i])) {
            if (beyond != none && sample_near_[beyond] == none) {
                sample_near_[beyond] = sample_near_[waiting[i]];
                waiting.push_back(beyond);
            }
        }
    }
}

/// The nearest point of another shell of the original that was not dropped. There may be none where it is farther than
/// `max_distance`.
measure::NearestOnMesh Shells::nearest_other(std::uint32_t shell, const glm::dvec3& place, double max_distance) const {
    measure::NearestOnMesh found;
    for (double within = std::min(1e-3, max_distance); found.triangle == none && within < 4.0 * max_distance;
         within *= 4.0) {
        found.distance2 = within * within;
        original_.for_each_near(place, within, [&](std::uint32_t triangle) {
            const std::uint32_t other = of_original_[triangle];
            if (other == shell || face_counts_[other] == 0) { return; }
            const double distance2 = original_.distance2(triangle, place);
            if (distance2 < found.distance2 || (distance2 == found.distance2 && triangle < found.triangle)) {
                found.distance2 = distance2;
                found.triangle = triangle;
            }
        });
    }
    return found;
}

double Shells::cost(std::uint32_t shell) const {
    if (count_left_ < 2) { return infinite; }
    std::size_t all = 0;
    double present = 0.0;
    for (const std::uint32_t face : faces_[shell]) {
        if (surface_.mesh.has_face(face)) { all += samples_.count(face); }
    }
    constexpr std::size_t asked_samples = 48; // about
    const std::size_t stride = max_distance_ < max_shell_distance ? 1 : all / asked_samples + 1;
    double weights = 0.0;
    double asked_weights = 0.0;
    double sum = 0.0;
    bool is_far = all == 0; // Nothing is known of where it is.
    std::size_t place = 0;
    for (const std::uint32_t face : faces_[shell]) {
        if (!surface_.mesh.has_face(face)) { continue; }
        samples_.for_each(face, [&](std::uint32_t number) {
            const SurfaceSample& sample = samples_[number];
            weights += static_cast<double>(sample.weight);
            present +=
                static_cast<double>(sample.weight) * samples_.penalty().of(static_cast<double>(sample.distance2));
            if (!is_far && place++ % stride == 0) {
                const glm::dvec3 at(sample.place[0], sample.place[1], sample.place[2]);
                const measure::NearestOnMesh other = nearest_other(shell, at, max_distance_);
                is_far = other.triangle == none || other.distance2 > max_distance_ * max_distance_;
                asked_weights += static_cast<double>(sample.weight);
                sum += static_cast<double>(sample.weight) * samples_.penalty().of(other.distance2);
            }
        });
    }
    if (is_far) { return infinite; }
    return asked_weights > 0.0 ? sum * weights / asked_weights - present : 0.0;
}

/// Puts the samples of a shell that was dropped into the lists of triangles of the others: from the nearest point of
/// the original to a sample near it, and from the triangle of that to the nearest around.
void Shells::move_samples(std::uint32_t shell, std::span<const std::uint32_t> numbers) {
    for (const std::uint32_t number : numbers) {
        const std::array<float, 3>& at = samples_[number].place;
        // No two points are farther apart than the diagonal, which is 1, and each shell has samples.
        const measure::NearestOnMesh other = nearest_other(shell, {at[0], at[1], at[2]}, 1.0);
        assert(other.triangle != none && sample_near_[other.triangle] != none);
        const std::uint32_t start = samples_[sample_near_[other.triangle]].face;
        assert(surface_.mesh.has_face(start));
        float distance2 = 0.0F;
        const std::uint32_t face = nearest_face_from(surface_, start, at, distance2);
        samples_.put(number, face, distance2);
    }
}

} // namespace octant::models::simplify
