#include "client/parts.h"

#include <charconv>
#include <filesystem>
#include <utility>

#include "client/device/replay.h"
#include "client/device/simulation.h"
#include "client/present/compositor_choice.h"
#include "client/present/make_compositor.h"
#include "client/present/taa_settings.h"
#include "client/spec.h"
#include "protocol/gl/context.h"

namespace macula {

Expected<std::unique_ptr<TrackSource>> make_source(const std::string& gaze,
                                                   const std::function<void(const std::string&)>& warn) {
    const auto spec = parse_spec(gaze, "--gaze");
    if (!spec) return tl::unexpected(spec.error());
    if (spec->kind == "sim") {
        if (auto known = only_settings(*spec, {}); !known) return tl::unexpected(known.error());
        std::uint64_t seed = 1;
        const char* end = spec->target.data() + spec->target.size();
        const auto [stop, problem] = std::from_chars(spec->target.data(), end, seed);
        if (!spec->target.empty() && (problem != std::errc() || stop != end)) {
            return fail(ErrorCode::option, "--gaze sim:SEED needs a whole number, not '" + spec->target + "'");
        }
        return make_simulation(seed);
    }
    if (spec->kind == "replay") {
        if (auto known = only_settings(*spec, {"loop"}); !known) return tl::unexpected(known.error());
        if (spec->target.empty()) return fail(ErrorCode::option, "--gaze replay:FILE needs a file");
        auto recording = load_recording(spec->target);
        if (!recording) return tl::unexpected(recording.error());
        if (recording->skipped_rows > 0) {
            warn(spec->target + ": " + std::to_string(recording->skipped_rows) + " of " +
                 std::to_string(recording->skipped_rows + recording->samples.size()) +
                 " rows are broken and were skipped; the first is " + recording->first_problem);
        }
        return make_replay(std::move(*recording), spec->settings.contains("loop"));
    }
    return fail(ErrorCode::option, "--gaze " + gaze + ": expected sim:SEED or replay:FILE");
}

Expected<std::vector<std::unique_ptr<PictureSink>>> make_sinks(const std::vector<std::string>& displays) {
    std::vector<std::unique_ptr<PictureSink>> sinks;
    for (const std::string& display : displays) {
        const auto spec = parse_spec(display, "--display");
        if (!spec) return tl::unexpected(spec.error());
        const bool png = spec->kind == "png";
        auto known = png ? only_settings(*spec, {"every"}) : only_settings(*spec, {});
        if (!known) return tl::unexpected(known.error());
        if (spec->kind == "null" && spec->target.empty()) {
            sinks.push_back(make_null_sink());
            continue;
        }
        if ((!png && spec->kind != "mp4") || spec->target.empty()) {
            return fail(ErrorCode::option, "--display " + display + ": expected null, png:FOLDER or mp4:FILE");
        }
        const auto every = positive_setting(*spec, "every", 1);
        if (!every) return tl::unexpected(every.error());
        auto sink = png ? make_png_sink(spec->target, *every) : make_mp4_sink(spec->target);
        if (!sink) return tl::unexpected(sink.error());
        sinks.push_back(std::move(*sink));
    }
    return sinks;
}

Expected<std::unique_ptr<Study>> make_study(const ClientOptions& options) {
    if (options.study.empty()) return nullptr;
    if (!options.sampling.empty())
        return fail(ErrorCode::option, "--study chooses the sampling: give --study-reference and not --sampling");
    if (auto good = check_study(options.study_settings); !good) return tl::unexpected(good.error());
    auto log = StudyLog::open(options.study);
    if (!log) return tl::unexpected(log.error());
    return std::make_unique<Study>(options.study_settings, std::move(*log));
}

Hello make_hello(const Display& headset, const ClientOptions& options, const std::string& token) {
    Hello hello;
    hello.client_name = "macula-client";
    hello.token = token;
    hello.display_name = headset.name;
    hello.eye_width_px = headset.eye_width_px;
    hello.eye_height_px = headset.eye_height_px;
    hello.refresh_hz = headset.refresh_hz;
    for (std::size_t eye = 0; eye < kEyeCount; ++eye) {
        const EyeDisplay& from = headset.eyes[eye];
        hello.eyes[eye] = {from.tangents, from.head_from_eye, from.visible_outline};
    }
    hello.sampling = options.study.empty() ? options.sampling : options.study_settings.reference;
    hello.codecs = {"h264"};
    hello.accumulates = options.taa != "off";
    return hello;
}

Expected<Credentials> find_credentials(const ClientOptions& options) {
    Credentials credentials{options.fingerprint, options.token};
    if (!credentials.fingerprint.empty() && !credentials.token.empty()) return credentials;
    std::filesystem::path folder = options.state;
    if (folder.empty()) {
        const auto standard = default_state_folder();
        if (!standard) return tl::unexpected(standard.error());
        folder = *standard;
    }
    const auto found = load_credentials(folder);
    if (!found) {
        return fail(found.error().code,
                    found.error().message + "; for a server on another machine give --fingerprint and --token");
    }
    if (credentials.fingerprint.empty()) credentials.fingerprint = found->fingerprint;
    if (credentials.token.empty()) credentials.token = found->token;
    return credentials;
}

Expected<std::unique_ptr<Compositor>> make_compositor(const ClientOptions& options, const Display& headset,
                                                      const std::function<void(const std::string&)>& log) {
    const auto context = parse_context_kind(options.context);
    if (!context) return tl::unexpected(context.error());
    const TaaOn on = options.taa_on == "gl" ? TaaOn::gl : options.taa_on == "cpu" ? TaaOn::cpu : TaaOn::automatic;
    const kernels::TaaWeights weights = options.taa == "paper" ? paper_taa_weights()
                                        : options.taa == "off" ? no_taa_weights()
                                                               : default_taa_weights();
    auto compositor = choose_compositor(on, *context, headset, weights, log);
    if (compositor) log("temporal anti-aliasing: " + options.taa + ", on " + (*compositor)->name());
    return compositor;
}

}  // namespace macula
