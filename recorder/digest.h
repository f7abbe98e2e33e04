// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The checksum of a chunk.

#include <openssl/sha.h>

#include <array>
#include <cstddef>
#include <span>

namespace forceshade::recorder {

inline std::array<std::byte, SHA256_DIGEST_LENGTH> sha256(std::span<const std::byte> data) {
  std::array<std::byte, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), reinterpret_cast<unsigned char*>(digest.data()));
  return digest;
}

}  // namespace forceshade::recorder
