// SPDX-License-Identifier: BSD-3-Clause
// PNG through libpng, whose errors jump: nothing with a destructor lives between setjmp and what may jump.

#include <png.h>

#include <cstdio>
#include <memory>
#include <span>
#include <string_view>

#include "files/decimal.h"
#include "rendering/heights/samples.h"
#include "rendering/heights/xml.h"

namespace forceshade::heights {
namespace {

// Puts libpng's message into the error's text.
void keep_message(png_structp png, png_const_charp message) {
  std::snprintf(static_cast<char*>(png_get_error_ptr(png)), 200, "%s", message);
  png_longjmp(png, 1);
}
void ignore_warning(png_structp, png_const_charp) {}

bool are_equal(std::string_view a, std::string_view b) {
  for (std::string_view* number : {&a, &b})
    if (number->starts_with('+')) number->remove_prefix(1);
  const auto first = files::Decimal::of(a), second = files::Decimal::of(b);
  return first && second && *first == *second;
}

class Reader {
 public:
  explicit Reader(const Source& source)
      : source_(source), file_(source.file), stream_(std::fopen(source.file.c_str(), "rb"), &std::fclose) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, message_, &keep_message, &ignore_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) return;
    // A chunk that was changed, or left over, is an error: its content may have mattered.
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_set_benign_errors(png_, 0);
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>("acTL\0sTER"), 2);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  Samples read() {
    if (stream_ == nullptr || info_ == nullptr || !read_header()) throw Error(file_, message_);
    const int depth = png_get_bit_depth(png_, info_);
    if (png_get_color_type(png_, info_) != PNG_COLOR_TYPE_GRAY || depth < 8) throw Error(file_, "is not 8 or 16 bit greyscale");
    const auto bytes = static_cast<std::uint32_t>(depth / 8);
    if (png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE) throw Error(file_, "is interlaced");
    Samples samples =
        allocate(source_, png_get_image_width(png_, info_), png_get_image_height(png_, info_), bytes, kCompressed);
    std::vector<unsigned char> row(std::size_t{samples.columns} * bytes);
    const float white = depth == 8 ? 255 : 65535;
    for (std::uint32_t i = 0; i < samples.rows; ++i) {
      if (!read_row(row.data())) throw Error(file_, message_);
      samples.put_row(i, [&](std::size_t k) {
        return static_cast<double>(static_cast<float>(bytes == 1 ? row[k] : 256 * row[2 * k] + row[2 * k + 1]) / white);
      });
    }
    if (!read_end()) throw Error(file_, message_);
    if (std::fgetc(stream_.get()) != EOF) throw Error(file_, "goes on after its end");
    expect_heights_alone();
    return samples;
  }

 private:
  // That no chunk, wherever in the file, says that a sample is no height, or not where it stands. How bright a sample is shown
  // (gAMA, sRGB, cHRM, iCCP) changes no height: a height is the sample's number.
  void expect_heights_alone() const {
    const auto refuse = [&](const char* what) { throw Error(file_, what); };
    if (png_get_valid(png_, info_, PNG_INFO_tRNS) != 0) refuse("has a transparent level (tRNS); expected greyscale alone");
    if (png_get_valid(png_, info_, PNG_INFO_pCAL) != 0) refuse("has a scale of its own (pCAL); expected none");
    if (png_get_valid(png_, info_, PNG_INFO_eXIf) != 0) refuse("has Exif data (eXIf), which may turn it; expected none");
    png_uint_32 across = 1, along = 1;
    int unit = 0;
    png_get_pHYs(png_, info_, &across, &along, &unit);  // without a unit, too: the numbers are then a ratio alone
    if (across != along) refuse("has pixels that are not square (pHYs); expected one pitch");
    png_charp width = nullptr, height = nullptr;
    if (png_get_sCAL_s(png_, info_, &unit, &width, &height) != 0 && !are_equal(width, height))
      refuse("has pixels that are not square (sCAL); expected one size");
    png_unknown_chunkp other = nullptr;
    if (png_get_unknown_chunks(png_, info_, &other) > 0)
      refuse(other->name[0] == 's' ? "is a pair for two eyes (sTER); expected one picture"
                                   : "is animated (acTL); expected one picture");
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png_, info_, &texts, &count);
    for (const png_text& text : std::span(texts, static_cast<std::size_t>(count))) {
      const std::string_view key = text.key;
      // The Exif data of programs that are older than eXIf.
      if (key == "Raw profile type exif" || key == "Raw profile type APP1")
        refuse("has Exif data (Raw profile), which may turn it; expected none");
      if (key == "Raw profile type xmp") refuse("has XMP (Raw profile), which may turn it; expected none");
      if (key == "XML:com.adobe.xmp" && is_turned_by_xmp(text.text))
        refuse("is turned by its XMP (tiff:Orientation); expected 1, the first row on top");
    }
  }

  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, stream_.get());
    png_read_info(png_, info_);
    return true;
  }
  bool read_row(unsigned char* to) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, to, nullptr);
    return true;
  }
  bool read_end() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_end(png_, info_);
    return true;
  }

  const Source& source_;
  const std::filesystem::path& file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char message_[200] = "cannot be read";
};

}  // namespace

Samples read_png(const Source& source) {
  return Reader(source).read();
}

}  // namespace forceshade::heights
