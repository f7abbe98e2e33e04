// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/run.h"

#include <rapidcheck.h>

#include <algorithm>
#include <stdexcept>

#include "forceshade/properties/equivalence.h"

namespace forceshade::properties {
namespace {

class Silent : public rc::detail::TestListener {
 public:
  void onTestCaseFinished(const rc::detail::CaseDescription&) override {}
  void onShrinkTried(const rc::detail::CaseDescription&, bool) override {}
  void onTestFinished(const rc::detail::TestMetadata&, const rc::detail::TestResult&) override {}
};

}  // namespace

PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed,
                            const std::function<Violation()>& property) {
  rc::detail::TestParams params;
  params.seed = seed;
  params.maxSuccess = cases;
  Silent silent;
  // The form with a (here empty) map of cases to reproduce is the one that reads no environment variable.
  const rc::detail::TestResult result = rc::detail::checkTestable(
      [&] {
        if (const Violation violation = property()) RC_FAIL(*violation);
      },
      rc::detail::TestMetadata{name, name}, params, silent, std::unordered_map<std::string, rc::detail::Reproduce>{});
  rc::detail::SuccessResult success{};
  if (result.match(success)) return {name, static_cast<std::uint64_t>(success.numSuccess), true, ""};
  rc::detail::FailureResult failure;
  if (!result.match(failure)) return {name, 0, false, "the generator gave up"};
  // RC_FAIL puts its place in the source before our words.
  const std::size_t words = failure.description.find("\n\n");
  const std::string text = words == std::string::npos ? failure.description : failure.description.substr(words + 2);
  return {name, static_cast<std::uint64_t>(failure.numSuccess) + 1, false, text};
}

namespace {

// run_property() with its progress. While a failure is shrunk, all is done.
PropertyResult run_watched(const std::string& name, int cases, std::uint64_t seed, const OnCase& on_case,
                           const std::function<Violation()>& property) {
  double begun = 0;
  return run_property(name, cases, seed, [&] {
    if (on_case) on_case(name, std::min(begun++ / cases, 1.0));
    return property();
  });
}

// Along a path, from its beginning: the renderer's answer is the exact force rounded, at every step.
Violation equivalence_along(const Subject& subject, const std::vector<Eigen::Vector3f>& path) {
  const auto session = subject.calls().open();
  const auto reference = subject.open_reference();
  for (const Eigen::Vector3f& position : path) {
    try {
      const fast::Evaluation answer = session->step(position);
      if (auto violation = difference(position, {answer.force, answer.status}, reference->step(position))) return violation;
    } catch (const std::domain_error& error) {
      return not_decided(position, error);
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<PropertyResult> run_properties(const Subject& subject, int cases, std::uint64_t seed, const PropertyDone& done,
                                           const OnCase& on_case, const std::atomic<bool>* stop) {
  if (cases < 1) throw std::invalid_argument("cases of a property: expected 1 or more, got " + std::to_string(cases));
  const auto is_stopped = [&] { return stop != nullptr && *stop; };
  std::vector<PropertyResult> results;
  const auto run = [&](const std::string& name, const std::function<Violation()>& property) {
    const auto all = static_cast<int>(cases_of(name, static_cast<std::uint64_t>(cases)));
    results.push_back(run_watched(name, all, seed, on_case, [&] { return is_stopped() ? Violation("stopped") : property(); }));
  };
  const auto say = [&] {
    if (on_case) on_case(results.back().name, 1);
    if (done) done(results.back());
  };
  run("equivalence", [&] { return equivalence_along(subject, subject.draw_path()); });
  say();
  run("continuity", [&] { return subject.check_continuity(); });
  say();
  run("unit normals", [&] { return subject.check_unit_normals(); });
  say();
  run("passivity", [&] { return subject.check_passivity(); });
  for (const auto& loop : subject.fixed_loops()) {
    PropertyResult& passive = results.back();
    if (!passive.held || is_stopped()) break;
    ++passive.cases;
    if (const Violation violation = loop()) {
      passive.held = false;
      passive.counterexample = *violation;
    }
  }
  say();
  for (const FurtherProperty& further : subject.further_properties()) {
    run(further.name, further.check);
    say();
  }
  return results;
}

}  // namespace forceshade::properties
