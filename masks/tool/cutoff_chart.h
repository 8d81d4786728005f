#pragma once

#include <span>

#include "masks/make/recipe.h"
#include "masks/tool/chart.h"

namespace macula {

/// The frequency that a preset's curve has at an eccentricity, in cycles per degree. `law` is the preset's, solved;
/// `px_per_deg` are those of the display there.
///
/// It is the law's cut-off frequency fc, except where the exponent was solved (paper-18, paper-41). These share their
/// fc with another mask and differ in how many samples they take for it, which a plot of fc would not show. Their curve
/// is the frequency for which the preset's exponent before solving asks for the same density:
/// fd (fc / fd)^(solved / before), where fd = px_per_deg / 2 is the display's own limit.
double drawn_frequency_cpd(const SamplingPreset& preset, const AcuityLaw& law, double eccentricity_deg,
                           double px_per_deg);

/// Cut-off frequency against eccentricity of each recipe's law (the published figures 2 and 6), with the display's
/// limit dashed. In the legend: each preset's name and the share of the window's pixels that a mask of it samples while
/// the gaze is on the axis. Beyond the eccentricities that a law's source measured, stretched as the law is, curves are
/// faint. `full` has no law; it is the limit itself. All recipes are for one display; there is one at least. `to_cpd`
/// 0: a range that holds the cut-off frequencies of all laws.
Chart cutoff_chart(std::span<const Recipe> recipes, double to_deg, double to_cpd, bool logarithmic);

}  // namespace macula
