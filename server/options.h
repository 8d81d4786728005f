#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "protocol/base/error.h"
#include "server/scene_options.h"

namespace macula {

/// What macula-server is started with: defaults, then the configuration file, then the command line.
struct Options {
    SceneOptions scene;
    std::string listen = "*:7470";
    std::string sampling = "27";
    std::string mesh;        ///< file of sampling `mesh:file`
    std::string mesh_cache;  ///< folder of made meshes; empty: default_mesh_cache()
    std::string context = "auto";
    std::string reconstruct_on = "auto";
    std::string encoder = "libx264";
    std::int64_t bit_rate_bps = 25'000'000;
    std::string state;  ///< empty: default_state_folder()
    int max_clients = 4;
    int threads = 0;  ///< 0: one for each processor
    std::string log_level = "info";
};

/// Reads the command line and the configuration file that it names. Returns an exit code instead where that is all
/// there is to do: 0 after --help, --version and --print-config, ErrorCode::option after a mistake, which is told
/// on standard error.
std::variant<Options, int> parse_options(int argc, char** argv);

/// Where to listen.
struct Endpoint {
    std::string address;  ///< empty: every address of this machine
    std::uint16_t port = 0;
};

/// Parses ADDRESS:PORT, [IPV6]:PORT or *:PORT. Errors: `option`.
Expected<Endpoint> parse_endpoint(const std::string& text);

}  // namespace macula
