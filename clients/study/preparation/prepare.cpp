// SPDX-License-Identifier: BSD-3-Clause
#include "study/preparation/prepare.h"

#include "files/output_file.h"
#include "forceshade/certify.h"
#include "forceshade/checks.h"
#include "forceshade/properties.h"
#include "forceshade/run.h"
#include "study/apparatus/certificates.h"

namespace forceshade::apparatus {

namespace fs = std::filesystem;

bool prepare(const fs::path& protocol, const fs::path& folder, const PreparationOptions& options,
             const std::atomic<bool>& stop) {
  return prepare(Bumps(experiments::read_protocol(protocol), read_until(stop)), folder, options, stop);
}

bool prepare(const Bumps& bumps, const fs::path& folder, const PreparationOptions& options, const std::atomic<bool>& stop) {
  const std::vector<experiments::Bump> all = bumps.protocol().bumps();
  bool held = true;
  Prepared one;
  one.of = all.size();
  for (const experiments::Bump& bump : all) {
    const std::shared_ptr<const properties::Subject> subject = properties::subject_of(bumps.description(bump));
    const fs::path file = folder / certificate_name(subject->identity());
    ++one.number;
    one.bump = words_of(bump);
    // A certificate of an earlier build covers nothing now, and is made again.
    one.was_there = fs::exists(file) && run::certified(file, subject->identity()).digest;
    one.why_not.clear();
    if (!one.was_there) {
      const auto certificate = properties::certify(
          {.subjects = {subject},
           .points = properties::points_of_kind(subject->identity().kind),
           .seed = 1,
           .threads = options.threads},
          [](std::string_view, double) {}, stop);
      if (!certificate) throw Interrupted("the certificates made so far are in " + folder.string());
      files::write_file(file, to_json(*certificate));
      one.why_not = run::certified(file, subject->identity()).why_not;
    }
    held = held && one.why_not.empty();
    options.done(one);
  }
  return held;
}

}  // namespace forceshade::apparatus
