#pragma once

#include "models/collapse_sequence.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace octant::models::simplify {

/// A priority queue of edges with changeable costs: the least cost first, equal costs by the edges' numbers. A heap
/// with four children a node, which causes fewer cache misses than a binary one.
class EdgeHeap {
public:
    explicit EdgeHeap(std::size_t edges) : places_(edges, none), costs_(edges, 0.0F) {}

    bool empty() const { return heap_.empty(); }

    bool holds(std::uint32_t edge) const { return places_[edge] != none; }

    std::uint32_t top() const { return heap_.front().edge; }

    /// The last cost given to an edge that is or was in the queue.
    float cost(std::uint32_t edge) const { return costs_[edge]; }

    /// Inserts an edge or changes its cost.
    void set(std::uint32_t edge, float cost) {
        costs_[edge] = cost;
        if (!holds(edge)) {
            places_[edge] = static_cast<std::uint32_t>(heap_.size());
            heap_.push_back({cost, edge});
        } else {
            heap_[places_[edge]].cost = cost;
        }
        down(up(places_[edge]));
    }

    /// Removes an edge, if it is in the queue.
    void remove(std::uint32_t edge) {
        const std::uint32_t place = places_[edge];
        if (place == none) { return; }
        places_[edge] = none;
        const Entry last = heap_.back();
        heap_.pop_back();
        if (last.edge != edge) {
            put(place, last);
            down(up(place));
        }
    }

private:
    /// The cost stands beside the edge, so that a comparison loads one cache line of children.
    struct Entry {
        float cost = 0.0F;
        std::uint32_t edge = none;

        bool operator<(const Entry& other) const { return cost != other.cost ? cost < other.cost : edge < other.edge; }
    };

    void put(std::uint32_t place, const Entry& entry) {
        heap_[place] = entry;
        places_[entry.edge] = place;
    }

    std::uint32_t up(std::uint32_t place) {
        const Entry entry = heap_[place];
        while (place > 0 && entry < heap_[(place - 1) / 4]) {
            put(place, heap_[(place - 1) / 4]);
            place = (place - 1) / 4;
        }
        put(place, entry);
        return place;
    }

    void down(std::uint32_t place) {
        const Entry entry = heap_[place];
        while (true) {
            const std::size_t first = 4 * static_cast<std::size_t>(place) + 1;
            const std::size_t end = std::min(first + 4, heap_.size());
            std::size_t best = first;
            for (std::size_t child = first + 1; child < end; ++child) {
                best = heap_[child] < heap_[best] ? child : best;
            }
            if (best >= heap_.size() || !(heap_[best] < entry)) { break; }
            put(place, heap_[best]);
            place = static_cast<std::uint32_t>(best);
        }
        put(place, entry);
    }

    std::vector<Entry> heap_;
    std::vector<std::uint32_t> places_; ///< For each edge its index in heap_; none = not in it.
    std::vector<float> costs_;
};

} // namespace octant::models::simplify
