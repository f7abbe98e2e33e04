// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/bytes.h"

#include "rendering/meshes/lines.h"

namespace forceshade::mesh {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;

}  // namespace

Bytes::Bytes(const std::filesystem::path& file, std::uint64_t begin, std::endian order)
    : file_(file),
      in_(),
      order_(order),
      position_(begin),
      size_(size_of(file)),
      room_(static_cast<std::size_t>(std::min<std::uint64_t>(kBuffer, size_ + 1))),
      buffer_(std::make_unique_for_overwrite<char[]>(room_)) {
  in_.rdbuf()->pubsetbuf(nullptr, 0);  // this has a buffer of its own
  in_.open(file, std::ios::binary);
  if (!in_ || !in_.seekg(static_cast<std::streamoff>(begin))) throw Error(file, "cannot be opened");
}

const char* Bytes::next(std::size_t bytes) {
  if (bytes > left()) throw error(position_, "the file is truncated");
  if (end_ - begin_ < bytes) {
    std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    in_.read(buffer_.get() + end_, static_cast<std::streamsize>(room_ - end_));
    end_ += static_cast<std::size_t>(in_.gcount());
    if (end_ < bytes) throw error(position_, "cannot be read");
  }
  const char* const at = buffer_.get() + begin_;
  begin_ += bytes;
  position_ += bytes;
  return at;
}

void Bytes::skip(std::uint64_t bytes) {
  if (bytes > left()) throw error(position_, "the file is truncated");
  for (std::size_t part = 0; bytes > 0; bytes -= part) {
    part = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, room_));
    next(part);
  }
}

Error Bytes::error(std::uint64_t position, const std::string& reason) const {
  return {file_, "byte " + std::to_string(position) + ": " + reason};
}

}  // namespace forceshade::mesh
