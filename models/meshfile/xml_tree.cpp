#include "models/meshfile/xml_tree.h"

#include "sim/base/error.h"
#include "sim/base/text_file.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <system_error>
#include <utility>

namespace octant::models::meshfile {

namespace fs = std::filesystem;

fs::path flightgear_file(const fs::path& model, const std::string& name) {
    std::error_code ignored;
    for (fs::path folder = fs::absolute(model).parent_path();; folder = folder.parent_path()) {
        fs::path named = name;
        // "Aircraft/NAME/Models/..." where the aircraft's own folder is called something else
        for (int less = 0; less < 3 && !named.empty(); ++less) {
            if (fs::is_regular_file(folder / named, ignored)) { return folder / named; }
            fs::path shorter;
            for (auto part = std::next(named.begin()); part != named.end(); ++part) { shorter /= *part; }
            named = shorter;
        }
        if (folder == folder.parent_path()) { return {}; }
    }
}

fs::path flightgear_pictures(const fs::path& model, const std::string& texture_path) {
    const fs::path folder = fs::path(texture_path).relative_path();
    return folder.empty() ? fs::path() : model.parent_path() / folder;
}

namespace {

constexpr int max_xml_depth = 100;
constexpr std::string_view xml_blanks = " \t\r\n";

class XmlReading {
public:
    XmlReading(const std::filesystem::path& file, std::string_view text) : file_(file), left_(text) {}

    XmlElement read() {
        XmlElement none;
        skip_between(none);
        if (left_.empty()) { refuse("an element", "the end of the file"); }
        return element(0);
    }

private:
    [[noreturn]] void refuse(std::string_view expected, std::string_view got) const {
        throw_error_at(file_, line_, fmt::format("expected {}, got {}", expected, got));
    }

    void take(std::size_t count) {
        const std::string_view taken = left_.substr(0, count);
        line_ += static_cast<int>(std::ranges::count(taken, '\n'));
        left_.remove_prefix(taken.size());
    }

    /// Takes what comes before `end`, and it.
    std::string_view take_until(std::string_view end) {
        const std::size_t at = left_.find(end);
        if (at == std::string_view::npos) { refuse(fmt::format("'{}'", end), "the end of the file"); }
        const std::string_view before = left_.substr(0, at);
        take(at + end.size());
        return before;
    }

    /// Text into `parent`, comments and the like away, up to the next tag.
    void skip_between(XmlElement& parent) {
        while (!left_.empty()) {
            if (left_.starts_with("<!--")) {
                take_until("-->");
            } else if (left_.starts_with("<![CDATA[")) {
                take(9);
                parent.text += take_until("]]>");
            } else if (left_.starts_with("<?") || left_.starts_with("<!")) {
                take_until(">");
            } else if (left_.front() == '<') {
                return;
            } else {
                const std::size_t next = std::min(left_.find('<'), left_.size());
                add_text(parent.text, left_.substr(0, next));
                take(next);
            }
        }
    }

    static void add_text(std::string& to, std::string_view text) {
        constexpr std::array<std::pair<std::string_view, char>, 5> named{
            {{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}}};
        while (!text.empty()) {
            const auto found =
                std::ranges::find_if(named, [&](const auto& entity) { return text.starts_with(entity.first); });
            to += found == named.end() ? text.front() : found->second;
            text.remove_prefix(found == named.end() ? 1 : found->first.size());
        }
    }

    /// The tag that begins here; quotes hide what is in them.
    std::string_view take_tag() {
        char quote = '\0';
        for (std::size_t i = 1; i < left_.size(); ++i) {
            const char c = left_[i];
            if (quote != '\0') {
                quote = c == quote ? '\0' : quote;
            } else if (c == '"' || c == '\'') {
                quote = c;
            } else if (c == '>') {
                const std::string_view tag = left_.substr(1, i - 1);
                take(i + 1);
                return tag;
            }
        }
        refuse("'>'", "the end of the file");
    }

    static std::string_view name_of(std::string_view tag) {
        return tag.substr(0, std::min(tag.find_first_of(" \t\r\n/"), tag.size()));
    }

    /// The value of an attribute of a tag; empty where it has none. What stands in another attribute's quotes is none.
    static std::string attribute_of(std::string_view tag, std::string_view name) {
        std::string_view rest = tag.substr(name_of(tag).size());
        for (;;) {
            const std::size_t equals = rest.find('=');
            const std::size_t open = rest.find_first_of("\"'", std::min(equals, rest.size()));
            const std::size_t close = open == rest.npos ? open : rest.find(rest[open], open + 1);
            if (close == rest.npos) { return {}; }
            std::string_view word = rest.substr(0, equals);
            word.remove_prefix(std::min(word.find_first_not_of(xml_blanks), word.size()));
            word = word.substr(0, word.find_last_not_of(xml_blanks) + 1);
            if (word == name) {
                std::string value;
                add_text(value, rest.substr(open + 1, close - open - 1));
                return value;
            }
            rest.remove_prefix(close + 1);
        }
    }

    XmlElement element(int depth) {
        if (depth > max_xml_depth) { refuse(fmt::format("elements at most {} deep", max_xml_depth), "a deeper one"); }
        XmlElement made;
        made.line = line_;
        const std::string_view tag = take_tag();
        made.name = name_of(tag);
        made.include = attribute_of(tag, "include");
        if (made.name.empty()) { refuse("the name of an element", in_quotes(tag)); }
        if (tag.ends_with('/')) { return made; }
        while (true) {
            skip_between(made);
            if (left_.empty()) { refuse(fmt::format("</{}>", printable(made.name)), "the end of the file"); }
            if (!left_.starts_with("</")) {
                made.children.push_back(element(depth + 1));
                continue;
            }
            const std::string_view end = take_tag().substr(1);
            if (name_of(end) != made.name) { refuse(fmt::format("</{}>", printable(made.name)), in_quotes(end)); }
            trim(made.text);
            return made;
        }
    }

    static void trim(std::string& text) {
        text.erase(0, std::min(text.find_first_not_of(xml_blanks), text.size()));
        text.erase(text.find_last_not_of(xml_blanks) + 1);
    }

    std::filesystem::path file_;
    std::string_view left_;
    int line_ = 1;
};

} // namespace

const XmlElement* XmlElement::find(std::string_view child) const {
    const auto found = std::ranges::find(children, child, &XmlElement::name);
    return found == children.end() ? nullptr : &*found;
}

std::string_view XmlElement::text_of(std::string_view child) const {
    const XmlElement* found = find(child);
    return found == nullptr ? std::string_view() : std::string_view(found->text);
}

XmlElement xml_tree(const std::filesystem::path& file, std::string_view text) { return XmlReading(file, text).read(); }

} // namespace octant::models::meshfile
