// SPDX-License-Identifier: BSD-3-Clause
#include "files/file_kind.h"

#include <array>

namespace forceshade::files {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view beginning, kind;
};
constexpr std::array kSignatures{Signature{"\x89PNG"sv, "a PNG picture"},
                                 Signature{"\xff\xd8\xff"sv, "a JPEG picture"},
                                 Signature{"GIF8"sv, "a GIF picture"},
                                 Signature{"II*\0"sv, "a TIFF picture"},
                                 Signature{"MM\0*"sv, "a TIFF picture"},
                                 Signature{"\x93NUMPY"sv, "an NPY array"},
                                 Signature{"SQLite format 3\0"sv, "a recording or another SQLite database"},
                                 Signature{"PK\x03\x04"sv, "a ZIP archive"},
                                 Signature{"\x1f\x8b"sv, "a gzip archive"},
                                 Signature{"%PDF-"sv, "a PDF document"},
                                 Signature{"\x7f"
                                           "ELF"sv,
                                           "a program"},
                                 Signature{"\xff\xfe"sv, "a UTF-16 text"},
                                 Signature{"\xfe\xff"sv, "a UTF-16 text"}};

}  // namespace

std::string binary_kind(std::string_view bytes) {
  for (const Signature& signature : kSignatures)
    if (bytes.starts_with(signature.beginning)) return std::string(signature.kind);
  return bytes.find('\0') == std::string_view::npos ? "" : "a binary file";
}

}  // namespace forceshade::files
