#!/usr/bin/env bash
# clang-format on every source file and clang-tidy on every .cpp of the programs, as configured in the root.
set -euo pipefail
cd "$(dirname "$0")/.."
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    mapfile -t sources < <(git ls-files '*.h' '*.cpp')
else
    mapfile -t sources < <(find protocol masks scenes server client tests -name '*.h' -o -name '*.cpp')
fi
clang-format --dry-run --Werror "${sources[@]}"
echo "clang-format: ${#sources[@]} files clean"

build=build/release
cmake --preset release >/dev/null
cmake --build --preset release -- --quiet  # clang-tidy needs what the build generates
mapfile -t units < <(printf '%s\n' "${sources[@]}" | grep -E '^(protocol|masks|scenes|server|client)/.*\.cpp$')
printf '%s\n' "${units[@]}" | xargs -P "$(nproc)" -n 4 clang-tidy -p $build --quiet 2>/dev/null
echo "clang-tidy: ${#units[@]} files clean"
