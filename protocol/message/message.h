#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "protocol/base/error.h"
#include "protocol/base/geometry.h"

namespace macula {

/// Version of the message schema; both ends must agree on it (PROTOCOL.md).
inline constexpr std::uint32_t kProtocolVersion = 1;

using Bytes = std::vector<std::byte>;

/// Largest message that each side accepts.
inline constexpr std::size_t kMaxClientMessage_bytes = std::size_t{64} << 10;
inline constexpr std::size_t kMaxServerMessage_bytes = std::size_t{16} << 20;

/// One eye of the client's display. `visible_outline` is a closed polygon of tangents (x right, y up) outside
/// which the lens never shows a pixel; empty means that the whole buffer is visible.
struct EyeDisplayMessage {
    Tangents tangents;
    Pose head_from_eye;
    std::vector<glm::vec2> visible_outline;
};

/// Client -> server, first message.
struct Hello {
    std::uint32_t protocol_version = kProtocolVersion;
    std::string client_name;   ///< for logs, at most 64 bytes
    std::string token;         ///< shared secret of the server's state folder
    std::string display_name;  ///< for logs
    int eye_width_px = 0;      ///< per eye, multiple of 4, 64..4096
    int eye_height_px = 0;
    float refresh_hz = 90.0F;
    PerEye<EyeDisplayMessage> eyes;
    std::string sampling;             ///< wished preset; empty leaves the choice to the server
    std::vector<std::string> codecs;  ///< video codecs the client can decode, best first ("h264")
    /// Whether the client accumulates frames over time. If not, samples that moved from frame to frame would only
    /// flicker, so the server leaves them where they are.
    bool accumulates = true;
};

/// Server -> client, answer to an accepted Hello.
struct Welcome {
    std::uint32_t protocol_version = kProtocolVersion;
    std::string server_name;
    std::string scene_name;
    std::string codec;
    std::string sampling;
    std::string renderer;                 ///< GL renderer and tracer, for the client's log
    int rank_tile_size_px = 0;            ///< edge of the rank tile, a multiple of the tile edge
    std::vector<std::uint8_t> rank_tile;  ///< rank order of each pixel inside its tile, row-major, 0..255
    Pose world_from_start;                ///< where a head pose of identity stands in the scene
    bool can_choose = false;              ///< whether the server takes Choose; one that does not say so does not
};

/// Server -> client, answer to a Hello that cannot be served. The connection closes after it.
struct Refused {
    std::uint32_t protocol_version = kProtocolVersion;
    std::string reason;  ///< what to do, for a person; one line
};

/// Where one eye looks: unit vector in head space; confidence 0 (lost) .. 1.
struct GazeSample {
    glm::vec3 direction = glm::vec3(0.0F, 0.0F, -1.0F);
    float confidence = 1.0F;
};

/// Client -> server, as often as the tracker delivers; the newest wins. Times are the client's clock.
struct Track {
    std::uint64_t id = 0;                                ///< counts up
    std::int64_t pose_time_ns = 0;                       ///< when the head had this pose
    std::int64_t gaze_time_ns = 0;                       ///< when the eyes looked there
    std::int64_t display_time_ns = 0;                    ///< when the client expects to show a frame made from this
    Pose start_from_head;                                ///< head pose relative to the start pose of Welcome
    glm::vec3 linear_velocity_m_s = glm::vec3(0.0F);     ///< in start space
    glm::vec3 angular_velocity_rad_s = glm::vec3(0.0F);  ///< in start space, axis times rate
    PerEye<GazeSample> gaze;
};

/// How one eye of a frame was sampled: which pixels were traced. If `exact`, a pixel (x, y) that the lens shows was
/// traced if and only if rank_tile[(y + phase.y) mod size][(x + phase.x) mod size] < count[tile], with tile column (x +
/// phase.x mod 16) / 16 and row (y + phase.y mod 16) / 16 of this map. Otherwise about count of 256 pixels were, and it
/// is not said which.
struct EyeSamplingMessage {
    glm::ivec2 phase_px = glm::ivec2(0);
    int tiles_x = 0;
    int tiles_y = 0;
    std::vector<std::uint8_t> level;  ///< index into kLevelCounts (masks/levels.h), row-major, no guard ring
    bool exact = true;                ///< whether it is said which pixels were traced, or only how many
};

/// When each stage of a frame ended, server clock; a stage's time is the difference to the one before.
struct StageTimes {
    std::int64_t track_received_ns = 0;
    std::int64_t begin_ns = 0;
    std::int64_t plan_ns = 0;
    std::int64_t trace_ns = 0;
    std::int64_t reconstruct_ns = 0;
    std::int64_t encode_ns = 0;  ///< includes any wait for the encoder thread
    std::int64_t send_ns = 0;
};

/// Something in the scene that moves by itself, as it stands at the display time of a frame.
struct MovingObject {
    std::uint32_t id = 0;  ///< the same from frame to frame; unique in a frame
    /// Affine; columns x, y, z and origin. A point of the object that lies at p in world space now lay at
    /// world_from_object_before * inverse(world_from_object) * p in an earlier frame that has the same id.
    glm::mat4x3 world_from_object = glm::mat4x3(1.0F);
    glm::mat4x3 velocity_per_s = glm::mat4x3(0.0F);  ///< derivative of world_from_object by time; 0 across a jump
};

/// Server -> client: one stereo frame with everything that made it; nothing is re-matched afterwards.
struct Frame {
    std::uint64_t id = 0;
    std::uint64_t track_id = 0;
    std::int64_t pose_time_ns = 0;  ///< client clock, copied from the Track
    std::int64_t gaze_time_ns = 0;
    std::int64_t display_time_ns = 0;
    PerEye<Pose> world_from_eye;  ///< the view rendered, after prediction
    PerEye<glm::vec3> gaze;       ///< unit vectors in eye space that the plan was made for
    PerEye<EyeSamplingMessage> sampling;
    std::uint32_t traced = 0;  ///< rays of both eyes, primary
    float near_m = 0.1F;       ///< inverse depth code 255... maps to 1/near (PROTOCOL.md)
    StageTimes times;
    bool keyframe = false;
    std::vector<std::uint8_t> color;  ///< H.264 access unit, both eyes side by side, left eye left
    std::vector<std::uint8_t> depth;  ///< depth stream's access unit (protocol/codec/depth_codec.h)
    /// What moves by itself and is seen in this frame; empty in a still scene. All other surfaces are still.
    std::vector<MovingObject> moving;
    /// Which of them is seen where: one zstd frame (byte_map.h) that holds a byte for each 4x4 block of both eyes side
    /// by side, row-major, as the depth stream has them: 0 still, otherwise index into `moving` + 1. Empty if that is.
    std::vector<std::uint8_t> moving_map;
    std::uint32_t choice = 0;  ///< id of the Choose that it was made after; 0: none
};

/// Client -> server, one for each frame shown or given up.
struct FrameReport {
    std::uint64_t frame_id = 0;
    std::int64_t received_ns = 0;  ///< client clock
    std::int64_t decoded_ns = 0;
    std::int64_t displayed_ns = 0;  ///< 0: not shown
    bool decode_failed = false;     ///< asks for a keyframe
};

struct Ping {
    std::int64_t sent_ns = 0;  ///< sender's clock
};
struct Pong {
    std::int64_t ping_sent_ns = 0;  ///< copied from the Ping
    std::int64_t answered_ns = 0;   ///< answerer's clock
};

/// Either side, before closing on purpose.
struct Bye {
    std::string reason;
};

/// Client -> server: frames are to be made in another way from now on, or later. The server goes on in the old way
/// until the new one is ready.
struct Choose {
    std::uint32_t id = 0;       ///< counts up from 1
    std::string sampling;       ///< as in Hello; not empty
    bool only_prepare = false;  ///< makes the method ready, so that a later Choose takes effect at once, and no more
};

/// Server -> client: what became of a Choose.
struct Chosen {
    std::uint32_t id = 0;  ///< of the Choose
    std::string problem;   ///< why the method cannot be had, for a person, one line; empty: it is ready
};

using Message = std::variant<Hello, Welcome, Refused, Track, Frame, FrameReport, Ping, Pong, Bye, Choose, Chosen>;

/// Serialises a message; the result is the body that a Channel frames. Nothing is validated: a message outside
/// the limits is refused by whoever decodes it.
Bytes encode_message(const Message& message);

/// Parses and validates a body: schema verification, then ranges (limits.h: finite numbers, unit vectors and
/// quaternions within 1e-3 and renormalised, sizes and counts, levels, texts of one line). Of a Hello of another
/// protocol version only the version and the client's name are validated, so that it can be refused by name.
/// Errors have code `protocol` and name the field.
Expected<Message> decode_message(std::span<const std::byte> body);

}  // namespace macula
