#include "masks/tool/output_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

namespace macula {
namespace {

namespace fs = std::filesystem;

tl::unexpected<Error> cannot(const std::string& path, const std::string& why) {
    return fail(ErrorCode::output, path + ": it cannot be written: " + why);
}

}  // namespace

Expected<void> check_writable(const std::string& path) {
    if (path == "-") return {};
    std::error_code error;
    if (fs::is_directory(path, error)) return cannot(path, "it is a folder");
    fs::path folder = fs::path(path).parent_path();
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, error)) return cannot(path, "there is no folder " + folder.string());
    if (::access(folder.c_str(), W_OK) != 0) return cannot(path, "the folder is read-only");
    return {};
}

Expected<void> write_whole(const std::string& path, std::string_view bytes) {
    if (path == "-") {
        std::cout.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
        if (!std::cout) return cannot("standard output", "it is closed or full");
        return {};
    }
    const std::string partial = path + ".partial";
    std::ofstream file(partial, std::ios::binary | std::ios::trunc);
    if (!file) return cannot(path, "check the folder and its permissions");
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    std::error_code error;
    if (!file) {
        fs::remove(partial, error);
        return cannot(path, "is the disk full?");
    }
    fs::rename(partial, path, error);
    if (!error) return {};
    const std::string why = error.message();
    fs::remove(partial, error);
    return cannot(path, why);
}

Expected<void> write_whole(const std::string& path, std::span<const std::uint8_t> bytes) {
    return write_whole(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace macula
