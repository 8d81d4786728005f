#include "masks/law.h"

#include <cmath>
#include <numbers>

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

TEST(AcuityLaw, HasThePublishedCutoffFrequencies) {
    const AcuityLaw law;
    EXPECT_NEAR(cutoff_frequency_cpd(law, 0.0), 39.23, 0.01);  // ln 64 / .106
    EXPECT_NEAR(cutoff_frequency_cpd(law, 2.3), 39.23 / 2, 0.01);
    AcuityLaw shifted;
    shifted.full_acuity_deg = 1.5;
    EXPECT_EQ(cutoff_frequency_cpd(shifted, 1.0), cutoff_frequency_cpd(law, 0.0));
    EXPECT_DOUBLE_EQ(cutoff_frequency_cpd(shifted, 10.0), cutoff_frequency_cpd(law, 8.5));
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
