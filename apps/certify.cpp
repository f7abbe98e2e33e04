// SPDX-License-Identifier: BSD-3-Clause
// forceshade certify: check the fast path against the reference and write certificate.json and certificate.html.

#include "forceshade/certify.h"

#include <chrono>
#include <memory>
#include <thread>

#include "apps/certificate_files.h"
#include "apps/command.h"
#include "apps/junit.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "files/printable.h"
#include "text/formatted.h"

namespace forceshade::apps {
namespace {

struct CertifyOptions {
  std::uint64_t points = 0, cases = properties::kCases, seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string junit;
};

// Share and time left of a run, with the name of what is being checked and the mean rate at its points.
class CertifyProgress {
 public:
  explicit CertifyProgress(const properties::CertifyOptions& what)
      : points_(static_cast<double>(what.subjects.size() * (what.points + properties::spread_points(what.points)))) {}

  void draw(std::string_view name, double done) {
    done_ = done;
    name_ = files::printable(name);
    draw();
  }
  void draw() {
    const double seconds = std::chrono::duration<double>(ProgressLine::Clock::now() - start_).count();
    line_.draw(done_, formatted("%.3g points/s  ", done_ * points_ / std::max(seconds, 1e-9)) + name_);
  }

 private:
  double points_, done_ = 0;
  std::string name_;
  ProgressLine::Clock::time_point start_ = ProgressLine::Clock::now();
  ProgressLine line_{"certify"};
};

constexpr const char* kPoints = "points";

// One case for the points of a subject, with those of other parameters, and one for each property.
std::string junit_of(const properties::Certificate& certificate, const PartTimes& times) {
  std::vector<JunitCase> cases;
  for (const properties::SubjectResult& found : certificate.subjects) {
    const std::string name = found.name();
    std::optional<std::string> wrong;
    for (const properties::Comparison* part :
         {static_cast<const properties::Comparison*>(&found), static_cast<const properties::Comparison*>(&found.spread)}) {
      if (part->mismatches == 0) continue;
      wrong = wrong.value_or("") + std::to_string(part->mismatches) + " mismatches in " + std::to_string(part->points) +
              " points: ";
      for (const std::string& words : part->counterexamples) *wrong += words + "; ";
    }
    cases.push_back(
        {name, kPoints, times.seconds(name, kPoints), wrong,
         std::to_string(found.points) + " points, and " + std::to_string(found.spread.points) + " with other parameters"});
    for (const properties::PropertyResult& property : found.properties)
      cases.push_back({name, property.name, times.seconds(name, property.name),
                       property.held ? std::nullopt : std::optional(property.counterexample),
                       std::to_string(property.cases) + " cases"});
  }
  return to_junit("forceshade certify",
                  {{"seed", properties::in_words(certificate.seeds())},
                   {"version", certificate.build.version},
                   {"library_digest", certificate.build.library_digest}},
                  cases);
}

int run(const CertifyOptions& options, const SubjectOption& subject, const OutFolder& out) {
  watch_for_interrupt();
  properties::CertifyOptions what{.subjects = subject.subjects()};
  // Before the work, so that a path that cannot be written to is reported at once.
  out.expect_room_for(certificate_files());
  expect_folder_of("--junit", options.junit);
  what.points = options.points > 0 ? options.points : properties::points_of_kind(what.subjects.front()->identity().kind);
  what.cases = static_cast<int>(options.cases);
  what.seed = options.seed;
  what.threads = options.threads;
  PartTimes times;
  std::optional<CertifyProgress> progress(what);
  what.on_case = [&](std::string_view subject, const std::string& property, double) {
    times.add(files::printable(subject), property);
    progress->draw();
  };
  auto certificate = properties::certify(
      what,
      [&](std::string_view name, double done) {
        times.add(files::printable(name), kPoints);
        progress->draw(name, done);
      },
      interrupted());
  progress.reset();  // off the row that is printed on
  if (!certificate) {
    tell("interrupted: no certificate was written");
    return kInterrupted;
  }
  const subjects::Options named = subject.options();
  const std::vector<std::string> subject_files = subjects::written_files(named);
  for (std::size_t i = 0; i < subject_files.size(); ++i) {
    certificate->subjects[i].subject_file = subject_files[i];
    certificate->subjects[i].options = subjects::written_for_shell(named);
  }
  if (!options.junit.empty()) write_file(options.junit, junit_of(*certificate, times));
  return write_certificate(*certificate, out.folder());
}

}  // namespace

void add_certify(CLI::App& app, int& result) {
  const auto options = std::make_shared<CertifyOptions>();
  CLI::App* command = app.add_subcommand("certify", "Check the fast path against the reference and write a certificate");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::several);
  command->option_defaults()->group(kEvidenceGroup);
  add_whole(*command, "--points",
            "points per law, height map or mesh, half of them aimed, and a quarter as many with other parameters; "
            "default: " +
                std::to_string(properties::points_of_kind(kLawKind)) + ", for a height map or mesh " +
                std::to_string(properties::points_of_kind(kHeightMapKind)),
            {1, 1000000000000}, [options](std::uint64_t given) { options->points = given; });
  add_whole(*command, "--cases", options->cases, "cases per property (passivity: a tenth)", kCases);
  add_whole(*command, "--seed", options->seed, "seed of points and cases", kSeeds);
  add_whole(*command, "--threads", options->threads, "threads", {1, 1024})->group(kOtherGroup);
  const auto out = std::make_shared<OutFolder>(*command, kCertificateFolder);
  add_junit(*command, options->junit);
  add_certify_merge(*command, result);
  add_certify_plan(*command, result);
  add_certify_work(*command, result);
  command->callback([options, subject, out, command, &result] {
    if (command->get_subcommands().empty()) result = run(*options, *subject, *out);
  });
}

}  // namespace forceshade::apps
