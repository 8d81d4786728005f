#pragma once

#include <iostream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "protocol/base/error.h"

namespace macula {

/// Completes a program's option table with what both programs have, --version, --config FILE and --print-config, and
/// reads command line and configuration file: defaults < file < command line. Returns an exit code where that is all
/// there is to do: 0 after --help, --version and --print-config, ErrorCode::option after a mistake, which is told on
/// standard error. The app's name is the program's.
inline std::optional<int> read_command_line(CLI::App& app, const std::string& version, int argc, char** argv) {
    bool print_config = false;
    app.set_version_flag("--version", app.get_name() + " " + version);
    app.set_config("--config", "", "TOML file with these options; the command line wins over it");
    app.allow_config_extras(CLI::config_extras_mode::error);
    app.add_flag("--print-config", print_config, "Print the options in effect as TOML, and end")->configurable(false);
    try {
        app.parse(argc, argv);
        if (!print_config) return std::nullopt;
        std::cout << app.config_to_str(true, true);
        return 0;
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::Error& error) {
        std::cerr << app.get_name() << ": " << error.what() << "; see " << app.get_name() << " --help\n";
        return static_cast<int>(ErrorCode::option);
    }
}

}  // namespace macula
