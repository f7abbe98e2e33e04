// SPDX-License-Identifier: BSD-3-Clause
// In place of digest.cpp in a build without certificates, which is all that digests are for.
#include "rendering/identity/digest.h"

namespace forceshade {

void Digest::Free::operator()(evp_md_ctx_st*) const noexcept {}

Digest::Digest() = default;

void Digest::bytes(const void*, std::size_t) {}

std::string Digest::hex() {
  return "";
}

}  // namespace forceshade
