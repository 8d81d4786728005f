#include "server/options.h"

#include <charconv>
#include <map>

#include "protocol/base/command_line.h"

namespace macula {

std::variant<Options, int> parse_options(int argc, char** argv) {
    Options options;
    CLI::App app{"macula-server: ray-traces foveated stereo frames for the gaze that a client sends.", "macula-server"};
    options.scene.level_camera = true;
    add_scene_options(app, options.scene);
    app.add_option("--listen", options.listen, "ADDRESS:PORT, [IPV6]:PORT, or *:PORT for every address; port 0: any")
        ->capture_default_str();
    app.add_option(
           "--sampling", options.sampling,
           "How to make frames for clients without a wish of their own, [SAMPLER:]PRESET[/RECONSTRUCTION]: 27, full, "
           "mesh:paper-27/raster, layers:27, ... (server/METHODS.md)")
        ->capture_default_str();
    app.add_option("--mesh", options.mesh, "Mesh file, made by macula-mask, that sampling mesh:file is made with");
    app.add_option("--mesh-cache", options.mesh_cache,
                   "Folder that meshes are kept in (default: $XDG_CACHE_HOME/macula/meshes or ~/.cache/macula/meshes)");
    app.add_option("--context", options.context, "GL context: auto, egl (a GPU), surfaceless or osmesa")
        ->check(CLI::IsMember({"auto", "egl", "surfaceless", "osmesa"}))
        ->capture_default_str();
    app.add_option("--reconstruct-on", options.reconstruct_on, "gl, cpu, or auto: the faster one, measured at start")
        ->check(CLI::IsMember({"auto", "gl", "cpu"}))
        ->capture_default_str();
    app.add_option("--encoder", options.encoder, "H.264 encoder of libavcodec: libx264, h264_nvenc, h264_vaapi, ...")
        ->capture_default_str();
    app.add_option("--bit-rate", options.bit_rate_bps, "Of each client's video, in bit/s, with suffix k or M")
        ->transform(CLI::AsNumberWithUnit(std::map<std::string, std::int64_t>{{"k", 1'000}, {"M", 1'000'000}}))
        ->check(CLI::Range(std::int64_t{100'000}, std::int64_t{1'000'000'000}))
        ->capture_default_str();
    app.add_option("--state", options.state,
                   "Folder of key, certificate and token (default: $XDG_STATE_HOME/macula or ~/.local/state/macula)");
    app.add_option("--max-clients", options.max_clients, "Clients served at once")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    app.add_option("--threads", options.threads, "Threads that trace and reconstruct; 0: one for each processor")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    app.add_option("--log-level", options.log_level, "debug, info, warning or error")
        ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
        ->capture_default_str();

    if (const auto exit_code = read_command_line(app, MACULA_VERSION, argc, argv)) return *exit_code;
    return options;
}

Expected<Endpoint> parse_endpoint(const std::string& text) {
    const std::string advice =
        "--listen " + text + ": expected ADDRESS:PORT, [IPV6]:PORT or *:PORT, for example 127.0.0.1:7470";
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return fail(ErrorCode::option, advice);
    Endpoint endpoint;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, endpoint.port);
    if (error != std::errc() || stop != end) return fail(ErrorCode::option, advice);

    std::string address = text.substr(0, colon);
    const bool bracketed = address.size() >= 2 && address.front() == '[' && address.back() == ']';
    if (bracketed) address = address.substr(1, address.size() - 2);
    if (address.empty() || bracketed != (address.find(':') != std::string::npos))
        return fail(ErrorCode::option, advice);
    if (address != "*") endpoint.address = address;
    return endpoint;
}

}  // namespace macula
