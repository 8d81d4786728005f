#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "protocol/base/error.h"
#include "protocol/base/geometry.h"

namespace macula::test {

/// Where head and eyes are when a frame is shown.
struct Moment {
    std::int64_t time_ns = 0;
    Pose start_from_head;  ///< relative to where the session begins
    /// What the eye tracker says: unit vector in head space, the same for both eyes, which look into the distance.
    glm::vec3 gaze_head = glm::vec3(0.0F, 0.0F, -1.0F);
    glm::vec3 true_gaze_head = glm::vec3(0.0F, 0.0F, -1.0F);  ///< where the eye looks in truth: what metrics use
    float confidence = 1.0F;                                  ///< below .5: the tracker has lost the eye
    glm::vec3 linear_velocity_m_s = glm::vec3(0.0F);          ///< of the head, in start space
    glm::vec3 angular_velocity_rad_s = glm::vec3(0.0F);       ///< axis times rate
};

/// One way in which a person moves, frame by frame. The same name, length and seed give the same moments on every
/// machine.
///
///   still       nothing moves; the gaze is 5 degrees off the axis, in a direction that the seed chooses
///   noise       the same with tracker noise of .08 degrees from sample to sample (facts of real trackers)
///   pursuit     the eye follows a target at 10 deg/s past the axis, in the seed's direction; the head is still
///   saccade     a saccade of 15 degrees in the middle of the clip: duration and profile of SimulationModel
///   lost        the tracker loses the eye for a third of the clip, then finds it 8 degrees away
///   edge        the gaze runs from 30 degrees to beyond the edge of the field and stays there
///   pan         the head turns at 150 deg/s, p99 of recordings; the gaze is fixed in the head
///   slow-pan    the head turns by .1 pixels of `vive` a frame
///   sway        the head translates at .5 m/s sideways, to and fro: near objects uncover what lies behind
///   cut         the head jumps by 60 degrees and .3 m in the middle of the clip
///   recorded-gaze   gaze of shared/gaze, in the head, which is still; the seed chooses where it begins
///   recorded        the same with the recorded head motion
struct Scenario {
    std::string name;
    std::vector<Moment> moments;
    bool head_moves = false;  ///< whether one reference serves all frames
    int event = 0;            ///< index of the first moment after the saccade, loss, cut ...; 0 if there is none
};

/// `frames` moments at `rate_hz`. Errors: `option` for an unknown name; `input_file` for recorded ones where the
/// recordings are absent.
Expected<Scenario> make_scenario(const std::string& name, int frames, double rate_hz, std::uint32_t seed);

/// All names that make_scenario() knows.
const std::vector<std::string>& scenario_names();

}  // namespace macula::test
