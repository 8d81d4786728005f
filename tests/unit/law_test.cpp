#include "masks/law.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace macula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(PixelsPerDegree, IsThePublishedOneAtTheCentreAndGrowsBySecantToTheThreeHalves) {
    const Display vive = load_display("vive").value();
    EXPECT_NEAR(pixels_per_degree(vive, kLeftEye, 0.0, 0.0), 9.967, 0.001);
    for (const double angle_deg : {5.0, 20.0, 40.0, 60.0}) {
        const double expected = 9.967 * std::pow(std::cos(angle_deg * kDegree), -1.5);
        EXPECT_NEAR(pixels_per_degree(vive, kLeftEye, 0.0, std::tan(angle_deg * kDegree)), expected, 1e-3 * expected);
        EXPECT_NEAR(pixels_per_degree(vive, kLeftEye, -std::tan(angle_deg * kDegree), 0.0), expected, 1e-3 * expected);
    }
}

TEST(PixelsPerDegree, IsTheRootOfThePixelsPerSolidAngle) {
    const Display vive = load_display("vive").value();
    const Tangents& edge = vive.eyes[kRightEye].tangents;
    const double width = (double{edge.right} - edge.left) / vive.eye_width_px;
    const double height = (double{edge.top} - edge.bottom) / vive.eye_height_px;
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.3, 0.2), std::pair(-1.1, 1.4), std::pair(0.7, -1.4)}) {
        // Solid angle of a pixel: the parallelogram of its corners' directions.
        const auto direction = [](double tx, double ty) { return glm::normalize(glm::dvec3(tx, ty, -1.0)); };
        const glm::dvec3 corner = direction(x - width / 2, y - height / 2);
        const glm::dvec3 across = direction(x + width / 2, y - height / 2) - corner;
        const glm::dvec3 up = direction(x - width / 2, y + height / 2) - corner;
        const double solid_angle_deg2 = glm::length(glm::cross(across, up)) / (kDegree * kDegree);
        EXPECT_NEAR(std::pow(pixels_per_degree(vive, kRightEye, x, y), 2.0) * solid_angle_deg2, 1.0, 5e-3);
    }
}

TEST(GeislerPerry, HasThePublishedCutoffFrequencies) {
    const AcuityLaw law;
    EXPECT_NEAR(cutoff_frequency_cpd(law, 0.0), 39.23, 0.01);  // ln 64 / .106
    EXPECT_NEAR(cutoff_frequency_cpd(law, 2.3), 39.23 / 2, 0.01);
    // The contrast threshold at the cutoff is 1.
    for (const double e_deg : {0.0, 7.0, 30.0, 80.0}) {
        const double f = cutoff_frequency_cpd(law, e_deg);
        EXPECT_NEAR(1.0 / 64.0 * std::exp(0.106 * f * (e_deg + 2.3) / 2.3), 1.0, 1e-9);
    }
}

TEST(Peli, IsGeislerAndPerrysAtTheRatioOfTheirConstants) {
    for (const double e_deg : {0.0, 1.0, 10.0, 60.0}) {
        EXPECT_NEAR(cutoff_frequency_cpd(Peli{.k = 0.106 / 2.3}, e_deg), cutoff_frequency_cpd(GeislerPerry{}, e_deg),
                    1e-9);
        const double f = cutoff_frequency_cpd(Peli{}, e_deg);
        EXPECT_NEAR(1.0 / 64.0 * std::exp(0.106 * f) * std::exp(0.036 * f * e_deg), 1.0, 1e-9);
    }
}

TEST(LinearMar, HasThePublishedAngles) {
    EXPECT_NEAR(cutoff_frequency_cpd(LinearMar{}, 0.0), 48.0, 1e-9);
    EXPECT_NEAR(1.0 / cutoff_frequency_cpd(LinearMar{}, 20.0), 1.0 / 48.0 + 0.44, 1e-9);
    EXPECT_NEAR(1.0 / cutoff_frequency_cpd(LinearMar{.slope = 0.0275}, 20.0), 1.0 / 48.0 + 0.55, 1e-9);
}

TEST(RingMap, HasAFlatFoveaOfSixtySamplesADegree) {
    EXPECT_NEAR(2.0 * cutoff_frequency_cpd(RingMap{}, 0.0), 60.0, 1e-9);
    EXPECT_NEAR(2.0 * cutoff_frequency_cpd(RingMap{}, 0.5), 60.0, 1e-9);
    EXPECT_NEAR(0.5 / cutoff_frequency_cpd(RingMap{}, 20.5), 1.0 / 60.0 + 0.44, 1e-9);
}

TEST(Watson, IsTheNyquistFrequencyOfAHexagonalLattice) {
    // In the centre one midget cell of each sign for nearly each of 14804.6 cones a square degree. Rows of a hexagonal
    // lattice lie sqrt(3) / 2 of the cells' distance apart, and each cell has sqrt(3) / 2 of its square for itself.
    const double distance_deg = std::sqrt(2.0 / std::sqrt(3.0) / (14804.6 / 1.12));
    const double row_deg = std::sqrt(3.0) / 2.0 * distance_deg;
    EXPECT_NEAR(cutoff_frequency_cpd(Watson{}, 0.0), 1.0 / (2.0 * row_deg), 1e-6);
}

TEST(Watson, LiesBetweenItsMeridians) {
    using enum Watson::Meridian;
    for (const double e_deg : {1.0, 10.0, 30.0}) {
        const auto along = [&](Watson::Meridian meridian) {
            return cutoff_frequency_cpd(Watson{.meridian = meridian}, e_deg);
        };
        double squares = 0.0;
        for (const auto meridian : {temporal, superior, nasal, inferior}) squares += along(meridian) * along(meridian);
        EXPECT_NEAR(along(mean), std::sqrt(squares / 4.0), 1e-9);
    }
    // Beyond the fovea the temporal half of the field, seen by the nasal retina, is the finest.
    EXPECT_GT(cutoff_frequency_cpd(Watson{.meridian = temporal}, 30.0),
              1.2 * cutoff_frequency_cpd(Watson{.meridian = nasal}, 30.0));
}

/// Achromatic sensitivity of castleCSF at 0 Hz, 100 cd/m2, pi square degrees, in the paper's own terms.
double castle_sensitivity(double f, double e_deg) {
    const double peak = 56.4947 * std::pow(1.0 + 7.54726 / 100.0, -0.144532) *
                        (1.0 - std::pow(1.0 + 5.58341e-07 / 100.0, -9.66862e+09));
    const double f_max = 1.78119 * std::pow(1.0 + 91.5718 / 100.0, -0.256682);
    double shape = std::pow(10.0, -std::pow(std::log10(f) - std::log10(f_max), 2.0) / std::pow(2.0, 0.000213047));
    if (f < f_max) shape = std::max(shape, 1.0 - 0.100207);
    const double critical = 157.103 / (1.0 + std::pow(f / 0.702338, 2.0));
    return peak * shape * std::sqrt(critical / (1.0 + critical / std::numbers::pi)) * f *
           std::pow(10.0, -(0.0239853 + 0.0189038 * f) * e_deg);
}

TEST(CastleCsf, FindsTheHighestFrequencyThatIsSeen) {
    EXPECT_NEAR(castle_sensitivity(3.0, 0.0), 205.0, 5.0);  // the contrast of a large, bright grating's threshold: .5 %
    for (const double e_deg : {0.0, 0.5, 3.0, 10.0, 25.0, 40.0}) {
        const double f = cutoff_frequency_cpd(CastleCsf{}, e_deg);
        EXPECT_NEAR(castle_sensitivity(f, e_deg), 1.0, 1e-5) << e_deg;
        for (double higher = 1.001 * f; higher < 200.0; higher *= 1.01)
            ASSERT_LT(castle_sensitivity(higher, e_deg), 1.0);
    }
    EXPECT_EQ(cutoff_frequency_cpd(CastleCsf{}, 50.0), 0.0);
    for (double f = 0.05; f < 200.0; f *= 1.01) ASSERT_LT(castle_sensitivity(f, 50.0), 1.0);
}

/// Share of the pixels of the Vive's left eye that a law asks for while the gaze is on the axis.
double share_on_vive(const AcuityModel& model) {
    static const Display vive = load_display("vive").value();
    const Tangents& edge = vive.eyes[kLeftEye].tangents;
    AcuityLaw law;
    law.model = model;
    constexpr int kStep_px = 24;
    double sum = 0.0;
    int pixels = 0;
    for (int y = kStep_px / 2; y < vive.eye_height_px; y += kStep_px) {
        for (int x = kStep_px / 2; x < vive.eye_width_px; x += kStep_px) {
            const double tan_x = edge.left + (x + 0.5) / vive.eye_width_px * (double{edge.right} - edge.left);
            const double tan_y = edge.top - (y + 0.5) / vive.eye_height_px * (double{edge.top} - edge.bottom);
            const double e_deg = std::atan(std::hypot(tan_x, tan_y)) / kDegree;
            sum += needed_share(law, e_deg, pixels_per_degree(vive, kLeftEye, tan_x, tan_y));
            ++pixels;
        }
    }
    return sum / pixels;
}

TEST(AcuityLaw, AsksForTheKnownSharesOnVive) {
    EXPECT_NEAR(share_on_vive(GeislerPerry{}), 0.116, 0.001);
    EXPECT_NEAR(share_on_vive(Peli{}), 0.161, 0.001);
    EXPECT_NEAR(share_on_vive(Peli{.k = 0.030}), 0.204, 0.001);
    EXPECT_NEAR(share_on_vive(Peli{.k = 0.048}), 0.109, 0.001);
    EXPECT_NEAR(share_on_vive(LinearMar{}), 0.043, 0.001);
    EXPECT_NEAR(share_on_vive(LinearMar{.slope = 0.0275}), 0.030, 0.001);
    EXPECT_NEAR(share_on_vive(RingMap{}), 0.015, 0.001);
    EXPECT_NEAR(share_on_vive(Watson{}), 0.088, 0.001);
    EXPECT_NEAR(share_on_vive(CastleCsf{}), 0.104, 0.001);
}

TEST(AcuityLaw, NeverRisesWithEccentricity) {
    const auto seed = std::random_device{}();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.2, 3.0);
    for (const NamedLaw& named : named_laws()) {
        for (int round = 0; round < 4; ++round) {
            AcuityLaw law;
            law.model = named.model;
            if (round > 0) {
                law.stretch = uniform(random);
                law.full_acuity_deg = uniform(random);
            }
            double before = cutoff_frequency_cpd(law, 0.0);
            ASSERT_GT(before, 10.0) << named.name;
            for (double e_deg = 0.0; e_deg <= 180.0; e_deg += 0.31 * uniform(random)) {
                const double now = cutoff_frequency_cpd(law, e_deg);
                ASSERT_LE(now, before) << named.name << " at " << e_deg << ", seed " << seed;
                ASSERT_GE(now, 0.0);
                before = now;
            }
        }
    }
}

TEST(AcuityLaw, DividesWhatLiesBeyondFullAcuityByTheStretch) {
    for (const NamedLaw& named : named_laws()) {
        AcuityLaw law;
        law.model = named.model;
        law.stretch = 2.5;
        law.full_acuity_deg = 1.5;
        EXPECT_EQ(cutoff_frequency_cpd(law, 1.0), cutoff_frequency_cpd(named.model, 0.0)) << named.name;
        EXPECT_DOUBLE_EQ(cutoff_frequency_cpd(law, 11.5), cutoff_frequency_cpd(named.model, 4.0)) << named.name;
    }
    // Which is what multiplying e2 does.
    AcuityLaw stretched;
    stretched.stretch = 3.0;
    EXPECT_DOUBLE_EQ(cutoff_frequency_cpd(stretched, 20.0), cutoff_frequency_cpd(GeislerPerry{.e2_deg = 6.9}, 20.0));
}

TEST(AcuityLaw, NeedsTheNyquistDensityToItsExponent) {
    AcuityLaw law;
    const double px_per_deg = 20.0;
    const double density = 2.0 * cutoff_frequency_cpd(law, 30.0) / px_per_deg;
    EXPECT_DOUBLE_EQ(needed_share(law, 30.0, px_per_deg), density * density);
    law.exponent = 1.0;
    EXPECT_DOUBLE_EQ(needed_share(law, 30.0, px_per_deg), density);
    EXPECT_EQ(needed_share(law, 0.0, px_per_deg), 1.0);
}

}  // namespace
}  // namespace macula
