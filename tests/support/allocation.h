#pragma once

#include <cstddef>

namespace macula {

/// Bytes that operator new has handed out since the start, in a program that links allocation.cpp.
std::size_t allocated_bytes();

}  // namespace macula
