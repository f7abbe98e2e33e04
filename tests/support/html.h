// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks of every page that this program writes.

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/has.h"

namespace forceshade::tests {

inline std::size_t count(const std::string& text, const std::string& wanted) {
  std::size_t found = 0;
  for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) ++found;
  return found;
}

// The first group of each match.
inline std::vector<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match) found.push_back((*match)[1]);
  return found;
}

// The page has a picture at least.
inline void expect_needs_nothing_from_elsewhere(const std::string& page) {
  EXPECT_FALSE(has(page, "<script"));
  EXPECT_FALSE(has(page, "<link"));
  EXPECT_FALSE(has(page, "@import"));
  const auto addresses = matches(page, R"re((?:src|href|action)\s*=\s*["']([^"']{1,5}))re");
  EXPECT_FALSE(addresses.empty());
  for (const std::string& address : addresses) EXPECT_TRUE(address[0] == '#' || address == "data:") << address;
  for (const std::string& address : matches(page, R"re(url\(["']?([^)]))re")) EXPECT_EQ(address, "#");
}

inline void expect_every_id_once_and_none_missing(const std::string& page, std::size_t least) {
  const auto ids = matches(page, R"re(\sid=["']([^"']+))re");
  const std::set<std::string> distinct(ids.begin(), ids.end());
  EXPECT_GT(ids.size(), least);
  EXPECT_EQ(ids.size(), distinct.size());
  for (const std::string& used : matches(page, R"re((?:href=["']#|url\(#)([^"')]+))re"))
    EXPECT_TRUE(distinct.contains(used)) << used;
}

}  // namespace forceshade::tests
