#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>

namespace macula {

/// How a line or an area is drawn; colours as SVG writes them.
struct SvgPaint {
    std::string stroke = "none";
    double stroke_width = 1.0;
    std::string dash = "none";  ///< or lengths of dashes and gaps, "6 3"
    std::string fill = "none";
    double opacity = 1.0;
};

struct SvgText {
    enum class Anchor : std::uint8_t { start, middle, end };
    double size = 13.0;
    Anchor anchor = Anchor::start;
    double turn_deg = 0.0;  ///< clockwise, about the text's place
    bool bold = false;
    std::string color = "#000000";
};

/// A picture of lines, areas, text and embedded images as SVG 1.1, drawn in the order of the calls. Units are pixels,
/// x right, y down. Coordinates are written to a hundredth, in every locale alike; text may be any UTF-8.
class SvgWriter {
public:
    SvgWriter(double width, double height, const std::string& title);

    void line(glm::dvec2 from, glm::dvec2 to, const SvgPaint& paint);
    void rectangle(glm::dvec2 corner, glm::dvec2 size, const SvgPaint& paint);
    void circle(glm::dvec2 centre, double radius, const SvgPaint& paint);
    /// Fewer than two points: nothing.
    void polyline(std::span<const glm::dvec2> points, const SvgPaint& paint, bool closed = false);
    /// `data` as the attribute d of a path has it.
    void path(std::string_view data, const SvgPaint& paint);
    /// `place` is the baseline's start, middle or end.
    void text(glm::dvec2 place, std::string_view text, const SvgText& style = {});
    /// A PNG file's bytes, stretched over the rectangle.
    void image(glm::dvec2 corner, glm::dvec2 size, std::span<const std::uint8_t> png);

    /// What is drawn until the matching end_clip() is seen inside a rectangle only. They nest.
    void begin_clip(glm::dvec2 corner, glm::dvec2 size);
    void end_clip();

    /// Ends the document, which is then complete, and returns it. Once.
    [[nodiscard]] std::string finish();

private:
    std::string out_;
    int clips_ = 0;
};

/// A number as SvgWriter writes it: rounded to a hundredth, "-1.5", "0", "120".
std::string svg_number(double value);

}  // namespace macula
