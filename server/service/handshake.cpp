#include "server/service/handshake.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "protocol/transport/certificate.h"

namespace macula {

Expected<void> authenticate(const Hello& hello, const std::string& token) {
    if (hello.protocol_version != kProtocolVersion)
        return fail(ErrorCode::refused,
                    fmt::format("the client speaks protocol version {} and this server version {}: install the same "
                                "release of Macula on both ends",
                                hello.protocol_version, kProtocolVersion));
    if (!same_token(hello.token, token))
        return fail(ErrorCode::refused,
                    "wrong token: give the client the token that lies in the server's state folder");
    return {};
}

Display display_of(const Hello& hello) {
    Display display{hello.display_name, hello.eye_width_px, hello.eye_height_px, hello.refresh_hz, {}};
    for (std::size_t eye = 0; eye < kEyeCount; ++eye)
        display.eyes[eye] = {hello.eyes[eye].tangents, hello.eyes[eye].head_from_eye, hello.eyes[eye].visible_outline};
    return display;
}

namespace {

Expected<std::unique_ptr<MethodParts>> make_method(const Display& display, const std::string& sampling,
                                                   const Supplies& supplies) {
    auto method = std::make_unique<MethodParts>();
    for (const Eye eye : {kLeftEye, kRightEye}) {
        auto sampler = supplies.make_sampler(display, eye, sampling);
        if (!sampler) return tl::unexpected(sampler.error());
        method->samplers[eye] = *std::move(sampler);
    }
    auto reconstructor = supplies.make_reconstructor(sampling);
    if (!reconstructor) return tl::unexpected(reconstructor.error());
    method->reconstructor = *std::move(reconstructor);
    return method;
}

}  // namespace

Expected<Admission> admit(const Hello& hello, const Supplies& supplies) {
    if (std::ranges::find(hello.codecs, supplies.codec) == hello.codecs.end())
        return fail(ErrorCode::refused, fmt::format("this server codes video as {}, which the client cannot decode: "
                                                    "start the server with another --encoder",
                                                    supplies.codec));
    const Display display = display_of(hello);
    if (auto valid = validate_display(display); !valid) return tl::unexpected(valid.error());

    Admission admission;
    const std::string& sampling = hello.sampling.empty() ? supplies.default_sampling : hello.sampling;
    FrameMaker::Parts maker_parts;
    maker_parts.scene = supplies.scene;
    maker_parts.scene_start_ns = supplies.scene_start_ns;
    maker_parts.image_depth = supplies.image_depth;
    maker_parts.shifts_phase = hello.accumulates;
    maker_parts.tracer = supplies.tracer;
    auto method = make_method(display, sampling, supplies);
    if (!method) return tl::unexpected(method.error());
    maker_parts.samplers = std::move((*method)->samplers);
    maker_parts.reconstructor = std::move((*method)->reconstructor);
    admission.reconstructor = maker_parts.reconstructor->name();

    const int width_px = kEyeCount * display.eye_width_px;
    auto color_encoder = supplies.make_color_encoder(width_px, display.eye_height_px, display.refresh_hz);
    if (!color_encoder) return tl::unexpected(color_encoder.error());
    auto depth_encoder = supplies.make_depth_encoder(width_px, display.eye_height_px, display.refresh_hz);
    if (!depth_encoder) return tl::unexpected(depth_encoder.error());

    Welcome& welcome = admission.welcome;
    welcome.server_name = "macula-server";
    welcome.scene_name = supplies.scene->name;
    welcome.codec = supplies.codec;
    welcome.sampling = sampling;
    welcome.renderer = supplies.renderer;
    welcome.rank_tile_size_px = RankTile::kEdge_px;
    welcome.rank_tile.assign(supplies.rank_tile->rank.begin(), supplies.rank_tile->rank.end());
    welcome.world_from_start = supplies.scene->world_from_start;
    welcome.can_choose = true;

    Session::Parts& parts = admission.parts;
    parts.refresh_hz = display.refresh_hz;
    parts.frame_pixels = static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(display.eye_height_px);
    parts.frame_maker = std::make_unique<FrameMaker>(display, std::move(maker_parts));
    parts.make_method = [display, supplies](const std::string& chosen) {
        return make_method(display, chosen, supplies);
    };
    parts.color_encoder = *std::move(color_encoder);
    parts.depth_encoder = *std::move(depth_encoder);
    return admission;
}

}  // namespace macula
