#pragma once

#include <cstdint>

#include "tests/stability/trial.h"

namespace macula::test {

/// Share of what was seen before that is still seen `later` frames after it is gone: 0 is no ghost, 1 is all of it. Of
/// pixels of the left eye that show object `background` since then and showed another before, over the judged frames,
/// what history adds (shown less what is shown without history) is projected on what was there before less what is
/// there now.
double ghost(const Trial& trial, const Take& with_history, const Take& without_history, std::uint32_t background,
             int later);

}  // namespace macula::test
