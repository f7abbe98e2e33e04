// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The certificates of an experiment: one for each bump that a session can render, kept in a folder by what they are of.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/experiment_bumps.h"

namespace forceshade::apps {

// "bump-1p-shaded-0123456789abcdef.json": the name, and the beginning of the digest of the whole identity.
std::string certificate_name(const Identity& identity);

// Of what the folder lacks, certifies each with as many points and cases as `drive` demands: a certificate of fewer would not
// let anything be driven. What is there and covers this build is kept. Says each on standard output; false where one failed.
// Throws Interrupted.
bool prepare_certificates(Bumps& bumps, const std::filesystem::path& folder, unsigned threads);

// The digest of each bump's certificate, by certificate_name(). Throws BadInput, with every bump that no certificate of this
// build covers and the reason of the first.
std::map<std::string, std::string> certificates_of(Bumps& bumps, const std::filesystem::path& folder);

}  // namespace forceshade::apps
