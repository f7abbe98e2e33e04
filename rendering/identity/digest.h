// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SHA-256, in hex.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace forceshade {

// Fed with text and lines of it, and with binary32 and whole numbers as their four bytes, the least significant first. In a
// build without certificates the digest is empty.
class Digest {
 public:
  Digest();

  void text(std::string_view text) { bytes(text.data(), text.size()); }
  void line(std::string_view words) {
    text(words);
    text("\n");
  }
  void number(float value) { whole(std::bit_cast<std::uint32_t>(value)); }
  void whole(std::uint32_t bits) {
    const unsigned char four[]{static_cast<unsigned char>(bits), static_cast<unsigned char>(bits >> 8),
                               static_cast<unsigned char>(bits >> 16), static_cast<unsigned char>(bits >> 24)};
    bytes(four, sizeof four);
  }
  std::string hex();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const noexcept;
  };

  void bytes(const void* from, std::size_t count);

  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

inline std::string digest_of_text(std::string_view text) {
  Digest digest;
  digest.text(text);
  return digest.hex();
}

}  // namespace forceshade
