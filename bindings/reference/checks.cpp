// SPDX-License-Identifier: BSD-3-Clause
// Properties and certificates of the C interface.

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "bindings/c/errors.h"
#include "bindings/reference/handles.h"
#include "files/output_file.h"
#include "forceshade/certificate.h"
#include "forceshade/certify.h"
#include "forceshade/fast.h"
#include "forceshade/properties.h"
#include "text/beginning.h"

namespace forceshade::exact {
namespace {

constexpr std::uint64_t kMostPoints = 1'000'000'000'000, kMostCases = 1'000'000'000, kMostThreads = 1024;

// The definition, where this library's own copy of the renderer, which it certifies, and that of the library that programs call
// were compiled of the same objects.
const Defined& checkable(forceshade_reference handle) {
  const Defined& its = defined(handle);
  const std::string own = fast::library_digest(), loaded = forceshade_library_digest();
  if (own == loaded) return its;
  throw c::Refused{
      c::fail(FORCESHADE_FAILED,
              "libforceshade.so.0, which is loaded, is of another build than libforceshade-reference.so.0, and nothing that "
              "this one finds would hold of it: expected digest " +
                  own + ", got " + loaded)};
}

void expect_at_most(const char* name, std::uint64_t value, std::uint64_t most) {
  if (value > most)
    c::require(c::fail(FORCESHADE_BAD_VALUE, std::string(name) + " is " + std::to_string(value) + "; expected 1 to " +
                                                 std::to_string(most) + ", or 0 for what is usual"));
}

int cases_of(std::uint64_t cases) {
  return static_cast<int>(cases == 0 ? properties::kCases : cases);
}

properties::CertifyOptions options_of(const Defined& its, const forceshade_reference_plan& plan) {
  properties::CertifyOptions options;
  options.subjects.push_back(std::shared_ptr<properties::Subject>(properties::subject_of(its.description)));
  options.points = plan.points != 0 ? plan.points : properties::points_of_kind(options.subjects.front()->identity().kind);
  options.cases = cases_of(plan.cases);
  options.seed = plan.seed;
  options.threads = plan.threads != 0 ? plan.threads : std::max(1U, std::thread::hardware_concurrency());
  return options;
}

// The first failure, in words.
std::string first_failure(const properties::SubjectResult& found) {
  for (const properties::Comparison* part :
       {static_cast<const properties::Comparison*>(&found), static_cast<const properties::Comparison*>(&found.spread)})
    if (part->mismatches > 0)
      return std::to_string(part->mismatches) + " of " + std::to_string(part->points) +
             " points differ: " + (part->counterexamples.empty() ? "" : part->counterexamples.front());
  for (const properties::PropertyResult& property : found.properties)
    if (!property.held) return property.name + " does not hold: " + property.counterexample;
  return "a check failed, which the certificate has";
}

}  // namespace
}  // namespace forceshade::exact

using namespace forceshade;
using namespace forceshade::exact;

forceshade_result forceshade_reference_properties(forceshade_reference reference, uint64_t cases, uint64_t seed,
                                                  forceshade_reference_property callback, void* user) {
  return c::guarded([&]() -> forceshade_result {
    const Defined& its = checkable(reference);
    if (callback == nullptr) return c::fail(FORCESHADE_NULL_POINTER, "callback is NULL");
    expect_at_most("cases", cases, kMostCases);
    std::atomic<bool> stop = false;
    const auto done = [&](const properties::PropertyResult& result) {
      if (stop) return;  // the results from then on are void
      stop = callback(user, result.name.c_str(), result.held ? 1 : 0, result.cases, result.counterexample.c_str()) != 0;
    };
    properties::run_properties(*properties::subject_of(its.description), cases_of(cases), seed, done, nullptr, &stop);
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_reference_certify(forceshade_reference reference, const forceshade_reference_plan* plan,
                                               const char* file, forceshade_reference_progress progress, void* user,
                                               int32_t* standing) {
  return c::guarded([&]() -> forceshade_result {
    const Defined& its = checkable(reference);
    if (plan == nullptr || file == nullptr) return c::fail(FORCESHADE_NULL_POINTER, "plan or file is NULL");
    if (plan->size < sizeof *plan)
      return c::fail(FORCESHADE_BAD_SIZE, "plan->size is " + std::to_string(plan->size) +
                                              "; expected sizeof(forceshade_reference_plan), " + std::to_string(sizeof *plan));
    expect_at_most("plan->points", plan->points, kMostPoints);
    expect_at_most("plan->cases", plan->cases, kMostCases);
    expect_at_most("plan->threads", plan->threads, kMostThreads);
    if (files::is_standard_output(file))
      return c::fail(FORCESHADE_BAD_VALUE, "file: expected the name of a file, got " + std::string(beginning_of(file, 64)));
    files::OutputFile out(file);  // so that a missing folder is reported before the work
    std::atomic<bool> stop = false;
    const auto tell = [&](std::string_view, double done) {
      if (progress != nullptr && !stop) stop = progress(user, done) != 0;
    };
    const std::optional<properties::Certificate> certificate = properties::certify(options_of(its, *plan), tell, stop);
    if (!certificate) return c::fail(FORCESHADE_FAILED, "it was stopped before its end, and no certificate is written");
    out.stream() << properties::to_json(*certificate);
    out.commit();
    const properties::Standing found = properties::assessed(*certificate).standing;
    if (standing != nullptr) *standing = static_cast<int32_t>(found);
    if (found != properties::Standing::failed) return FORCESHADE_OK;
    return c::fail(FORCESHADE_FAILED, first_failure(certificate->subjects.front()));
  });
}
