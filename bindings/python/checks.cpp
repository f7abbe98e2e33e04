// SPDX-License-Identifier: BSD-3-Clause
// Properties and certificates.

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/python/arrays.h"
#include "bindings/python/errors.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/subject.h"
#include "files/output_file.h"
#include "forceshade/certificate.h"
#include "forceshade/certify.h"
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
}

}  // namespace forceshade::python
