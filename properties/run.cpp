// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>
#include <stdexcept>

#include "forceshade/properties.h"
#include "properties/field_properties.h"
#include "properties/second_answer.h"
#include "properties/words_of_violation.h"
#include "rendering/breakdown.h"
#include "rendering/control_words.h"

namespace forceshade::properties {
namespace {

// run_property() with its progress. While a failure is shrunk, all is done.
PropertyResult run_watched(const std::string& name, int cases, std::uint64_t seed, const OnCase& on_case,
                           const Property& property) {
  double begun = 0;
  return run_property(name, cases, seed, [&](Chooser& choose) {
    if (on_case) on_case(name, std::min(begun++ / cases, 1.0));
    return property(choose);
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

  // The reason why an answer is wrong, if it is not simply computed wrongly. A renderer that goes wrong for good gives
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
  const ExactArithmetic with_all_bits;
  if (cases < 1) throw std::invalid_argument("cases of a property: expected 1 or more, got " + std::to_string(cases));
  const auto is_stopped = [&] { return stop != nullptr && *stop; };
  std::vector<PropertyResult> results;
  const auto run = [&](const std::string& name, const Property& property) {
    const auto all = static_cast<int>(cases_of(name, static_cast<std::uint64_t>(cases)));
    results.push_back(run_watched(name, all, seed, on_case,
                                  [&](Chooser& choose) { return is_stopped() ? Violation("stopped") : property(choose); }));
  };
  const auto say = [&] {
    if (on_case) on_case(results.back().name, 1);
    if (done) done(results.back());
  };
  Equivalence equivalence(subject);
  run("equivalence", [&](Chooser& choose) { return equivalence.along(subject.draw_path(choose)); });
  if (equivalence.inconsistency()) results.back().counterexample = *equivalence.inconsistency();
  say();
  run("continuity", [&](Chooser& choose) { return subject.check_continuity(choose); });
  say();
  run("unit normals", [&](Chooser& choose) { return subject.check_unit_normals(choose); });
  say();
  run("passivity", [&](Chooser& choose) { return subject.check_passivity(choose); });
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
