#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "masks/display_file.h"

/// Any bytes: the parser answers with a display that passes the checks, or with an error that names the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto display = macula::parse_display(text, "fuzz.json");
    if (!display) {
        if (display.error().code != macula::ErrorCode::input_file) std::abort();
        if (display.error().message.find("fuzz.json") == std::string::npos) std::abort();
        return 0;
    }
    if (!macula::validate_display(*display)) std::abort();
    // A valid display can be used, whatever its outline.
    const auto pixels = static_cast<std::size_t>(display->eye_width_px) * display->eye_height_px;
    if (pixels <= 65536 && macula::hidden_pixels(*display, macula::kLeftEye).size() != pixels) std::abort();
    return 0;
}
