#include "models/meshfile/vrml_nodes.h"

#include "models/meshfile/vrml_tokenizer.h"
#include "models/meshfile/word_scanner.h"
#include "sim/base/error.h"

#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace octant::models::meshfile {

namespace {

constexpr int max_vrml_use_depth = 100;

class Nodes {
public:
    Nodes(const std::filesystem::path& path, std::string_view text)
        : words_(path, text, 1) {}

    VrmlFile read() {
        const std::string_view text = words_.text();
        if (!text.starts_with("#VRML V2.0")) {
            words_.refuse("'#VRML V2.0'", in_quotes(text.substr(0, text.find('\n'))));
        }
        while (!words_.peek().empty()) {
            if (!passed_over()) {
                file_.roots.push_back(take_node(0));
            }
        }
        return std::move(file_);
    }

private:
    static bool is_name(std::string_view word) {
        const auto first = static_cast<unsigned char>(word.empty() ? '0' : word.front());
        return (std::isalpha(first) != 0 || first == '_' || first >= 0x80) && word != "TRUE" &&
               word != "FALSE" && word != "NULL";
    }

    std::string_view take_name(std::string_view what) {
        const std::string_view word = words_.take(what);
        if (!is_name(word)) {
            words_.refuse(what, in_quotes(word));
        }
        return word;
    }

    /// Whether the next words are a node: DEF, USE or a type with its brace.
    bool node_follows() {
        const std::string_view word = words_.peek();
        if (word == "DEF" || word == "USE") {
            return true;
        }
        if (!is_name(word)) {
            return false;
        }
        VrmlTokenizer ahead = words_;
        ahead.take("a node");
        return ahead.peek() == "{";
    }

    /// Passes over what stands between a mark and its partner.
    void skip_balanced(char open, char close) {
        if (words_.take("a bracket") != std::string_view(&open, 1)) {
            words_.refuse(fmt::format("'{}'", open), in_quotes(words_.peek()));
        }
        for (std::size_t depth = 1; depth > 0;) {
            const std::string_view word = words_.take(fmt::format("'{}'", close));
            depth += static_cast<std::size_t>(word.front() == open);
            depth -= static_cast<std::size_t>(word.front() == close);
        }
    }

    /// Passes over ROUTE A.a TO B.b and prototypes; false where neither begins.
    bool passed_over() {
        const std::string_view word = words_.peek();
        if (word == "ROUTE") {
            for (int i = 0; i < 4; ++i) {
                words_.take("a route");
            }
            return true;
        }
        if (word != "PROTO" && word != "EXTERNPROTO") {
            return false;
        }
        file_.has_prototypes = true;
        words_.take("PROTO");
        take_name("a name of a prototype");
        skip_balanced('[', ']');
        if (word == "PROTO") {
            skip_balanced('{', '}');
        } else if (words_.peek() == "[") {
            skip_balanced('[', ']');
        } else {
            words_.take("an address");
        }
        return true;
    }

    std::uint32_t take_node(int depth) {
        if (depth > max_vrml_use_depth) {
            words_.refuse(
                fmt::format("nodes at most {} deep", max_vrml_use_depth), "a deeper one");
        }
        std::string_view word = take_name("a node");
        if (word == "USE") {
            const std::string_view name = take_name("a name");
            const auto known = named_.find(name);
            if (known == named_.end()) {
                words_.refuse("a name that DEF gave to a node before", in_quotes(name));
            }
            return known->second;
        }
        VrmlNode node;
        if (word == "DEF") {
            node.name = take_name("a name");
            word = take_name("a node");
        }
        node.type = word;
        node.line = words_.line();
        if (words_.take("'{'") != "{") {
            words_.refuse(
                fmt::format("'{{' after {}", printable(std::string(word))), "something else");
        }
        while (words_.peek() != "}") {
            if (!passed_over()) {
                const std::string_view field = take_name("a field or '}'");
                node.fields.insert_or_assign(field, take_field(depth));
            }
        }
        words_.take("'}'");
        const auto made = static_cast<std::uint32_t>(file_.nodes.size());
        if (!node.name.empty()) {
            named_.insert_or_assign(node.name, made);
        }
        file_.nodes.push_back(std::move(node));
        return made;
    }

    VrmlField take_field(int depth) {
        VrmlField field;
        const bool is_list = words_.peek() == "[";
        if (is_list) {
            words_.take("'['");
        }
        words_.peek();
        field.line = words_.line();
        const std::size_t first = words_.at();
        std::size_t last = first;
        while (true) {
            if (node_follows()) {
                field.nodes.push_back(take_node(depth + 1));
                if (!is_list) {
                    return field;
                }
                continue;
            }
            const std::string_view word = words_.peek();
            if (word.empty()) {
                words_.refuse(is_list ? "']'" : "'}'", "the end of the file");
            }
            if (is_list ? word == "]" : word == "}" || is_name(word)) {
                break;
            }
            if (VrmlTokenizer::is_punctuation(word)) {
                words_.refuse("a value of a field", in_quotes(word));
            }
            words_.take("a value");
            last = words_.at();
        }
        if (field.nodes.empty()) {
            field.text = words_.text().substr(first, last - first);
        }
        if (is_list) {
            words_.take("']'");
        }
        return field;
    }

    VrmlTokenizer words_;
    VrmlFile file_;
    std::map<std::string_view, std::uint32_t> named_;
};

} // namespace

const VrmlField* VrmlNode::field(std::string_view field_name) const {
    const auto found = fields.find(field_name);
    return found == fields.end() ? nullptr : &found->second;
}

VrmlFile read_vrml_nodes(const std::filesystem::path& path, std::string_view text) {
    return Nodes(path, text).read();
}

} // namespace octant::models::meshfile
