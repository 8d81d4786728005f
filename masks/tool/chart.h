#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace macula {

/// One axis of a chart. `high` exceeds `low`; both are positive where it is logarithmic.
struct ChartAxis {
    std::string label;  ///< with the unit: "eccentricity (degrees)"
    double low = 0.0;
    double high = 1.0;
    bool logarithmic = false;
};

/// One curve: values in the axes' units, x ascending. Parts outside the axes' ranges are cut off.
struct ChartSeries {
    std::string name;  ///< in the legend; empty: not there
    std::vector<glm::dvec2> points;
    bool reference = false;  ///< a limit that others are compared with: dashed grey without marks
    /// x beyond which the values are extrapolated, drawn faint.
    double faint_from = 1e300;
};

struct Chart {
    std::string title;  ///< of the document, not drawn: a figure has its caption beside it
    ChartAxis x;
    ChartAxis y;
    std::vector<ChartSeries> series;
    double width = 640.0;
    double height = 420.0;
};

/// Draws a chart as SVG. Curves differ in colour (a palette that the colour-blind tell apart: Okabe & Ito 2008) and in
/// the marks along them, so that they can be told apart in print; the ninth begins again. The legend lies in a corner
/// of the chart where it covers nothing, else to its right; the picture is then wider than `width`.
std::string draw_chart(const Chart& chart);

/// Values for an axis's ticks, ascending, all within its range: multiples of 1, 2 or 5 times a power of ten, at most
/// about `most`; of a logarithmic axis 1, 2 and 5 times powers of ten, or the powers alone where those are too many.
std::vector<double> chart_ticks(const ChartAxis& axis, int most);

}  // namespace macula
