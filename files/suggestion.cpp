// SPDX-License-Identifier: BSD-3-Clause
#include "files/suggestion.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace forceshade::files {
namespace {

constexpr std::size_t kLongestWord = 100;  // the distance takes time that grows with the square

// Insertions, deletions and replacements of a character that make one word of the other.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

bool ends_in_words(std::string_view word, std::string_view last) {
  if (last.empty() || !word.ends_with(last) || word.size() == last.size()) return false;
  const char before = word[word.size() - last.size() - 1];
  return before == '_' || before == '-';
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t least = word.size() / 3 + 2;
  if (word.empty() || word.size() > kLongestWord) return best;
  for (const std::string& candidate : words) {
    const bool is_longer = candidate.starts_with(word), is_shorter = ends_in_words(word, candidate);
    const std::size_t distance = is_longer ? 1 : is_shorter ? 2 : edits(word, candidate);
    if (distance < least) least = distance, best = candidate;
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
  const std::string near = nearest(word, words);
  return near.empty() || near == word ? "" : "; the nearest is " + near;
}

}  // namespace forceshade::files
