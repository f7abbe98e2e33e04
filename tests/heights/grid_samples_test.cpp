// SPDX-License-Identifier: BSD-3-Clause
// Every kind of number that a TIFF or NPY file may hold becomes the height that rendering/heights/formats.md promises.

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <limits>
#include <random>

#include "forceshade/heights.h"
#include "rendering/heights/samples.h"
#include "tests/heights/written_grids.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::heights {
namespace {

using tests::TiffOptions;
using tests::write_tiff;

class GridSamples : public ::testing::Test {
 protected:
  std::vector<float> loaded(const std::string& file, float scale) const {
    const auto grid = load({file, 0.5F, scale, height::Edge::clamp, height::Interpolant::bilinear});
    EXPECT_EQ(grid->values.size(), std::size_t{grid->columns} * grid->rows);
    return grid->values;
  }
  std::string refusal(const std::string& file, float scale) const {
    return tests::without(file + ": ", tests::thrown_by<Error>([&] { loaded(file, scale); }));
  }

  // In the order of heights: the bottom row comes first.
  template <class T, class HeightOf>
  static std::vector<float> expected(const std::vector<T>& numbers, std::size_t columns, const HeightOf& height) {
    std::vector<float> heights;
    for (std::size_t row = numbers.size() / columns; row-- > 0;)
      for (std::size_t column = 0; column < columns; ++column) heights.push_back(height(numbers[row * columns + column]));
    return heights;
  }

  tests::TemporaryDirectory directory_;
};

// By MPFR, whose product of 160 bits is exact.
float nearest_product(double number, float scale) {
  mpfr_t product;
  mpfr_init2(product, 160);
  mpfr_set_d(product, number, MPFR_RNDN);
  mpfr_mul_d(product, product, static_cast<double>(scale), MPFR_RNDN);
  const float nearest = mpfr_get_flt(product, MPFR_RNDN);
  mpfr_clear(product);
  return nearest;
}

template <class T>
std::vector<T> some(std::size_t count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::vector<T> numbers(count);
  for (T& number : numbers)
    if constexpr (std::is_floating_point_v<T>)
      number = std::uniform_real_distribution<T>(-1000, 1000)(random);
    else
      number = static_cast<T>(static_cast<T>(random()) >> (sizeof(T) == 8 ? 24 : 0));
  if constexpr (!std::is_floating_point_v<T> && sizeof(T) < 8) {
    numbers[0] = std::numeric_limits<T>::max();
    numbers[1] = std::numeric_limits<T>::min();
    numbers[2] = 1;
  }
  return numbers;
}

// At which all numbers of some<T>() are heights, and which is no power of 2.
template <class T>
float scale_for() {
  if constexpr (std::is_floating_point_v<T>) return 3.3F;
  return static_cast<float>(9000 / std::min(0x1p40, static_cast<double>(std::numeric_limits<T>::max())));
}

float or_zero(float height) {
  return std::fabs(height) < 0x1p-30F ? 0 : height;
}

template <class T>
T reversed(T number) {
  auto* bytes = reinterpret_cast<char*>(&number);
  std::reverse(bytes, bytes + sizeof(T));
  return number;
}

TEST(height_of, is_the_nearest_binary32_number_to_the_exact_product) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> logarithm(-20, 8);
  int inexact = 0, would_round_twice = 0;
  for (int i = 0; i < 2'000'000; ++i) {
    const auto scale = static_cast<float>(std::exp2(logarithm(random) / 2));
    double number = std::exp2(logarithm(random)) * (i % 2 == 0 ? 1 : -1);
    // Every other number is as near to a middle of two heights as binary64 comes.
    if (i % 4 < 2) {
      const float height = height_of(number, scale);
      const float next = std::nextafter(height, 1e9F);
      const double middle = (static_cast<double>(height) + static_cast<double>(next)) / 2;
      number = middle / static_cast<double>(scale);
      for (unsigned k = 0; k < static_cast<unsigned>(i) % 3; ++k) number = std::nextafter(number, 0.0);
    }
    const float got = height_of(number, scale), want = nearest_product(number, scale);
    ASSERT_EQ(got, want) << std::hexfloat << number << " * " << scale;
    const double product = number * static_cast<double>(scale);
    inexact += std::fma(number, static_cast<double>(scale), -product) != 0;
    would_round_twice += static_cast<float>(product) != want;
  }
  std::printf("  %d products are not exact in binary64, %d would be wrong if rounded there first\n", inexact,
              would_round_twice);
  EXPECT_GT(inexact, 100'000);
  EXPECT_GT(would_round_twice, 100);
  for (const double far : {1e300, -1e300, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_FALSE(std::isfinite(height_of(far, 1))) << far;
}

template <class T>
class Npy : public GridSamples {};
using NpyTypes = ::testing::Types<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t, std::int8_t, std::int16_t,
                                  std::int32_t, std::int64_t, float, double>;
TYPED_TEST_SUITE(Npy, NpyTypes);

template <class T>
std::string npy_type(const char* order) {
  std::string type = sizeof(T) == 1 ? "|" : order;
  type += std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
  return type += static_cast<char>('0' + sizeof(T));
}

TYPED_TEST(Npy, numbers_times_the_scale_are_heights_in_both_orders_of_bytes_and_of_places) {
  using T = TypeParam;
  constexpr std::size_t kColumns = 7, kRows = 5;
  const std::vector<T> numbers = some<T>(kColumns * kRows, 3);
  const float scale = scale_for<T>();
  const auto want =
      this->expected(numbers, kColumns, [&](T number) { return or_zero(nearest_product(static_cast<double>(number), scale)); });
  std::vector<T> by_column;
  for (std::size_t column = 0; column < kColumns; ++column)
    for (std::size_t row = 0; row < kRows; ++row) by_column.push_back(numbers[row * kColumns + column]);
  for (const char* order : {"<", ">"})
    for (const char* fortran : {"False", "True"}) {
      std::vector<T> stored = *fortran == 'T' ? by_column : numbers;
      if (*order == '>')
        for (T& number : stored) number = reversed(number);
      const std::string file =
          this->directory_.write("a.npy", tests::npy_of(npy_type<T>(order), "(5, 7)", tests::bytes(stored), fortran));
      EXPECT_EQ(this->loaded(file, scale), want) << npy_type<T>(order) << ", fortran_order " << fortran;
    }
}

template <class T>
class Tiff : public GridSamples {};
using TiffTypes =
    ::testing::Types<std::uint8_t, std::uint16_t, std::uint32_t, std::int8_t, std::int16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(Tiff, TiffTypes);

// In every layout that writers use, compressed or not, and with tiles that reach beyond the picture.
TYPED_TEST(Tiff, numbers_are_heights_in_strips_and_tiles_and_both_orders_of_bytes) {
  using T = TypeParam;
  constexpr std::uint32_t kColumns = 37, kRows = 20;
  constexpr bool kPicture = std::is_unsigned_v<T>;
  const std::vector<T> numbers = some<T>(std::size_t{kColumns} * kRows, 4);
  const float scale = kPicture ? 3.3F : scale_for<T>();
  const auto want = this->expected(numbers, kColumns, [&](T number) {
    if constexpr (!kPicture) return or_zero(nearest_product(static_cast<double>(number), scale));
    mpfr_t sample;
    mpfr_init2(sample, 24);
    mpfr_t exact;
    mpfr_init2(exact, 53);
    mpfr_set_d(exact, static_cast<double>(number), MPFR_RNDN);
    mpfr_div_d(sample, exact, static_cast<double>(std::numeric_limits<T>::max()), MPFR_RNDN);
    const float nearest = mpfr_get_flt(sample, MPFR_RNDN);
    mpfr_clears(sample, exact, static_cast<mpfr_ptr>(nullptr));
    return or_zero(nearest_product(static_cast<double>(nearest), scale));
  });
  const std::string file = this->directory_.file("a.tif");
  for (const char* mode : {"wl", "wb"})
    for (const std::uint32_t tile : {0U, 16U, 32U})
      for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE})
        for (const int predictor : {PREDICTOR_NONE, PREDICTOR_HORIZONTAL, PREDICTOR_FLOATINGPOINT}) {
          const bool is_binary = std::is_floating_point_v<T>;
          // libtiff 4.5 writes floating-point predictions of the other order of bytes wrongly; it reads them.
          if (predictor != PREDICTOR_NONE &&
              (compression == COMPRESSION_NONE || is_binary != (predictor == PREDICTOR_FLOATINGPOINT) ||
               (is_binary && mode == std::string("wb"))))
            continue;
          write_tiff(file, kColumns, kRows, numbers,
                     TiffOptions{.compression = compression, .tile = tile, .mode = mode, .predictor = predictor});
          EXPECT_EQ(this->loaded(file, scale), want)
              << mode << ", tile " << tile << ", compression " << compression << ", predictor " << predictor;
        }
}

TEST_F(GridSamples, of_unsigned_tiffs_run_from_black_to_white_like_those_of_a_png) {
  write_tiff<std::uint8_t>(directory_.file("8.tif"), 3, 2, {0, 51, 255, 102, 153, 204});
  write_tiff<std::uint16_t>(directory_.file("16.tif"), 3, 2, {0, 13107, 65535, 26214, 39321, 52428});
  write_tiff<std::uint32_t>(directory_.file("32.tif"), 3, 2, {0, 858993459, 4294967295, 1717986918, 2576980377, 3435973836});
  for (const char* name : {"8.tif", "16.tif", "32.tif"})
    EXPECT_EQ(loaded(directory_.file(name), 2), (std::vector<float>{0.8F, 1.2F, 1.6F, 0, 0.4F, 2})) << name;
}

TEST_F(GridSamples, that_are_no_heights_are_named_by_place_and_number_in_every_layout) {
  std::vector<double> numbers(20 * 20, 1);
  numbers[17 * 20 + 18] = 10000.000001;
  write_tiff(directory_.file("strips.tif"), 20, 20, numbers);
  write_tiff(directory_.file("tiles.tif"), 20, 20, numbers, {.tile = 16});
  std::vector<double> turned(20 * 20, 1);
  turned[18 * 20 + 17] = 10000.000001;
  directory_.write("c.npy", tests::npy_of("<f8", "(20, 20)", tests::bytes(numbers)));
  directory_.write("fortran.npy", tests::npy_of("<f8", "(20, 20)", tests::bytes(turned), "True"));
  for (const char* name : {"strips.tif", "tiles.tif", "c.npy", "fortran.npy"}) {
    const std::string file = directory_.file(name);
    EXPECT_EQ(refusal(file, 2), "row 17, column 18 holds 10000.000001, which is no height within 10000 mm") << name;
    EXPECT_EQ(refusal(file, 1), "") << name << ": the nearest binary32 number is 10000";
  }
  directory_.write("count.npy", tests::npy_of("<i8", "(2, 2)", tests::bytes(std::vector<std::int64_t>{0, -20000, 0, 0})));
  EXPECT_EQ(refusal(directory_.file("count.npy"), 1), "row 0, column 1 holds -20000, which is no height within 10000 mm");
}

// As GDAL and GeoTIFF declare them: a place without data has no height, and a pixel may be longer than it is wide.
TEST_F(GridSamples, without_data_or_with_pixels_that_are_not_square_are_refused) {
  const auto written = [&](const tests::TiffOptions& options, float middle = -9999) {
    std::vector<float> numbers(9, 0.5F);
    numbers[5] = middle;
    write_tiff(directory_.file("a.tif"), 3, 3, numbers, options);
    return refusal(directory_.file("a.tif"), 0.001F);
  };
  const std::string words =
      "row 1, column 2 has no data, by the number that the file declares for that (GDAL_NODATA); expected a height";
  for (const char* no_data : {"-9999", "-9999 ", " -9.999e3"}) EXPECT_EQ(written({.no_data = no_data}), words) << no_data;
  EXPECT_EQ(written({.tile = 16, .no_data = "-9999"}), words);
  EXPECT_EQ(written({.no_data = "nan"}, std::nanf("")), words);
  EXPECT_EQ(written({.no_data = "-9999"}, 0.25F), "");
  EXPECT_EQ(written({.no_data = "none"}), "declares \"none\" for places without data (GDAL_NODATA); expected a number");
  EXPECT_EQ(written({.scale = {2, 2, 0}}, 1), "");
  EXPECT_EQ(written({.scale = {2, 3, 0}}, 1), "has pixels that are not square (ModelPixelScale); expected one size");
  const auto turned = [&](double xx, double xy, double yx, double yy) {
    return written({.matrix = {xx, xy, 0, 7, yx, yy, 0, 8, 0, 0, 0, 0, 0, 0, 0, 1}}, 1);
  };
  EXPECT_EQ(turned(2, 0, 0, -2), "");
  for (const std::string& what :
       {turned(2, 0, 0, -3), turned(2, 0, 0, 2), turned(0, 2, 2, 0), turned(2, 1, 0, -2), turned(2, 0, 1, -2)})
    EXPECT_EQ(what, "has pixels that are turned or not square (ModelTransformation); expected one size, with y upwards");
  const auto described = [&](const std::string& item) {
    return written({.metadata = ("<GDALMetadata>" + item + "</GDALMetadata>").c_str()}, 1);
  };
  EXPECT_EQ(described("<Item name=\"DATE\">2026</Item>"), "");
  EXPECT_EQ(described("<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item>"),
            "declares a scale of its numbers (GDAL_METADATA); expected heights, which scale_mm scales");
  EXPECT_EQ(described("<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">9</Item>"),
            "declares an offset of its numbers (GDAL_METADATA); expected heights, which scale_mm scales");
  for (const char* item : {"<Item role='scale'>2</Item>", "<Item role = \"scale\">2</Item>", "<Item role=\n'scale' >2</Item>"})
    EXPECT_EQ(described(item), "declares a scale of its numbers (GDAL_METADATA); expected heights, which scale_mm scales")
        << item;
  for (const char* item :
       {"<Item role=\"unittype\">m</Item>", "<Item role=\"scales\">m</Item>", "<Item name=\"scale\">m</Item>"})
    EXPECT_EQ(described(item), "") << item;
}

TEST_F(GridSamples, that_geotiff_scales_or_places_on_pixels_of_any_size_are_refused) {
  const auto written = [&](const tests::TiffOptions& options) {
    write_tiff(directory_.file("a.tif"), 3, 3, std::vector<float>(9, 0.5F), options);
    return refusal(directory_.file("a.tif"), 1);
  };
  const std::string scaled = " its numbers; expected heights, which scale_mm scales";
  EXPECT_EQ(written({.scale = {2, 2, 1}}), "");
  EXPECT_EQ(written({.scale = {2, 2, 0.01}}), "scales (ModelPixelScale)" + scaled);
  EXPECT_EQ(written({.matrix = {2, 0, 0, 7, 0, -2, 0, 8, 0, 0, 1, 0, 0, 0, 0, 1}}), "");
  for (const auto& [x, y, z, offset] : {std::array{0., 0., 2., 0.}, {0., 0., 1., 9.}, {1., 0., 1., 0.}, {0., 1., 1., 0.}})
    EXPECT_EQ(written({.matrix = {2, 0, 0, 7, 0, -2, 0, 8, x, y, z, offset, 0, 0, 0, 1}}),
              "scales, tilts or moves (ModelTransformation)" + scaled);
  const std::vector<double> one{0, 0, 0, 5, 6, 0}, two{0, 0, 0, 5, 6, 0, 3, 3, 0, 8, 0, 0};
  EXPECT_EQ(written({.points = one}), "");
  EXPECT_EQ(written({.scale = {1, 1, 0}, .points = two}), "");
  EXPECT_EQ(written({.points = two}),
            "is placed by 2 points (ModelTiepoint), between which a pixel may have any size; expected ModelPixelScale");
  const auto of_model = [](std::uint16_t model) {
    return std::vector<std::uint16_t>{1, 1, 0, 2, 1025, 0, 1, 2, 1024, 0, 1, model};
  };
  EXPECT_EQ(written({.keys = of_model(1)}), "");
  EXPECT_EQ(
      written({.keys = of_model(2)}),
      "has pixels in degrees of longitude and latitude (GTModelTypeGeoKey), which are not square; expected a projection, in "
      "a unit of length");
  EXPECT_EQ(written({.scale = {2, 2, 1}, .other_types = true}), "has tag 33550 of another type; expected type 12");
  EXPECT_EQ(written({.keys = of_model(1), .other_types = true}), "has tag 34735 of another type; expected type 3");
}

TEST_F(GridSamples, that_imagej_calibrates_or_stacks_are_refused) {
  const auto described = [&](const char* words) {
    write_tiff(directory_.file("a.tif"), 3, 3, std::vector<std::uint16_t>(9, 5), {.description = words});
    return refusal(directory_.file("a.tif"), 1);
  };
  EXPECT_EQ(described("ImageJ=1.53t\nunit=mm\nmin=0.0\n"), "");
  EXPECT_EQ(described("a picture with\ncf=0\n"), "") << "is no text of ImageJ's";
  EXPECT_EQ(described("ImageJ=1.53t\ncf=0\nc0=-32768.0\nc1=1.0\nvunit=gray value\n"),
            "declares a calibration of its numbers (ImageJ's cf); expected heights, which scale_mm scales");
  for (const char* words : {"ImageJ=1.53t\nimages=1\n", "ImageJ=1.53t\nimages=1"}) EXPECT_EQ(described(words), "") << words;
  for (const char* words : {"ImageJ=1.53t\nimages=3\nslices=3\n", "ImageJ=1.53t\nimages=12\n"})
    EXPECT_EQ(described(words), "has a stack of pictures (ImageJ's images); expected one") << words;
}

// The number is text, and a sample has fewer bits or runs from black to white.
TEST_F(GridSamples, without_data_are_refused_in_every_kind_of_number) {
  const auto expect_refused = [&]<class T>(T hole, const char* no_data, T other) {
    std::vector<T> numbers(9, other);
    write_tiff(directory_.file("a.tif"), 3, 3, numbers, {.no_data = no_data});
    EXPECT_EQ(refusal(directory_.file("a.tif"), 0.001F), "") << no_data;
    numbers[5] = hole;
    write_tiff(directory_.file("a.tif"), 3, 3, numbers, {.no_data = no_data});
    EXPECT_EQ(refusal(directory_.file("a.tif"), 0.001F),
              "row 1, column 2 has no data, by the number that the file declares for that (GDAL_NODATA); expected a height")
        << no_data;
  };
  expect_refused(-999.9F, "-999.9", -999.8F);
  expect_refused(std::numeric_limits<float>::lowest(), "-3.40282347e+38", 1.0F);
  expect_refused(-999.9, "-999.9", -999.8);
  expect_refused(std::int8_t{-128}, "-128", std::int8_t{-127});
  expect_refused(std::int16_t{-32768}, "-32768", std::int16_t{-32767});
  expect_refused(std::int32_t{-2147483647 - 1}, "-2147483648", std::int32_t{1});
  expect_refused(std::uint8_t{255}, "255", std::uint8_t{254});
  expect_refused(std::uint16_t{65535}, "65535", std::uint16_t{65534});
  expect_refused(std::uint16_t{0}, "0", std::uint16_t{1});
  expect_refused(std::uint32_t{3}, "3", std::uint32_t{0});
}

TEST_F(GridSamples, of_a_lossy_or_unknown_kind_are_refused_in_words) {
  write_tiff<std::uint8_t>(directory_.file("a.tif"), 16, 16, std::vector<std::uint8_t>(256, 9));
  const auto changed = [&](std::uint16_t tag, std::uint16_t value) {
    std::string file = directory_.read("a.tif");
    const std::string entry{static_cast<char>(tag % 256), static_cast<char>(tag / 256), 3, 0, 1, 0, 0, 0};
    const std::size_t at = file.find(entry);
    EXPECT_NE(at, std::string::npos) << tag;
    file[at + 8] = static_cast<char>(value % 256);
    file[at + 9] = static_cast<char>(value / 256);
    return refusal(directory_.write("b.tif", file), 1);
  };
  const std::string lossless = "; expected one without loss: none, LZW, Deflate, LZMA, PackBits or ZSTD";
  EXPECT_EQ(changed(TIFFTAG_COMPRESSION, COMPRESSION_JPEG), "has compression 7" + lossless);
  EXPECT_EQ(changed(TIFFTAG_COMPRESSION, 9999), "has compression 9999" + lossless);
  const std::string kinds = "; expected 1 of 8, 16 or 32 bits, whole (1 or 2), or of 32 or 64, binary (3)";
  EXPECT_EQ(changed(TIFFTAG_BITSPERSAMPLE, 4), "has 1 samples a pixel of 4 bits and sample format 1" + kinds);
  EXPECT_EQ(changed(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP), "has 1 samples a pixel of 8 bits and sample format 3" + kinds);
  EXPECT_EQ(changed(TIFFTAG_SAMPLESPERPIXEL, 3), "has 3 samples a pixel of 8 bits and sample format 1" + kinds);
  const std::vector<std::uint16_t> half(4);
  for (const char* type : {"<f2", "<u1", "|u2", "=i4", "i4", "", "|b1", "<c8", "<u3"})
    EXPECT_EQ(refusal(directory_.write("a.npy", tests::npy_of(type, "(2, 2)", tests::bytes(half))), 1),
              std::string("holds numbers of type ") + type +
                  "; expected |u1, |i1, or < or > and one of u2, u4, u8, i2, i4, i8, f4, f8");
  EXPECT_EQ(refusal(directory_.write("a.npy", tests::npy_of("<u2", "(2, 2)", tests::bytes(half), "Perhaps")), 1),
            "has fortran_order Perhaps; expected True or False");
}

TEST_F(GridSamples, in_tiles_that_a_file_only_declares_are_not_allocated) {
  write_tiff<std::uint8_t>(directory_.file("a.tif"), 16, 16, std::vector<std::uint8_t>(256, 9), {.tile = 16});
  std::string file = directory_.read("a.tif");
  for (const int tag : {TIFFTAG_TILEWIDTH, TIFFTAG_TILELENGTH}) {
    const std::string entry{static_cast<char>(tag % 256), static_cast<char>(tag / 256)};
    for (std::size_t i = 0; i + 12 <= file.size(); ++i)
      if (file.compare(i, 2, entry) == 0 && (file[i + 2] == 3 || file[i + 2] == 4) && file[i + 4] == 1 && file[i + 8] == 16)
        file.replace(i + 2, 10, std::string("\4\0\1\0\0\0\0\0\x01\0", 10));
  }
  EXPECT_EQ(refusal(directory_.write("b.tif", file), 1),
            "declares tiles of 65536 x 65536 samples, more than its bytes can hold");
}

}  // namespace
}  // namespace forceshade::heights
