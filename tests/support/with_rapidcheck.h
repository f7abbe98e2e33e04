// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Properties of forceshade/properties.h whose cases RapidCheck draws and shrinks: a second opinion on run_property().

#include <rapidcheck.h>

#include <any>
#include <string>
#include <unordered_map>
#include <utility>

#include "forceshade/properties.h"

namespace forceshade::tests {

class Silent : public rc::detail::TestListener {
 public:
  void onTestCaseFinished(const rc::detail::CaseDescription&) override {}
  void onShrinkTried(const rc::detail::CaseDescription&, bool) override {}
  void onTestFinished(const rc::detail::TestMetadata&, const rc::detail::TestResult&) override {}
};

class RapidCheckChooser final : public properties::Chooser {
 private:
  std::any next(const properties::Generator<std::any>& generator) override {
    const rc::Gen<std::any> gen([&generator](const rc::Random& random, int) {
      return rc::shrinkable::shrinkRecur(
          generator.draw(rc::Random(random).next()),
          [simpler = generator.simpler](const std::any& value) { return rc::seq::fromContainer(simpler(value)); });
    });
    return *gen;
  }
};

// As properties::run_property(), which it says no more than.
inline properties::PropertyResult run_with_rapidcheck(const std::string& name, int cases, std::uint64_t seed,
                                                      const properties::Property& property) {
  rc::detail::TestParams params;
  params.seed = seed;
  params.maxSuccess = cases;
  Silent silent;
  std::string words;  // of the last case that failed
  // The form with a (here empty) map of cases to reproduce is the one that reads no environment variable.
  const rc::detail::TestResult result = rc::detail::checkTestable(
      [&] {
        RapidCheckChooser choose;
        if (const properties::Violation violation = property(choose)) {
          words = *violation;
          RC_FAIL(words);
        }
      },
      rc::detail::TestMetadata{name, name}, params, silent, std::unordered_map<std::string, rc::detail::Reproduce>{});
  rc::detail::SuccessResult success{};
  if (result.match(success)) return {name, static_cast<std::uint64_t>(success.numSuccess), true, ""};
  rc::detail::FailureResult failure;
  if (!result.match(failure)) return {name, 0, false, "RapidCheck came to no result"};
  return {name, static_cast<std::uint64_t>(failure.numSuccess) + 1, false, words.empty() ? failure.description : words};
}

}  // namespace forceshade::tests
