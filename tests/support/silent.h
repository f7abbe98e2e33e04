// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A listener for properties that are checked many times over, and say themselves what failed.

#include <rapidcheck.h>

namespace forceshade::tests {

class Silent : public rc::detail::TestListener {
 public:
  void onTestCaseFinished(const rc::detail::CaseDescription&) override {}
  void onShrinkTried(const rc::detail::CaseDescription&, bool) override {}
  void onTestFinished(const rc::detail::TestMetadata&, const rc::detail::TestResult&) override {}
};

}  // namespace forceshade::tests
