#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scenes/scene.h"

namespace macula {

/// What a scene may ask of a renderer, one bit each. What no visible surface and no light asks for is not done.
enum Need : std::uint32_t {
    kNeedTextures = 1U << 0,      ///< images on surfaces
    kNeedNormalMaps = 1U << 1,    ///< normals from images
    kNeedVertexColors = 1U << 2,  ///< colours at vertices
    kNeedAlphaMasks = 1U << 3,    ///< holes cut by alpha
    kNeedBlending = 1U << 4,      ///< surfaces that cover what lies behind them in part
    kNeedTransmission = 1U << 5,  ///< thin walls that let light through
    kNeedRefraction = 1U << 6,    ///< volumes that bend light
    kNeedAbsorption = 1U << 7,    ///< volumes that colour light on its way
    kNeedMirrors = 1U << 8,       ///< reflections without visible blur
    kNeedGloss = 1U << 9,         ///< blurred reflections for which a ray is traced
    kNeedClearcoat = 1U << 10,    ///< a second, clear layer
    kNeedSheen = 1U << 11,        ///< fabric
    kNeedSpecular = 1U << 12,     ///< dielectrics that reflect other than 4 %
    kNeedShadows = 1U << 13,      ///< lights that cast shadows
    kNeedSoftShadows = 1U << 14,  ///< lights with an extent
    kNeedEnvironment = 1U << 15,  ///< light from an image all around
    kNeedAnimation = 1U << 16,    ///< instances or lights that move
};
inline constexpr int kNeedCount = 17;

/// Roughness above which a reflection is so blurred that the environment stands for it and no ray is traced.
inline constexpr float kGlossLimit = 0.4F;
/// Roughness up to which a reflection is as sharp as the display shows it: the highlight of GGX is then within about a
/// degree of the mirror direction.
inline constexpr float kMirrorLimit = 0.1F;

/// The needs of a scene, with a reason for each that is there and for each that is not.
struct SceneNeeds {
    std::uint32_t needs = 0;          ///< of `Need`
    std::vector<std::string> reason;  ///< by the need's bit: kNeedCount sentences without a full stop

    [[nodiscard]] bool has(Need need) const { return (needs & need) != 0; }
};

/// Finds what surfaces ask for. Images are read, each channel once: a blended material whose alpha is 1 everywhere does
/// not blend. The scene outlives it.
class SurfaceNeeds {
public:
    explicit SurfaceNeeds(const Scene& scene) : scene_(scene) {}
    /// Bits of a mesh with its material.
    std::uint32_t of(const Mesh& mesh);

private:
    struct Range {
        float low;
        float high;
    };
    Range factor_range(float factor, const TextureUse& use, int channel);
    bool has_factor(float factor, const TextureUse& use, int channel);
    bool has_color(const glm::vec3& factor, const TextureUse& use);
    float least_alpha(const Mesh& mesh, const Material& material);
    std::uint32_t of_alpha(const Mesh& mesh, const Material& material);
    std::uint32_t of_transmission(const Material& material);
    std::uint32_t of_reflection(const Material& material);

    const Scene& scene_;
    std::map<std::pair<int, int>, Range> range_;  ///< by image and channel
};

/// What a light asks for; nothing where its intensity is zero.
std::uint32_t light_needs(const Light& light);

/// What all instances and lights ask for together; `surfaces` is of the same scene, and what it has read is not read
/// again.
SceneNeeds scene_needs(const Scene& scene, SurfaceNeeds& surfaces);
SceneNeeds scene_needs(const Scene& scene);

/// One line per need: its name, yes or no, and the reason.
std::string explain(const SceneNeeds& needs);

/// Names of what is needed, on one line; "nothing".
std::string summary(const SceneNeeds& needs);

}  // namespace macula
