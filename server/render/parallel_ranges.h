#pragma once

#include <functional>

namespace macula {

/// Calls `body(begin, end)` for ranges that together are [first, last), on the shared thread pool; ranges longer than
/// `grain` may be split. What the caller wrote before is seen by the body, and what the body wrote by the caller after.
void parallel_ranges(int first, int last, int grain, const std::function<void(int begin, int end)>& body);

}  // namespace macula
