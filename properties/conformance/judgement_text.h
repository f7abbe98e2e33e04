// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A judgement, and a whole conformance run, for people and as JSON (docs/conformance.md).

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "forceshade/identity.h"
#include "properties/conformance/conform.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {

// Lines for a terminal, each ended: what was right, how large the errors are, the worst of them, and the verdict with a case
// that one can paste into a test.
std::string words_of(const Judgement& found, const Identity& identity, const Tolerance& tolerance);

// A key "held", the counts, and the worst cases with numbers in hexfloat.
nlohmann::ordered_json json_of(const Judgement& found, const Identity& identity, const Tolerance& tolerance);

// The circumstances of a conformance run, for its report.
struct Circumstances {
  ConformOptions options;
  std::string version;  // of this program
  std::string command;  // repeats the run; empty where it is not known
};

// The same of a conformance run: the renderer, the invariants beside the judgement, and what ended it before its end. The
// JSON is that of docs/conformance-schema.json.
inline constexpr const char* kConformanceSchema = "forceshade conformance 1";
std::string words_of(const Conformance& found, const Tolerance& tolerance);
nlohmann::ordered_json json_of(const Conformance& found, const Circumstances& circumstances);

std::string words_of(const Invariant& invariant);
nlohmann::ordered_json json_of(const Invariant& invariant);

// The text of a file.
std::string text_of(const nlohmann::ordered_json& json);

// A case in which a renderer is wrong, as a test that one can paste.

// {0x1.8p+1f, 0x0p+0f, -0x1p-1f}, as C and C++ read it.
std::string literal(const Eigen::Vector3f& numbers);

// Lines of C, each ended: the path from no contact, the periods before each position if there are any, and the force at its
// end.
std::string test_to_paste(const Identity& identity, std::span<const Eigen::Vector3f> path,
                          std::span<const std::uint32_t> periods, const Judged& at_its_end);

}  // namespace forceshade::conformance
