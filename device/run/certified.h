// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether a certificate covers what is to be driven.

#include <optional>
#include <string>

#include "rendering/identity/identity.h"

namespace forceshade::run {

struct Certified {
  std::optional<std::string> digest;  // SHA-256 of the certificate's file, in hex; none where it does not cover the rendering
  std::string why_not;                // then the reason
};

// file: certificate.json, as `forceshade certify` or certify() writes it; an empty name is no file. The certificate has to be
// of this build, of a rendering with this identity, and sufficient. Throws std::runtime_error for a file that is no
// certificate.
Certified certified(const std::string& file, const Identity& rendering);

}  // namespace forceshade::run
