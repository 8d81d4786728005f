#include "client/options.h"

#include <charconv>
#include <iterator>
#include <sstream>

#include "protocol/base/command_line.h"
#include "protocol/transport/tls.h"

namespace macula {

namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text.append(text.empty() ? "" : " ").append(name);
    return text;
}

/// The detection experiment's options; their own group, since nobody else needs them.
void add_study_options(CLI::App& app, ClientOptions& options) {
    constexpr const char* kGroup = "Study (tests/study/README.md)";
    StudySettings& study = options.study_settings;
    app.add_option("--study", options.study,
                   "Run the detection experiment: masks replace one another, keys that are pressed on the terminal, or "
                   "lines of other standard input, go to this CSV file")
        ->group(kGroup);
    app.add_option("--study-reference", study.reference, "What is shown first, a sampling as above")
        ->capture_default_str()
        ->group(kGroup);
    // One text, not a list: a list's default value would be printed as what cannot be read back.
    app.add_option_function<std::string>(
           "--study-masks",
           [&study](const std::string& text) {
               std::istringstream names(text);
               study.masks.assign(std::istream_iterator<std::string>(names), {});
           },
           "What is then shown in random order: samplings, with spaces between them")
        ->default_str(joined(study.masks))
        ->group(kGroup);
    const auto add_seconds = [&](const char* name, double& seconds, const char* what) {
        app.add_option(name, seconds, what)->check(CLI::Range(0.0, 1e6))->capture_default_str()->group(kGroup);
    };
    add_seconds("--study-begin", study.begin_s, "Seconds of the reference");
    add_seconds("--study-interval", study.interval_s, "Seconds between changes, on average");
    add_seconds("--study-spread", study.spread_s, "Intervals are up to so many seconds shorter or longer, evenly");
    add_seconds("--study-length", study.length_s, "Seconds of the whole, the reference included");
    app.add_option("--study-seed", study.seed, "Of masks and intervals")->capture_default_str()->group(kGroup);
}

}  // namespace

std::variant<ClientOptions, int> parse_client_options(int argc, char** argv) {
    ClientOptions options;
    CLI::App app{"macula-client: sends head and gaze to a server and shows the frames that come back.",
                 "macula-client"};
    app.add_option("--connect", options.connect,
                   "Server: HOST, HOST:PORT or [IPV6]:PORT; none: only --record, for --seconds, at once")
        ->capture_default_str();
    app.add_option("--gaze", options.gaze,
                   "Head and eyes: sim:SEED, replay:FILE, or replay:FILE?loop (client/device/RECORDING.md)")
        ->capture_default_str();
    app.add_option("--display", options.displays,
                   "null, png:FOLDER, png:FOLDER?every=N or mp4:FILE; may be given several times")
        ->default_str("null");
    app.add_option("--headset", options.headset, "Display geometry: vive, desktop, or a file (masks/display.md)")
        ->capture_default_str();
    app.add_option("--sampling", options.sampling,
                   "How the server makes frames: full, percent (54, 41, 27, 18), mesh:paper-27/raster, layers:27, ... "
                   "(server/METHODS.md); empty: the server's choice")
        ->capture_default_str();
    app.add_option("--token", options.token, "Secret that the server asks for (default: from the state folder)");
    app.add_option("--fingerprint", options.fingerprint,
                   "Of the server's certificate, as the server prints it (default: from the state folder)");
    app.add_option("--state", options.state,
                   "The server's state folder, on the same machine (default: $XDG_STATE_HOME/macula or "
                   "~/.local/state/macula)");
    app.add_option("--seconds", options.seconds, "End after this time; 0: with the recording, or never")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    app.add_option("--frames", options.frames, "End after this many frames; 0: no limit")
        ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 40))
        ->capture_default_str();
    app.add_option("--stats", options.stats, "CSV file that gets one row a frame");
    app.add_option("--summary", options.summary, "File that gets the summary, as lines of name=value");
    app.add_option("--record", options.record, "File that gets the head and eye movement (client/device/RECORDING.md)");
    app.add_option("--taa", options.taa,
                   "Temporal anti-aliasing: macula, paper (half and half with the last picture), or off")
        ->check(CLI::IsMember({"macula", "paper", "off"}))
        ->capture_default_str();
    app.add_option("--taa-on", options.taa_on,
                   "What runs it and the late reprojection: gl, cpu, or auto: the faster one, measured at start")
        ->check(CLI::IsMember({"auto", "gl", "cpu"}))
        ->capture_default_str();
    app.add_option("--context", options.context, "GL context: auto, egl (a GPU), surfaceless or osmesa")
        ->check(CLI::IsMember({"auto", "egl", "surfaceless", "osmesa"}))
        ->capture_default_str();
    app.add_option("--retry-seconds", options.retry_seconds,
                   "Give up when there has been no server for so long; 0: at the first failure")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    add_study_options(app, options);
    app.add_option("--log-level", options.log_level, "debug, info, warning or error")
        ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
        ->capture_default_str();

    if (const auto exit_code = read_command_line(app, MACULA_VERSION, argc, argv)) return *exit_code;
    return options;
}

Expected<std::pair<std::string, std::uint16_t>> parse_server_address(const std::string& text) {
    const auto malformed = [&] {
        return fail(ErrorCode::option, "--connect " + text + ": expected HOST, HOST:PORT or [IPV6]:PORT");
    };
    std::string host = text;
    std::uint16_t port = kDefaultPort;
    const std::size_t bracket = text.rfind(']');
    const std::size_t colon = text.rfind(':');
    const bool bare_ipv6 = bracket == std::string::npos && text.find(':') != colon;
    if (colon != std::string::npos && !bare_ipv6 && (bracket == std::string::npos || colon > bracket)) {
        const char* end = text.data() + text.size();
        const auto [stop, problem] = std::from_chars(text.data() + colon + 1, end, port);
        if (problem != std::errc() || stop != end || port == 0) return malformed();
        host = text.substr(0, colon);
    }
    if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
    if (host.empty() || host.find_first_of("[] ") != std::string::npos) return malformed();
    return std::pair{host, port};
}

}  // namespace macula
