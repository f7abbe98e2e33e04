// SPDX-License-Identifier: BSD-3-Clause
// In place of png.cpp and tiff.cpp in a build without libpng and libtiff.
#include "rendering/heights/samples.h"
#include "rendering/left_out.h"

namespace forceshade::heights {

Samples read_png(const Source& source) {
  throw LeftOut(source.file.string() + " is a PNG picture, which cannot be read", "image-files");
}

Samples read_tiff(const Source& source) {
  throw LeftOut(source.file.string() + " is a TIFF picture, which cannot be read", "image-files");
}

}  // namespace forceshade::heights
