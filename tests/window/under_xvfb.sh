#!/usr/bin/env bash
# under_xvfb.sh PROGRAM ARGUMENTS...: runs it on a display of its own, in memory. Exit code 77, which CTest takes for a skipped
# test, where this machine has no such display.
set -euo pipefail
for needed in xvfb-run xauth xdotool; do
  command -v "$needed" > /dev/null || { echo "SKIPPED: expected $needed (Debian: xvfb, xauth, xdotool)"; exit 77; }
done
export LIBGL_ALWAYS_SOFTWARE=1 LC_ALL=C.UTF-8
# Graphics drivers and fontconfig keep what they have allocated.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
unset WAYLAND_DISPLAY
exec xvfb-run --auto-servernum --server-args="-screen 0 1600x1000x24 -nolisten tcp -noreset" "$@"
