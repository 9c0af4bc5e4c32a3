# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# What the with-* here share. Sourced; the caller has set -euo pipefail.

# Ends a test that cannot run here.
skip() {
  echo "$(basename "$0"): $*" >&2
  exit 77
}

# needs PROGRAM...: where one is not installed, the test cannot run.
needs() {
  local program
  for program in "$@"; do
    command -v "$program" >/dev/null || skip "$program is not installed; run packaging/test, which installs it."
  done
}
