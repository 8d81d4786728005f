#include "tests/stability/case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "tests/support/pictures.h"

namespace macula::test {
namespace {

/// Four significant digits, as a person would write them.
std::string written(double value) {
    char text[32];
    if (std::abs(value) >= 1000.0 && std::abs(value) < 1e9)
        std::snprintf(text, sizeof text, "%.0f", value);
    else
        std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// One write, so that rows of programs that run side by side stay whole.
void print_row(const std::string& row) {
    std::fputs(row.c_str(), stdout);
    std::fflush(stdout);
}

/// The folder of a case's pictures, or why there is none.
std::string save(const std::string& name, const CasePictures& pictures) {
    const std::filesystem::path folder = std::filesystem::path(MACULA_STABILITY_PICTURES) / name;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return folder.string() + ": " + error.message();
    const auto put = [&](const char* file, const ColorImage& picture) -> std::string {
        const auto done = write_png((folder / file).string(), picture);
        return done ? "" : " (" + done.error().message + ")";
    };
    std::string failures = put("shown.png", pictures.shown) + put("reference.png", pictures.reference);
    failures += put("difference.png", compare(pictures.shown, pictures.reference).picture);
    return folder.string() + failures;
}

}  // namespace

void check(const Case& measured, const std::function<CasePictures()>& pictures) {
    const bool at_most = measured.side == Side::at_most;
    // Written so that what is not a number is beyond the bound.
    const bool holds = at_most ? measured.value <= measured.bound : measured.value >= measured.bound;
    const std::string bound = (at_most ? "≤ " : "≥ ") + written(measured.bound);
    print_row("| " + measured.name + " | " + measured.figure + " | " + written(measured.value) + " | " + bound +
              (holds ? "" : ", **broken**") + " | " + measured.reason + " |\n");
    if (holds) return;
    std::string where;
    if (pictures) where = "\npictures: " + save(measured.name, pictures());
    ADD_FAILURE() << measured.name << ": " << measured.figure << " is " << written(measured.value) << ", bound "
                  << bound << ": " << measured.reason << where;
}

void state(const std::string& name, const std::string& figure, double value, const std::string& remark) {
    print_row("| " + name + " | " + figure + " | " + written(value) + " | | " + remark + " |\n");
}

bool whole_suite() {
    const char* asked = std::getenv("MACULA_STABILITY");
    return asked != nullptr && std::string_view(asked) == "full";
}

}  // namespace macula::test
