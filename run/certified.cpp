// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/build.h"
#include "forceshade/certificate.h"
#include "forceshade/run.h"
#include "rendering/identity/digest.h"

namespace forceshade::run {

// Decides by the identity, of which damping is no part: its stage is right for every rate, parameter and force
// (docs/damping.md).
Certified certified(const std::string& file, const Identity& rendering) {
  if (file.empty())
    return {std::nullopt, "no certificate was given; expected --certificate FILE, as written by 'forceshade certify'"};
  const std::string text = properties::read_certificate(file);
  const properties::Certificate certificate = properties::from_json(text, file);
  if (const auto refused = refusal(certificate, properties::current_build(), rendering))
    return {std::nullopt, file + ": " + *refused};
  return {digest_of_text(text), ""};
}

}  // namespace forceshade::run
