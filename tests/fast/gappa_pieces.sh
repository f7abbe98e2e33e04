# Sourced by the tests that run Gappa's scripts. A script of fast/ holds definitions and then pieces: "#! piece NAME", a proposition
# over the definitions, and its rewritings.
#
# "p rel= a * b;" defines p as the result of one operation of which no more is used than that it is within 2^-53 of the exact
# result, relative. In Gappa's language that is a hypothesis on a number p of its own, so it holds for every way to round. (Gappa's
# own add_rel and mul_rel state less, since they are functions, and Gappa's library for Coq does not know them.)
# "z any= float<ieee_32, ne>(z_);" says what z is in the header, for the test that compares the operations. The proof uses nothing of
# it, so z is any number there, and may be scaled by any number.

pieces_of() { sed -n 's/^#! piece //p' "$1"; }

# A piece as it stands in its script.
piece_text() { awk -v wanted="$2" '/^#! piece / { is_wanted = $3 == wanted } is_wanted' "$1"; }  # script, name

# The script of one piece by itself, for Gappa: the definitions that it uses, of which those with rel= become hypotheses.
piece() {  # script, name
  awk -v wanted="$2" '
    function use(text,    words, count, i) {
      count = split(text, words, /[^A-Za-z0-9_]+/)
      for (i = 1; i <= count; ++i) used[words[i]] = 1
    }
    /^#! piece / { is_wanted = $3 == wanted; is_in_pieces = 1; next }
    { sub(/#.*/, "") }
    !is_in_pieces { definitions = definitions $0 "\n" }
    is_wanted { proposition = proposition $0 "\n" }
    END {
      use(proposition)
      for (i = split(definitions, all, ";") - 1; i >= 1; --i) {
        sub(/^[ \n]+/, "", all[i])
        match(all[i], /^[A-Za-z0-9_]+/)
        name = substr(all[i], 1, RLENGTH)
        if (RLENGTH > 0 && !(name in used)) continue
        rest = substr(all[i], RLENGTH + 1)
        if (rest ~ /^ any= /) continue
        use(rest)
        if (rest ~ /^ rel= /)
          hypotheses = "|" name " -/ (" substr(rest, 7) ")| <= 1b-53 /\\\n" hypotheses
        else
          kept = all[i] ";\n" kept
      }
      brace = index(proposition, "{")
      printf "%s%s\n%s%s", kept, substr(proposition, 1, brace), hypotheses, substr(proposition, brace + 1)
    }' "$1"
}

# Gappa's output for a piece, one line for each: "piece: expression in [low, high]", the ends to the six digits that Gappa prints of
# them (their 60-bit fractions differ from run to run in the last places), or "piece: Error: ...".
intervals() {  # piece; Gappa's output comes from the standard input
  sed -E 's/-?[0-9]+(b-?[0-9]+)? \{([^,]*),[^}]*\}/\2/g' | sed -n "s/^  *\(.* in \[.*\]\)\$/$1: \1/p; s/^Error.*/$1: &/p"
}
