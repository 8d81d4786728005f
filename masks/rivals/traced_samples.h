#pragma once

#include <cstdint>

#include "masks/rivals/bit_rows.h"
#include "masks/sample_plan.h"

namespace macula {

/// Appends all addresses of a grid of the set's size, offset + y * width + x: members to the plan's trace order, in
/// blocks of 16x16 and along the Morton curve inside, so that neighbouring rays share packets, the others to
/// `untraced`.
void append_samples(const BitRows& traced, std::uint32_t offset, SamplePlan& plan);

/// Empties what append_samples() appends to, and what other kinds of plans fill.
void clear_plan(SamplePlan& plan);

}  // namespace macula
