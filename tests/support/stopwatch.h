#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <limits>

#include "protocol/base/clock.h"

namespace macula::test {

/// Wall and processor time since construction. On a machine with other work only the latter is steady.
class Stopwatch {
public:
    [[nodiscard]] double wall_s() const { return static_cast<double>(now_ns() - begin_ns_) * 1e-9; }
    [[nodiscard]] double cpu_s() const { return static_cast<double>(std::clock() - begin_cpu_) / CLOCKS_PER_SEC; }

private:
    std::int64_t begin_ns_ = now_ns();
    std::clock_t begin_cpu_ = std::clock();
};

/// The least of several times.
struct Best {
    double wall_s = std::numeric_limits<double>::infinity();
    double cpu_s = std::numeric_limits<double>::infinity();

    void add(const Stopwatch& watch) {
        wall_s = std::min(wall_s, watch.wall_s());
        cpu_s = std::min(cpu_s, watch.cpu_s());
    }
};

}  // namespace macula::test
