#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/study/schedule.h"
#include "protocol/base/error.h"

namespace macula {

/// What macula-client is started with: defaults, then the configuration file, then the command line.
struct ClientOptions {
    std::string connect = "localhost:7470";
    std::string gaze = "sim:1";
    std::vector<std::string> displays = {"null"};
    std::string headset = "desktop";
    std::string sampling;  ///< empty leaves the choice to the server
    std::string token;
    std::string fingerprint;
    std::string state;   ///< empty: default_state_folder()
    double seconds = 0;  ///< 0: until the recording ends, or forever
    std::int64_t frames = 0;
    std::string stats;
    std::string summary;
    std::string record;
    std::string taa = "macula";
    std::string taa_on = "auto";
    std::string context = "auto";
    double retry_seconds = 30;
    std::string log_level = "info";
    std::string study;  ///< CSV file; empty: no study
    StudySettings study_settings;
};

/// Reads the command line and the configuration file that it names. Returns an exit code instead where that is all
/// there is to do: 0 after --help, --version and --print-config, ErrorCode::option after a mistake, which is told
/// on standard error.
std::variant<ClientOptions, int> parse_client_options(int argc, char** argv);

/// Parses HOST:PORT, [IPV6]:PORT or HOST (then the default port). Errors: `option`.
Expected<std::pair<std::string, std::uint16_t>> parse_server_address(const std::string& text);

}  // namespace macula
