// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lists of words in a sentence.

#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade {

inline constexpr auto in_digits = [](auto whole) { return std::to_string(whole); };

// The words of a range, or what word_of makes of each of its elements, with `between` between two of them, and none before the
// first word that is not empty. last: in its place before the last word, where it is given: "1, 2 and 3".
template <class Range, class WordOf = std::identity>
std::string joined(const Range& range, std::string_view between, const WordOf& word_of = {}, std::string_view last = {}) {
  std::string all;
  auto left = std::distance(std::begin(range), std::end(range));
  for (const auto& each : range) {
    const bool is_last = --left == 0;
    if (!all.empty()) all += is_last && !last.empty() ? last : between;
    all += std::invoke(word_of, each);
  }
  return all;
}

// The first of many; all where there are no more.
template <class T>
std::span<const T> first_of(std::size_t most, const std::vector<T>& all) {
  return std::span(all).first(all.size() < most ? all.size() : most);
}

}  // namespace forceshade
