#!/usr/bin/env bash
# fails_test.sh FORCESHADE NAMES ADAPTER: conform finds these invariants to fail, with | between them, and no others.
set -u
found=$("$1" conform simulator --command "$3" | sed -n 's/^FAILED: \([^,:]*\).*/\1/p' | paste -sd '|')
[ "$found" = "$2" ] || { echo "expected: $2"; echo "got: $found"; exit 1; }
