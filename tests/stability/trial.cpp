#include "tests/stability/trial.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

#include "server/render/tracer.h"
#include "server/service/prediction.h"
#include "tests/stability/scenes.h"
#include "tests/support/plans.h"

namespace macula::test {
namespace {

/// A value that a trial cannot do without.
template <class T>
T need(Expected<T> value) {
    if (!value) throw std::runtime_error(value.error().message);
    return *std::move(value);
}

Stage stage_of(const std::string& scene, const std::set<std::string>& without) {
    if (auto made = test_scene(scene)) return need(make_stage(std::move(made), without));
    return need(make_stage(scene, without));
}

}  // namespace

Trial::Trial(What what) : what_(std::move(what)), stage_(stage_of(what_.scene, {})) {
    display_ = need(display_of_row(what_.display));
    const int moments = (what_.warm + what_.frames) * what_.stride;
    const Scenario scenario = need(make_scenario(what_.scenario, moments, display_.refresh_hz, what_.seed));
    for (int i = 0; i < moments; i += what_.stride) moments_.push_back(scenario.moments[static_cast<std::size_t>(i)]);
    event_ = (scenario.event + what_.stride - 1) / what_.stride;
    still_ = !scenario.head_moves && !stage_.scene->animation.present();
    hidden_ = hidden_pixels(display_, kLeftEye);
    references_.resize(moments_.size());
}

glm::vec3 Trial::gaze_eye(int frame) const {
    const Pose eye_from_head = display_.eyes[kLeftEye].head_from_eye.inverse();
    return glm::normalize(eye_from_head.direction(moments_[static_cast<std::size_t>(frame)].true_gaze_head));
}

ClipMeter Trial::meter() const {
    return {display_.eyes[kLeftEye].tangents, display_.eye_width_px, display_.eye_height_px, hidden_};
}

Take Trial::run(const std::string& method, const std::string& taa, const std::string& codec,
                const std::set<std::string>& without) const {
    Row row;
    row.scene = what_.scene;
    row.scenario = what_.scenario;
    row.method = method;
    row.taa = taa;
    row.codec = codec;
    row.display = what_.display;
    row.without = without;
    const Stage stage = without.empty() ? stage_ : need(make_stage(stage_.scene, without));
    Pipeline pipeline = need(Pipeline::make(stage, row));
    Take run;
    ClipMeter meter = this->meter();
    for (int frame = 0; frame < frames(); ++frame) {
        const Moment& moment = moments_[static_cast<std::size_t>(frame)];
        run.shown.push_back(left_eye(*need(pipeline.frame(moment, moment))));
        if (frame >= what_.warm) meter.add(run.shown.back(), reference(frame), gaze_eye(frame));
    }
    run.figures = meter.figures();
    return run;
}

const ColorImage& Trial::reference(int frame) const {
    ColorImage& picture = references_[still_ ? 0 : static_cast<std::size_t>(frame)];
    if (picture.texels.empty())
        picture = reference_picture(stage_, display_, moments_[static_cast<std::size_t>(frame)], what_.spp);
    return picture;
}

double Trial::foveal_psnr_db(const Take& run, int frame) const {
    ClipMeter meter = this->meter();
    meter.add(run.shown[static_cast<std::size_t>(frame)], reference(frame), gaze_eye(frame));
    return meter.figures().foveal_psnr_db;
}

double Trial::psnr_db(const Take& run, int frame, const std::vector<std::uint8_t>& wanted) const {
    const ColorImage& shown = run.shown[static_cast<std::size_t>(frame)];
    const ColorImage& truth = reference(frame);
    double squares = 0.0;
    double values = 0.0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted[i] == 0) continue;
        for (unsigned shift = 0; shift < 24; shift += 8) {
            const double error = double(shown.texels[i] >> shift & 255U) - double(truth.texels[i] >> shift & 255U);
            squares += error * error;
            values += 1.0;
        }
    }
    return 10.0 * std::log10(255.0 * 255.0 * values / squares);
}

std::vector<std::uint32_t> Trial::objects(int frame) const {
    const Moment& moment = moments_[static_cast<std::size_t>(frame)];
    const EyeView view = eye_views(display_, stage_.scene->world_from_start * moment.start_from_head)[kLeftEye];
    const SamplePlan plan = full_plan(view.width_px, view.height_px);
    Samples samples;
    const TraceTask task{&view, &plan, &samples};
    stage_.tracer->trace({&task, 1}, 1e-9 * static_cast<double>(moment.time_ns));
    return samples.object_id;
}

}  // namespace macula::test
