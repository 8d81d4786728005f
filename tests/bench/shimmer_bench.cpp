// What prefiltered textures do for foveated samples: three widths of a sample's footprint (none, one pixel, the
// distance to its neighbours) at several shares of rays, on patterned and glossy bumpy surfaces. The head turns a
// little from frame to frame, the sampling pattern moves as the server's does, and pictures are what the server sends,
// before any temporal filter. By ring of angles from the gaze:
//   shimmer: rms of the change of the error from one frame to the next; what moves without cause
//   error:   PSNR against 64 rays a pixel
// Values are sRGB-coded, of 0..255. Not a timing: the figures do not depend on the machine.
//
// usage: shimmer_bench [width of an eye in pixels] [frames]

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "masks/display.h"
#include "masks/law.h"
#include "masks/tile_sampler.h"
#include "scenes/pattern.h"
#include "scenes/shapes.h"
#include "server/kernels/color.h"
#include "server/render/reconstructor.h"
#include "server/render/tracer.h"
#include "tests/support/bumps.h"
#include "tests/support/plans.h"

namespace macula {
namespace {

/// Edges of the rings, in degrees from the gaze.
constexpr std::array<double, 5> kRingEnd_deg = {5.0, 15.0, 25.0, 40.0, 90.0};

int add_image(Scene& scene, TextureImage image) {
    scene.images.push_back(std::move(image));
    return static_cast<int>(scene.images.size()) - 1;
}

TextureUse tiled(int image, float repeats) {
    TextureUse use;
    use.image = image;
    use.uv_scale_rotation = glm::vec4(repeats, 0.0F, 0.0F, repeats);
    return use;
}

void add(Scene& scene, Mesh mesh, Material material) {
    if (material.normal_texture.present())
        mesh.tangent.assign(mesh.position_m.size(),
                            glm::vec4(glm::normalize(mesh.position_m[1] - mesh.position_m[0]), -1.0F));
    mesh.material = static_cast<int>(scene.materials.size());
    scene.materials.push_back(std::move(material));
    scene.instances.push_back({"", static_cast<int>(scene.meshes.size())});
    scene.meshes.push_back(std::move(mesh));
}

/// A floor of checks that runs to 40 m, and ahead three walls: text, stripes, and glossy bumps.
std::shared_ptr<const Scene> make_scene() {
    auto scene = std::make_shared<Scene>();
    scene->name = "shimmer";
    Material matt;
    matt.metallic = 0.0F;
    matt.base_color_texture = tiled(add_image(*scene, make_checkerboard(256, 16, {})), 40.0F);
    add(*scene, make_quad({-20.0F, -1.6F, -40.0F}, {40.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 40.0F}), matt);
    matt.base_color_texture = tiled(add_image(*scene, make_text_page(1024)), 6.0F);
    add(*scene, make_quad({-12.0F, 6.0F, -7.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, -7.6F, 0.0F}), matt);
    matt.base_color_texture = tiled(add_image(*scene, make_stripes(512, 32, {})), 6.0F);
    add(*scene, make_quad({4.0F, 6.0F, -7.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, -7.6F, 0.0F}), matt);
    Material metal;
    metal.base_color = glm::vec4(0.9F, 0.8F, 0.6F, 1.0F);
    metal.roughness = 0.25F;
    metal.normal_texture = tiled(add_image(*scene, test::bumps(512, 64, 4.0F)), 6.0F);
    add(*scene, make_quad({-4.0F, 6.0F, -7.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, -7.6F, 0.0F}), metal);
    Light sun;
    sun.direction = glm::normalize(glm::vec3(0.3F, -1.0F, -0.8F));
    sun.intensity = glm::vec3(1.5F);
    sun.casts_shadow = false;
    scene->lights.push_back(sun);
    for (const float x : {-3.0F, 3.0F}) {
        Light lamp;
        lamp.kind = LightKind::point;
        lamp.position_m = {x, 3.0F, -3.0F};
        lamp.intensity = glm::vec3(8.0F);
        lamp.casts_shadow = false;
        scene->lights.push_back(lamp);
    }
    scene->ambient_radiance = glm::vec3(0.1F);
    scene->background_radiance = glm::vec3(0.3F, 0.4F, 0.5F);
    return scene;
}

/// The mean of a grid of rays in each pixel.
ColorImage reference(const Tracer& tracer, const Scene& scene, const EyeView& view) {
    constexpr int kGrid = 8;
    const SamplePlan plan = test::full_plan(view.width_px, view.height_px);
    Samples samples;
    samples.keep_radiance = true;
    ColorImage picture(view.width_px, view.height_px);
    std::vector<glm::vec3> sum(picture.texels.size(), glm::vec3(0.0F));
    for (int i = 0; i < kGrid * kGrid; ++i) {
        const glm::vec2 at = (glm::vec2(i % kGrid, i / kGrid) + glm::vec2(0.5F)) / static_cast<float>(kGrid);
        const TraceTask task{&view, &plan, &samples, at, 1.0F / static_cast<float>(kGrid)};
        tracer.trace({&task, 1});
        for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += glm::min(samples.radiance[p], glm::vec3(1.0F));
    }
    const float scale = scene.exposure / static_cast<float>(kGrid * kGrid);
    for (std::size_t p = 0; p < sum.size(); ++p) picture.texels[p] = kernels::srgb8_from_linear(sum[p] * scale);
    return picture;
}

/// How wide a sample's footprint is.
struct Footprint {
    const char* name;
    float scale;     ///< TraceTask's
    bool in_pixels;  ///< instead of in distances of samples
};
constexpr std::array<Footprint, 5> kFootprints = {{{"none", 0.0F, false},
                                                   {"one pixel", 1.0F, true},
                                                   {".5 spacing", 0.5F, false},
                                                   {".7 spacing", 0.7F, false},
                                                   {"spacing", 1.0F, false}}};

/// Pictures of one sampling and one footprint, frame by frame, and what they add up to.
class Judge {
public:
    Judge(std::string sampling, const Footprint& footprint, const Display& display,
          const std::shared_ptr<const TileTables>& tables)
        : sampling_(std::move(sampling)),
          footprint_(footprint),
          hidden_(hidden_pixels(display, kLeftEye)),
          reconstructor_(make_cpu_reconstructor(tables)) {
        const SamplingPreset preset = parse_sampling(sampling_).value();
        sampler_ = std::make_unique<TileSampler>(display, kLeftEye, tile_law(display, kLeftEye, preset), tables);
    }

    void add(const Tracer& tracer, const EyeView& view, int frame, const ColorImage& reference) {
        sampler_->plan({.phase_px = {frame * 13 % 64, frame * 29 % 64}}, plan_);
        SamplePlan traced = plan_;
        // A plan without levels has samples as wide as pixels.
        if (footprint_.in_pixels) traced.level.clear();
        const TraceTask task{&view, &traced, &samples_, glm::vec2(0.5F), footprint_.scale};
        tracer.trace({&task, 1});
        ColorImage picture(view.width_px, view.height_px);
        InverseDepthImage depth(view.width_px, view.height_px);
        const auto stride = static_cast<std::size_t>(view.width_px);
        if (!reconstructor_->reconstruct(plan_, samples_, {picture.row(0), stride, depth.row(0), stride})) std::abort();
        count(view, picture, reference);
    }

    void print() const {
        std::printf("%-8s %-10s", sampling_.c_str(), footprint_.name);
        for (const Ring& ring : rings_)
            std::printf("   %6.2f %5.1f", std::sqrt(ring.change_sq / std::max(ring.changes, 1.0)),
                        10.0 * std::log10(255.0 * 255.0 * ring.values / std::max(ring.error_sq, 1e-9)));
        std::printf("\n");
    }

private:
    struct Ring {
        double change_sq = 0.0;
        double changes = 0.0;
        double error_sq = 0.0;
        double values = 0.0;
    };

    void count(const EyeView& view, const ColorImage& picture, const ColorImage& reference) {
        std::vector<float> error(picture.texels.size() * 3);
        for (int y = 0; y < view.height_px; ++y)
            for (int x = 0; x < view.width_px; ++x) {
                const auto p =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width_px) + static_cast<std::size_t>(x);
                if (hidden_[p] != 0) continue;
                Ring& ring = ring_of(view, x, y);
                for (unsigned c = 0; c < 3; ++c) {
                    float& e = error[3 * p + c];
                    e = static_cast<float>(picture.texels[p] >> 8U * c & 255U) -
                        static_cast<float>(reference.texels[p] >> 8U * c & 255U);
                    ring.error_sq += double{e} * e;
                    ring.values += 1.0;
                    if (before_.empty()) continue;
                    const double change = e - before_[3 * p + c];
                    ring.change_sq += change * change;
                    ring.changes += 1.0;
                }
            }
        before_ = std::move(error);
    }

    Ring& ring_of(const EyeView& view, int x, int y) {
        const Tangents& t = view.tangents;
        const double tx = t.left + (x + 0.5) / view.width_px * (t.right - t.left);
        const double ty = t.top - (y + 0.5) / view.height_px * (t.top - t.bottom);
        const double angle_deg = std::atan(std::hypot(tx, ty)) * 57.29577951308232;
        const auto* end = std::find_if(kRingEnd_deg.begin(), kRingEnd_deg.end() - 1,
                                       [angle_deg](double edge) { return angle_deg < edge; });
        return rings_.at(static_cast<std::size_t>(end - kRingEnd_deg.begin()));
    }

    std::string sampling_;
    Footprint footprint_;
    std::vector<std::uint8_t> hidden_;
    std::unique_ptr<Reconstructor> reconstructor_;
    std::unique_ptr<TileSampler> sampler_;
    SamplePlan plan_;
    Samples samples_;
    std::vector<float> before_;
    std::array<Ring, kRingEnd_deg.size()> rings_{};
};

struct Turn {
    const char* name;
    float px;  ///< of the centre, from frame to frame
};

void measure(const Turn& turn, const Tracer& tracer, const Scene& scene, const Display& display, int frames) {
    const auto tables = std::make_shared<const TileTables>(make_rank_tile());
    std::vector<std::unique_ptr<Judge>> judges;
    for (const char* sampling : {"54", "27", "18"})
        for (const Footprint& footprint : kFootprints)
            judges.push_back(std::make_unique<Judge>(sampling, footprint, display, tables));
    const EyeDisplay& eye = display.eyes[kLeftEye];
    const float px_angle = (eye.tangents.right - eye.tangents.left) / static_cast<float>(display.eye_width_px);
    ColorImage wanted;
    for (int frame = 0; frame < frames; ++frame) {
        EyeView view{{}, eye.tangents, display.eye_width_px, display.eye_height_px};
        view.world_from_eye.orientation =
            glm::angleAxis(turn.px * px_angle * static_cast<float>(frame), glm::vec3(0.0F, 1.0F, 0.0F));
        if (frame == 0 || turn.px != 0.0F) wanted = reference(tracer, scene, view);
        for (const auto& judge : judges) judge->add(tracer, view, frame, wanted);
    }
    std::printf("\n%s\n%-8s %-10s", turn.name, "sampling", "footprint");
    double begin = 0.0;
    for (const double end : kRingEnd_deg) {
        std::printf("   %3.0f-%-2.0f deg  ", begin, end);
        begin = end;
    }
    std::printf("\n");
    for (const auto& judge : judges) judge->print();
    std::fflush(stdout);
}

}  // namespace
}  // namespace macula

int main(int argc, char** argv) {
    using namespace macula;
    Display display = load_display("desktop").value();
    const int width_px = argc > 1 ? std::clamp(std::atoi(argv[1]), 64, 4096) : display.eye_width_px / 2;
    const int frames = argc > 2 ? std::clamp(std::atoi(argv[2]), 2, 100) : 5;
    display.eye_height_px = width_px * display.eye_height_px / display.eye_width_px;
    display.eye_width_px = width_px;
    const std::shared_ptr<const Scene> scene = make_scene();
    const auto tracer = make_embree_tracer(scene);
    if (!tracer) {
        std::fprintf(stderr, "shimmer_bench: %s\n", tracer.error().message.c_str());
        return static_cast<int>(tracer.error().code);
    }
    std::printf("%d x %d pixels, %d frames; shimmer (rms of 255), PSNR (dB)\n", display.eye_width_px,
                display.eye_height_px, frames);
    for (const Turn& turn : {Turn{"still", 0.0F}, Turn{"turning by .1 px a frame", 0.1F}})
        measure(turn, **tracer, *scene, display, frames);
    return 0;
}
