// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words of what a call throws, and the words that a text must have.

#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

namespace forceshade::tests {

// Empty where nothing is thrown; what is no Error is thrown on.
template <class Error = std::exception, class Call>
std::string thrown_by(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// The words without their beginning, which must be this place; none of none.
inline std::string without(const std::string& place, const std::string& words) {
  if (words.empty()) return words;
  EXPECT_TRUE(words.starts_with(place)) << words;
  return words.substr(std::min(words.size(), place.size()));
}

inline void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\nnot in: " << text;
}

}  // namespace forceshade::tests
