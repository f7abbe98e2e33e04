// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/certificate_files.h"

#include <cstdio>

#include "forceshade/apps/command.h"
#include "forceshade/certificate/evidence.h"
#include "forceshade/csv/output_folder.h"
#include "forceshade/report/report.h"

namespace forceshade::apps {
namespace {

std::string page(const properties::Certificate& certificate) {
  try {
    return to_html(certificate);
  } catch (const properties::PlotError& error) {
    std::fprintf(stderr, "forceshade: certificate.html has no pictures: %s\n", error.what());
    return to_html(certificate, properties::Pictures::none);
  }
}

// What `drive` would find too little; the word "certified" is for what it would accept.
std::optional<std::string> lacking_for_drive(const properties::Certificate& certificate) {
  std::optional<std::string> lacks;
  for (const properties::SubjectResult& subject : certificate.subjects)
    if (!lacks) lacks = lacking(subject);
  return lacks;
}

std::string verdict(const properties::Certificate& certificate) {
  if (certificate.subjects.empty()) return certificate.held() ? "swept, no mismatch" : "FAILED, not certified";
  std::uint64_t points = 0;
  for (const properties::Findings& subject : certificate.subjects) points += subject.points + subject.spread.points;
  const char* word = "certified";
  if (!certificate.held())
    word = "FAILED, not certified";
  else if (lacking_for_drive(certificate))
    word = "held, not certified";
  char words[160];
  std::snprintf(words, sizeof words, "%s: %llu points in %.1f s, seed %llu", word, static_cast<unsigned long long>(points),
                certificate.seconds, static_cast<unsigned long long>(certificate.seed));
  return words;
}

void print_what_drive_lacks(const properties::Certificate& certificate) {
  if (!certificate.held()) return;
  if (certificate.subjects.empty())
    std::printf(
        "drive needs points and properties too: join these sweeps to a certificate that has them with 'certify merge'\n");
  if (const auto lacks = lacking_for_drive(certificate)) std::printf("too little for drive: %s\n", lacks->c_str());
}

}  // namespace

std::vector<std::string> certificate_files() {
  return {"certificate.json", "certificate.html"};
}

int write_certificate(const properties::Certificate& certificate, const std::filesystem::path& directory) {
  csv::OutputFolder folder(directory);
  folder.write("certificate.json", to_json(certificate));
  folder.write("certificate.html", page(certificate));
  folder.commit();
  std::printf("%s\n", verdict(certificate).c_str());
  print_what_drive_lacks(certificate);
  std::printf("%s\n", (directory / "certificate.html").c_str());
  return certificate.held() ? kHeld : kFailed;
}

}  // namespace forceshade::apps
