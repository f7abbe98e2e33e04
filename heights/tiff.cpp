// SPDX-License-Identifier: BSD-3-Clause
// TIFF through libtiff: one binary32 number a sample, in strips.

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <string>

#include "forceshade/heights/samples.h"

namespace forceshade::heights {
namespace {

struct Message {
  char text[200] = "cannot be read";
};

int keep_message(TIFF*, void* to, const char*, const char* format, va_list arguments) {
  std::vsnprintf(static_cast<Message*>(to)->text, sizeof Message::text, format, arguments);
  return 1;
}
int ignore_warning(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

// Refuses whatever says that the numbers are no heights, or not where they stand.
void expect_heights_alone(TIFF* tiff, const std::filesystem::path& file) {
  std::uint16_t bits = 0, samples_per_pixel = 0, format = 0, orientation = 0, photometric = PHOTOMETRIC_MINISBLACK, below = 0;
  std::uint64_t* places = nullptr;
  float across = 1, along = 1;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples_per_pixel);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  if (bits != 32 || samples_per_pixel != 1 || format != SAMPLEFORMAT_IEEEFP || TIFFIsTiled(tiff) != 0)
    throw Error(file, "is not one binary32 number a sample, in strips");
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
  if (orientation != ORIENTATION_TOPLEFT)
    throw Error(file, "declares orientation " + std::to_string(orientation) + "; expected 1, the first row on top");
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  if (photometric != PHOTOMETRIC_MINISBLACK)
    throw Error(file,
                "declares photometric interpretation " + std::to_string(photometric) + "; expected 1, greyscale with 0 black");
  if (TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &across) == 1 && TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &along) == 1 &&
      across != along)
    throw Error(file, "has pixels that are not square; expected one resolution");
  if (TIFFLastDirectory(tiff) == 0 || TIFFGetField(tiff, TIFFTAG_SUBIFD, &below, &places) == 1)
    throw Error(file, "has more than one page; expected one");
}

}  // namespace

Samples read_tiff(const std::filesystem::path& file) {
  Message message;
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &keep_message, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &ignore_warning, nullptr);
  // No strip or table of an honest file is larger.
  const std::uint64_t most =
      std::min(kCompressed * std::filesystem::file_size(file), kMostSamples * sizeof(float)) + (1U << 16);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(most));
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(TIFFOpenExt(file.c_str(), "r", options.get()), &TIFFClose);
  if (tiff == nullptr) throw Error(file, message.text);
  std::uint32_t columns = 0, rows = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &columns);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &rows);
  expect_heights_alone(tiff.get(), file);
  Samples samples = allocate(file, columns, rows, sizeof(float), kCompressed);
  if (TIFFScanlineSize(tiff.get()) != static_cast<tmsize_t>(columns * sizeof(float)))
    throw Error(file, "has rows of another size");
  for (std::uint32_t row = 0; row < rows; ++row)
    if (TIFFReadScanline(tiff.get(), samples.row_from_top(row), row) != 1) throw Error(file, message.text);
  return samples;
}

}  // namespace forceshade::heights
