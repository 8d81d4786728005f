#include "masks/tool/cutoff_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "masks/law.h"
#include "masks/make/density.h"

namespace macula {
namespace {

constexpr int kPoints = 600;

/// Points of a function of eccentricity.
template <class Function>
std::vector<glm::dvec2> sample(double to_deg, Function&& frequency_cpd) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= kPoints; ++i) {
        const double eccentricity_deg = to_deg * i / kPoints;
        points.emplace_back(eccentricity_deg, frequency_cpd(eccentricity_deg));
    }
    return points;
}

/// Eccentricity up to which the law follows data.
double domain_deg(const AcuityLaw& law) {
    for (const NamedLaw& named : named_laws())
        if (named.model.index() == law.model.index()) return law.full_acuity_deg + named.domain_deg * law.stretch;
    return 0.0;
}

std::string legend_name(const Recipe& recipe, const AcuityLaw& law) {
    const MaskField field(recipe.display, recipe.geometry);
    const double share = WindowHistogram(recipe.display, field).mean([&](double eccentricity_deg) {
        return wished_density(field, law, eccentricity_deg);
    });
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), " (%.1f %%)", 100.0 * share);
    return recipe.preset.name + text.data();
}

ChartSeries display_limit(const Recipe& recipe, const MaskField& field, double to_deg) {
    ChartSeries limit;
    limit.name = recipe.display.name + " display";
    limit.points = sample(to_deg, [&](double eccentricity_deg) { return 0.5 * field.px_per_deg(eccentricity_deg); });
    limit.reference = true;
    return limit;
}

ChartAxis frequency_axis(const std::vector<ChartSeries>& series, double to_cpd, bool logarithmic) {
    ChartAxis axis{"cut-off frequency (cycles per degree)", 0.0, to_cpd, logarithmic};
    double least = to_cpd;
    for (const ChartSeries& one : series)
        for (const glm::dvec2& point : one.points) least = std::min(least, point.y);
    // Laws that fall exponentially would leave the others no room.
    if (logarithmic) axis.low = std::max(0.9 * least, std::min(0.1, 0.01 * axis.high));
    return axis;
}

}  // namespace

double drawn_frequency_cpd(const SamplingPreset& preset, const AcuityLaw& law, double eccentricity_deg,
                           double px_per_deg) {
    const double cutoff_cpd = cutoff_frequency_cpd(law, eccentricity_deg);
    if (preset.free != SamplingPreset::Free::exponent) return cutoff_cpd;
    const double limit_cpd = 0.5 * px_per_deg;
    return limit_cpd * std::pow(cutoff_cpd / limit_cpd, law.exponent / preset.law.exponent);
}

Chart cutoff_chart(std::span<const Recipe> recipes, double to_deg, double to_cpd, bool logarithmic) {
    Chart chart;
    chart.title = "Cut-off frequency against eccentricity";
    chart.x = {"eccentricity (degrees)", 0.0, to_deg, false};
    double greatest_cpd = 0.5 * MaskField(recipes.front().display, recipes.front().geometry).px_per_deg(to_deg);
    for (const Recipe& recipe : recipes) {
        if (recipe.preset.full) continue;
        const MaskField field(recipe.display, recipe.geometry);
        const AcuityLaw law = mask_law(recipe);
        ChartSeries series;
        series.name = legend_name(recipe, law);
        series.points = sample(to_deg, [&](double eccentricity_deg) {
            return drawn_frequency_cpd(recipe.preset, law, eccentricity_deg, field.px_per_deg(eccentricity_deg));
        });
        series.faint_from = domain_deg(law);
        // Not the greatest of the curve: of a solved exponent that may be thousands.
        greatest_cpd = std::max(greatest_cpd, cutoff_frequency_cpd(law, 0.0));
        chart.series.push_back(std::move(series));
    }
    const Recipe& any = recipes.front();
    chart.series.push_back(display_limit(any, MaskField(any.display, any.geometry), to_deg));
    chart.y = frequency_axis(chart.series, to_cpd > 0.0 ? to_cpd : 1.04 * greatest_cpd, logarithmic);
    return chart;
}

}  // namespace macula
