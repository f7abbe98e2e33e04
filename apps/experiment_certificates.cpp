// SPDX-License-Identifier: BSD-3-Clause
#include "apps/experiment_certificates.h"

#include <cctype>
#include <cstdio>

#include "apps/command.h"
#include "apps/signals.h"
#include "forceshade/certify.h"
#include "forceshade/checks.h"
#include "forceshade/run.h"
#include "rendering/identity/digest.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;
using experiments::Bump;

// A subject that lives elsewhere.
std::shared_ptr<const properties::Subject> borrowed(const properties::Subject& subject) {
  return {std::shared_ptr<const properties::Subject>(), &subject};
}

run::Certified covering(const properties::Subject& subject, const fs::path& folder) {
  const fs::path file = folder / certificate_name(subject.identity());
  if (!fs::exists(file)) return {std::nullopt, file.string() + " is not there; 'forceshade experiment prepare' makes it"};
  return run::certified(file, subject.identity());
}

}  // namespace

std::string certificate_name(const Identity& identity) {
  Digest digest;
  for (const std::string& word : {identity.kind, identity.name, identity.digest}) digest.line(word);
  for (const auto& [key, value] : identity.parameters) digest.line(key + '=' + forceshade::text_of(value));
  std::string name = identity.name;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return name + '-' + digest.hex().substr(0, 16) + ".json";
}

bool prepare_certificates(Bumps& bumps, const fs::path& folder, unsigned threads) {
  const std::vector<Bump> all = bumps.protocol().bumps();
  bool held = true;
  int done = 0, kept = 0;
  for (const Bump& bump : all) {
    const properties::Subject& subject = bumps.of(bump);
    const fs::path file = folder / certificate_name(subject.identity());
    ++done;
    // A certificate of an earlier build covers nothing now, and is made again.
    if (fs::exists(file) && run::certified(file, subject.identity()).digest) {
      ++kept;
      continue;
    }
    const auto certificate = properties::certify(
        {.subjects = {borrowed(subject)},
         .points = properties::points_of_kind(subject.identity().kind),
         .seed = 1,
         .threads = threads},
        [](std::string_view, double) {}, interrupted());
    if (!certificate) throw Interrupted("the certificates made so far are in " + folder.string());
    write_file(file, to_json(*certificate));
    const run::Certified covers = run::certified(file, subject.identity());
    held = held && covers.digest;
    std::printf("%3d of %zu  %-28s %s\n", done, all.size(), words_of(bump).c_str(),
                covers.digest ? "certified" : ("FAILED: " + covers.why_not).c_str());
    std::fflush(stdout);
  }
  std::printf("%zu bumps, %d of them certified before\n", all.size(), kept);
  return held;
}

std::map<std::string, std::string> certificates_of(Bumps& bumps, const fs::path& folder) {
  std::map<std::string, std::string> digests;
  std::string lacking, why;
  int count = 0;
  constexpr int kNamed = 10;
  for (const Bump& bump : bumps.protocol().bumps()) {
    const properties::Subject& subject = bumps.of(bump);
    const run::Certified covers = covering(subject, folder);
    if (covers.digest) {
      digests[certificate_name(subject.identity())] = *covers.digest;
      continue;
    }
    if (++count <= kNamed) lacking += (count > 1 ? "; " : "") + words_of(bump);
    if (why.empty()) why = covers.why_not;
  }
  if (count == 0) return digests;
  if (count > kNamed) lacking += "; and " + std::to_string(count - kNamed) + " more";
  throw BadInput("no certificate of this build covers " + lacking + " (" + why + "); 'forceshade experiment prepare PROTOCOL " +
                 "--out " + folder.string() + "' makes what is missing");
}

}  // namespace forceshade::apps
