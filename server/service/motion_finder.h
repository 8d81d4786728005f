#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

#include "masks/sample_plan.h"
#include "protocol/base/image.h"
#include "protocol/message/message.h"
#include "scenes/scene.h"
#include "server/render/tracer.h"

namespace macula {

/// Finds which of a scene's moving objects a frame shows, where in it, and how they move (PROTOCOL.md, "What moves by
/// itself"). An object is all that hangs on one node of the animation; its id is the node's index + 1. Keeps memory
/// from frame to frame. One thread at a time.
class MotionFinder {
public:
    explicit MotionFinder(std::shared_ptr<const Scene> scene);

    /// Whether anything in the scene can move; if not, there is nothing to find.
    [[nodiscard]] bool anything_moves() const { return moves_; }

    /// Sets `moving` and `moving_map` of the frame, both empty where nothing that moves was hit. `samples` are those
    /// that the tracer found for `plans` at the scene time `time_s`; `inverse_depth` is the frame's, reconstructed,
    /// both eyes side by side, its edges multiples of 4.
    void find(double time_s, const PerEye<SamplePlan>& plans, const PerEye<Samples>& samples,
              const InverseDepthImage& inverse_depth, Frame& frame);

private:
    /// Blocks of one eye.
    struct Blocks {
        int columns = 0;
        int rows = 0;
        std::vector<float> nearest_per_m;  ///< inverse depth of the nearest sample in each block; -1: there is none
        std::vector<std::uint8_t> slot;    ///< 0, or 1 + index into Frame::moving of what that sample hit
    };

    void count_samples(const PerEye<SamplePlan>& plans, const PerEye<Samples>& samples);
    void list_objects(double time_s, Frame& frame);
    [[nodiscard]] std::uint8_t slot_of(std::uint32_t object_id) const;
    void map_samples(const SamplePlan& plan, const Samples& samples);
    void fill_between(int reach, const float* inverse_depth, std::ptrdiff_t stride);
    void find_empty(int reach);
    [[nodiscard]] int neighbour_like(int block, const float* inverse_depth, std::ptrdiff_t stride) const;

    std::shared_ptr<const Scene> scene_;
    bool moves_ = false;
    std::vector<int> node_of_object_;  ///< by object id; -1: still
    std::vector<std::uint32_t> count_;
    std::vector<std::uint8_t> slot_of_node_;
    std::vector<int> seen_nodes_;
    std::vector<glm::mat4> before_;
    std::vector<glm::mat4> now_;
    std::vector<glm::mat4> after_;
    Blocks blocks_;
    std::vector<int> empty_;
    std::vector<int> still_empty_;
    std::vector<std::pair<int, int>> filled_;  ///< block, and the one it takes its slot from
    std::vector<std::uint8_t> map_;
};

}  // namespace macula
