// The published formulas, each where its sensitivity or sampling density gives the cutoff frequency. Sources: laws.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "masks/law.h"

namespace macula {
namespace {

// Frequencies between which castleCSF is searched. Its data end at 64 cpd; it falls below 1 a little beyond.
constexpr double kCastleLeast_log2_cpd = -4.0;
constexpr double kCastleMost_log2_cpd = 7.0;

double cutoff_cpd(const GeislerPerry& law, double e_deg) {
    return law.e2_deg * std::log(1.0 / law.contrast) / (law.alpha_deg * (e_deg + law.e2_deg));
}

double cutoff_cpd(const Peli& law, double e_deg) {
    return std::log(1.0 / law.contrast) / (law.alpha_deg + law.k * e_deg);
}

double cutoff_cpd(const LinearMar& law, double e_deg) {
    return 1.0 / (law.foveal_deg + law.slope * e_deg);
}

double cutoff_cpd(const RingMap& law, double e_deg) {
    return 0.5 / (law.foveal_deg + law.slope * std::max(e_deg - law.flat_deg, 0.0));
}

/// Ganglion cells of all kinds per square degree along a meridian.
struct GanglionCells {
    double a;
    double r2_deg;
    double re_deg;

    [[nodiscard]] double density(double e_deg) const {
        constexpr double kConesInTheCentre_deg2 = 14804.6;
        const double near = 1.0 + e_deg / r2_deg;
        return 2.0 * kConesInTheCentre_deg2 * (a / (near * near) + (1.0 - a) * std::exp(-e_deg / re_deg));
    }
};

constexpr std::array<GanglionCells, 4> kMeridians = {{
    {0.9851, 1.058, 22.14},  // temporal
    {0.9935, 1.035, 16.35},  // superior
    {0.9729, 1.084, 7.633},  // nasal
    {0.9960, 0.9932, 12.13}  // inferior
}};

double cutoff_cpd(const Watson& law, double e_deg) {
    double cells = 0.0;
    if (law.meridian == Watson::Meridian::mean) {
        for (const GanglionCells& meridian : kMeridians) cells += meridian.density(e_deg) / kMeridians.size();
    } else {
        cells = kMeridians.at(static_cast<std::size_t>(law.meridian)).density(e_deg);
    }
    const double midget_share = 1.0 / 1.12 / (1.0 + e_deg / 41.03);
    return 0.5 * std::sqrt(2.0 / std::numbers::sqrt3 * 0.5 * midget_share * cells);
}

/// The sustained achromatic channel of castleCSF; the transient one is silent at 0 Hz.
class CastleFovea {
public:
    explicit CastleFovea(const CastleCsf& law) : area_deg2_(law.area_deg2) {
        const auto saturating = [&](double half_cd_m2, double power) {
            return std::pow(1.0 + half_cd_m2 / law.luminance_cd_m2, -power);
        };
        log10_peak_ =
            std::log10(56.4947 * saturating(7.54726, 0.144532) * (1.0 - saturating(5.58341e-07, 9.66862e+09)));
        log10_peak_cpd_ = std::log10(1.78119 * saturating(91.5718, 0.256682));
    }

    /// Logarithm to base 10 of the sensitivity to a frequency, given with its logarithm.
    [[nodiscard]] double log10_sensitivity(double cpd, double log10_cpd) const {
        const double from_peak = log10_cpd - log10_peak_cpd_;
        double parabola = -from_peak * from_peak / kBandwidth;
        if (from_peak < 0.0) parabola = std::max(parabola, kLeast);
        // Rovamo, Luntinen and Nasanen (1993): integration over the area of the grating.
        const double relative = cpd / 0.702338;
        const double critical_deg2 = 157.103 / (1.0 + relative * relative);
        const double seen_deg2 = critical_deg2 / (1.0 + critical_deg2 / area_deg2_);
        return log10_peak_ + parabola + 0.5 * std::log10(seen_deg2) + log10_cpd;
    }

private:
    static inline const double kBandwidth = std::exp2(0.000213047);
    static inline const double kLeast = std::log10(1.0 - 0.100207);  ///< the parabola is cut off below its peak

    double area_deg2_;
    double log10_peak_ = 0.0;
    double log10_peak_cpd_ = 0.0;
};

double cutoff_cpd(const CastleCsf& law, double e_deg) {
    const CastleFovea fovea(law);
    const double log10_of_2 = std::log10(2.0);
    const auto seen = [&](double log2_cpd) {
        const double cpd = std::exp2(log2_cpd);
        return fovea.log10_sensitivity(cpd, log2_cpd * log10_of_2) >= (law.k1 + law.k2 * cpd) * e_deg;
    };
    // What is sought is the highest of the frequencies that are seen; they lie together.
    constexpr double kStep = 0.25;
    double low = kCastleMost_log2_cpd;
    while (low >= kCastleLeast_log2_cpd && !seen(low)) low -= kStep;
    if (low < kCastleLeast_log2_cpd) return 0.0;
    double high = low + kStep;
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (low + high);
        (seen(middle) ? low : high) = middle;
    }
    return std::exp2(low);
}

}  // namespace

double cutoff_frequency_cpd(const AcuityModel& model, double eccentricity_deg) {
    return std::visit([&](const auto& published) { return cutoff_cpd(published, eccentricity_deg); }, model);
}

const std::vector<NamedLaw>& named_laws() {
    constexpr double kUnstated_deg = std::numeric_limits<double>::infinity();
    static const std::vector<NamedLaw> laws = {
        {"geisler-perry",
         "W. S. Geisler and J. S. Perry, A real-time foveated multiresolution system for low-bandwidth video "
         "communication, 1998",
         40.0, GeislerPerry{}},
        {"peli",
         "E. Peli, J. Yang and R. B. Goldstein, Image invariance with changes in size: the role of peripheral contrast "
         "thresholds, 1991",
         23.0, Peli{}},
        {"guenter", "B. Guenter, M. Finch, S. Drucker, D. Tan and J. Snyder, Foveated 3D graphics, 2012", kUnstated_deg,
         LinearMar{}},
        {"hvvr",
         "W. Hunt, M. Mara and A. Nankervis, Hierarchical visibility for virtual reality, 2018, with the ring map of "
         "the published program",
         kUnstated_deg, RingMap{}},
        {"watson",
         "A. B. Watson, A formula for human retinal ganglion cell receptive field density as a function of visual "
         "field location, 2014",
         kUnstated_deg, Watson{}},
        {"castle-csf",
         "M. Ashraf, R. K. Mantiuk, A. Chapiro and S. Wuerger, castleCSF - a contrast sensitivity function of color, "
         "area, spatiotemporal frequency, luminance and eccentricity, 2024",
         120.0, CastleCsf{}},
    };
    return laws;
}

}  // namespace macula
