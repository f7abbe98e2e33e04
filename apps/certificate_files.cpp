// SPDX-License-Identifier: BSD-3-Clause
#include "apps/certificate_files.h"

#include <cstdio>

#include "apps/command.h"
#include "apps/page.h"
#include "apps/troubleshooting.h"
#include "certificate/certificate_text.h"
#include "files/printable.h"
#include "forceshade/certificate.h"
#include "rendering/breakdown.h"
#include "text/formatted.h"

namespace forceshade::apps {
namespace {

void print(const properties::SubjectResult& law) {
  const std::string name = law.name() + words_behind_name(law.rendered_by);
  std::printf("%-15s %s  %llu points, %llu mismatches", name.c_str(), law.held() ? "held  " : "FAILED",
              static_cast<unsigned long long>(law.points), static_cast<unsigned long long>(law.mismatches));
  for (const std::string_view stage : properties::kStageNames)
    std::printf(", %llu %s", static_cast<unsigned long long>(law.points_by_stage.at(std::string(stage))), stage.data());
  std::printf("; with %llu other parameters %llu points, %llu mismatches\n",
              static_cast<unsigned long long>(law.spread.parameter_sets), static_cast<unsigned long long>(law.spread.points),
              static_cast<unsigned long long>(law.spread.mismatches));
  for (const properties::Comparison* found :
       {static_cast<const properties::Comparison*>(&law), static_cast<const properties::Comparison*>(&law.spread)})
    for (const std::string& words : found->counterexamples) std::printf("  %s\n", words.c_str());
  for (const properties::PropertyResult& property : law.properties)
    if (!property.held) std::printf("  %s: %s\n", property.name.c_str(), property.counterexample.c_str());
}

// The word "certified" is for what `drive` accepts.
std::string verdict(const properties::Certificate& certificate, properties::Standing standing) {
  const bool failed = standing == properties::Standing::failed;
  if (certificate.subjects.empty()) return failed ? "FAILED, not certified" : "swept, no mismatch";
  std::uint64_t points = 0;
  for (const properties::Findings& subject : certificate.subjects) points += subject.points + subject.spread.points;
  const std::vector<std::uint64_t> seeds = certificate.seeds();
  const char* word = failed                                           ? "FAILED, not certified"
                     : standing == properties::Standing::insufficient ? "held, not certified"
                                                                      : "certified";
  return word + (": " + std::to_string(points)) + " points in all, " + formatted("%.1f s", certificate.seconds) +
         (seeds.size() == 1 ? ", seed " : ", seeds ") + properties::in_words(seeds);
}

}  // namespace

std::vector<std::string> certificate_files() {
  return {"certificate.json", "certificate.html", "evidence.json"};
}

int write_certificate(const properties::Certificate& certificate, files::OutputFolder& folder) {
  folder.write("certificate.json", to_json(certificate));
  folder.write("evidence.json", evidence_of(certificate));
  folder.write("certificate.html",
               page_of("certificate.html", [&](properties::Pictures shown) { return to_html(certificate, shown); }));
  folder.commit();
  for (const properties::SubjectResult& subject : certificate.subjects) print(subject);
  const properties::Assessment assessment = assessed(certificate);
  std::printf("%s\n", (folder.path() / "certificate.html").c_str());
  if (assessment.standing == properties::Standing::insufficient)
    std::printf("too little for drive: %s\nto gather it: %s\n", files::printable(assessment.lacks).c_str(),
                files::printable(assessment.remedy).c_str());
  std::printf("%s\n", with_page(verdict(certificate, assessment.standing)).c_str());
  return certificate.held() ? kHeld : kFailed;
}

}  // namespace forceshade::apps
