#include "ui/base/spelling.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <vector>

namespace octant::ui::base {

// Distance of words: F. J. Damerau, "A technique for computer detection and correction of spelling errors", Comm. ACM
// 7(3), 1964; swaps of neighbours only.

namespace {

constexpr std::size_t longest_word = 64;

std::size_t distance_of(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) { last[j] = j; }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, changed});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                now[j] = std::min(now[j], before[j - 2] + 1);
            }
        }
        before.swap(last);
        last.swap(now);
    }
    return last[b.size()];
}

std::string_view without_dashes(std::string_view word) {
    return word.substr(std::min(word.find_first_not_of('-'), word.size()));
}

/// Returns the known word that a person meant who wrote `word`: the one that the fewest letters, left out, added,
/// changed or swapped with their neighbours, make of it, or that begins with it. Nothing where no known word is near,
/// or where two are equally near.
std::optional<std::string> nearest_spelling(std::string_view word, std::span<const std::string> known) {
    const std::string_view bare = without_dashes(word);
    if (bare.empty() || bare.size() > longest_word) { return std::nullopt; }
    // One fault in three letters is a slip, more is another word.
    std::size_t least = 1 + bare.size() / 3;
    const std::string* nearest = nullptr;
    for (const std::string& each : known) {
        const std::string_view other = without_dashes(each);
        const bool begins = bare.size() >= 3 && other.starts_with(bare);
        const std::size_t apart = distance_of(bare, other);
        const std::size_t distance = begins ? std::min<std::size_t>(apart, 1) : apart;
        if (distance < least) {
            least = distance;
            nearest = &each;
        } else if (distance == least) {
            nearest = nullptr;
        }
    }
    return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

} // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
    const auto nearest = nearest_spelling(word, known);
    return nearest ? fmt::format("; perhaps {} is meant", *nearest) : std::string();
}

} // namespace octant::ui::base
