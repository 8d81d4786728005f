// macula-chart: measures rows. Reads their names (tests/pipeline/row.h) from standard input, one a line, and answers
// each with one line: of CSV, or `error: ...`. The first line it writes is the header of the table.

#include <cstdio>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>

#include "tests/chart/measure.h"

int main(int argc, char** argv) {
    using namespace macula::test;
    std::string clips;
    CLI::App app(
        "Measures rows of the chart of speed against accuracy: names on standard input, CSV on standard output",
        "macula-chart");
    app.add_option("--clips", clips, "Folder for the last row's clip: test.npy, reference.npy, gaze.csv")
        ->check(CLI::ExistingDirectory);
    CLI11_PARSE(app, argc, argv);

    Measurer measurer(clips);
    std::cout << csv_header() << std::endl;
    bool all_measured = true;
    for (std::string name; std::getline(std::cin, name);) {
        if (name.empty()) continue;
        const auto row = parse_row(name);
        const auto measured = row ? measurer.measure(*row) : macula::Expected<Measurement>(tl::unexpected(row.error()));
        all_measured = all_measured && measured;
        std::cout << (measured ? csv_line(*measured) : "error: " + measured.error().message) << std::endl;
    }
    return all_measured ? 0 : 1;
}
