#include "masks/tool/chart.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "masks/tool/svg.h"

namespace macula {
namespace {

// Published figures of foveation draw their first curves in magenta, blue, green and black.
constexpr std::array<const char*, 8> kColors = {"#cc3f93", "#0072b2", "#009e73", "#000000",
                                                "#e69f00", "#56b4e9", "#d55e00", "#7a5c2e"};
constexpr const char* kReferenceColor = "#555555";
constexpr double kMarkRadius = 3.6;
constexpr double kMarkDistance = 80.0;  ///< along a curve
constexpr double kLegendRow = 19.0;
constexpr double kLegendSample = 34.0;  ///< length of the piece of line before a name
constexpr double kTextSize = 12.0;

std::string tick_label(double value) {
    std::array<char, 40> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
    return {text.data(), end};
}

/// Where the axes' ranges lie on the page.
struct Frame {
    const Chart& chart;
    glm::dvec2 corner{66.0, 14.0};
    glm::dvec2 size{chart.width - 66.0 - 18.0, chart.height - 14.0 - 52.0};

    static double share(const ChartAxis& axis, double value) {
        if (!axis.logarithmic) return (value - axis.low) / (axis.high - axis.low);
        // What a logarithm has no place for lies far below.
        return value > 0.0 ? std::log(value / axis.low) / std::log(axis.high / axis.low) : -1e3;
    }
    [[nodiscard]] double x(double value) const { return corner.x + size.x * share(chart.x, value); }
    [[nodiscard]] double y(double value) const { return corner.y + size.y * (1.0 - share(chart.y, value)); }
    [[nodiscard]] bool holds(glm::dvec2 place) const {
        return place.x >= corner.x && place.x <= corner.x + size.x && place.y >= corner.y &&
               place.y <= corner.y + size.y;
    }
};

std::vector<glm::dvec2> on_page(const Frame& frame, const ChartSeries& series) {
    std::vector<glm::dvec2> places;
    for (const glm::dvec2& point : series.points)
        // Renderers take coordinates of any size badly; what is cut off may lie anywhere outside.
        places.emplace_back(std::clamp(frame.x(point.x), -1e4, 1e4), std::clamp(frame.y(point.y), -1e4, 1e4));
    return places;
}

/// A regular polygon around the centre, first corner at an angle from the right, clockwise.
std::vector<glm::dvec2> polygon(glm::dvec2 centre, int corners, double first_deg, double radius) {
    std::vector<glm::dvec2> result;
    for (int i = 0; i < corners; ++i) {
        const double angle = first_deg * std::numbers::pi / 180.0 + 2.0 * std::numbers::pi * i / corners;
        result.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return result;
}

void draw_mark(SvgWriter& svg, glm::dvec2 centre, std::size_t style) {
    const char* color = kColors[style % kColors.size()];
    const SvgPaint filled{.stroke = "#ffffff", .stroke_width = 0.8, .fill = color};
    const SvgPaint hollow{.stroke = color, .stroke_width = 1.4, .fill = "#ffffff"};
    switch (style % kColors.size()) {
        case 0:
            svg.circle(centre, kMarkRadius, filled);
            break;
        case 1:
            svg.polyline(polygon(centre, 4, 45.0, 1.3 * kMarkRadius), filled, true);
            break;
        case 2:
            svg.polyline(polygon(centre, 3, -90.0, 1.4 * kMarkRadius), filled, true);
            break;
        case 3:
            svg.polyline(polygon(centre, 4, 0.0, 1.4 * kMarkRadius), filled, true);
            break;
        case 4:
            svg.circle(centre, kMarkRadius, hollow);
            break;
        case 5:
            svg.polyline(polygon(centre, 4, 45.0, 1.3 * kMarkRadius), hollow, true);
            break;
        case 6:
            svg.polyline(polygon(centre, 3, 90.0, 1.4 * kMarkRadius), hollow, true);
            break;
        default:
            svg.polyline(polygon(centre, 4, 0.0, 1.4 * kMarkRadius), hollow, true);
            break;
    }
}

SvgPaint line_paint(const ChartSeries& series, std::size_t style) {
    if (series.reference) return {.stroke = kReferenceColor, .stroke_width = 1.4, .dash = "7 4"};
    return {.stroke = kColors[style % kColors.size()], .stroke_width = 1.8};
}

/// Marks at equal distances along the visible part of the curve, those of different curves at different places.
void draw_marks(SvgWriter& svg, const Frame& frame, const std::vector<glm::dvec2>& places, std::size_t style) {
    double until_next = kMarkDistance * (0.25 + std::fmod(0.375 * static_cast<double>(style), 1.0));
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (!frame.holds(places[i - 1]) || !frame.holds(places[i])) continue;
        const double length = glm::distance(places[i - 1], places[i]);
        double at = until_next;
        for (; at <= length; at += kMarkDistance)
            draw_mark(svg, glm::mix(places[i - 1], places[i], at / length), style);
        until_next = at - length;
    }
}

void draw_series(SvgWriter& svg, const Frame& frame, const ChartSeries& series, std::size_t style) {
    const std::vector<glm::dvec2> places = on_page(frame, series);
    SvgPaint paint = line_paint(series, style);
    const auto beyond = std::ranges::find_if(series.points, [&](glm::dvec2 p) { return p.x > series.faint_from; });
    const auto firm = static_cast<std::size_t>(beyond - series.points.begin());
    svg.begin_clip(frame.corner, frame.size);
    svg.polyline(std::span(places).first(firm), paint);
    paint.opacity = 0.4;
    // Both parts have the point between them.
    svg.polyline(std::span(places).subspan(firm > 0 ? firm - 1 : 0), paint);
    svg.end_clip();
    if (!series.reference) draw_marks(svg, frame, places, style);
}

void draw_axes(SvgWriter& svg, const Frame& frame) {
    const Chart& chart = frame.chart;
    const glm::dvec2 end = frame.corner + frame.size;
    const SvgPaint grid{.stroke = "#e4e4e4", .stroke_width = 0.8};
    const SvgPaint tick{.stroke = "#000000", .stroke_width = 1.0};
    for (const double value : chart_ticks(chart.x, 10)) {
        const double x = frame.x(value);
        svg.line({x, frame.corner.y}, {x, end.y}, grid);
        svg.line({x, end.y}, {x, end.y + 5.0}, tick);
        svg.text({x, end.y + 19.0}, tick_label(value), {.size = kTextSize, .anchor = SvgText::Anchor::middle});
    }
    for (const double value : chart_ticks(chart.y, 8)) {
        const double y = frame.y(value);
        svg.line({frame.corner.x, y}, {end.x, y}, grid);
        svg.line({frame.corner.x - 5.0, y}, {frame.corner.x, y}, tick);
        svg.text({frame.corner.x - 9.0, y + 4.0}, tick_label(value),
                 {.size = kTextSize, .anchor = SvgText::Anchor::end});
    }
    svg.text({frame.corner.x + 0.5 * frame.size.x, chart.height - 12.0}, chart.x.label,
             {.size = 13.0, .anchor = SvgText::Anchor::middle});
    svg.text({18.0, frame.corner.y + 0.5 * frame.size.y}, chart.y.label,
             {.size = 13.0, .anchor = SvgText::Anchor::middle, .turn_deg = -90.0});
}

/// Letters of UTF-8 text.
std::size_t letters(std::string_view text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

/// Length of the curves that lies in a rectangle.
double covered_length(const Frame& frame, glm::dvec2 corner, glm::dvec2 size) {
    double covered = 0.0;
    for (const ChartSeries& series : frame.chart.series) {
        const std::vector<glm::dvec2> places = on_page(frame, series);
        for (std::size_t i = 1; i < places.size(); ++i) {
            const double length = glm::distance(places[i - 1], places[i]);
            const int steps = std::clamp(static_cast<int>(length / 4.0), 1, 500);
            for (int k = 0; k < steps; ++k) {
                const glm::dvec2 p = glm::mix(places[i - 1], places[i], (k + 0.5) / steps) - corner;
                if (p.x > 0.0 && p.y > 0.0 && p.x < size.x && p.y < size.y) covered += length / steps;
            }
        }
    }
    return covered;
}

/// Size of the legend's box; 0 where nothing is named. A letter is about .54 of its size wide.
glm::dvec2 legend_size(const Chart& chart) {
    std::size_t longest = 0;
    int rows = 0;
    for (const ChartSeries& series : chart.series) {
        longest = std::max(longest, letters(series.name));
        rows += series.name.empty() ? 0 : 1;
    }
    if (rows == 0) return {0.0, 0.0};
    return {kLegendSample + 26.0 + 0.54 * kTextSize * static_cast<double>(longest), 10.0 + kLegendRow * rows};
}

/// Corner of the legend's box: in one of the frame's corners if no curve lies there, else to the right of the frame.
glm::dvec2 legend_corner(const Frame& frame, glm::dvec2 box) {
    constexpr double kGap = 10.0;
    const glm::dvec2 near = frame.corner + kGap;
    const glm::dvec2 far = frame.corner + frame.size - box - kGap;
    for (const glm::dvec2 corner : {glm::dvec2(far.x, near.y), glm::dvec2(near.x, far.y), near, far})
        if (covered_length(frame, corner - kGap, box + 2.0 * kGap) == 0.0) return corner;
    return {frame.corner.x + frame.size.x + kGap, frame.corner.y};
}

void draw_legend(SvgWriter& svg, const Chart& chart, glm::dvec2 corner, glm::dvec2 box) {
    svg.rectangle(corner, box, {.stroke = "#bbbbbb", .stroke_width = 0.8, .fill = "#ffffff"});
    double y = corner.y + 5.0 + 0.5 * kLegendRow;
    std::size_t style = 0;
    for (const ChartSeries& series : chart.series) {
        if (!series.name.empty()) {
            const double x = corner.x + 9.0;
            svg.line({x, y}, {x + kLegendSample, y}, line_paint(series, style));
            if (!series.reference) draw_mark(svg, {x + 0.5 * kLegendSample, y}, style);
            svg.text({x + kLegendSample + 8.0, y + 4.0}, series.name, {.size = kTextSize});
            y += kLegendRow;
        }
        style += series.reference ? 0 : 1;
    }
}

std::vector<double> logarithmic_ticks(const ChartAxis& axis, int most) {
    std::vector<double> all;
    std::vector<double> powers;
    const int first = static_cast<int>(std::floor(std::log10(axis.low)));
    const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
    for (int power = first; power <= last; ++power) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, power);
            if (value < axis.low * (1.0 - 1e-9) || value > axis.high * (1.0 + 1e-9)) continue;
            all.push_back(value);
            if (digit == 1.0) powers.push_back(value);
        }
    }
    return all.size() <= static_cast<std::size_t>(most) ? all : powers;
}

}  // namespace

std::vector<double> chart_ticks(const ChartAxis& axis, int most) {
    if (axis.logarithmic) return logarithmic_ticks(axis, most + 3);
    const double least_step = (axis.high - axis.low) / most;
    const double power = std::pow(10.0, std::floor(std::log10(least_step)));
    double step = 10.0 * power;
    for (const double digit : {5.0, 2.0, 1.0})
        if (digit * power >= least_step * (1.0 - 1e-9)) step = digit * power;
    std::vector<double> ticks;
    const double slack = 1e-9 * (axis.high - axis.low);
    for (double k = std::ceil((axis.low - slack) / step); k * step <= axis.high + slack; k += 1.0)
        ticks.push_back(k * step + 0.0);
    return ticks;
}

std::string draw_chart(const Chart& chart) {
    const Frame frame{chart};
    const glm::dvec2 legend = legend_size(chart);
    const glm::dvec2 corner = legend_corner(frame, legend);
    const double width = legend.y > 0.0 ? std::max(chart.width, corner.x + legend.x + 10.0) : chart.width;
    SvgWriter svg(width, chart.height, chart.title);
    draw_axes(svg, frame);
    std::size_t style = 0;
    for (const ChartSeries& series : chart.series) {
        draw_series(svg, frame, series, style);
        style += series.reference ? 0 : 1;
    }
    svg.rectangle(frame.corner, frame.size, {.stroke = "#000000", .stroke_width = 1.0});
    if (legend.y > 0.0) draw_legend(svg, chart, corner, legend);
    return svg.finish();
}

}  // namespace macula
