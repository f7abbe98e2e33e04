// SPDX-License-Identifier: BSD-3-Clause
// TIFF through libtiff: one number a sample, whole or binary, in strips or tiles, without loss.

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "files/decimal.h"
#include "files/printable.h"
#include "rendering/heights/samples.h"
#include "rendering/heights/xml.h"

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

// One kind of number. An unsigned one is a picture's, whose white is its largest: a sample is the binary32 number nearest to
// number / white, as in a PNG. Any other sample is the number itself.
struct Kind {
  std::uint16_t format, bits;
  double (*sample)(double number);
  double (*number)(const unsigned char* row, std::size_t column);  // the sample there, in this machine's order of bytes
};

// A number that the file declares in words is rounded to its samples' kind, too, as GDAL compares it: -0.1 is -0.1F.
template <class T>
double sample(double number) {
  if constexpr (std::is_same_v<T, float>)
    return static_cast<double>(static_cast<float>(number));
  else if constexpr (!std::is_unsigned_v<T>)
    return number;
  // In binary64 first, which changes nothing: the quotient's bits are those of the number over and over, so where binary64 ends
  // there was a 1 beyond the middle of two binary32 numbers, if the quotient is beyond it.
  constexpr auto kWhite = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<double>(static_cast<float>(number / kWhite));
}

template <class T>
double number(const unsigned char* row, std::size_t column) {
  T value;
  std::memcpy(&value, row + column * sizeof(T), sizeof(T));
  return sample<T>(static_cast<double>(value));
}

template <class T>
constexpr Kind kind_of_numbers(std::uint16_t format) {
  return {format, 8 * sizeof(T), &sample<T>, &number<T>};
}

constexpr std::array<Kind, 8> kKinds{
    kind_of_numbers<std::uint8_t>(SAMPLEFORMAT_UINT),  kind_of_numbers<std::uint16_t>(SAMPLEFORMAT_UINT),
    kind_of_numbers<std::uint32_t>(SAMPLEFORMAT_UINT), kind_of_numbers<std::int8_t>(SAMPLEFORMAT_INT),
    kind_of_numbers<std::int16_t>(SAMPLEFORMAT_INT),   kind_of_numbers<std::int32_t>(SAMPLEFORMAT_INT),
    kind_of_numbers<float>(SAMPLEFORMAT_IEEEFP),       kind_of_numbers<double>(SAMPLEFORMAT_IEEEFP)};

// Those that lose nothing.
constexpr std::array<std::uint16_t, 7> kCompressions{COMPRESSION_NONE,    COMPRESSION_LZW,  COMPRESSION_ADOBE_DEFLATE,
                                                     COMPRESSION_DEFLATE, COMPRESSION_LZMA, COMPRESSION_PACKBITS,
                                                     COMPRESSION_ZSTD};

const Kind& kind_of(TIFF* tiff, const std::filesystem::path& file) {
  std::uint16_t bits = 0, samples_per_pixel = 0, format = 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples_per_pixel);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  for (const Kind& kind : kKinds)
    if (samples_per_pixel == 1 && format == kind.format && bits == kind.bits) return kind;
  throw Error(file, "has " + std::to_string(samples_per_pixel) + " samples a pixel of " + std::to_string(bits) +
                        " bits and sample format " + std::to_string(format) +
                        "; expected 1 of 8, 16 or 32 bits, whole (1 or 2), or of 32 or 64, binary (3)");
}

// Tags of GDAL and GeoTIFF, which are no names of libtiff's: the number that stands for "no data" as text, other text in XML,
// the sizes of a pixel, the places of some, the matrix that stands in their place where a picture is turned, and what they are
// measured in. One of MetaMorph's.
constexpr std::uint32_t kNoData = 42113, kMetadata = 42112, kPixelScale = 33550, kTiePoints = 33922, kTransformation = 34264,
                        kGeoKeys = 34735, kUic2 = 33629;

bool has_tag(TIFF* tiff, std::uint32_t tag) {
  for (int i = 0; i < TIFFGetTagListCount(tiff); ++i)
    if (TIFFGetTagListEntry(tiff, i) == tag) return true;
  return false;
}

// None where the file does not have the tag. Of another type its numbers would mean nothing, so the file is refused.
template <class T>
std::span<const T> numbers_of(TIFF* tiff, std::uint32_t tag, TIFFDataType type, const std::filesystem::path& file) {
  if (!has_tag(tiff, tag)) return {};
  std::uint32_t count = 0;
  const T* numbers = nullptr;
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (field == nullptr || TIFFFieldDataType(field) != type || TIFFFieldReadCount(field) != TIFF_VARIABLE2 ||
      TIFFGetField(tiff, tag, &count, &numbers) != 1)
    throw Error(file, "has tag " + std::to_string(tag) + " of another type; expected type " + std::to_string(type));
  return {numbers, count};
}

std::string_view text_of(TIFF* tiff, std::uint32_t tag, const std::filesystem::path& file) {
  const std::span<const char> text = numbers_of<char>(tiff, tag, TIFF_ASCII, file);
  return {text.data(), std::min(std::string_view(text.data(), text.size()).find('\0'), text.size())};
}

// A height that GeoTIFF declares for a number of 1: neither 0, which stands for none, nor 1.
bool is_scale(double number) {
  return number != 0 && number != 1;
}

// Refuses what GeoTIFF says about pixels that are not square, turned, or scaled in height.
void expect_square_pixels(TIFF* tiff, const std::filesystem::path& file) {
  const std::string scaled = " its numbers; expected heights, which scale_mm scales";
  const std::span<const double> scale = numbers_of<double>(tiff, kPixelScale, TIFF_DOUBLE, file),
                                matrix = numbers_of<double>(tiff, kTransformation, TIFF_DOUBLE, file);
  if (scale.size() >= 2 && !(scale[0] == scale[1]))
    throw Error(file, "has pixels that are not square (ModelPixelScale); expected one size");
  if (scale.size() >= 3 && is_scale(scale[2])) throw Error(file, "scales (ModelPixelScale)" + scaled);
  if (matrix.size() >= 6 && !(matrix[0] > 0 && matrix[5] == -matrix[0] && matrix[1] == 0 && matrix[4] == 0))
    throw Error(file, "has pixels that are turned or not square (ModelTransformation); expected one size, with y upwards");
  if (matrix.size() >= 12 && (matrix[8] != 0 || matrix[9] != 0 || is_scale(matrix[10]) || matrix[11] != 0))
    throw Error(file, "scales, tilts or moves (ModelTransformation)" + scaled);
  const std::span<const double> points = numbers_of<double>(tiff, kTiePoints, TIFF_DOUBLE, file);
  if (points.size() > 6 && scale.empty() && matrix.empty())
    throw Error(file, "is placed by " + std::to_string(points.size() / 6) +
                          " points (ModelTiepoint), between which a pixel may have any size; expected ModelPixelScale");
  // A point of the picture at a height: z of the model for k of the picture.
  if (points.size() >= 6 && matrix.empty() && points[5] - points[2] * (scale.size() >= 3 ? scale[2] : 0) != 0)
    throw Error(file, "moves (ModelTiepoint)" + scaled);
  // Rows of four: a key, where its value is (0: in the row), how many, and the value. Key 1024 says what the model is: 2 is
  // degrees of longitude and latitude, 3 is places around the middle of the earth. Where it is missing, key 2048 names degrees
  // and key 3072 a projection.
  const std::span<const std::uint16_t> keys = numbers_of<std::uint16_t>(tiff, kGeoKeys, TIFF_SHORT, file);
  const auto key = [&](std::uint16_t name) {
    for (std::size_t at = 4; at + 4 <= keys.size(); at += 4)
      if (keys[at] == name && keys[at + 1] == 0) return keys[at + 3];
    return std::uint16_t{0};
  };
  const std::uint16_t model = key(1024);
  if (model == 3)
    throw Error(file,
                "has places around the middle of the earth (GTModelTypeGeoKey); expected a projection, in a unit of length");
  if (model == 2 || (model == 0 && key(2048) != 0 && key(3072) == 0))
    throw Error(file,
                "has pixels in degrees of longitude and latitude (GTModelTypeGeoKey), which are not square; expected a "
                "projection, in a unit of length");
}

constexpr const char* kStack = "has a stack of pictures (";

// ImageJ's text: a line for each of its numbers. It writes a stack of pictures behind the page of the first, and what a number
// of the file means: cf=0 is c0 + c1 number.
void expect_no_calibration(std::string_view text, const std::filesystem::path& file) {
  if (text.find("\ncf=") != text.npos)
    throw Error(file, "declares a calibration of its numbers (ImageJ's cf); expected heights, which scale_mm scales");
  constexpr std::string_view kImages = "\nimages=";
  const std::size_t at = text.find(kImages);
  if (at == text.npos) return;
  std::string_view images = text.substr(at + kImages.size());
  images = images.substr(0, images.find_first_of("\r\n"));
  if (images != "1") throw Error(file, kStack + std::string("ImageJ's images); expected one"));
}

// The description of OME-TIFF, in XML: two sizes of a pixel, each in its own unit, micrometres where none is named.
void expect_square_pixels_of_ome(std::string_view text, const std::filesystem::path& file) {
  for (std::size_t at = text.find("<Pixels"); at < text.size(); at = text.find("<Pixels", at + 1)) {
    const std::string_view pixels = text.substr(at, text.find('>', at) - at);
    const auto size = [pixels](std::string_view name, std::string_view otherwise) {
      has_value(pixels, name, [&otherwise](std::string_view value) {
        otherwise = value;
        return true;
      });
      return otherwise;
    };
    const std::string_view across = size("PhysicalSizeX", ""), along = size("PhysicalSizeY", "");
    const auto first = files::Decimal::of(across), second = files::Decimal::of(along);
    if ((first && second ? *first != *second : across != along) ||
        size("PhysicalSizeXUnit", "µm") != size("PhysicalSizeYUnit", "µm"))
      throw Error(file, "has pixels that are not square (OME's PhysicalSizeX and PhysicalSizeY); expected one size");
  }
}

// tifffile writes a stack behind the page of the first picture, too, and its sizes as JSON: {"shape": [pictures, rows,
// columns]}.
void expect_one_shape(std::string_view text, std::uint64_t samples, const std::filesystem::path& file) {
  double all = 1, size = 0;
  for (;;) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error != std::errc()) break;
    all *= size;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
  }
  if (all > static_cast<double>(samples)) throw Error(file, kStack + std::string("tifffile's shape); expected one"));
}

void expect_plain_description(TIFF* tiff, const std::filesystem::path& file) {
  const char* description = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &description) != 1 || description == nullptr) return;
  const std::string_view text = description;
  std::uint32_t columns = 0, rows = 0;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &columns);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &rows);
  constexpr std::string_view kShape = "{\"shape\": [";
  if (text.starts_with("ImageJ=")) expect_no_calibration(text, file);
  if (text.starts_with(kShape)) expect_one_shape(text.substr(kShape.size()), std::uint64_t{columns} * rows, file);
  if (text.find("<OME") != text.npos) expect_square_pixels_of_ome(text, file);
}

// Tags that change what a number means, or where it stands, in ways of their own.
struct OtherTag {
  std::uint32_t tag;
  const char* name;
};
constexpr std::array kOtherTags{OtherTag{33920, "IntergraphMatrix"}, OtherTag{50844, "RPCCoefficient"},
                                OtherTag{50712, "LinearizationTable"}, OtherTag{50714, "BlackLevel"},
                                OtherTag{50717, "WhiteLevel"}};

void expect_no_other_tag(TIFF* tiff, const std::filesystem::path& file) {
  for (const OtherTag& other : kOtherTags)
    if (has_tag(tiff, other.tag))
      throw Error(file, "has the tag " + std::string(other.name) +
                            ", by which a number is no height or stands elsewhere; expected heights alone");
  std::uint32_t count = 0, kind = 0, depth = 1;
  const unsigned char* xmp = nullptr;
  const void* planes = nullptr;
  if (TIFFGetField(tiff, TIFFTAG_XMLPACKET, &count, &xmp) == 1 && is_turned_by_xmp({reinterpret_cast<const char*>(xmp), count}))
    throw Error(file, "is turned by its XMP (tiff:Orientation); expected 1, the first row on top");
  TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &kind);
  if ((kind & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0)
    throw Error(file, "is a smaller copy or a mask of a picture (NewSubfileType); expected the picture");
  TIFFGetField(tiff, TIFFTAG_IMAGEDEPTH, &depth);
  // MetaMorph's UIC2 has numbers for each picture of the stack behind the page of the first.
  if (depth > 1 || (has_tag(tiff, kUic2) && (TIFFGetField(tiff, kUic2, &count, &planes) != 1 || count > 1)))
    throw Error(file, kStack + std::string(depth > 1 ? "ImageDepth" : "MetaMorph's UIC2") + "); expected one");
}

// Refuses whatever says that the numbers are no heights, or not where they stand.
void expect_heights_alone(TIFF* tiff, const std::filesystem::path& file) {
  std::uint16_t compression = 0, orientation = 0, photometric = PHOTOMETRIC_MINISBLACK, below = 0;
  std::uint64_t* places = nullptr;
  float across = 1, along = 1;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  if (std::find(kCompressions.begin(), kCompressions.end(), compression) == kCompressions.end())
    throw Error(file, "has compression " + std::to_string(compression) +
                          "; expected one without loss: none, LZW, Deflate, LZMA, PackBits or ZSTD");
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
  expect_square_pixels(tiff, file);
  expect_plain_description(tiff, file);
  expect_no_other_tag(tiff, file);
  for (const std::string_view role : {"scale", "offset"})
    if (has_value(text_of(tiff, kMetadata, file), "role", [&](std::string_view value) { return value == role; }))
      throw Error(file, std::string(role == "offset" ? "declares an " : "declares a ") + std::string(role) +
                            " of its numbers (GDAL_METADATA); expected heights, which scale_mm scales");
  if (TIFFLastDirectory(tiff) == 0 || TIFFGetField(tiff, TIFFTAG_SUBIFD, &below, &places) == 1)
    throw Error(file, "has more than one page; expected one");
}

// The sample that stands for a place without data, as GDAL and what writes GeoTIFF declare it.
std::optional<double> no_data_of(TIFF* tiff, const Kind& kind, const std::filesystem::path& file) {
  std::string_view words = text_of(tiff, kNoData, file);
  if (words.data() == nullptr) return std::nullopt;
  words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
  double number = 0;
  const auto read = std::from_chars(words.data(), words.data() + words.size(), number);
  if (read.ec != std::errc() || words.find_first_not_of(' ', static_cast<std::size_t>(read.ptr - words.data())) != words.npos)
    throw Error(file, "declares " + files::shown(words) + " for places without data (GDAL_NODATA); expected a number");
  return kind.sample(number);
}

void read_strips(TIFF* tiff, const Kind& kind, Samples& samples, const Message& message) {
  std::vector<unsigned char> row(std::size_t{samples.columns} * kind.bits / 8);
  if (TIFFScanlineSize(tiff) != static_cast<tmsize_t>(row.size()))
    throw Error(samples.source->file, "has rows of another size");
  for (std::uint32_t j = 0; j < samples.rows; ++j) {
    if (TIFFReadScanline(tiff, row.data(), j) != 1) throw Error(samples.source->file, message.text);
    samples.put_row(j, [&](std::size_t column) { return kind.number(row.data(), column); });
  }
}

// Tiles are all of one size; those on the right and at the bottom reach beyond the picture. `most`: bytes that one may take.
void read_tiles(TIFF* tiff, const Kind& kind, Samples& samples, const Message& message, std::uint64_t most) {
  std::uint32_t width = 0, length = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &length);
  const std::uint64_t bytes = std::uint64_t{width} * (kind.bits / 8U);
  if (width == 0 || length == 0 || bytes > most / length)
    throw Error(samples.source->file, "declares tiles of " + std::to_string(width) + " x " + std::to_string(length) +
                                          " samples, more than its bytes can hold");
  std::vector<unsigned char> tile(bytes * length);
  if (TIFFTileSize(tiff) != static_cast<tmsize_t>(tile.size())) throw Error(samples.source->file, "has tiles of another size");
  for (std::uint32_t top = 0; top < samples.rows; top += std::min(length, samples.rows - top))
    for (std::uint32_t left = 0; left < samples.columns; left += std::min(width, samples.columns - left)) {
      if (TIFFReadTile(tiff, tile.data(), left, top, 0, 0) != static_cast<tmsize_t>(tile.size()))
        throw Error(samples.source->file, message.text);
      for (std::uint32_t j = 0; j < std::min(length, samples.rows - top); ++j)
        for (std::uint32_t i = 0; i < std::min(width, samples.columns - left); ++i)
          samples.put(top + j, left + i, kind.number(&tile[j * bytes], i));
    }
}

}  // namespace

Samples read_tiff(const Source& source) {
  const std::filesystem::path& file = source.file;
  Message message;
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &keep_message, &message);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &ignore_warning, nullptr);
  // No strip, tile or table of an honest file is larger.
  const std::uint64_t most =
      std::min(kCompressed * std::filesystem::file_size(file), kMostSamples * sizeof(double)) + (1U << 16);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(most));
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(TIFFOpenExt(file.c_str(), "r", options.get()), &TIFFClose);
  if (tiff == nullptr) throw Error(file, message.text);
  std::uint32_t columns = 0, rows = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &columns);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &rows);
  const Kind& kind = kind_of(tiff.get(), file);
  expect_heights_alone(tiff.get(), file);
  Samples samples = allocate(source, columns, rows, kind.bits / 8U, kCompressed);
  samples.no_data = no_data_of(tiff.get(), kind, file);
  if (TIFFIsTiled(tiff.get()) != 0)
    read_tiles(tiff.get(), kind, samples, message, most);
  else
    read_strips(tiff.get(), kind, samples, message);
  return samples;
}

}  // namespace forceshade::heights
