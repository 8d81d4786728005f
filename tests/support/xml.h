#pragma once

#include <algorithm>
#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace macula::testing {

/// One element of an XML document.
struct XmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string text;    ///< between its tags, children's left out
    std::string parent;  ///< name; empty: the root

    [[nodiscard]] std::string at(const std::string& attribute) const {
        const auto found = attributes.find(attribute);
        if (found == attributes.end()) throw std::runtime_error("<" + name + "> without " + attribute);
        return found->second;
    }
    [[nodiscard]] double number(const std::string& attribute) const { return std::stod(at(attribute)); }
};

/// Reads an XML document of elements, attributes and text, and throws std::runtime_error where it is not well-formed
/// (XML 1.0: one root, tags in pairs, quoted attributes, each once, no stray < or &). Elements come in the order in
/// which they begin.
class XmlReader {
public:
    static std::vector<XmlElement> read(std::string_view document) { return XmlReader(document).elements(); }

private:
    explicit XmlReader(std::string_view document) : rest_(document) {}

    std::vector<XmlElement> elements() {
        if (rest_.starts_with("<?xml ")) skip_past("?>");
        skip_space();
        while (!rest_.empty()) {
            if (rest_.starts_with("</")) {
                close();
            } else if (rest_.starts_with("<")) {
                require(!open_.empty() || all_.empty(), "a second root");
                open();
            } else {
                const std::string text = unescaped(take_until("<"));
                if (!open_.empty())
                    all_[open_.back()].text += text;
                else
                    require(std::ranges::all_of(text, [](unsigned char c) { return std::isspace(c) != 0; }),
                            "text outside the root");
            }
        }
        require(open_.empty(), "an element without end");
        require(!all_.empty(), "no root");
        return all_;
    }

    void open() {
        rest_.remove_prefix(1);
        XmlElement element;
        element.name = name();
        if (!open_.empty()) element.parent = all_[open_.back()].name;
        while (true) {
            const bool spaced = skip_space();
            if (rest_.starts_with("/>") || rest_.starts_with(">")) break;
            require(spaced, "no space before an attribute");
            const std::string key = name();
            require(rest_.starts_with("=\""), "an attribute without value");
            rest_.remove_prefix(2);
            const std::string_view value = take_until("\"");
            require(value.find('<') == std::string_view::npos, "< in an attribute");
            rest_.remove_prefix(1);
            require(element.attributes.emplace(key, unescaped(value)).second, "an attribute twice");
        }
        all_.push_back(element);
        if (rest_.starts_with(">")) open_.push_back(all_.size() - 1);
        skip_past(">");
    }

    void close() {
        rest_.remove_prefix(2);
        const std::string closed = name();
        require(!open_.empty() && all_[open_.back()].name == closed, "</" + closed + "> closes nothing");
        open_.pop_back();
        skip_space();
        require(rest_.starts_with(">"), "an end tag with more than a name");
        rest_.remove_prefix(1);
    }

    std::string name() {
        std::size_t length = 0;
        while (length < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[length])) != 0 ||
                                         std::string_view(":_-.").find(rest_[length]) != std::string_view::npos))
            ++length;
        require(length > 0 && std::isdigit(static_cast<unsigned char>(rest_.front())) == 0, "no name");
        const std::string result(rest_.substr(0, length));
        rest_.remove_prefix(length);
        return result;
    }

    std::string unescaped(std::string_view text) {
        static const std::map<std::string_view, char> kEntities = {
            {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
        std::string result;
        for (std::size_t i = 0; i < text.size(); ++i) {
            require(static_cast<unsigned char>(text[i]) >= 0x20 || std::isspace(static_cast<unsigned char>(text[i])),
                    "a control character");
            if (text[i] != '&') {
                result += text[i];
                continue;
            }
            const std::size_t end = text.find(';', i);
            require(end != std::string_view::npos, "a stray &");
            const auto entity = kEntities.find(text.substr(i + 1, end - i - 1));
            require(entity != kEntities.end(), "an unknown entity");
            result += entity->second;
            i = end;
        }
        return result;
    }

    bool skip_space() {
        const std::size_t length = std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size());
        rest_.remove_prefix(length);
        return length > 0;
    }

    std::string_view take_until(std::string_view end) {
        const std::size_t length = std::min(rest_.find(end), rest_.size());
        const std::string_view taken = rest_.substr(0, length);
        rest_.remove_prefix(length);
        return taken;
    }

    void skip_past(std::string_view end) {
        take_until(end);
        require(!rest_.empty(), "an end within a tag");
        rest_.remove_prefix(end.size());
    }

    void require(bool good, const std::string& what) const {
        if (!good) throw std::runtime_error("XML: " + what + " before '" + std::string(rest_.substr(0, 40)) + "'");
    }

    std::string_view rest_;
    std::vector<XmlElement> all_;
    std::vector<std::size_t> open_;  ///< indices of elements that have begun and not ended
};

inline std::vector<XmlElement> read_xml(std::string_view document) {
    return XmlReader::read(document);
}

}  // namespace macula::testing
