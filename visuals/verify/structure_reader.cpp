#include "visuals/verify/structure_reader.h"

#include <fmt/format.h>
#include <utility>

namespace octant::visuals::verify {

bool StructureReader::take() {
    return words_.skip("tolerance") ? take_tolerance()
           : words_.skip("about")   ? take_about()
           : words_.skip("vertex")  ? take_vertex()
           : words_.skip("axis")    ? take_axis()
           : words_.skip("polygon") ? take_polygon(false)
           : words_.skip("turning") ? take_polygon(true)
           : words_.skip("list")    ? take_list()
                                    : words_.skip("node") && take_node();
}

bool StructureReader::take_tolerance() {
    if (made_.tolerance > 0.0) {
        words_.refuse("one tolerance");
    }
    made_.tolerance = words_.number("a tolerance", 1e-30, largest_number);
    return true;
}

/// Where the certificate measures from changes nothing of what it proves.
bool StructureReader::take_about() {
    if (!made_.vertices.empty() || !made_.axes.empty()) {
        words_.refuse("'about' before all places");
    }
    words_.vector("a coordinate");
    return true;
}

bool StructureReader::take_vertex() {
    words_.add(made_.vertices, words_.vector("a coordinate"));
    return true;
}

bool StructureReader::take_axis() {
    const Vector point = words_.vector("a coordinate");
    words_.add(made_.axes, {point, words_.unit_vector("a direction")});
    return true;
}

bool StructureReader::take_polygon(bool turning) {
    Polygon polygon;
    polygon.line = words_.line();
    if (turning) {
        polygon.axis = words_.index("an axis", made_.axes.size());
    }
    polygon.source = words_.index("a polygon of the model's file", max_entries);
    polygon.plane = words_.plane();
    while (!words_.done() || polygon.corners.size() < 3) {
        polygon.corners.push_back(words_.index("a vertex", made_.vertices.size()));
    }
    words_.add(made_.polygons, std::move(polygon));
    return true;
}

bool StructureReader::take_list() {
    List list;
    list.line = words_.line();
    std::vector<bool>& used = used_;
    used.resize(made_.polygons.size());
    while (!words_.done()) {
        const std::uint32_t polygon = words_.index("a polygon", made_.polygons.size());
        if (used[polygon]) {
            words_.refuse_last("each polygon once");
        }
        used[polygon] = true;
        list.polygons.push_back(polygon);
    }
    for (const std::uint32_t polygon : list.polygons) {
        used[polygon] = false;
    }
    words_.add(made_.lists, std::move(list));
    return true;
}

bool StructureReader::take_node() {
    Node node;
    node.line = words_.line();
    const bool sequence = words_.skip("sequence");
    const bool parting = !sequence && words_.skip("parting");
    if (!sequence && !parting && !words_.skip("choice")) {
        words_.refuse("choice, parting or sequence");
    }
    node.kind = sequence  ? Node::Kind::Sequence
                : parting ? Node::Kind::Parting
                          : Node::Kind::Choice;
    if (!sequence) {
        node.plane = words_.plane();
    }
    const auto side = [&] {
        return sequence || parting        ? child(true, true)
               : words_.skip("unclaimed") ? Node::unclaimed
                                          : child(false, true);
    };
    node.front = side();
    node.back = side();
    if (parting) {
        node.along = child(true, false);
        node.against = child(true, false);
    }
    words_.add(made_.nodes, std::move(node));
    return true;
}

/// A child; whether it is there is known only when all are read.
int StructureReader::child(bool may_be_nothing, bool may_be_node) {
    if (may_be_nothing && words_.skip("nothing")) {
        return Node::nothing;
    }
    if (words_.skip("list")) {
        return ~static_cast<int>(words_.index("a list", max_entries));
    }
    if (!may_be_node || !words_.skip("node")) {
        words_.refuse(fmt::format(
            "{}list K{}", may_be_node ? "node K, " : "", may_be_nothing ? ", nothing" : ""));
    }
    const std::uint32_t number = words_.index("a node", max_entries);
    if (number <= made_.nodes.size()) {
        words_.refuse_last("a later node");
    }
    return static_cast<int>(number);
}

} // namespace octant::visuals::verify
