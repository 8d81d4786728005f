#pragma once

#include <string>

#include "masks/display.h"
#include "protocol/base/error.h"

namespace macula {

/// How acuity falls with eccentricity, as Geisler and Perry (1998) fitted it, and what density of samples follows.
/// Angles are in degrees here because the published constants are.
///
/// Cutoff frequency: fc(e) = e2 ln(1 / CT0) / (alpha (e + e2)), cycles per degree.
/// Share of pixels sampled: p = min(1, (2 fc / pixels per degree)^exponent).
struct AcuityLaw {
    double alpha_deg = 0.106;      ///< spatial frequency decay constant, in 1/cpd = degrees
    double e2_deg = 2.3;           ///< eccentricity at which acuity is halved
    double contrast = 1.0 / 64.0;  ///< CT0, least contrast that is seen
    double exponent = 2.0;         ///< 2: Nyquist density of the cutoff frequency; 1: its square root
    double full_acuity_deg = 0.0;  ///< eccentricity S up to which acuity is that of the centre
};

/// Finest pattern that is seen at an eccentricity, in cycles per degree.
double cutoff_frequency_cpd(const AcuityLaw& law, double eccentricity_deg);

/// Share 0..1 of the pixels that need a sample, where the display has `px_per_deg` pixels per degree.
double needed_share(const AcuityLaw& law, double eccentricity_deg, double px_per_deg);

/// Pixels per degree of an eye's planar image at a direction given by its tangents: the square root of the pixels
/// per square degree. A plane at unit distance shows the solid angle cos^3 of its area, so this is the density at
/// the axis times cos^-3/2 of the angle to it.
double pixels_per_degree(const Display& display, Eye eye, double tangent_x, double tangent_y);

/// A choice of the `sampling` option.
struct SamplingPreset {
    bool full = false;   ///< a ray for every visible pixel
    double share = 1.0;  ///< else: share of the buffer's pixels that get a ray while the gaze is on the axis
};

/// Parses "full" or a percentage from 1 to 99: "54", "41", "27", "18" or any other. Errors: `option`.
Expected<SamplingPreset> parse_sampling(const std::string& text);

/// The law of the shape of `shape` whose e2 gives a plan that samples `share` of all pixels of the eye's buffer,
/// hidden ones included, while the gaze is on the optical axis. Solved by bisection on the levels that the tile
/// sampler would choose. Shares below that of the sparsest level, 1.6 %, give the sparsest plan.
AcuityLaw solve_law(const Display& display, Eye eye, double share, AcuityLaw shape = {});

}  // namespace macula
