// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Reads the keys of a hello. Each is required, and a wrong one is named with what was expected.

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace forceshade::conformance {

// A renderer or simulator did not answer as it has to. What was requested is part of the words where one position is to blame.
struct RendererFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A value for a message: its beginning, a text in quotes.
std::string shown_json(const nlohmann::ordered_json& value);

// "a", "b" or "c".
std::string one_of(const std::vector<std::string>& words);

// All but refusal() throw RendererFailed.
class HelloReader {
 public:
  using Json = nlohmann::ordered_json;

  // whose: "renderer". The hello has to outlive the reader.
  HelloReader(const Json& hello, const char* whose) : hello_(hello), whose_(whose) {}

  const Json& value(const std::string& key, const std::string& expected) const;
  // As a terminal may show it. A long text is refused.
  std::string text(const std::string& key) const;
  // Which of these words it is.
  std::size_t word(const std::string& key, const std::vector<std::string>& words) const;
  double number(const std::string& key, double least, double most, const std::string& expected) const;
  std::optional<double> number_or_null(const std::string& key, double least, double most, const std::string& expected) const;

  // The reason of one that does not accept what it was sent.
  std::optional<std::string> refusal() const;

  [[noreturn]] void refuse(const std::string& key, const Json& value, const std::string& expected) const;

 private:
  const Json& hello_;
  const char* whose_;
};

}  // namespace forceshade::conformance
