#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace macula {

/// Where the lamps of Air Shed hang: their upper ends, at the trusses. World space, metres.
struct AirShedLamps {
    static constexpr float kHighBayDrop = 1.3F;  ///< from there to the bulb
    static constexpr std::array<glm::vec3, 10> kHighBays = {{{-10.5F, 8.1F, 19.5F},
                                                             {-10.5F, 8.1F, 7.6F},
                                                             {-10.5F, 8.1F, -8.2F},
                                                             {-10.5F, 8.1F, -20.0F},
                                                             {1.5F, 8.1F, 19.5F},
                                                             {1.5F, 8.1F, 3.6F},
                                                             {1.5F, 8.1F, -16.1F},
                                                             {11.0F, 8.1F, 15.5F},
                                                             {11.0F, 8.1F, 3.6F},
                                                             {11.0F, 8.1F, -12.2F}}};
    static constexpr float kTubeDrop = 4.9F;
    /// Above the workbenches along the right wall.
    static constexpr std::array<glm::vec3, 4> kTubes = {
        {{15.6F, 8.1F, 9.0F}, {15.6F, 8.1F, 12.5F}, {15.6F, 8.1F, 16.0F}, {15.6F, 8.1F, 19.5F}}};
};

}  // namespace macula
