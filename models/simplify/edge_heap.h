#pragma once

#include "models/collapse_sequence.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// A priority queue of edges by cost, the least first; equal costs go by the edges' numbers. Each
/// edge is in it at most once, and its cost can be changed. It is a heap with four children to a
/// node, which takes fewer cache misses than two.
class EdgeHeap {
public:
    explicit EdgeHeap(std::size_t edges)
        : places_(edges, none)
        , costs_(edges, 0.0F) {}

    bool empty() const { return heap_.empty(); }

    bool holds(std::uint32_t edge) const { return places_[edge] != none; }

    std::uint32_t top() const { return heap_.front(); }

    /// The last cost given to an edge that is or was in the queue.
    float cost(std::uint32_t edge) const { return costs_[edge]; }

    /// Puts an edge in, or changes its cost.
    void set(std::uint32_t edge, float cost) {
        costs_[edge] = cost;
        if (!holds(edge)) {
            places_[edge] = static_cast<std::uint32_t>(heap_.size());
            heap_.push_back(edge);
        }
        down(up(places_[edge]));
    }

    /// Takes an edge out; does nothing when it is not in.
    void remove(std::uint32_t edge) {
        const std::uint32_t place = places_[edge];
        if (place == none) {
            return;
        }
        places_[edge] = none;
        const std::uint32_t last = heap_.back();
        heap_.pop_back();
        if (last != edge) {
            heap_[place] = last;
            places_[last] = place;
            down(up(place));
        }
    }

private:
    bool before(std::uint32_t a, std::uint32_t b) const {
        return costs_[a] != costs_[b] ? costs_[a] < costs_[b] : a < b;
    }

    void put(std::uint32_t place, std::uint32_t edge) {
        heap_[place] = edge;
        places_[edge] = place;
    }

    std::uint32_t up(std::uint32_t place) {
        const std::uint32_t edge = heap_[place];
        while (place > 0 && before(edge, heap_[(place - 1) / 4])) {
            put(place, heap_[(place - 1) / 4]);
            place = (place - 1) / 4;
        }
        put(place, edge);
        return place;
    }

    void down(std::uint32_t place) {
        const std::uint32_t edge = heap_[place];
        while (true) {
            std::uint32_t best = none;
            for (std::uint32_t child = 4 * place + 1;
                 child < heap_.size() && child <= 4 * place + 4;
                 ++child) {
                if (best == none || before(heap_[child], heap_[best])) {
                    best = child;
                }
            }
            if (best == none || !before(heap_[best], edge)) {
                break;
            }
            put(place, heap_[best]);
            place = best;
        }
        put(place, edge);
    }

    std::vector<std::uint32_t> heap_;
    std::vector<std::uint32_t> places_; ///< For each edge its index in heap_; none = not in it.
    std::vector<float> costs_;
};

} // namespace octant::models::simplify
