#include "visuals/nature/houses.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace octant::visuals::nature {

namespace {

// Of a house, over its half size.
constexpr float half_length = 1.25F;
constexpr float half_width = 0.85F;
constexpr float overhang = 0.12F;
constexpr float eaves_m = 0.55F * house_height_m;
constexpr float window_px = 45.0F; ///< houses that look lower have none
constexpr float window_out_m = 0.04F;

/// One house while its triangles are made. Its axes: along the ridge, to the left of that, up.
class HouseBuilder {
public:
    HouseBuilder(const House& house, const Daylight& day, StandingMesh& to)
        : house_(house), day_(day), to_(to), along_(compass_directions[house.random_bits >> 20U & 7U]),
          across_(-along_.y, along_.x), plaster_(glm::mix(glm::vec3(0.82F, 0.79F, 0.72F),
                                            glm::vec3(0.68F, 0.58F, 0.47F), share_of(house.random_bits, 12))),
          tiles_(
              glm::mix(glm::vec3(0.50F, 0.26F, 0.19F), glm::vec3(0.34F, 0.32F, 0.32F), share_of(house.random_bits, 4))),
          wall_(house.half_m * (glm::vec2(half_length, half_width) - overhang)),
          roof_(house.half_m * glm::vec2(half_length, half_width)) {}

    void add() const {
        const glm::vec3& foot_m = house_.anchor.at_m;
        const glm::vec3 below_eye =
            at(-glm::dot(along_, glm::vec2(foot_m)), -glm::dot(across_, glm::vec2(foot_m)), eaves_m);
        const bool eye_above = below_eye.z < 0.0F;
        if (eye_above) { add_roof(); }
        add_walls();
        if (!eye_above) { add_roof(); }
    }

private:
    /// A place of the house, world axes with the eye subtracted. What is not higher than the ground lies on it.
    glm::vec3 at(float x_m, float y_m, float z_m) const {
        const glm::vec2 level_m = along_ * x_m + across_ * y_m;
        const float ground_m = house_.anchor.height_at_offset_m(level_m);
        return house_.anchor.at_m + glm::vec3(level_m, ground_m + house_.height_share * std::max(z_m - ground_m, 0.0F));
    }

    /// `normal`: in the house's axes, of any length.
    glm::vec3 lit(const glm::vec3& own, const glm::vec3& normal) const {
        const glm::vec3 out = glm::normalize(glm::vec3(along_ * normal.x + across_ * normal.y, normal.z));
        const float towards = std::max(glm::dot(out, glm::vec3(day_.to_sun())), 0.0F);
        return own * (day_.ambient() * (0.85F + 0.15F * out.z) + day_.sunlight() * (house_.sun * towards));
    }

    void add_roof() const {
        const float x = roof_.x;
        const float y = roof_.y;
        const float top = house_height_m;
        const float up = y / (top - eaves_m);
        to_.face(std::array{at(x, y, eaves_m), at(-x, y, eaves_m), at(-x, 0.0F, top), at(x, 0.0F, top)},
            lit(tiles_, {0.0F, 1.0F, up}));
        to_.face(std::array{at(-x, -y, eaves_m), at(x, -y, eaves_m), at(x, 0.0F, top), at(-x, 0.0F, top)},
            lit(tiles_, {0.0F, -1.0F, up}));
        to_.face(
            std::array{at(x, -y, eaves_m), at(x, y, eaves_m), at(x, 0.0F, top)}, lit(plaster_, {1.0F, 0.0F, 0.0F}));
        to_.face(
            std::array{at(-x, y, eaves_m), at(-x, -y, eaves_m), at(-x, 0.0F, top)}, lit(plaster_, {-1.0F, 0.0F, 0.0F}));
        to_.face(std::array{at(-x, -y, eaves_m), at(-x, y, eaves_m), at(x, y, eaves_m), at(x, -y, eaves_m)},
            0.5F * lit(tiles_, {0.0F, 0.0F, -1.0F}));
    }

    /// The wall whose normal is `out` (unit, in the house's axes), after its windows, which lie before it.
    void add_wall(const glm::vec2& out, int windows) const {
        const glm::vec2 aside(-out.y, out.x);
        const float half_m = glm::dot(glm::abs(aside), wall_);
        const float away_m = glm::dot(glm::abs(out), wall_);
        const auto quad = [&](float from_m, float to_m, float low_m, float high_m, float before_m) {
            const auto corner = [&](float aside_m, float z_m) {
                const glm::vec2 plan = aside * aside_m + out * (away_m + before_m);
                return at(plan.x, plan.y, z_m);
            };
            return std::array{corner(from_m, low_m), corner(to_m, low_m), corner(to_m, high_m), corner(from_m, high_m)};
        };
        if (house_.height_px >= window_px) {
            const glm::vec3 glass = lit({0.20F, 0.22F, 0.25F}, glm::vec3(out, 0.0F));
            const float spacing_m = 2.0F * half_m / static_cast<float>(windows);
            for (int i = 0; i < windows; ++i) {
                const float middle_m = (static_cast<float>(i) + 0.5F) * spacing_m - half_m;
                to_.face(
                    quad(middle_m - 0.55F, middle_m + 0.55F, 0.36F * eaves_m, 0.72F * eaves_m, window_out_m), glass);
            }
        }
        constexpr float lowest_m = -1e3F; // walls end at the ground
        to_.face(quad(-half_m, half_m, lowest_m, eaves_m, 0.0F), lit(plaster_, glm::vec3(out, 0.0F)));
    }

    void add_walls() const {
        add_wall({1.0F, 0.0F}, 2);
        add_wall({0.0F, 1.0F}, 3);
        add_wall({-1.0F, 0.0F}, 2);
        add_wall({0.0F, -1.0F}, 3);
    }

    const House& house_;
    const Daylight& day_;
    StandingMesh& to_;
    glm::vec2 along_;
    glm::vec2 across_;
    glm::vec3 plaster_;
    glm::vec3 tiles_;
    glm::vec2 wall_; ///< half the length and half the width of the walls ...
    glm::vec2 roof_; ///< ... and of the roof
};

} // namespace

void add_house(const House& house, const Daylight& day, StandingMesh& to) { HouseBuilder(house, day, to).add(); }

} // namespace octant::visuals::nature
