#include "models/repair/agreeing_turns.h"

#include "models/no_index.h"
#include "models/repair/edge_joints.h"

#include <array>
#include <utility>

namespace octant::models::repair {

namespace {

class Turning {
public:
    Turning(
        std::span<const Triangle> triangles,
        std::span<const Side> sides,
        std::span<const Triangle> named)
        : neighbours_(triangles.size(), {no_index, no_index, no_index})
        , agrees_(triangles.size(), {true, true, true})
        , reached_(triangles.size(), false) {
        turns_.turned.assign(triangles.size(), 0);
        find_neighbours(sides, named);
    }

    AgreeingTurns turns() {
        for (std::uint32_t first = 0; first < reached_.size(); ++first) {
            if (!reached_[first]) {
                turn_shell(first);
            }
        }
        return std::move(turns_);
    }

private:
    void find_neighbours(std::span<const Side> sides, std::span<const Triangle> named) {
        for_each_joint(sides, named, [&](std::span<const Side> edge) {
            turns_.crowded_edges += static_cast<std::size_t>(edge.size() > 2);
            if (edge.size() == 2) {
                const bool agree = edge[0].rises != edge[1].rises;
                for (std::size_t i = 0; i < 2; ++i) {
                    const Side& side = edge[i];
                    neighbours_[side.triangle][side.corner] = edge[1 - i].triangle;
                    agrees_[side.triangle][side.corner] = agree;
                }
            }
        });
    }

    void turn_shell(std::uint32_t first) {
        std::vector<std::uint8_t>& turned = turns_.turned;
        shell_.assign(1, first);
        reached_[first] = true;
        std::size_t to_turn = 0;
        for (std::size_t i = 0; i < shell_.size(); ++i) {
            const std::uint32_t t = shell_[i];
            to_turn += turned[t];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t next = neighbours_[t][k];
                if (next != no_index && !reached_[next]) {
                    reached_[next] = true;
                    turned[next] = static_cast<std::uint8_t>(turned[t] ^ (agrees_[t][k] ? 0U : 1U));
                    shell_.push_back(next);
                }
            }
        }
        turn_fewer(to_turn);
    }

    void turn_fewer(std::size_t to_turn) {
        const bool others = 2 * to_turn > shell_.size();
        for (const std::uint32_t t : shell_) {
            turns_.turned[t] ^= static_cast<std::uint8_t>(others);
        }
        turns_.count += others ? shell_.size() - to_turn : to_turn;
    }

    AgreeingTurns turns_;
    std::vector<std::array<std::uint32_t, 3>> neighbours_; ///< of each triangle, side by side
    std::vector<std::array<bool, 3>> agrees_; ///< with that neighbour, before any is turned
    std::vector<bool> reached_;
    std::vector<std::uint32_t> shell_; ///< at hand, in the order in which it is reached
};

} // namespace

AgreeingTurns agreeing_turns(
    std::span<const Triangle> triangles,
    std::span<const Side> sides,
    std::span<const Triangle> named) {
    return Turning(triangles, sides, named).turns();
}

} // namespace octant::models::repair
