// What macula-mask inspect tells of small masks, against brute force.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include <nlohmann/json.hpp>

#include "masks/make/density.h"
#include "masks/make/mesh_store.h"
#include "masks/tool/inspection.h"
#include "tests/support/small_display.h"

namespace macula {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// An eye with square pixels whose axis lies in the corner of four of them.
Display square_display() {
    Display display = test::small_display(96, 96);
    for (EyeDisplay& eye : display.eyes) eye.tangents = {-1.0F, 1.0F, -1.0F, 1.0F};
    return display;
}

Recipe white_noise_recipe(MaskGeometry geometry) {
    Recipe recipe;
    recipe.display = square_display();
    recipe.preset = *parse_sampling("27");
    recipe.placement = Placement::white_noise;
    recipe.geometry = geometry;
    recipe.seed = 3;
    return recipe;
}

/// Degrees between the gaze and a pixel at that distance: 48 pixels are a tangent of 1.
double eccentricity_deg(double distance_px, MaskGeometry geometry) {
    const double tangent = distance_px / 48.0;
    return geometry == MaskGeometry::planar ? std::atan(tangent) / kDegree : std::min(180.0, tangent / kDegree);
}

double px_per_deg(double eccentricity_deg, MaskGeometry geometry) {
    const double axis = 48.0 * kDegree;
    return geometry == MaskGeometry::planar ? axis * std::pow(std::cos(eccentricity_deg * kDegree), -1.5) : axis;
}

double distance_px(const SamplePosition& a, const SamplePosition& b) {
    return std::hypot(a.x_px - b.x_px, a.y_px - b.y_px);
}

struct BruteRing {
    int pixels = 0;
    int samples = 0;
    double wanted = 0.0;
    int sites = 0;
    double nearest_sum_px = 0.0;
    double nearest_min_px = 1e9;
    double nearest_max_px = 0.0;
};

BruteRing brute_ring(const Mask& mask, const SampleMesh& mesh, const AcuityLaw& law, MaskGeometry geometry,
                     double from_deg, double to_deg) {
    BruteRing ring;
    for (int y = 0; y < mask.height_px; ++y) {
        for (int x = 0; x < mask.width_px; ++x) {
            const double e = eccentricity_deg(std::hypot(x - mask.gaze_px.x, y - mask.gaze_px.y), geometry);
            if (e < from_deg || e >= to_deg) continue;
            ring.pixels += 1;
            ring.samples += mask.sampled[static_cast<std::size_t>(y * mask.width_px + x)];
            ring.wanted += std::max(4.0 / 256.0, needed_share(law, e, px_per_deg(e, geometry)));
        }
    }
    const SamplePosition gaze{static_cast<std::int16_t>(mask.gaze_px.x), static_cast<std::int16_t>(mask.gaze_px.y)};
    for (std::size_t i = 0; i < mesh.site.size(); ++i) {
        const double e = eccentricity_deg(distance_px(mesh.site[i], gaze), geometry);
        if (e < from_deg || e >= to_deg) continue;
        double nearest = 1e9;
        for (std::size_t k = 0; k < mesh.site.size(); ++k)
            if (k != i) nearest = std::min(nearest, distance_px(mesh.site[i], mesh.site[k]));
        ring.sites += 1;
        ring.nearest_sum_px += nearest;
        ring.nearest_min_px = std::min(ring.nearest_min_px, nearest);
        ring.nearest_max_px = std::max(ring.nearest_max_px, nearest);
    }
    return ring;
}

TEST(Inspection, AgreesWithBruteForce) {
    for (const MaskGeometry geometry : {MaskGeometry::flat, MaskGeometry::planar}) {
        SCOPED_TRACE(to_string(geometry));
        const Recipe recipe = white_noise_recipe(geometry);
        const Mask mask = make_mask(recipe).value();
        const SampleMesh mesh = triangulate_mask(mask);
        const AcuityLaw law = mask_law(recipe);
        const Inspection inspection =
            inspect(mask, mesh, {recipe.display, geometry, law, false}, {0.0, 3.0, 11.0, 40.0});

        ASSERT_EQ(inspection.rings.size(), 3U);
        for (const InspectedRing& ring : inspection.rings) {
            SCOPED_TRACE(ring.from_deg);
            const BruteRing brute = brute_ring(mask, mesh, law, geometry, ring.from_deg, ring.to_deg);
            ASSERT_GT(brute.sites, 1);
            EXPECT_EQ(ring.pixels, static_cast<std::uint64_t>(brute.pixels));
            EXPECT_EQ(ring.samples, static_cast<std::uint64_t>(brute.samples));
            EXPECT_DOUBLE_EQ(ring.drawn, 1.0 * brute.samples / brute.pixels);
            EXPECT_NEAR(ring.wanted.value(), brute.wanted / brute.pixels, 1e-5);
            EXPECT_EQ(ring.spacing.sites, static_cast<std::size_t>(brute.sites));
            EXPECT_NEAR(ring.spacing.nearest_mean_px, brute.nearest_sum_px / brute.sites, 1e-6);
            EXPECT_NEAR(ring.spacing.nearest_min_px, brute.nearest_min_px, 1e-6);
            EXPECT_NEAR(ring.spacing.nearest_max_px, brute.nearest_max_px, 1e-6);
        }

        std::uint64_t samples = 0;
        std::uint64_t in_window = 0;
        std::size_t on_border = 0;
        for (int y = 0; y < mask.height_px; ++y) {
            for (int x = 0; x < mask.width_px; ++x) {
                if (mask.sampled[static_cast<std::size_t>(y * mask.width_px + x)] == 0) continue;
                samples += 1;
                // The axis is at pixel 48, 48 of the window, the gaze at 96, 96 of the mask.
                in_window += x >= 48 && x < 144 && y >= 48 && y < 144 ? 1 : 0;
                on_border += x == 0 || y == 0 || x == mask.width_px - 1 || y == mask.height_px - 1 ? 1 : 0;
            }
        }
        EXPECT_EQ(inspection.samples, samples);
        EXPECT_DOUBLE_EQ(inspection.share_in_window.value(), static_cast<double>(in_window) / (96.0 * 96.0));
        EXPECT_NEAR(inspection.share_in_window.value(), 0.27, 0.002);
        // Euler: a triangulation of n sites, h of them on the hull, has 2 n - h - 2 triangles.
        EXPECT_EQ(inspection.triangles.triangles, 2 * samples - on_border - 2);
    }
}

TEST(Inspection, UsualRingsHoldEveryPixel) {
    const Recipe recipe = white_noise_recipe(MaskGeometry::flat);
    const Mask mask = make_mask(recipe).value();
    const Inspection inspection = inspect(mask, triangulate_mask(mask), {recipe.display, recipe.geometry, {}, false});
    std::uint64_t pixels = 0;
    std::uint64_t samples = 0;
    std::size_t sites = 0;
    double edge_deg = 0.0;
    for (const InspectedRing& ring : inspection.rings) {
        EXPECT_EQ(ring.from_deg, edge_deg);
        edge_deg = ring.to_deg;
        pixels += ring.pixels;
        samples += ring.samples;
        sites += ring.spacing.sites;
        EXPECT_FALSE(ring.wanted) << "there is no law";
    }
    EXPECT_EQ(pixels, static_cast<std::uint64_t>(mask.width_px) * mask.height_px);
    EXPECT_EQ(samples, inspection.samples);
    EXPECT_EQ(sites, inspection.samples);
}

TEST(Inspection, OfAFullMaskEverythingIsWanted) {
    Recipe recipe = white_noise_recipe(MaskGeometry::flat);
    recipe.preset = *parse_sampling("full");
    const Mask mask = make_mask(recipe).value();
    const Inspection inspection = inspect(mask, triangulate_mask(mask), {recipe.display, recipe.geometry, {}, true});
    EXPECT_EQ(inspection.share_in_window, 1.0);
    for (const InspectedRing& ring : inspection.rings) {
        EXPECT_EQ(ring.wanted, 1.0);
        EXPECT_EQ(ring.drawn, 1.0);
    }
}

TEST(Inspection, AMaskSmallerThanTheWindowHasNoShareOfIt) {
    const Mask mask{32, 32, {16, 16}, std::vector<std::uint8_t>(32 * 32, 1), ""};
    const Inspection inspection = inspect(mask, triangulate_mask(mask), {square_display(), {}, {}, false});
    EXPECT_FALSE(inspection.share_in_window);
    EXPECT_EQ(inspection.share, 1.0);
}

TEST(Inspection, TableAndJsonTellTheSame) {
    const Recipe recipe = white_noise_recipe(MaskGeometry::flat);
    const Mask mask = make_mask(recipe).value();
    const AcuityLaw law = mask_law(recipe);
    const Inspection inspection =
        inspect(mask, triangulate_mask(mask), {recipe.display, recipe.geometry, law, false}, {0.0, 10.0, 60.0});

    const nlohmann::json json = nlohmann::json::parse(to_json(inspection, "a.png", mask.recipe));
    EXPECT_EQ(json["file"], "a.png");
    EXPECT_EQ(json["samples"], inspection.samples);
    EXPECT_EQ(json["share_in_window"], *inspection.share_in_window);
    EXPECT_EQ(json["law"]["stretch"], law.stretch);
    EXPECT_EQ(json["recipe"]["placement"], "white-noise");
    ASSERT_EQ(json["rings"].size(), 2U);
    const InspectedRing& ring = inspection.rings[1];
    EXPECT_EQ(json["rings"][1]["samples"], ring.samples);
    EXPECT_EQ(json["rings"][1]["ratio"], ring.drawn / *ring.wanted);
    EXPECT_EQ(json["rings"][1]["nearest_px"]["mean"], ring.spacing.nearest_mean_px);
    EXPECT_TRUE(json["rings"][0]["regularity"].is_null()) << "full density is a lattice";
    EXPECT_NEAR(json["triangles"]["area_px2"], 191.0 * 191.0, 1e-9);

    const std::string table = to_table(inspection, "a.png", mask.recipe);
    for (const std::string& part :
         {std::string("a.png: 192 x 192 pixels, gaze at 96,96"), std::to_string(inspection.samples),
          std::string("white-noise"), std::to_string(ring.pixels), std::string("wanted")})
        EXPECT_NE(table.find(part), std::string::npos) << part << " in\n" << table;
}

TEST(Inspection, UnknownRecipesAreSaidToBe) {
    const Mask mask{32, 32, {16, 16}, std::vector<std::uint8_t>(32 * 32, 1), ""};
    const Inspection inspection = inspect(mask, triangulate_mask(mask), {square_display(), {}, {}, false});
    EXPECT_TRUE(nlohmann::json::parse(to_json(inspection, "a.png", "")).at("recipe").is_null());
    EXPECT_NE(to_table(inspection, "a.png", "").find("unknown"), std::string::npos);
}

}  // namespace
}  // namespace macula
