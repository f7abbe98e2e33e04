// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads a line of JSON from a third-party program (child_process.h). A wrong key is named with what was expected.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace forceshade::files {

// whose: "renderer", for messages. Throws ProcessFailed for what is no object, has a key twice, or says why its writer failed:
// {"failure":"no licence was found"}.
nlohmann::ordered_json object_in(const std::string& said, const char* whose);

// A value for a message: its beginning, a text in quotes.
std::string shown_json(const nlohmann::ordered_json& value);

// "a", "b" or "c".
std::string one_of(const std::vector<std::string>& words);

// The keys of an object. All of it throws ProcessFailed.
class KeyReader {
 public:
  using Json = nlohmann::ordered_json;

  // what: "the renderer's hello". The object has to outlive the reader.
  KeyReader(const Json& object, std::string what) : object_(object), what_(std::move(what)) {}

  const Json& value(const std::string& key, const std::string& expected) const;
  // As a terminal may show it. A long text is refused.
  std::string text(const std::string& key) const;
  // The index of its word among these.
  std::size_t word(const std::string& key, const std::vector<std::string>& words) const;
  double number(const std::string& key, double least, double most, const std::string& expected) const;
  std::optional<double> number_or_null(const std::string& key, double least, double most, const std::string& expected) const;

  // The reason of one that does not accept what it was sent.
  std::optional<std::string> refusal() const;

  void expect_no_key_but(const std::vector<std::string>& keys) const;

  [[noreturn]] void refuse(const std::string& key, const Json& value, const std::string& expected) const;

 private:
  const Json& object_;
  std::string what_;
};

}  // namespace forceshade::files
