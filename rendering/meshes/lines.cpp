// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/lines.h"

#include <algorithm>
#include <cstring>
#include <system_error>

#include "files/file_kind.h"
#include "text/beginning.h"

namespace forceshade::mesh {
namespace {

constexpr std::size_t kLineBuffer = 2 * Lines::kLongest + 2;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r';
}

}  // namespace

std::string_view Words::next() {
  std::size_t begin = 0;
  while (begin < rest_.size() && is_space(rest_[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest_.size() && !is_space(rest_[end])) ++end;
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

std::string_view Words::rest() const {
  std::string_view rest = rest_;
  while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
  return rest;
}

std::uint64_t size_of(const std::filesystem::path& file) {
  std::error_code error;
  const auto kind = std::filesystem::status(file, error).type();
  if (kind == std::filesystem::file_type::not_found) throw Error(file, "is not there");
  if (kind != std::filesystem::file_type::regular) throw Error(file, "is no regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw Error(file, error.message());
  return size;
}

Lines::Lines(const std::filesystem::path& file)
    : file_(file),
      in_(),
      file_size_(size_of(file)),
      room_(static_cast<std::size_t>(std::min<std::uint64_t>(kLineBuffer, file_size_ + 1))),
      buffer_(std::make_unique_for_overwrite<char[]>(room_)) {
  in_.rdbuf()->pubsetbuf(nullptr, 0);  // this has a buffer of its own
  in_.open(file, std::ios::binary);
  if (!in_) throw Error(file, "cannot be opened");
}

// Reads more behind what is there; false where nothing more comes.
bool Lines::fill() {
  std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  in_.read(buffer_.get() + end_, static_cast<std::streamsize>(room_ - end_));
  if (in_.bad()) throw Error(file_, "cannot be read");
  const auto got = static_cast<std::size_t>(in_.gcount());
  end_ += got;
  return got > 0;
}

bool Lines::next() {
  ++number_;
  std::size_t searched = 0;  // bytes from begin_ that hold no end of a line
  while (true) {
    const char* const from = buffer_.get() + begin_;
    const std::size_t size = end_ - begin_;
    const char* const feed = static_cast<const char*>(std::memchr(from + searched, '\n', size - searched));
    const std::size_t until = feed != nullptr ? static_cast<std::size_t>(feed - from) : size;
    const char* const turn = static_cast<const char*>(std::memchr(from + searched, '\r', until - searched));
    std::size_t length = until, taken = until + 1;
    bool is_found = feed != nullptr;
    // A CR may end the line alone: the next byte decides.
    if (turn != nullptr && (turn + 1 < from + size || in_.eof())) {
      length = static_cast<std::size_t>(turn - from);
      taken = length + (turn + 1 < from + size && turn[1] == '\n' ? 2 : 1);
      is_found = true;
    }
    if (!is_found) {
      searched = turn != nullptr ? static_cast<std::size_t>(turn - from) : size;
      if (searched <= kLongest && fill()) continue;
      if (searched <= kLongest && turn != nullptr) continue;  // the file's last byte is a CR
      length = taken = end_ - begin_;
    }
    if (length > kLongest) throw error("is longer than " + std::to_string(kLongest) + " bytes");
    if (taken == 0) {
      line_ = {};
      --number_;
      return false;
    }
    line_ = {buffer_.get() + begin_, length};
    if (number_ == 1 && line_.starts_with(files::kByteOrderMark)) line_.remove_prefix(files::kByteOrderMark.size());
    begin_ += taken;
    position_ += taken;
    return true;
  }
}

bool Lines::next_with_words() {
  while (next()) {
    const std::size_t comment = line_.find('#');
    if (comment != std::string_view::npos) line_ = line_.substr(0, comment);
    if (!Words(line_).next().empty()) return true;
  }
  return false;
}

Error Lines::error(const std::string& reason) const {
  return {file_, "line " + std::to_string(number_) + ": " + reason};
}

Error Lines::unexpected(const std::string& expected, std::string_view word) const {
  return error("expected " + expected + ", got " + (word.empty() ? "the end of the line" : in_quotes(word)));
}

Error Lines::ended(const std::string& expected) const {
  if (number_ == 0) return {file_, "is empty; expected " + expected};
  return error("the file ends here; expected " + expected);
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string shown = "\"";
  for (const char c : beginning_of(word, kMost)) c == '\0' ? shown += "\\x00" : shown += c;
  return shown + (word.size() > kMost ? "...\"" : "\"");
}

}  // namespace forceshade::mesh
