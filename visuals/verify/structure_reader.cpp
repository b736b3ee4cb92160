#include "visuals/verify/structure_reader.h"

#include <fmt/format.h>
#include <utility>

namespace octant::visuals::verify {

bool StructureReader::take() {
    return words_.skip("tolerance") ? read_tolerance()
           : words_.skip("about")   ? read_reference()
           : words_.skip("vertex")  ? read_vertex()
           : words_.skip("axis")    ? read_axis()
           : words_.skip("polygon") ? read_polygon(false)
           : words_.skip("turning") ? read_polygon(true)
           : words_.skip("list")    ? read_list()
                                    : words_.skip("node") && read_node();
}

bool StructureReader::read_tolerance() {
    if (made_.tolerance > 0.0) {
        words_.refuse("one tolerance");
    }
    made_.tolerance = words_.number("a tolerance", 1e-30, largest_number);
    return true;
}

/// Where the certificate measures from changes nothing of what it proves.
bool StructureReader::read_reference() {
    if (!made_.vertices.empty() || !made_.axes.empty()) {
        words_.refuse("'about' before all places");
    }
    words_.vector("a coordinate");
    return true;
}

bool StructureReader::read_vertex() {
    words_.add(made_.vertices, words_.vector("a coordinate"));
    return true;
}

bool StructureReader::read_axis() {
    const Vector point = words_.vector("a coordinate");
    words_.add(made_.axes, {point, words_.unit_vector("a direction")});
    return true;
}

bool StructureReader::read_polygon(bool turning) {
    CertificatePolygon polygon;
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

bool StructureReader::read_list() {
    OrderList list;
    list.line = words_.line();
    std::vector<bool>& used = used_;
    used.resize(made_.polygons.size());
    while (!words_.done()) {
        const std::uint32_t polygon = words_.index("a polygon", made_.polygons.size());
        if (used[polygon]) {
            words_.fail_at_last("each polygon once");
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

bool StructureReader::read_node() {
    OrderNode node;
    node.line = words_.line();
    const bool sequence = words_.skip("sequence");
    const bool parting = !sequence && words_.skip("parting");
    if (!sequence && !parting && !words_.skip("choice")) {
        words_.refuse("choice, parting or sequence");
    }
    node.kind = sequence  ? OrderNode::Kind::Sequence
                : parting ? OrderNode::Kind::PolygonSplit
                          : OrderNode::Kind::ViewSplit;
    if (!sequence) {
        node.plane = words_.plane();
    }
    const auto side = [&] {
        return sequence || parting        ? child(true, true)
               : words_.skip("unclaimed") ? OrderNode::not_covered
                                          : child(false, true);
    };
    node.front = side();
    node.back = side();
    if (parting) {
        node.coplanar_front = child(true, false);
        node.coplanar_back = child(true, false);
    }
    words_.add(made_.nodes, std::move(node));
    return true;
}

/// A child; whether it is there is known only when all are read.
int StructureReader::child(bool may_be_nothing, bool may_be_node) {
    if (may_be_nothing && words_.skip("nothing")) {
        return OrderNode::nothing;
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
        words_.fail_at_last("a later node");
    }
    return static_cast<int>(number);
}

} // namespace octant::visuals::verify
