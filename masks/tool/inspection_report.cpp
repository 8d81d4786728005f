#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "masks/tool/inspection.h"

namespace macula {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = 0.017453292519943295;

/// printf into a string.
template <class... Values>
std::string print(const char* format, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

Json json_of(const InspectedRing& ring) {
    Json json = {{"from_deg", ring.from_deg},
                 {"to_deg", ring.to_deg},
                 {"pixels", ring.pixels},
                 {"samples", ring.samples},
                 {"drawn", ring.drawn}};
    if (ring.wanted) {
        json["wanted"] = *ring.wanted;
        if (*ring.wanted > 0.0) json["ratio"] = ring.drawn / *ring.wanted;
    }
    const SpacingRing& spacing = ring.spacing;
    json["nearest_px"] = {{"min", spacing.nearest_min_px},
                          {"p5", spacing.nearest_p5_px},
                          {"median", spacing.nearest_median_px},
                          {"p95", spacing.nearest_p95_px},
                          {"max", spacing.nearest_max_px},
                          {"mean", spacing.nearest_mean_px},
                          {"deviation", spacing.nearest_deviation_px}};
    // JSON has no infinity, which is what a lattice has.
    json["regularity"] = std::isfinite(spacing.regularity) ? Json(spacing.regularity) : Json(nullptr);
    return json;
}

std::string ring_line(const InspectedRing& ring) {
    std::string line = print("%6.1f %6.1f %9llu %9llu  %7.3f %%", ring.from_deg, ring.to_deg,
                             static_cast<unsigned long long>(ring.pixels),
                             static_cast<unsigned long long>(ring.samples), 100.0 * ring.drawn);
    if (ring.wanted)
        line += print(" %7.3f %% %6.3f", 100.0 * *ring.wanted, *ring.wanted > 0.0 ? ring.drawn / *ring.wanted : 0.0);
    const SpacingRing& spacing = ring.spacing;
    if (spacing.sites > 0)
        line += print("  %6.2f %6.2f %6.2f %6.2f %7.2f", spacing.nearest_min_px, spacing.nearest_median_px,
                      spacing.nearest_p95_px, spacing.nearest_mean_px, spacing.regularity);
    return line + "\n";
}

}  // namespace

std::string to_table(const Inspection& inspection, const std::string& name, const std::string& recipe) {
    std::string text = name + ": " +
                       print("%d x %d pixels, gaze at %d,%d\n", inspection.width_px, inspection.height_px,
                             inspection.gaze_px.x, inspection.gaze_px.y);
    text += print("samples    %llu, %.2f %% of the mask", static_cast<unsigned long long>(inspection.samples),
                  100.0 * inspection.share);
    if (inspection.share_in_window)
        text += print("; %.2f %% of the window while the gaze is on the axis", 100.0 * *inspection.share_in_window);
    text += "\nrecipe     " + (recipe.empty() ? std::string("unknown") : recipe) + "\n";
    if (inspection.law)
        text += print("law        solved: eccentricities stretched %.4f times, exponent %.4f\n",
                      inspection.law->stretch, inspection.law->exponent);

    const bool compared = !inspection.rings.empty() && inspection.rings.front().wanted.has_value();
    text += "\n  eccentricity                         density";
    text += compared ? "                     distance to the nearest (px)\n" : "  distance to the nearest (px)\n";
    text += "  from     to    pixels   samples      drawn";
    text += compared ? "    wanted  ratio" : "";
    text += "     min median    p95   mean regular\n";
    for (const InspectedRing& ring : inspection.rings) text += ring_line(ring);

    const TriangleQuality& t = inspection.triangles;
    text += print("\ntriangles  %zu over %.1f pixels\n", t.triangles, 0.5 * static_cast<double>(t.doubled_area_px2));
    text += print("  longest edge    %.1f px\n", t.longest_edge_px);
    text += print("  smallest angle  least %.2f, 1st percentile %.2f, median %.2f degrees\n",
                  t.smallest_angle_min_rad / kDegree, t.smallest_angle_p1_rad / kDegree,
                  t.smallest_angle_median_rad / kDegree);
    text +=
        print("  aspect          median %.3f, 99th percentile %.3f (outer radius over twice the inner: 1 is best)\n",
              t.aspect_p50, t.aspect_p99);
    return text;
}

std::string to_json(const Inspection& inspection, const std::string& name, const std::string& recipe) {
    Json json = {{"file", name},
                 {"width_px", inspection.width_px},
                 {"height_px", inspection.height_px},
                 {"gaze_px", {inspection.gaze_px.x, inspection.gaze_px.y}},
                 {"samples", inspection.samples},
                 {"share", inspection.share}};
    if (inspection.share_in_window) json["share_in_window"] = *inspection.share_in_window;
    if (inspection.law) json["law"] = {{"stretch", inspection.law->stretch}, {"exponent", inspection.law->exponent}};
    json["rings"] = Json::array();
    for (const InspectedRing& ring : inspection.rings) json["rings"].push_back(json_of(ring));
    const TriangleQuality& t = inspection.triangles;
    json["triangles"] = {{"count", t.triangles},
                         {"area_px2", 0.5 * static_cast<double>(t.doubled_area_px2)},
                         {"longest_edge_px", t.longest_edge_px},
                         {"smallest_angle_deg",
                          {{"min", t.smallest_angle_min_rad / kDegree},
                           {"p1", t.smallest_angle_p1_rad / kDegree},
                           {"median", t.smallest_angle_median_rad / kDegree}}},
                         {"aspect", {{"p50", t.aspect_p50}, {"p99", t.aspect_p99}}}};
    Json made = Json::parse(recipe, nullptr, /*allow_exceptions=*/false);
    json["recipe"] = made.is_discarded() ? Json(nullptr) : std::move(made);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace macula
