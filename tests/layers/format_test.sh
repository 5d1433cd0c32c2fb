#!/usr/bin/env bash
# Every file of C and C++ is as clang-format writes it. Status 77: cannot be said here.
set -euo pipefail
cd "$(dirname "$0")/../.."
# How a file is formatted depends on the version; Debian 12 has 14.
clang_format=$(command -v clang-format-14 || command -v clang-format) || { echo "no clang-format" && exit 77; }
git rev-parse --git-dir >/dev/null 2>&1 || { echo "not a git repository" && exit 77; }
if ! git ls-files '*.h' '*.cpp' '*.c' | grep -v '/generated/' | xargs -P "$(nproc)" -n 200 "$clang_format" --dry-run -Werror; then
  echo "clang-format differs (fix with: $clang_format -i FILE; made with version 14, this is $("$clang_format" --version))"
  exit 1
fi
