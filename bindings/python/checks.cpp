// SPDX-License-Identifier: BSD-3-Clause
// Properties and certificates.

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/python/arrays.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/subject.h"
#include "files/output_file.h"
#include "forceshade/certificate.h"
#include "forceshade/certify.h"
#include "forceshade/error.h"
#include "forceshade/properties.h"

namespace forceshade::python {
namespace {

py::dict dict_of(const properties::PropertyResult& result) {
  py::dict all;
  all["name"] = result.name;
  all["cases"] = result.cases;
  all["held"] = result.held;
  all["counterexample"] = result.counterexample;
  return all;
}

py::list properties_of(const Subject& subject, int cases, std::uint64_t seed) {
  expect_arithmetic();
  const std::unique_ptr<properties::Subject> checked = properties::subject_of(subject.description);
  const auto results = interruptible([&](const std::atomic<bool>& stop) {
    return properties::run_properties(*checked, cases, seed, nullptr, nullptr, &stop);
  });
  py::list all;
  for (const properties::PropertyResult& result : results) all.append(dict_of(result));
  return all;
}

// Its JSON, whether every check held, and how it stands: "sufficient", what it lacks, and the remedy.
py::tuple standing_of(const properties::Certificate& certificate, const std::string& text) {
  const properties::Assessment assessed = properties::assessed(certificate);
  return py::make_tuple(text, certificate.held(), std::string(properties::name_of(assessed.standing)), assessed.lacks,
                        assessed.remedy);
}

py::tuple certificate_of(const std::vector<const Subject*>& subjects, std::uint64_t points, int cases, std::uint64_t seed,
                         unsigned threads) {
  expect_arithmetic();
  properties::CertifyOptions options{.subjects = {}, .points = points, .cases = cases, .seed = seed, .threads = threads};
  for (const Subject* subject : subjects)
    options.subjects.push_back(std::shared_ptr<properties::Subject>(properties::subject_of(subject->description)));
  const auto certificate = interruptible([&](const std::atomic<bool>& stop) {
    return properties::certify(
        options, [](std::string_view, double) {}, stop);
  });
  if (!certificate) throw Error("the certificate was stopped before its end");
  return standing_of(*certificate, properties::to_json(*certificate));
}

// The same of a certificate's file.
py::tuple read_certificate(const std::string& path) {
  const std::string text = properties::read_certificate(path);
  return standing_of(properties::from_json(text, path), text);
}

py::dict dict_of(const properties::PlanState& state) {
  py::dict all;
  all["digest"] = state.digest;
  all["units"] = state.units;
  all["done"] = state.done;
  all["taken"] = state.taken;
  all["expired"] = state.expired;
  all["missing"] = state.missing;
  all["alarms"] = state.alarms;
  return all;
}

py::dict make_plan(const std::string& folder, const std::vector<std::pair<std::string, std::string>>& subject,
                   std::uint64_t points, std::uint64_t cases, std::uint64_t seed, std::uint64_t units) {
  const properties::PlanRequest request{subject, points, cases, seed, {{}, {}, {}}, units};
  return dict_of(interruptible([&](const std::atomic<bool>& stop) { return properties::make_plan(folder, request, stop); }));
}

py::dict plan_state(const std::string& folder) {
  return dict_of(interruptible([&](const std::atomic<bool>& stop) { return properties::state_of_plan(folder, stop); }));
}

void work_on_plan(const std::string& folder, unsigned threads, bool waits) {
  expect_arithmetic();
  interruptible([&](const std::atomic<bool>& stop) { return properties::work_on_plan(folder, {threads, waits}, stop); });
}

// The certificate as certify() has it, and the state.
py::tuple merged_plan(const std::string& folder) {
  const properties::MergedPlan merged =
      interruptible([&](const std::atomic<bool>& stop) { return properties::merged_plan(folder, stop); });
  return py::make_tuple(standing_of(merged.certificate, properties::to_json(merged.certificate)), dict_of(merged.state));
}

void write(const std::string& path, const std::string& text) {
  const py::gil_scoped_release released;
  files::write_file(path, text);
}

}  // namespace

void add_checks(py::module_& module) {
  module.def("properties", &properties_of);
  module.def("certify", &certificate_of);
  module.def("read_certificate", &read_certificate);
  module.def("points_of_kind", [](const std::string& kind) { return properties::points_of_kind(kind); });
  module.attr("usual_cases") = properties::kCases;  // required for driving a device
  module.def("write_file", &write);
  module.def("make_plan", &make_plan);
  module.def("plan_state", &plan_state);
  module.def("work_on_plan", &work_on_plan);
  module.def("merged_plan", &merged_plan);
}

}  // namespace forceshade::python
