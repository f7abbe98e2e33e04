// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Strict reading of JSON from a file that may be damaged or hostile.

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/error.h"

namespace forceshade::properties {

inline constexpr std::size_t kLargestJson = 16U << 20;  // bytes: ten times the largest certificate
inline constexpr int kDeepestJson = 16;                 // levels of objects and arrays; a certificate has six

// Throws Error where the text is no JSON, is larger or deeper than that, or has a key twice in one object. An Error of this
// header names no file, but the place, the value and what was expected: "laws[0].points is 0.5; expected a whole number from 0
// to 2^64 - 1".
nlohmann::json json_from(std::string_view text);

// The bytes of a file, at most so many. expected: "a certificate", for a file that is empty. Throws Error.
std::string text_of_json_file(const std::string& file, const std::string& expected);

// The members of one object, each read once by its key. The getters throw Error where a member is missing or is not what
// its getter gives.
class Fields {
 public:
  // path: of the object, for messages; "" for the outermost.
  Fields(const nlohmann::json& object, std::string path);

  std::uint64_t count(const char* key);
  double number(const char* key);   // finite
  float binary32(const char* key);  // a number that is one exactly
  bool flag(const char* key);
  std::string text(const char* key, bool may_have_lines = false);  // else without any control character
  std::vector<std::string> texts(const char* key);
  std::vector<std::uint64_t> whole_numbers(const char* key);
  std::map<std::string, std::uint64_t> counts(const char* key);
  Fields object(const char* key);
  std::vector<Fields> objects(const char* key);
  std::array<double, 2> interval(const char* key);  // from a lower to a higher number
  const nlohmann::json& any(const char* key);
  bool has(const char* key) const { return json_->contains(key); }
  std::vector<std::string> keys() const;  // in the order of their bytes

  // Refuses the member unless it is as the rest of the certificate says it must be.
  void expect(const char* key, bool is_right, const std::string& expected) const;

  // Throws where a member was not read: it is unknown.
  void end() const;

 private:
  [[noreturn]] void refuse(const std::string& key, const nlohmann::json& value, const std::string& expected) const;
  std::string plain_text(const std::string& key, const nlohmann::json& value, bool may_have_lines) const;
  std::string place(const std::string& key) const { return path_.empty() ? key : path_ + '.' + key; }

  const nlohmann::json* json_;
  std::string path_;
  std::set<std::string> read_;
};

}  // namespace forceshade::properties
