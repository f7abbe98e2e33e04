// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The files and the words that the verbs of conform write, and their tolerance.

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/junit.h"
#include "properties/conformance/conform.h"
#include "properties/conformance/distance.h"
#include "report/report.h"

namespace forceshade::apps {

// The results of a verb, once for all that is written of them.
struct ConformResults {
  bool held = false;
  std::string words = {};  // for the terminal
  nlohmann::ordered_json json = {};
  std::function<std::string(properties::Pictures)> page = {};
  std::pair<std::string, std::string> about = {};  // a property of each suite of JUnit
  std::vector<JunitCase> cases = {};
};

// --json, --junit and, of a verb that has a page, --out.
class ConformOutputs {
 public:
  explicit ConformOutputs(CLI::App& command, bool has_page = true);

  // Throws Error where one of the files cannot be written, before a long run.
  void expect_room() const;

  // Returns the exit code.
  int write(const ConformResults& results) const;

 private:
  std::string out_, json_, junit_;
};

// The case of the forces of a subject.
JunitCase case_of_forces(const std::string& suite, const conformance::Judgement& judgement, const std::string& words);
// A case for each invariant that was tried, and one for what ended the run before its end.
void add_cases(std::vector<JunitCase>& cases, const std::string& suite, const std::vector<conformance::Invariant>& invariants,
               const std::optional<std::string>& failure = {});

// --tolerance: the largest distance of a force from the exact one.
CLI::Option* add_tolerance(CLI::App& command, std::string& value);
// Throws Error. An empty text stands for correctly rounded.
conformance::Tolerance parse_tolerance(const std::string& text);

}  // namespace forceshade::apps
