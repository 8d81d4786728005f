#include "tests/chart/measure.h"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "tests/metrics/npy.h"

namespace macula::test {

namespace {

/// Where the left eye looks, in its own space.
glm::vec3 gaze_in_eye(const Display& display, const Moment& moment) {
    return glm::normalize(display.eyes[kLeftEye].head_from_eye.inverse().direction(moment.true_gaze_head));
}

/// What the lens hides is no difference to metrics that take whole pictures.
std::vector<ColorImage> without_hidden(std::vector<ColorImage> pictures, const std::vector<std::uint8_t>& hidden) {
    for (ColorImage& picture : pictures)
        for (std::size_t i = 0; i < hidden.size(); ++i)
            if (hidden[i] != 0) picture.texels[i] = 0xFF000000U;
    return pictures;
}

}  // namespace

Expected<const Stage*> Measurer::stage(const Row& row) {
    if (!stage_ || scene_name_ != row.scene) {
        ablated_stage_.reset();
        stage_.reset();
        auto made = make_stage(row.scene);
        if (!made) return tl::unexpected(made.error());
        stage_ = *std::move(made);
        scene_name_ = row.scene;
    }
    if (row.without.empty()) return &*stage_;
    if (!ablated_stage_ || ablated_ != row.without) {
        auto made = make_stage(stage_->scene, row.without);
        if (!made) return tl::unexpected(made.error());
        ablated_stage_ = *std::move(made);
        ablated_ = row.without;
    }
    return &*ablated_stage_;
}

void Measurer::make_references(const Row& row, const Display& display, const Scenario& scenario) {
    const bool moves = scenario.head_moves || stage_->scene->animation.present();
    std::string key = row.scene;
    key.append(" ").append(row.display);
    if (moves) {
        key.append(" ").append(row.scenario).append(" ").append(std::to_string(row.seed));
        key.append(" ").append(std::to_string(row.warm)).append(" ").append(std::to_string(row.frames));
    }
    if (key == references_.key) return;
    references_ = {std::move(key), {}};
    const int count = moves ? row.frames : 1;
    for (int i = 0; i < count; ++i)
        references_.pictures.push_back(reference_picture(*stage_, display, scenario.moments[row.warm + i]));
}

Expected<void> Measurer::write_clips(const std::vector<ColorImage>& shown, const Display& display,
                                     const std::vector<glm::vec3>& gaze_eye) const {
    const std::vector<std::uint8_t> hidden = hidden_pixels(display, kLeftEye);
    if (auto written = write_npy(clips_ + "/test.npy", without_hidden(shown, hidden)); !written) return written;
    if (auto written = write_npy(clips_ + "/reference.npy", without_hidden(references_.pictures, hidden)); !written)
        return written;
    const std::string path = clips_ + "/gaze.csv";
    std::ofstream file(path, std::ios::trunc);
    file << "frame,x_px,y_px\n";
    const Tangents& edges = display.eyes[kLeftEye].tangents;
    for (std::size_t i = 0; i < gaze_eye.size(); ++i) {
        // A gaze beyond a right angle meets no plane; the metrics take it to be far aside.
        const glm::vec3 gaze = gaze_eye[i];
        const float depth = std::max(-gaze.z, 0.01F);
        const float x = (gaze.x / depth - edges.left) / (edges.right - edges.left);
        const float y = (edges.top - gaze.y / depth) / (edges.top - edges.bottom);
        file << i << ',' << x * static_cast<float>(display.eye_width_px) << ','
             << y * static_cast<float>(display.eye_height_px) << '\n';
    }
    file.close();
    if (!file) return fail(ErrorCode::output, path + " cannot be written");
    return {};
}

Expected<Measurement> Measurer::measure(const Row& row) {
    const auto display = display_of_row(row.display);
    if (!display) return tl::unexpected(display.error());
    const auto scenario = make_scenario(row.scenario, row.warm + row.frames, display->refresh_hz, row.seed);
    if (!scenario) return tl::unexpected(scenario.error());
    const auto on = stage(row);
    if (!on) return tl::unexpected(on.error());
    make_references(row, *display, *scenario);
    auto pipeline = Pipeline::make(**on, row);
    if (!pipeline) return tl::unexpected(pipeline.error());

    Measurement result{row, *display, {}, 0.0, 0.0, {}};
    ClipMeter meter(display->eyes[kLeftEye].tangents, display->eye_width_px, display->eye_height_px,
                    hidden_pixels(*display, kLeftEye));
    std::vector<ColorImage> shown;
    std::vector<glm::vec3> gaze_eye;
    for (int i = 0; i < row.warm + row.frames; ++i) {
        const Moment& now = scenario->moments[i];
        const auto picture = pipeline->frame(scenario->moments[std::max(i - row.latency, 0)], now);
        if (!picture) return tl::unexpected(picture.error());
        if (i < row.warm) continue;
        result.times.push_back(pipeline->times());
        result.traced_share += pipeline->traced_share() / row.frames;
        result.kilobytes += 1e-3 * static_cast<double>(pipeline->bytes()) / row.frames;
        shown.push_back(left_eye(**picture));
        gaze_eye.push_back(gaze_in_eye(*display, now));
    }
    // Judged afterwards, so that nothing runs between the frames that are timed.
    for (std::size_t i = 0; i < shown.size(); ++i)
        meter.add(shown[i], references_.pictures[std::min(i, references_.pictures.size() - 1)], gaze_eye[i]);
    result.quality = meter.figures();
    if (clips_.empty()) return result;
    if (auto written = write_clips(shown, *display, gaze_eye); !written) return tl::unexpected(written.error());
    return result;
}

}  // namespace macula::test
