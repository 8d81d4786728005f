// Charts, read from their SVG as a person reads them: curves are compared with the ticks beside them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "masks/make/density.h"
#include "masks/tool/chart.h"
#include "masks/tool/cutoff_chart.h"
#include "tests/support/small_display.h"
#include "tests/support/xml.h"

namespace macula {
namespace {

using testing::read_xml;
using testing::XmlElement;

/// A chart's SVG, taken apart.
struct ReadChart {
    struct Curve {
        std::vector<glm::dvec2> places;
        XmlElement element;
    };
    double width = 0.0;
    std::vector<std::pair<double, double>> x_ticks;  ///< place and value
    std::vector<std::pair<double, double>> y_ticks;
    std::vector<Curve> curves;
    std::vector<XmlElement> elements;

    explicit ReadChart(const Chart& chart) : elements(read_xml(draw_chart(chart))) {
        width = elements.front().number("width");
        for (const XmlElement& element : elements) {
            if (element.name == "text" && element.at("text-anchor") == "middle" &&
                element.text.find_first_not_of("0123456789.-e+") == std::string::npos)
                x_ticks.emplace_back(element.number("x"), std::stod(element.text));
            if (element.name == "text" && element.at("text-anchor") == "end")
                y_ticks.emplace_back(element.number("y") - 4.0, std::stod(element.text));  // on the baseline
            if (element.name != "polyline") continue;
            Curve curve;
            curve.element = element;
            std::istringstream list(element.at("points"));
            char comma = 0;
            for (glm::dvec2 place; list >> place.x >> comma >> place.y;) curve.places.push_back(place);
            curves.push_back(curve);
        }
    }

    /// Value at a place by the line through the outer two ticks.
    static double value(const std::vector<std::pair<double, double>>& ticks, double place, bool logarithmic) {
        const auto scaled = [logarithmic](double v) { return logarithmic ? std::log(v) : v; };
        const auto [place_a, value_a] = ticks.front();
        const auto [place_b, value_b] = ticks.back();
        const double result =
            scaled(value_a) + (place - place_a) / (place_b - place_a) * (scaled(value_b) - scaled(value_a));
        return logarithmic ? std::exp(result) : result;
    }
};

Chart one_curve(bool logarithmic) {
    Chart chart;
    chart.x = {"x", -3.0, 17.0, false};
    chart.y = {"y", logarithmic ? 0.1 : -10.0, 40.0, logarithmic};
    ChartSeries series;
    series.name = "curve";
    for (int i = 0; i <= 50; ++i) series.points.emplace_back(-3.0 + 0.4 * i, 1.0 + 0.7 * i);
    chart.series.push_back(series);
    return chart;
}

TEST(Chart, CurvesLieWhereTheTicksSay) {
    for (const bool logarithmic : {false, true}) {
        const Chart chart = one_curve(logarithmic);
        const ReadChart read(chart);
        ASSERT_GE(read.x_ticks.size(), 3U);
        ASSERT_GE(read.y_ticks.size(), 3U);
        const std::vector<glm::dvec2>& points = chart.series[0].points;
        ASSERT_EQ(read.curves.at(0).places.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec2 place = read.curves[0].places[i];
            EXPECT_NEAR(ReadChart::value(read.x_ticks, place.x, false), points[i].x, 1e-3);
            EXPECT_NEAR(ReadChart::value(read.y_ticks, place.y, logarithmic), points[i].y, 2e-3 * points[i].y);
        }
    }
}

TEST(Chart, TicksAreRoundAndWithin) {
    const unsigned seed = 5;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-6.0, 6.0);
    for (int i = 0; i < 1000; ++i) {
        const double low = (i % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(random));
        const ChartAxis axis{"", low, low + std::pow(10.0, exponent(random)), false};
        if (axis.high - axis.low < 1e-6 * std::abs(low)) continue;
        const std::vector<double> ticks = chart_ticks(axis, 8);
        ASSERT_GE(ticks.size(), 2U) << axis.low << ' ' << axis.high;
        ASSERT_LE(ticks.size(), 9U) << axis.low << ' ' << axis.high;
        const double slack = 1e-8 * (axis.high - axis.low);
        EXPECT_GE(ticks.front(), axis.low - slack);
        EXPECT_LE(ticks.back(), axis.high + slack);
        const double step = (ticks.back() - ticks.front()) / static_cast<double>(ticks.size() - 1);
        const double digit = step / std::pow(10.0, std::floor(std::log10(step * 1.0000001)));
        EXPECT_LT(std::min({std::abs(digit - 1.0), std::abs(digit - 2.0), std::abs(digit - 5.0)}), 1e-4) << step;
        // No further tick would have had a place.
        EXPECT_LT(ticks.back() + step, axis.high + step + slack);
        EXPECT_GT(ticks.back() + step, axis.high - slack);
        EXPECT_LT(ticks.front() - step, axis.low + slack);
    }
    EXPECT_EQ(chart_ticks({"", 0.1, 30.0, true}, 8).size(), 8U);  // 0.1 0.2 0.5 ... 20
    EXPECT_EQ(chart_ticks({"", 0.001, 1000.0, true}, 8).size(), 7U);
}

/// Eight curves in a row of the legend: what is drawn over the piece of line, colours left out.
TEST(Chart, CurvesDifferWithoutColour) {
    Chart chart = one_curve(false);
    chart.series.resize(8, chart.series[0]);
    for (std::size_t i = 0; i < 8; ++i) chart.series[i].name = "name" + std::to_string(i);
    std::vector<XmlElement> elements = ReadChart(chart).elements;
    std::set<std::string> kinds;
    for (std::size_t i = 2; i < elements.size(); ++i) {
        if (elements[i].name != "text" || !elements[i].text.starts_with("name")) continue;
        const XmlElement& mark = elements[i - 1];
        ASSERT_TRUE(mark.name == "circle" || mark.name == "polygon");
        // Corners relative to the first one, for the rows lie below each other.
        std::string kind = mark.name + (mark.at("fill") == "#ffffff" ? " hollow" : " filled");
        if (mark.name == "polygon") {
            std::istringstream list(mark.at("points"));
            char comma = 0;
            glm::dvec2 first;
            list >> first.x >> comma >> first.y;
            for (glm::dvec2 place; list >> place.x >> comma >> place.y;)
                kind += " " + std::to_string(std::lround(10.0 * (place.x - first.x))) + "," +
                        std::to_string(std::lround(10.0 * (place.y - first.y)));
        }
        kinds.insert(kind);
    }
    EXPECT_EQ(kinds.size(), 8U);
}

TEST(Chart, ReferencesAreDashedAndExtrapolationsFaint) {
    Chart chart = one_curve(false);
    chart.series[0].faint_from = 8.0;
    ChartSeries limit{"limit", {{-3.0, 5.0}, {17.0, 5.0}}, true};
    chart.series.push_back(limit);
    const ReadChart read(chart);
    ASSERT_EQ(read.curves.size(), 3U);
    EXPECT_FALSE(read.curves[0].element.attributes.contains("opacity"));
    EXPECT_NEAR(ReadChart::value(read.x_ticks, read.curves[0].places.back().x, false), 7.8, 1e-3);
    EXPECT_EQ(read.curves[1].element.at("opacity"), "0.4");
    EXPECT_EQ(read.curves[1].places.front(), read.curves[0].places.back()) << "the two parts meet";
    EXPECT_NEAR(ReadChart::value(read.x_ticks, read.curves[1].places.back().x, false), 17.0, 1e-3);
    EXPECT_FALSE(read.curves[1].element.attributes.contains("stroke-dasharray"));
    EXPECT_TRUE(read.curves[2].element.attributes.contains("stroke-dasharray"));
}

TEST(Chart, TheLegendCoversNoCurve) {
    // Free corners are used.
    Chart chart = one_curve(false);
    EXPECT_EQ(ReadChart(chart).width, chart.width);
    // A curve all over the frame leaves none.
    chart.series[0].points.clear();
    for (int i = 0; i <= 400; ++i) chart.series[0].points.emplace_back(-3.0 + 0.05 * i, i % 2 == 0 ? -10.0 : 40.0);
    EXPECT_GT(ReadChart(chart).width, chart.width);
    chart.series[0].name.clear();
    EXPECT_EQ(ReadChart(chart).width, chart.width) << "no legend, no place for it";
}

TEST(Chart, OddValuesStayOnThePage) {
    Chart chart = one_curve(true);
    chart.series[0].points = {{-3.0, 0.0}, {0.0, -5.0}, {5.0, 1e30}, {17.0, 1.0}};
    const ReadChart read(chart);
    for (const glm::dvec2& place : read.curves.at(0).places)
        EXPECT_LE(std::max(std::abs(place.x), std::abs(place.y)), 1e4);
}

class CutoffChart : public ::testing::Test {
protected:
    static Recipe recipe(const std::string& sampling, MaskGeometry geometry = MaskGeometry::flat) {
        Recipe result;
        result.display = test::small_display();
        result.preset = *parse_sampling(sampling);
        result.geometry = geometry;
        return result;
    }
};

TEST_F(CutoffChart, DrawsTheLaws) {
    const std::vector<Recipe> recipes = {recipe("geisler-perry"), recipe("guenter"), recipe("watson")};
    const Chart chart = cutoff_chart(recipes, 60.0, 0.0, false);
    ASSERT_EQ(chart.series.size(), 4U);
    for (const glm::dvec2& point : chart.series[0].points)
        EXPECT_NEAR(point.y, 2.3 * std::log(64.0) / (0.106 * (point.x + 2.3)), 1e-9);
    for (const glm::dvec2& point : chart.series[1].points)
        EXPECT_NEAR(point.y, 1.0 / (0.022 * point.x + 1.0 / 48.0), 1e-9);
    for (const glm::dvec2& point : chart.series[2].points)
        EXPECT_DOUBLE_EQ(point.y, cutoff_frequency_cpd(recipes[2].preset.law, point.x));
    EXPECT_EQ(chart.series[0].points.back().x, 60.0);
    EXPECT_GE(chart.y.high, chart.series[0].points.front().y);

    const ChartSeries& limit = chart.series[3];
    EXPECT_TRUE(limit.reference);
    const double limit_cpd = 0.5 * pixels_per_degree(recipes[0].display, kLeftEye, 0.0, 0.0);
    for (const glm::dvec2& point : limit.points) EXPECT_NEAR(point.y, limit_cpd, 1e-9);
}

/// Of a plane the limit grows away from the axis.
TEST_F(CutoffChart, TheLimitIsThatOfTheGeometry) {
    const std::vector<Recipe> recipes = {recipe("watson", MaskGeometry::planar)};
    const Chart chart = cutoff_chart(recipes, 60.0, 0.0, false);
    for (const glm::dvec2& point : chart.series[1].points)
        EXPECT_NEAR(
            point.y,
            0.5 * pixels_per_degree(recipes[0].display, kLeftEye, std::tan(point.x * std::numbers::pi / 180.0), 0.0),
            1e-6 * point.y);
}

/// A solved exponent is drawn as the frequency that asks for the same density by the exponent before.
TEST_F(CutoffChart, SolvedExponentsShowTheirDensity) {
    const Recipe sparse = recipe("paper-18");
    const AcuityLaw law{GeislerPerry{}, 1.7, 3.1, 0.0};
    for (double e = 0.0; e <= 90.0; e += 0.5) {
        const double drawn_cpd = drawn_frequency_cpd(sparse.preset, law, e, 10.0);
        EXPECT_NEAR(std::min(1.0, drawn_cpd / 5.0), needed_share(law, e, 10.0), 1e-9) << e;
    }
    const Recipe usual = recipe("paper-54");
    EXPECT_EQ(drawn_frequency_cpd(usual.preset, law, 20.0, 10.0), cutoff_frequency_cpd(law, 20.0));
}

TEST_F(CutoffChart, TheLegendTellsTheShare) {
    const std::vector<Recipe> recipes = {recipe("paper-54"), recipe("full"), recipe("41")};
    const Chart chart = cutoff_chart(recipes, 60.0, 0.0, true);
    ASSERT_EQ(chart.series.size(), 3U) << "full has no law";
    EXPECT_EQ(chart.series[0].name, "paper-54 (54.0 %)");
    EXPECT_EQ(chart.series[1].name, "41 (41.0 %)");
    EXPECT_GT(chart.y.low, 0.0);
}

/// Published constants are faint beyond their data; stretched laws reach as much farther.
TEST_F(CutoffChart, FaintBeyondTheDataOfTheSource) {
    int finite = 0;
    for (const NamedLaw& named : named_laws()) {
        const std::vector<Recipe> recipes = {recipe(std::string(named.name)), recipe(std::string(named.name) + "-30")};
        const Chart chart = cutoff_chart(recipes, 60.0, 0.0, false);
        EXPECT_EQ(chart.series[0].faint_from, named.domain_deg) << named.name;
        EXPECT_EQ(chart.series[1].faint_from, named.domain_deg * mask_law(recipes[1]).stretch) << named.name;
        finite += std::isfinite(named.domain_deg) ? 1 : 0;
    }
    EXPECT_GT(finite, 0);
}

}  // namespace
}  // namespace macula
