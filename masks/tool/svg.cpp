#include "masks/tool/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace macula {
namespace {

/// Text that may stand between tags and in attributes. Control characters, which XML has no way to write, are left out.
std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                if (static_cast<unsigned char>(c) >= 0x20U || c == '\t' || c == '\n') result += c;
        }
    }
    return result;
}

std::string attribute(std::string_view name, std::string_view value) {
    std::string result(1, ' ');
    result.append(name).append("=\"").append(escaped(value)).append("\"");
    return result;
}

std::string attribute(std::string_view name, double value) {
    return attribute(name, svg_number(value));
}

std::string attributes(const SvgPaint& paint) {
    std::string result = attribute("fill", paint.fill);
    if (paint.stroke != "none") {
        result += attribute("stroke", paint.stroke) + attribute("stroke-width", paint.stroke_width);
        if (paint.dash != "none") result += attribute("stroke-dasharray", paint.dash);
    }
    if (paint.opacity < 1.0) result += attribute("opacity", paint.opacity);
    return result;
}

/// RFC 4648.
std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k) result += k <= count ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
    }
    return result;
}

}  // namespace

std::string svg_number(double value) {
    std::array<char, 40> text{};
    const double rounded = std::round(value * 100.0) / 100.0;
    // Adding zero turns -0 into 0.
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), rounded + 0.0);
    return {text.data(), end};
}

SvgWriter::SvgWriter(double width, double height, const std::string& title) {
    out_ =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\"" +
        attribute("width", width) + attribute("height", height) +
        attribute("viewBox", "0 0 " + svg_number(width) + " " + svg_number(height)) +
        attribute("font-family", "Helvetica, Arial, 'Liberation Sans', sans-serif") + ">\n<title>" + escaped(title) +
        "</title>\n";
    rectangle({0.0, 0.0}, {width, height}, {.fill = "#ffffff"});
}

void SvgWriter::line(glm::dvec2 from, glm::dvec2 to, const SvgPaint& paint) {
    out_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
            attribute("y2", to.y) + attributes(paint) + "/>\n";
}

void SvgWriter::rectangle(glm::dvec2 corner, glm::dvec2 size, const SvgPaint& paint) {
    out_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", size.x) +
            attribute("height", size.y) + attributes(paint) + "/>\n";
}

void SvgWriter::circle(glm::dvec2 centre, double radius, const SvgPaint& paint) {
    out_ += "<circle" + attribute("cx", centre.x) + attribute("cy", centre.y) + attribute("r", radius) +
            attributes(paint) + "/>\n";
}

void SvgWriter::polyline(std::span<const glm::dvec2> points, const SvgPaint& paint, bool closed) {
    if (points.size() < 2) return;
    std::string list;
    for (const glm::dvec2& point : points) {
        if (!list.empty()) list += ' ';
        list += svg_number(point.x) + "," + svg_number(point.y);
    }
    out_ += (closed ? "<polygon" : "<polyline") + attribute("points", list) + attribute("stroke-linejoin", "round") +
            attributes(paint) + "/>\n";
}

void SvgWriter::path(std::string_view data, const SvgPaint& paint) {
    out_ += "<path" + attribute("d", data) + attributes(paint) + "/>\n";
}

void SvgWriter::text(glm::dvec2 place, std::string_view text, const SvgText& style) {
    constexpr std::array<std::string_view, 3> kAnchors = {"start", "middle", "end"};
    out_ += "<text" + attribute("x", place.x) + attribute("y", place.y) + attribute("font-size", style.size) +
            attribute("text-anchor", kAnchors[static_cast<std::size_t>(style.anchor)]) + attribute("fill", style.color);
    if (style.bold) out_ += attribute("font-weight", "bold");
    if (style.turn_deg != 0.0)
        out_ += attribute("transform", "rotate(" + svg_number(style.turn_deg) + " " + svg_number(place.x) + " " +
                                           svg_number(place.y) + ")");
    out_.append(">").append(escaped(text)).append("</text>\n");
}

void SvgWriter::image(glm::dvec2 corner, glm::dvec2 size, std::span<const std::uint8_t> png) {
    // SVG 1.1 readers want xlink:href.
    out_ += "<image" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", size.x) +
            attribute("height", size.y) + attribute("preserveAspectRatio", "none") +
            " xlink:href=\"data:image/png;base64," + base64(png) + "\"/>\n";
}

void SvgWriter::begin_clip(glm::dvec2 corner, glm::dvec2 size) {
    const std::string name = "clip" + std::to_string(++clips_);
    out_ += "<clipPath" + attribute("id", name) + ">";
    rectangle(corner, size, {.fill = "#000000"});
    out_ += "</clipPath>\n<g" + attribute("clip-path", "url(#" + name + ")") + ">\n";
}

void SvgWriter::end_clip() {
    out_ += "</g>\n";
}

std::string SvgWriter::finish() {
    out_ += "</svg>\n";
    return std::exchange(out_, {});
}

}  // namespace macula
