#pragma once

#include <memory>
#include <string>
#include <vector>

#include "masks/display.h"
#include "protocol/base/image.h"
#include "scenes/scene.h"
#include "tests/metrics/clip_meter.h"
#include "tests/pipeline/pipeline.h"
#include "tests/pipeline/row.h"
#include "tests/pipeline/scenario.h"
#include "tests/stability/case.h"

namespace macula::test {

/// What a method showed of a trial.
struct Take {
    std::vector<ColorImage> shown;  ///< left eye, all frames of the trial
    ClipFigures figures;            ///< of the judged ones
};

/// One way of moving through one scene, with what should be seen: what methods are compared on. References are made
/// when they are first asked for, and kept. A trial that cannot be made throws, which fails the test that wanted it.
class Trial {
public:
    struct What {
        std::string scene;  ///< test_scene() or load_scene()
        std::string scenario;
        std::string display = "vive/8";
        int frames = 12;  ///< that are judged
        int warm = 12;    ///< before them
        int stride = 1;   ///< displayed frames from one rendered frame to the next: 4 is what a server at 22.5 Hz does
        std::uint32_t seed = 1;
        int spp = 64;  ///< of the references
    };
    explicit Trial(What what);

    /// A method of the trial: `method` and `taa` as in a Row. Without a codec, unless one is named: what is looked for
    /// is the fault of sampling and history.
    [[nodiscard]] Take run(const std::string& method, const std::string& taa, const std::string& codec = "none",
                           const std::set<std::string>& without = {}) const;

    /// What the left eye should see in a frame of the trial, counted from the first warm one.
    [[nodiscard]] const ColorImage& reference(int frame) const;
    /// Decibels of the foveal window of one frame of a run.
    [[nodiscard]] double foveal_psnr_db(const Take& run, int frame) const;
    /// Decibels of one frame of a run, of the pixels that `wanted` marks.
    [[nodiscard]] double psnr_db(const Take& run, int frame, const std::vector<std::uint8_t>& wanted) const;
    /// Object id of the left eye's pixels.
    [[nodiscard]] std::vector<std::uint32_t> objects(int frame) const;
    /// The pictures of a frame of a run, for check().
    [[nodiscard]] CasePictures pictures(const Take& run, int frame) const {
        return {run.shown[static_cast<std::size_t>(frame)], reference(frame)};
    }

    [[nodiscard]] int frames() const { return static_cast<int>(moments_.size()); }  ///< warm ones included
    [[nodiscard]] int first_judged() const { return what_.warm; }
    [[nodiscard]] int event() const { return event_; }  ///< of the scenario
    [[nodiscard]] const Display& display() const { return display_; }
    /// 1 for each pixel that the lens never shows, row-major.
    [[nodiscard]] const std::vector<std::uint8_t>& hidden() const { return hidden_; }

private:
    [[nodiscard]] glm::vec3 gaze_eye(int frame) const;
    [[nodiscard]] ClipMeter meter() const;

    What what_;
    Stage stage_;
    Display display_;
    std::vector<Moment> moments_;
    bool still_ = false;  ///< one reference serves all frames
    int event_ = 0;
    std::vector<std::uint8_t> hidden_;
    mutable std::vector<ColorImage> references_;  ///< empty where not made yet
};

}  // namespace macula::test
