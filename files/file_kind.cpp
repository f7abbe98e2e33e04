// SPDX-License-Identifier: BSD-3-Clause
#include "files/file_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <system_error>

namespace forceshade::files {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view beginning, kind;
};
constexpr std::array kSignatures{Signature{kLfsBeginning, kLfsPointer},
                                 Signature{"\x89PNG"sv, "a PNG picture"},
                                 Signature{"\xff\xd8\xff"sv, "a JPEG picture"},
                                 Signature{"GIF8"sv, "a GIF picture"},
                                 Signature{"II*\0"sv, "a TIFF picture"},
                                 Signature{"MM\0*"sv, "a TIFF picture"},
                                 Signature{"II+\0"sv, "a TIFF picture"},
                                 Signature{"MM\0+"sv, "a TIFF picture"},
                                 Signature{"\x93NUMPY"sv, "an NPY array"},
                                 Signature{"SQLite format 3\0"sv, "a recording or another SQLite database"},
                                 Signature{"PK\x03\x04"sv, "a ZIP archive"},
                                 Signature{"\x1f\x8b"sv, "a gzip archive"},
                                 Signature{"\x89HDF"sv, "an HDF5 file"},
                                 Signature{"\xd0\xcf\x11\xe0"sv, "an Excel or another Office file"},
                                 Signature{"%PDF-"sv, "a PDF document"},
                                 Signature{"\x7f"
                                           "ELF"sv,
                                           "a program"},
                                 Signature{"\xff\xfe"sv, "a UTF-16 text"},
                                 Signature{"\xfe\xff"sv, "a UTF-16 text"}};

constexpr std::string_view kBlank = " \t\r\n";

// The first line that is neither blank nor a comment of TOML, and all that follows.
std::string_view from_first_line(std::string_view text) {
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    if (!text.starts_with('#')) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

// A list of JSON ends as it begins, and no [table] or [[table]] of TOML could have its first element as a name.
bool begins_as_json(std::string_view text) {
  if (text.starts_with('{')) return true;
  const std::size_t element = text.find_first_not_of(std::string(kBlank) + '[');
  return text.starts_with('[') && element != std::string_view::npos &&
         std::string_view("{\"-0123456789").find(text[element]) != std::string_view::npos &&
         text[text.find_last_not_of(kBlank)] == ']';
}

bool begins_as_toml(std::string_view line) {
  const std::size_t key = line.find_first_of(" \t=");
  if (line.starts_with('[')) return line.find(']') != std::string_view::npos;
  if (key == 0 || key == std::string_view::npos) return false;
  const std::size_t sign = line.find_first_not_of(" \t", key);
  return sign != std::string_view::npos && line[sign] == '=';
}

// Columns in the first line, and as many in the second if there is one.
bool begins_as_csv(std::string_view text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view first = text.substr(0, end), rest = text.substr(std::min(end + 1, text.size()));
  const std::string_view second = rest.substr(0, rest.find('\n'));
  return std::ranges::any_of(std::string_view(",;\t"), [&](char separator) {
    const auto columns = std::ranges::count(first, separator);
    return columns > 0 && (second.empty() || std::ranges::count(second, separator) == columns);
  });
}

}  // namespace

std::string binary_kind(std::string_view bytes) {
  for (const Signature& signature : kSignatures)
    if (bytes.starts_with(signature.beginning)) return std::string(signature.kind);
  return bytes.find('\0') == std::string_view::npos ? "" : std::string(kBinaryFile);
}

std::string text_kind(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // with which some programs begin a text in UTF-8
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  if (text.find_first_not_of(kBlank) == std::string_view::npos) return "an empty file";
  text = from_first_line(text);
  if (begins_as_json(text)) return std::string(kJsonFile);
  if (text.starts_with('<')) return std::string(kXmlFile);
  // Excel's line in front of the header, sep=; or "sep=;".
  if (text.substr(text.starts_with('"') ? 1 : 0).starts_with("sep=") && text.find_first_of(",;\t|") < 6)
    return std::string(kCsvFile);
  if (begins_as_toml(text.substr(0, text.find('\n')))) return std::string(kTomlFile);
  return begins_as_csv(text) ? std::string(kCsvFile) : "";
}

std::string kind_of_file(std::string_view bytes) {
  for (const std::string& kind : {binary_kind(bytes), text_kind(bytes)})
    if (!kind.empty()) return kind;
  return "a text";
}

bool is_folder(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_directory(path, none);
}

bool is_named_pipe(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_fifo(path, none) && !std::filesystem::canonical(path, none).empty();  // an unnamed one has no path
}

}  // namespace forceshade::files
