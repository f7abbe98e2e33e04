# Sourced by the tests that run Gappa's scripts: a script holds definitions and then pieces, "#! piece NAME" and a proposition
# over the definitions.

pieces_of() { sed -n 's/^#! piece //p' "$1"; }

# The script of one piece by itself: the definitions, which come before the first piece, and the proposition.
piece() { awk -v head="#! piece $2" '/^#! piece /{on = $0 == head; seen = 1; next} on || !seen' "$1"; }
