# Read by tests that type what a page says.

# page_blocks LANGUAGE: the lines of the page's blocks in it, from standard input; a line of a command that ends in \ is joined.
page_blocks() {
  sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/ { /^\`\`\`/d; p }" | sed -e ':a' -e '/\\$/ { N; s/\\\n *//; ba' -e '}'
}

# type_page PAGE: as in one terminal that begins in the folder it is called in, writes each file of the page, which is a block whose line
# before ends with its name in backticks and a colon; runs each block of commands (sh); and expects of the block without a language
# after it that all its lines were printed. A line or end of a line that is ... stands for anything. A block console is not typed.
type_page() {
  local pieces piece part name line terminal said="" typed=0 files=0 lines=0
  pieces=$(mktemp -d)
  terminal=$pieces/.terminal  # its folder and variables, from block to block
  printf 'cd %q\n' "$PWD" > "$terminal"
  awk -v folder="$pieces" '
    /^```./ && !on { on = ++count; kind = substr($0, 4); part = sprintf("%s/%03d.%s", folder, count, kind); printf "" > part
      if (match(before, /`[^`]+`:$/)) print substr(before, RSTART + 1, RLENGTH - 3) > (part ".name"); next }
    /^```$/ && !on { on = ++count; part = sprintf("%s/%03d.said", folder, count); printf "" > part; next }
    /^```$/ { on = 0; close(part); before = ""; next }
    on { print > part; next }
    NF { before = $0 }' "$1"
  for part in "$pieces"/*[a-z]; do
    piece=$(basename "$part")
    case $piece in
      *.name | *.console) ;;
      *.sh)
        typed=$((typed + 1))
        said=$(bash -ec '. "$0"; . "$1"; { export -p; printf "cd %q\n" "$PWD"; } > "$0"' "$terminal" "$part" 2>&1 < /dev/null) ||
          { echo "FAILED: $1: $(cat "$part"): $said"; return 1; } ;;
      *.said)
        while IFS= read -r line; do
          lines=$((lines + 1))
          line=${line%...}
          case $'\n'$said in *$'\n'"$line"*) ;; *) echo "FAILED: $1: expected \"$line\", got: $said"; return 1 ;; esac
        done < "$part" ;;
      *)
        [ -s "$part.name" ] || { echo "FAILED: $1: a block of ${piece#*.} has no name before it"; return 1; }
        files=$((files + 1)); name=$(cat "$part.name"); (. "$terminal" && cp "$part" "$name") || return 1 ;;
    esac
  done
  rm -rf "$pieces"
  echo "$files files, $typed blocks of commands, $lines lines that they print"
}
