// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certificate/merge.h"

#include <algorithm>
#include <functional>

namespace forceshade::properties {
namespace {

std::string units(std::uint64_t first, std::uint64_t end) {
  return "units " + std::to_string(first) + " to " + std::to_string(end);
}

bool same_sweeps(const Sweeps& a, const Sweeps& b) {
  return std::equal(a.results.begin(), a.results.end(), b.results.begin(), b.results.end(),
                    [](const SweepResult& x, const SweepResult& y) { return x.sweep == y.sweep; });
}

void add(Sweeps& sum, const Sweeps& part) {
  sum.end = sum.next = part.end;
  sum.seconds += part.seconds;
  std::transform(part.stages.begin(), part.stages.end(), sum.stages.begin(), sum.stages.begin(), std::plus<>());
  for (std::size_t i = 0; i < sum.results.size(); ++i) {
    sum.results[i].inputs += part.results[i].inputs;
    sum.results[i].mismatches += part.results[i].mismatches;
  }
  sum.counterexamples.insert(sum.counterexamples.end(), part.counterexamples.begin(), part.counterexamples.end());
}

// Parts sorted by their first unit.
Sweeps joined(const std::vector<CertificateFile>& parts) {
  const CertificateFile* before = &parts.front();
  Sweeps sum = before->certificate.sweeps;
  for (const CertificateFile& part : parts) {
    const Sweeps& sweeps = part.certificate.sweeps;
    if (!same_sweeps(sweeps, sum))
      throw CertificateError(part.name + ": expected the sweeps of " + before->name + ", got others");
    if (!sweeps.is_finished())
      throw CertificateError(part.name + ": expected a finished part; " + units(sweeps.next, sweeps.end) + " are not done");
    if (&part == &parts.front()) continue;
    if (sweeps.first < sum.end)
      throw CertificateError(part.name + ": overlaps " + before->name + " in " +
                             units(sweeps.first, std::min(sum.end, sweeps.end)));
    if (sweeps.first > sum.end)
      throw CertificateError("missing part: " + units(sum.end, sweeps.first) + ", between " + before->name + " and " +
                             part.name);
    add(sum, sweeps);
    before = &part;
  }
  if (sum.first > 0) throw CertificateError("missing part: " + units(0, sum.first) + ", before " + parts.front().name);
  if (sum.end < sum.units())
    throw CertificateError("missing part: " + units(sum.end, sum.units()) + ", after " + parts.back().name);
  return sum;
}

}  // namespace

Certificate merged(std::vector<CertificateFile> files) {
  if (files.empty()) throw CertificateError("expected at least one part");
  const CertificateFile first = files.front();
  for (const CertificateFile& file : files)
    if (!(file.certificate.build == first.certificate.build))
      throw CertificateError(file.name + ": expected the build of " + first.name + " (digest " +
                             first.certificate.build.library_digest + ", " + first.certificate.build.instruction_set +
                             "), got another (" + file.certificate.build.library_digest + ", " +
                             file.certificate.build.instruction_set + ")");
  const auto parts = std::stable_partition(files.begin(), files.end(),
                                           [](const CertificateFile& file) { return file.certificate.sweeps.results.empty(); });
  if (parts == files.end()) throw CertificateError(first.name + ": expected a part of an exhaustive run");
  if (parts - files.begin() > 1)
    throw CertificateError(files[1].name + ": expected at most one certificate of points; " + files[0].name + " is one");
  const std::vector<CertificateFile> certificate_of_points(files.begin(), parts);
  std::vector<CertificateFile> of_sweeps(parts, files.end());
  std::stable_sort(of_sweeps.begin(), of_sweeps.end(), [](const CertificateFile& a, const CertificateFile& b) {
    return a.certificate.sweeps.first < b.certificate.sweeps.first;
  });
  for (const CertificateFile& part : of_sweeps)
    if (!part.certificate.subjects.empty()) throw CertificateError(part.name + ": is merged already");
  Certificate result =
      certificate_of_points.empty() ? of_sweeps.front().certificate : certificate_of_points.front().certificate;
  result.sweeps = joined(of_sweeps);
  for (const CertificateFile& file : files) {
    const Certificate& part = file.certificate;
    result.date = std::max(result.date, part.date);
    if (result.processor.find(part.processor) == std::string::npos) result.processor += "; " + part.processor;
  }
  return result;
}

}  // namespace forceshade::properties
