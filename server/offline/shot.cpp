#include "server/offline/shot.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <glm/trigonometric.hpp>

#include "server/method_parts.h"

namespace macula {
namespace {

constexpr int kLeastSize_px = 16;
constexpr int kMostSize_px = 8192;

/// A whole text as a finite number.
std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

/// Left about +Y, then up about the turned +X.
glm::quat turn(double yaw_deg, double pitch_deg) {
    return glm::angleAxis(static_cast<float>(glm::radians(yaw_deg)), glm::vec3(0.0F, 1.0F, 0.0F)) *
           glm::angleAxis(static_cast<float>(glm::radians(pitch_deg)), glm::vec3(1.0F, 0.0F, 0.0F));
}

/// A display whose eyes both are the camera.
Expected<Display> camera_display(double fov_deg, const std::string& size) {
    const std::vector<std::string_view> sides = split(size, 'x');
    std::array<double, 2> side_px{};
    for (std::size_t i = 0; i < 2 && sides.size() == 2; ++i) side_px[i] = number(sides[i]).value_or(0.0);
    for (const double side : side_px) {
        if (side != std::floor(side) || side < kLeastSize_px || side > kMostSize_px)
            return fail(ErrorCode::option, "--size " + size + ": expected WIDTHxHEIGHT, 16 to 8192 pixels each");
    }
    Display display;
    display.name = "camera";
    display.eye_width_px = static_cast<int>(side_px[0]);
    display.eye_height_px = static_cast<int>(side_px[1]);
    const double top = std::tan(glm::radians(0.5 * fov_deg));
    const double right = top * side_px[0] / side_px[1];
    for (EyeDisplay& eye : display.eyes) {
        eye.tangents = {static_cast<float>(-right), static_cast<float>(right), static_cast<float>(-top),
                        static_cast<float>(top)};
    }
    return display;
}

}  // namespace

Expected<std::vector<float>> parse_numbers(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<float> values;
    for (const std::string_view part : split(text, ',')) {
        const auto value = number(part);
        if (value) values.push_back(static_cast<float>(*value));
    }
    if (values.size() != count || split(text, ',').size() != count) {
        return fail(ErrorCode::option,
                    option + " " + text + ": expected " + std::to_string(count) + " numbers with commas between them");
    }
    return values;
}

Expected<ShotPlan> ShotPlan::parse(const RenderOptions& options) {
    ShotPlan plan;
    plan.camera_ = options.camera_fov_deg > 0.0;
    auto display = plan.camera_ ? camera_display(options.camera_fov_deg, options.size) : load_display(options.display);
    if (!display) return tl::unexpected(display.error());
    plan.display_ = *std::move(display);
    if (plan.camera_ || options.eye != "right") plan.eyes_.push_back(kLeftEye);
    if (!plan.camera_ && options.eye != "left") plan.eyes_.push_back(kRightEye);

    if (!options.position.empty()) {
        const auto position = parse_numbers("--position", options.position, 3);
        if (!position) return tl::unexpected(position.error());
        plan.position_m_ = glm::vec3((*position)[0], (*position)[1], (*position)[2]);
    }
    plan.start_from_head_ = turn(options.yaw_deg, options.pitch_deg);
    const auto gaze = parse_numbers("--gaze", options.gaze, 2);
    if (!gaze) return tl::unexpected(gaze.error());
    plan.gaze_head_ = turn((*gaze)[0], (*gaze)[1]) * glm::vec3(0.0F, 0.0F, -1.0F);

    auto method = parse_method(options.sampling);
    if (!method) return tl::unexpected(method.error());
    plan.method_ = *std::move(method);
    return plan;
}

Expected<std::vector<Shot>> ShotPlan::shots(const Pose& world_from_start,
                                            const std::shared_ptr<const TileTables>& tables, MeshShelf& meshes) const {
    Pose world_from_head = world_from_start;
    world_from_head.orientation = world_from_head.orientation * start_from_head_;
    if (position_m_) world_from_head.position_m = *position_m_;
    std::vector<Shot> result;
    for (const Eye eye : eyes_) {
        const EyeDisplay& geometry = display_.eyes[eye];
        Shot& shot = result.emplace_back();
        if (!camera_) shot.name = eye == kLeftEye ? "left" : "right";
        shot.view = {world_from_head * geometry.head_from_eye, geometry.tangents, display_.eye_width_px,
                     display_.eye_height_px};
        shot.gaze_eye = glm::normalize(geometry.head_from_eye.inverse().direction(gaze_head_));
        auto sampler = make_sampler(method_, display_, eye, tables, meshes);
        if (!sampler) return tl::unexpected(sampler.error());
        shot.sampler = *std::move(sampler);
    }
    return result;
}

}  // namespace macula
