// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/certificates.h"

#include <cctype>

#include "forceshade/error.h"
#include "forceshade/run.h"
#include "rendering/identity/digest.h"

namespace forceshade::apparatus {
namespace {

namespace fs = std::filesystem;
using experiments::Bump;

run::Certified covering(const Identity& identity, const fs::path& folder) {
  const fs::path file = folder / certificate_name(identity);
  if (!fs::exists(file)) return {std::nullopt, file.string() + " is not there; 'forceshade-study experiment prepare' makes it"};
  return run::certified(file, identity);
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

std::map<std::string, std::string> certificates_of(Bumps& bumps, const fs::path& folder) {
  std::map<std::string, std::string> digests;
  std::string lacking, why;
  int count = 0;
  constexpr int kNamed = 10;
  for (const Bump& bump : bumps.protocol().bumps()) {
    const Identity& identity = bumps.of(bump).identity;
    const run::Certified covers = covering(identity, folder);
    if (covers.digest) {
      digests[certificate_name(identity)] = *covers.digest;
      continue;
    }
    if (++count <= kNamed) lacking += (count > 1 ? "; " : "") + words_of(bump);
    if (why.empty()) why = covers.why_not;
  }
  if (count == 0) return digests;
  if (count > kNamed) lacking += "; and " + std::to_string(count - kNamed) + " more";
  throw Error("no certificate of this build covers " + lacking + " (" + why +
              "); 'forceshade-study experiment prepare PROTOCOL " + "--out " + folder.string() + "' makes what is missing");
}

}  // namespace forceshade::apparatus
