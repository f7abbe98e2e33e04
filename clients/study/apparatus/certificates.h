// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The certificates of an experiment: one for each bump that a session can render, kept in a folder by what they are of.

#include <filesystem>
#include <map>
#include <string>

#include "study/apparatus/bumps.h"

namespace forceshade::apparatus {

// "bump-1p-shaded-0123456789abcdef.json": the name, and the beginning of the digest of the whole identity.
std::string certificate_name(const Identity& identity);

// The digest of each bump's certificate, by certificate_name(). Throws Error, with every bump that no certificate of this
// build covers and the reason of the first.
std::map<std::string, std::string> certificates_of(Bumps& bumps, const std::filesystem::path& folder);

}  // namespace forceshade::apparatus
