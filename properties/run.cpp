// SPDX-License-Identifier: BSD-3-Clause
#include <rapidcheck.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "forceshade/properties.h"
#include "properties/equivalence.h"
#include "properties/second_answer.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {
namespace {

class Silent : public rc::detail::TestListener {
 public:
  void onTestCaseFinished(const rc::detail::CaseDescription&) override {}
  void onShrinkTried(const rc::detail::CaseDescription&, bool) override {}
  void onTestFinished(const rc::detail::TestMetadata&, const rc::detail::TestResult&) override {}
};

// What RapidCheck says of a failure, without the place in the source that it puts before.
std::string without_place(const std::string& description) {
  const std::size_t words = description.find("\n\n");
  return words == std::string::npos ? description : description.substr(words + 2);
}

// The violation of a property that may throw. What RapidCheck throws is no violation and passes on.
Violation words_of_violation(const std::function<Violation()>& property) {
  try {
    return property();
  } catch (const rc::detail::CaseResult&) {
    throw;
  } catch (const rc::GenerationFailure&) {
    throw;
  } catch (const RendererThrew& error) {
    return error.what();
  } catch (...) {
    return "an exception is thrown: " + current_exception_words();
  }
}

}  // namespace

PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed,
                            const std::function<Violation()>& property) {
  rc::detail::TestParams params;
  params.seed = seed;
  params.maxSuccess = cases;
  Silent silent;
  // RapidCheck runs the smallest case that failed once more for its description, which says that nothing failed where the
  // property then holds. So the words are kept here.
  std::string failed;
  bool has_failed_last = false;
  const auto fail = [&](const std::string& words) {
    failed = words;
    has_failed_last = true;
  };
  // The form with a (here empty) map of cases to reproduce is the one that reads no environment variable.
  const rc::detail::TestResult result = rc::detail::checkTestable(
      [&] {
        has_failed_last = false;
        try {
          if (const Violation violation = words_of_violation(property)) {
            fail(*violation);
            RC_FAIL(*violation);
          }
        } catch (const rc::detail::CaseResult& result) {
          // RC_ASSERT of a property of one's own, or RC_PRE.
          if (result.type == rc::detail::CaseResult::Type::Failure && !has_failed_last) fail(without_place(result.description));
          throw;
        }
      },
      rc::detail::TestMetadata{name, name}, params, silent, std::unordered_map<std::string, rc::detail::Reproduce>{});
  rc::detail::SuccessResult success{};
  if (result.match(success)) return {name, static_cast<std::uint64_t>(success.numSuccess), true, ""};
  rc::detail::FailureResult failure;
  if (!result.match(failure)) return {name, 0, false, "the generator gave up"};
  if (failed.empty())
    return {name, static_cast<std::uint64_t>(failure.numSuccess) + 1, false, without_place(failure.description)};
  if (!has_failed_last)
    failed += "; the same case held when it was tried again, so the answers depend on chance or on what was asked before";
  return {name, static_cast<std::uint64_t>(failure.numSuccess) + 1, false, failed};
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

// Equivalence, and whether each answer is one for good.
class Equivalence {
 public:
  explicit Equivalence(const Subject& subject) : subject_(subject) {}

  // Along a path, from its beginning: the renderer's answer is the exact force rounded, at every step.
  Violation along(const std::vector<Eigen::Vector3f>& path) {
    const auto session = subject_.renderer().open();
    const auto reference = subject_.open_reference();
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Rendered answer = answer_of(*session, path[i]);
      try {
        const reference::Rounded exact = reference->step(path[i]);
        if (auto violation = difference(path[i], answer, exact)) {
          auto words = cause(std::span(path).first(i + 1), answer, exact);
          if (!words) return violation;
          inconsistency_ = words;
          return words;
        }
      } catch (const std::domain_error& error) {
        return not_decided(path[i], error);
      }
      if (i + 1 == path.size() && early_.size() < kEarly) early_.push_back({path, answer});
    }
    return std::nullopt;
  }

  // The last that was found. It need not be found again when the case is tried again, and matters more than what else is.
  const Violation& inconsistency() const { return inconsistency_; }

 private:
  static constexpr std::size_t kEarly = 16;

  struct Answered {
    std::vector<Eigen::Vector3f> path;
    Rendered answer;
  };

  // Why an answer is wrong, where it is not simply computed wrongly. A renderer that goes wrong for good after some time gives
  // two answers to the cases of the beginning.
  Violation cause(std::span<const Eigen::Vector3f> path, const Rendered& answer, const reference::Rounded& exact) const {
    if (auto words = properties::inconsistency(subject_, path, answer, exact)) return words;
    for (const Answered& early : early_)
      if (auto words = second_answer(subject_, early.path, early.answer)) return words;
    return std::nullopt;
  }

  const Subject& subject_;
  std::vector<Answered> early_;
  Violation inconsistency_;
};

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
  Equivalence equivalence(subject);
  run("equivalence", [&] { return equivalence.along(subject.draw_path()); });
  if (equivalence.inconsistency()) results.back().counterexample = *equivalence.inconsistency();
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
    if (const Violation violation = words_of_violation(loop)) {
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
