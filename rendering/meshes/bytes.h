// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The binary part of a file, from its front to its end, in little memory.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "forceshade/meshes.h"

namespace forceshade::mesh {

class Bytes {
 public:
  // Reads the file from the byte `begin` on, the first being 0. Throws Error unless the file is a regular one that can be
  // opened.
  Bytes(const std::filesystem::path& file, std::uint64_t begin, std::endian order);

  // The next number, of the type of sizeof(T) bytes. Throws Error at the end of the file.
  template <class T>
  T take() {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), next(sizeof(T)), sizeof(T));
    if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    T number;
    std::memcpy(&number, bytes.data(), sizeof(T));
    return number;
  }
  void skip(std::uint64_t bytes);

  std::uint64_t position() const { return position_; }  // of the next byte
  std::uint64_t left() const { return size_ - position_; }
  std::uint64_t file_size() const { return size_; }

  // "FILE: byte 84: REASON".
  Error error(std::uint64_t position, const std::string& reason) const;

 private:
  const char* next(std::size_t bytes);

  std::filesystem::path file_;
  std::ifstream in_;
  std::endian order_;
  std::uint64_t position_, size_;
  std::size_t room_;  // of the buffer
  std::unique_ptr<char[]> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what was read and not taken
};

}  // namespace forceshade::mesh
