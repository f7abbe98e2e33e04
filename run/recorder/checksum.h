// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The checksums of a chunk and of the metadata.

#include <openssl/sha.h>

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>

namespace forceshade::recorder {

inline std::array<std::byte, SHA256_DIGEST_LENGTH> sha256(std::span<const std::byte> data) {
  std::array<std::byte, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(data.data()), data.size(), reinterpret_cast<unsigned char*>(digest.data()));
  return digest;
}

// The digest, in hexadecimal, of every key and value but the digest's own, in the order of the keys' bytes, each as
// LENGTH:BYTES, where LENGTH is a decimal number of bytes: no two sets of metadata are written alike.
inline std::string digest_of(const std::map<std::string, std::string>& metadata, const std::string& digest_key) {
  std::string text;
  const auto write = [&](const std::string& word) { text += std::to_string(word.size()) + ':' + word + ','; };
  for (const auto& [key, value] : metadata) {
    if (key == digest_key) continue;
    write(key);
    write(value);
  }
  std::string hex;
  for (const std::byte byte : sha256(std::as_bytes(std::span(text))))
    for (const int shift : {4, 0}) hex += "0123456789abcdef"[std::to_integer<unsigned>(byte) >> shift & 15U];
  return hex;
}

}  // namespace forceshade::recorder
