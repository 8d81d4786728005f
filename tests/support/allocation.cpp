#include "tests/support/allocation.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::size_t> total_bytes{0};
}

void* operator new(std::size_t size) {
    total_bytes += size;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace macula {

std::size_t allocated_bytes() {
    return total_bytes;
}

}  // namespace macula
