#include "masks/display.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <glm/geometric.hpp>

#include "masks/display_file.h"

namespace macula {
namespace {

constexpr double kViveHiddenShare = 0.191;
constexpr float kInterpupillary_m = 0.063F;  // 63 mm, the mean of adults
constexpr int kOutlineCorners = 96;
constexpr std::size_t kMaxOutlinePoints = 1024;

/// Half-open range of columns.
struct Span {
    int begin = 0;
    int end = 0;
};

/// Columns of row `y` whose pixel centres lie inside the outline (even-odd rule), left to right.
void visible_spans(const Display& display, const EyeDisplay& eye, int y, std::vector<Span>& spans) {
    spans.clear();
    const auto& outline = eye.visible_outline;
    if (outline.empty()) {
        spans.push_back({0, display.eye_width_px});
        return;
    }
    const Tangents& edge = eye.tangents;
    const double row = edge.top - (y + 0.5) / display.eye_height_px * (double{edge.top} - edge.bottom);
    std::vector<int> crossings;  // first column whose centre is not left of the crossing
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 p(outline[i]);
        const glm::dvec2 q(outline[(i + 1) % outline.size()]);
        if ((p.y > row) == (q.y > row)) continue;
        const double tangent = p.x + (row - p.y) / (q.y - p.y) * (q.x - p.x);
        const double column = (tangent - edge.left) / (double{edge.right} - edge.left) * display.eye_width_px;
        crossings.push_back(static_cast<int>(std::ceil(std::clamp(column, 0.0, 1.0 * display.eye_width_px) - 0.5)));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) spans.push_back({crossings[i], crossings[i + 1]});
}

double hidden_share(const Display& display, const EyeDisplay& eye) {
    std::int64_t visible = 0;
    std::vector<Span> spans;
    for (int y = 0; y < display.eye_height_px; ++y) {
        visible_spans(display, eye, y, spans);
        for (const Span& span : spans) visible += span.end - span.begin;
    }
    return 1.0 - static_cast<double>(visible) / (1.0 * display.eye_width_px * display.eye_height_px);
}

/// Regular polygon about the optical axis.
std::vector<glm::vec2> round_outline(double radius_tangent) {
    std::vector<glm::vec2> outline;
    for (int i = 0; i < kOutlineCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kOutlineCorners;
        outline.emplace_back(radius_tangent * std::cos(angle), radius_tangent * std::sin(angle));
    }
    return outline;
}

/// Outline that hides `share` of the eye's buffer.
std::vector<glm::vec2> outline_that_hides(const Display& display, EyeDisplay eye, double share) {
    double low = 0.0;
    double high = 2.0 * std::max({-eye.tangents.left, eye.tangents.right, -eye.tangents.bottom, eye.tangents.top});
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (low + high);
        eye.visible_outline = round_outline(middle);
        (hidden_share(display, eye) > share ? low : high) = middle;
    }
    return round_outline(high);
}

/// HTC Vive: frustum, buffer and hidden share as its runtime reports them. The runtime's hidden-area mesh is not
/// part of that; the outline is a model of its share: a round lens about the optical axis.
Display make_vive() {
    Display display{"vive", 1512, 1680, 90.0F, {}};
    display.eyes[kLeftEye].tangents = {-1.397283F, 1.250510F, -1.477517F, 1.464221F};
    display.eyes[kRightEye].tangents = {-1.247887F, 1.394608F, -1.477517F, 1.464221F};
    display.eyes[kLeftEye].head_from_eye.position_m.x = -0.5F * kInterpupillary_m;
    display.eyes[kRightEye].head_from_eye.position_m.x = 0.5F * kInterpupillary_m;
    for (EyeDisplay& eye : display.eyes) eye.visible_outline = outline_that_hides(display, eye, kViveHiddenShare);
    return display;
}

/// The same optics at a quarter of the pixels, for machines without a GPU.
Display make_desktop() {
    Display display = make_vive();
    display.name = "desktop";
    display.eye_width_px = 756;
    display.eye_height_px = 840;
    return display;
}

/// Not-a-number is outside every range.
bool within(float value, float low, float high) {
    return value >= low && value <= high;
}

/// What is wrong with one eye, as "field: what"; empty if nothing is.
std::string fault_of(const EyeDisplay& eye) {
    constexpr float kMaxTangent = 20.0F;
    const Tangents& t = eye.tangents;
    for (const float tangent : {t.left, t.right, t.bottom, t.top}) {
        if (!within(tangent, -kMaxTangent, kMaxTangent)) return "tangents: each must lie in -20..20";
    }
    if (!(t.right - t.left >= 0.01F)) return "tangents: right must exceed left by at least 0.01";
    if (!(t.top - t.bottom >= 0.01F)) return "tangents: top must exceed bottom by at least 0.01";
    for (int axis = 0; axis < 3; ++axis) {
        if (!within(eye.head_from_eye.position_m[axis], -1.0F, 1.0F))
            return "head_from_eye position: must lie within 1 m of the head";
    }
    if (!within(glm::length(eye.head_from_eye.orientation), 0.999F, 1.001F))
        return "head_from_eye orientation: must be a unit quaternion";
    if (!eye.visible_outline.empty() &&
        (eye.visible_outline.size() < 3 || eye.visible_outline.size() > kMaxOutlinePoints))
        return "visible_outline: must have 3 to 1024 points, or none";
    for (const glm::vec2& point : eye.visible_outline) {
        if (!within(point.x, -kMaxTangent, kMaxTangent) || !within(point.y, -kMaxTangent, kMaxTangent))
            return "visible_outline: each tangent must lie in -20..20";
    }
    return {};
}

}  // namespace

Expected<Display> load_display(const std::string& name_or_path) {
    if (name_or_path == "vive") return make_vive();
    if (name_or_path == "desktop") return make_desktop();
    std::error_code ignored;
    const bool names_a_file =
        name_or_path.find_first_of("./") != std::string::npos || std::filesystem::exists(name_or_path, ignored);
    if (names_a_file) return read_display_file(name_or_path);
    return fail(ErrorCode::option, "display '" + name_or_path +
                                       "' is unknown: use vive, desktop, or the path of a display file "
                                       "(masks/display.md)");
}

Expected<void> validate_display(const Display& display) {
    const auto wrong = [](const std::string& what) { return fail(ErrorCode::protocol, "display: " + what); };
    for (const int edge : {display.eye_width_px, display.eye_height_px}) {
        if (edge < 64 || edge > 4096 || edge % 4 != 0)
            return wrong("eye_width_px and eye_height_px: must be multiples of 4 in 64..4096");
    }
    if (!within(display.refresh_hz, 1.0F, 1000.0F)) return wrong("refresh_hz: must lie in 1..1000");
    for (const Eye eye : {kLeftEye, kRightEye}) {
        const std::string fault = fault_of(display.eyes[eye]);
        if (!fault.empty()) return wrong((eye == kLeftEye ? "left " : "right ") + fault);
    }
    return {};
}

std::vector<std::uint8_t> hidden_pixels(const Display& display, Eye eye) {
    std::vector<std::uint8_t> hidden(static_cast<std::size_t>(display.eye_width_px) * display.eye_height_px, 1);
    std::vector<Span> spans;
    for (int y = 0; y < display.eye_height_px; ++y) {
        visible_spans(display, display.eyes[eye], y, spans);
        const auto row = hidden.begin() + std::ptrdiff_t{y} * display.eye_width_px;
        for (const Span& span : spans) std::fill(row + span.begin, row + span.end, std::uint8_t{0});
    }
    return hidden;
}

}  // namespace macula
