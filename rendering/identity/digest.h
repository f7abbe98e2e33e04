// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SHA-256, in hex.

#include <openssl/evp.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace forceshade {

// Fed with text and lines of it, and with binary32 and whole numbers as their four bytes, the least significant first.
class Digest {
 public:
  Digest() { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }

  void text(std::string_view text) { EVP_DigestUpdate(context_.get(), text.data(), text.size()); }
  void line(std::string_view words) {
    text(words);
    text("\n");
  }
  void number(float value) { whole(std::bit_cast<std::uint32_t>(value)); }
  void whole(std::uint32_t bits) {
    const unsigned char bytes[]{static_cast<unsigned char>(bits), static_cast<unsigned char>(bits >> 8),
                                static_cast<unsigned char>(bits >> 16), static_cast<unsigned char>(bits >> 24)};
    EVP_DigestUpdate(context_.get(), bytes, sizeof bytes);
  }
  std::string hex() {
    unsigned char bytes[EVP_MAX_MD_SIZE];
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), bytes, &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) text += {"0123456789abcdef"[bytes[i] >> 4], "0123456789abcdef"[bytes[i] & 15]};
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

}  // namespace forceshade
