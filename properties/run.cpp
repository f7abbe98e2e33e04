// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/run.h"

#include <algorithm>

#include "forceshade/properties/continuity.h"
#include "forceshade/properties/equivalence.h"
#include "forceshade/properties/generators.h"
#include "forceshade/properties/height_properties.h"
#include "forceshade/properties/passivity.h"
#include "forceshade/properties/unit_normals.h"

namespace forceshade::properties {
namespace {

class Silent : public rc::detail::TestListener {
 public:
  void onTestCaseFinished(const rc::detail::CaseDescription&) override {}
  void onShrinkTried(const rc::detail::CaseDescription&, bool) override {}
  void onTestFinished(const rc::detail::TestMetadata&, const rc::detail::TestResult&) override {}
};

int passivity_cases(int cases) {
  return static_cast<int>(cases_of("passivity", static_cast<std::uint64_t>(cases)));
}

// run_property() with its progress. While a failure is shrunk, all is done.
PropertyResult run_watched(const std::string& name, int cases, std::uint64_t seed, const OnCase& on_case,
                           const std::function<Violation()>& property) {
  double begun = 0;
  PropertyResult result = run_property(name, cases, seed, [&] {
    if (on_case) on_case(name, std::min(begun++ / cases, 1.0));
    return property();
  });
  if (on_case) on_case(name, 1);
  return result;
}

}  // namespace

PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed,
                            const std::function<Violation()>& property) {
  rc::detail::TestParams params;
  params.seed = seed;
  params.maxSuccess = cases;
  Silent silent;
  // The form with a (here empty) map of cases to reproduce is the one that asks no environment variable.
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

std::vector<float> witness_depths(const Subject& subject) {
  const float R = subject.law.parameters().radius;
  const float deepest = has_bump_geometry(subject.law.id()) ? std::clamp(2.0F, R / 1000, R / 8) : 2;
  return {deepest / 8, deepest / 4, deepest / 2, deepest * 3 / 4, deepest};
}

std::vector<PropertyResult> run_properties(const Subject& subject, int cases, std::uint64_t seed, const OnCase& on_case) {
  const reference::Law& law = subject.law;
  const Shape shape(law);
  std::vector<PropertyResult> results;
  results.push_back(run_watched("equivalence", cases, seed, on_case, [&] { return equivalence(subject, *position_of(law)); }));
  results.push_back(run_watched("continuity", cases, seed, on_case, [&]() -> Violation {
    const NearbyPair pair = *pair_of(law);
    const Eigen::Vector3f b = pair.b(shape);
    return is_valid(b) ? continuity(subject, shape, pair.a, b) : std::nullopt;
  }));
  results.push_back(
      run_watched("unit normals", cases, seed, on_case, [&] { return unit_normals(subject, *position_of(law)); }));
  PropertyResult passive = run_watched("passivity", passivity_cases(cases), seed, on_case,
                                       [&] { return passivity(subject, shape, *polygon_of(law)); });
  for (const float depth : witness_depths(subject)) {
    if (!passive.held) break;
    ++passive.cases;
    if (const Violation violation = witness_is_reached(subject, shape, depth)) {
      passive.held = false;
      passive.counterexample = *violation;
    }
    if (on_case) on_case(passive.name, 1);
  }
  results.push_back(passive);
  return results;
}

std::vector<PropertyResult> run_properties(const HeightSubject& subject, int cases, std::uint64_t seed, const OnCase& on_case) {
  const HeightShape shape(subject.law);
  const HeightTarget map{subject.law, shape};
  std::vector<PropertyResult> results;
  results.push_back(run_watched("equivalence", cases, seed, on_case, [&] { return equivalence(subject, *position_of(map)); }));
  results.push_back(run_watched("continuity", cases, seed, on_case, [&]() -> Violation {
    const Neighbours pair = *neighbours_on(map);
    const Eigen::Vector3f b = pair.b();
    return is_valid(b) ? continuity(subject, shape, pair.a, b) : std::nullopt;
  }));
  results.push_back(
      run_watched("unit normals", cases, seed, on_case, [&] { return unit_normals(subject, *position_of(map)); }));
  results.push_back(run_watched("passivity", passivity_cases(cases), seed, on_case,
                                [&] { return passivity(subject, shape, *polygon_of(map)); }));
  const auto has_cells = [](const PartShape& part) { return part.columns.has_value(); };
  if (std::any_of(shape.parts.begin(), shape.parts.begin() + static_cast<std::ptrdiff_t>(shape.map_parts), has_cells))
    results.push_back(run_watched("cell lines", cases, seed, on_case, [&]() -> Violation {
      Neighbours pair = *neighbours_on(map);
      const double surface = static_cast<double>(subject.law.estimate({pair.a.x(), pair.a.y(), 0}).gap.mid());
      pair.a.z() = static_cast<float>(surface - 1);  // deep enough that both are in contact
      const Eigen::Vector3f b = pair.b();
      return is_valid(pair.a) && is_valid(b) ? gradient_across_cells(subject, shape, pair.a, b) : std::nullopt;
    }));
  return results;
}

}  // namespace forceshade::properties
