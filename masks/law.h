#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "masks/display.h"
#include "protocol/base/error.h"

namespace macula {

// Published models of how fine a pattern the eye resolves at an eccentricity e, as data: the members are the published
// constants. Angles are in degrees here because those are. masks/laws.md has the sources and the domains.

/// Geisler and Perry (1998): fc = e2 ln(1 / CT0) / (alpha (e + e2)).
struct GeislerPerry {
    double alpha_deg = 0.106;      ///< spatial frequency decay constant, in 1/cpd = degrees
    double e2_deg = 2.3;           ///< eccentricity at which acuity is halved
    double contrast = 1.0 / 64.0;  ///< CT0, least contrast that is seen
};

/// Peli, Yang and Goldstein (1991): a contrast threshold CT0(f) exp(k f e), with Geisler and Perry's
/// CT0(f) = CT0 exp(alpha f) for the fovea; fc where it reaches 1.
struct Peli {
    double k = 0.036;  ///< 1/(cpd deg): .030 to .036 detection, .048 to .050 orientation discrimination
    double alpha_deg = 0.106;
    double contrast = 1.0 / 64.0;
};

/// Guenter et al. (2012): minimum angle of resolution w0 + m e, in degrees per cycle.
struct LinearMar {
    double slope = 0.022;            ///< m; .022 conservative, .0275 aggressive
    double foveal_deg = 1.0 / 48.0;  ///< w0
};

/// Hybrid view of HVVR (Hunt et al. 2018): distance of samples w0 + m max(e - S, 0) degrees, two to a cycle.
struct RingMap {
    double slope = 0.022;
    double foveal_deg = 1.0 / 60.0;
    double flat_deg = 0.5;  ///< S
};

/// Watson (2014): Nyquist frequency of the hexagonal lattice of the midget ganglion cells of one sign (on or off), half
/// of their density D in one meridian or in the mean of the four: fc = sqrt(2 / sqrt(3) D / 2) / 2.
struct Watson {
    enum class Meridian { temporal, superior, nasal, inferior, mean };
    Meridian meridian = Meridian::mean;
};

/// castleCSF (Ashraf et al. 2024) of a still, grey grating: foveal sensitivity times 10^-((k1 + k2 f) e); fc where it
/// falls to 1. Zero where no frequency is seen.
struct CastleCsf {
    double k1 = 0.0239853;  ///< 1/deg
    double k2 = 0.0189038;  ///< 1/(cpd deg)
    double luminance_cd_m2 = 100.0;
    double area_deg2 = std::numbers::pi;  ///< of the grating; this is one of 1 degree radius
};

using AcuityModel = std::variant<GeislerPerry, Peli, LinearMar, RingMap, Watson, CastleCsf>;

/// What density of samples follows from a model of acuity.
///
/// Share of pixels sampled: p = min(1, (2 fc(e) / pixels per degree)^exponent).
struct AcuityLaw {
    AcuityModel model;
    double stretch = 1.0;   ///< eccentricities are divided by it, so that it multiplies Geisler and Perry's e2
    double exponent = 2.0;  ///< 2: Nyquist density of the cutoff frequency; 1: its square root
    /// Eccentricity up to which acuity is that of the centre; what is beyond it is divided by `stretch`.
    double full_acuity_deg = 0.0;
};

/// A law that is known by name.
struct NamedLaw {
    std::string_view name;    ///< "geisler-perry", "peli", "guenter", "hvvr", "watson", "castle-csf"
    std::string_view source;  ///< authors, title, year
    /// Largest eccentricity of the data that the source rests on, infinite where it names none. Beyond, the formula is
    /// continued.
    double domain_deg;
    AcuityModel model;  ///< with the published constants
};

/// All of them.
const std::vector<NamedLaw>& named_laws();

/// Finest pattern that is seen at an eccentricity of 0..180 degrees, in cycles per degree. Falls, or stays, with it.
double cutoff_frequency_cpd(const AcuityModel& model, double eccentricity_deg);
double cutoff_frequency_cpd(const AcuityLaw& law, double eccentricity_deg);

/// Share 0..1 of the pixels that need a sample, where the display has `px_per_deg` pixels per degree.
double needed_share(const AcuityLaw& law, double eccentricity_deg, double px_per_deg);

/// Pixels per degree of an eye's planar image at a direction given by its tangents: the square root of the pixels
/// per square degree. A plane at unit distance shows the solid angle cos^3 of its area, so this is the density at
/// the axis times cos^-3/2 of the angle to it.
double pixels_per_degree(const Display& display, Eye eye, double tangent_x, double tangent_y);

/// A choice of the `sampling` option: how many samples, and by which law they are spread.
struct SamplingPreset {
    /// What is solved so that the plan has the share that was asked for.
    enum class Free {
        nothing,   ///< the law as it stands; there is no `share`
        stretch,   ///< same shape, wider or narrower
        exponent,  ///< the fovea of a stretch that is solved for `fovea_share`, times `fovea_scale`; then the periphery
    };
    std::string name;   ///< as parsed
    bool full = false;  ///< a ray for every visible pixel; nothing below counts
    AcuityLaw law;      ///< shape
    Free free = Free::stretch;
    double share = 1.0;  ///< of the buffer's pixels, hidden ones included, while the gaze is on the axis
    double fovea_share = 0.54;
    double fovea_scale = 1.0;
};

/// Parses what users write:
///   full                      every visible pixel
///   P                         percentage 1..99 by Geisler and Perry's law, exponent 1.5: "54", "27.5"
///   paper-54 -41 -27 -18      the published masks: exponent 1 (masks/laws.md says how their shapes were read)
///   NAME                      a named law with its published constants: "watson"
///   NAME-P                    a named law stretched to a percentage: "hvvr-27"
///   law:KEY=VALUE,...         Geisler and Perry's with alpha, e2, contrast, exponent, full
/// Errors: `option`.
Expected<SamplingPreset> parse_sampling(const std::string& text);

/// Share of the buffer's pixels that a way to place samples would sample by a law while the gaze is on the axis; grows
/// with stretch, falls with the exponent.
using ShareOfLaw = std::function<double(const AcuityLaw&)>;

/// The preset's law, solved by bisection of `planned_share`. Not for `full`. Shares out of reach give the nearest.
AcuityLaw solve_law(const SamplingPreset& preset, const ShareOfLaw& planned_share);

/// planned_share of the tile sampler: by the levels that it would choose. Shares below that of the sparsest level,
/// 1.6 %, are out of reach.
double tile_share(const Display& display, Eye eye, const AcuityLaw& law);

/// The preset's law as the tile sampler needs it; nothing for `full`.
std::optional<AcuityLaw> tile_law(const Display& display, Eye eye, const SamplingPreset& preset);

}  // namespace macula
