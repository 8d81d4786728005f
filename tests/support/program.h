#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace macula::testing {

/// A folder that goes with its owner.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Writes a file and returns its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

private:
    std::filesystem::path path_;
};

/// A running program, its standard output and error in one text.
class Program {
public:
    /// Starts it; `environment` is added to this process's, as NAME=VALUE.
    explicit Program(const std::string& path, const std::vector<std::string>& arguments,
                     const std::vector<std::string>& environment = {});
    /// Kills it if it still runs.
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// Exit code; 128 + signal if a signal ended it; nothing if it still runs after the time.
    std::optional<int> wait(std::chrono::milliseconds timeout = std::chrono::seconds(60));
    void signal(int number) const;
    [[nodiscard]] std::string output() const;
    /// First group of the first match of a regular expression in the output, once it is there.
    std::optional<std::string> wait_for_output(const std::string& regex,
                                               std::chrono::milliseconds timeout = std::chrono::seconds(60));

private:
    TemporaryFolder folder_;
    pid_t process_ = -1;
    std::optional<int> exit_code_;
};

}  // namespace macula::testing
