// macula-mask: makes sampling masks and meshes, measures them, and draws the figures that explain them.

#include <cstdio>

#include "masks/tool/commands.h"
#include "masks/tool/options.h"

int main(int argc, char** argv) {
    const auto parsed = macula::parse_mask_tool_options(argc, argv);
    if (const int* exit_code = std::get_if<int>(&parsed)) return *exit_code;
    const auto outcome =
        std::visit([](const auto& options) { return macula::run(options); }, std::get<macula::MaskToolOptions>(parsed));
    if (outcome) return 0;
    std::fprintf(stderr, "macula-mask: %s\n", outcome.error().message.c_str());
    return static_cast<int>(outcome.error().code);
}
