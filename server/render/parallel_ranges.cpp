#include "server/render/parallel_ranges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

// TBB's library is not built with ThreadSanitizer, which then takes every hand-over between its threads for a race, in
// its headers' templates too. So this file is not instrumented, and tells the sanitizer what TBB guarantees.
#if defined(MACULA_THREAD_SANITIZER)
#include <sanitizer/tsan_interface.h>
#endif

namespace macula {

namespace {

#if defined(MACULA_THREAD_SANITIZER)
void hand_over(char& place) {
    __tsan_release(&place);
}
void take_over(char& place) {
    __tsan_acquire(&place);
}
#else
void hand_over(char& /*place*/) {}
void take_over(char& /*place*/) {}
#endif

}  // namespace

void parallel_ranges(int first, int last, int grain, const std::function<void(int begin, int end)>& body) {
    char given = 0;
    char returned = 0;
    hand_over(given);
    tbb::parallel_for(tbb::blocked_range<int>(first, last, grain), [&](const tbb::blocked_range<int>& range) {
        take_over(given);
        body(range.begin(), range.end());
        hand_over(returned);
    });
    take_over(returned);
}

}  // namespace macula
