// SPDX-License-Identifier: BSD-3-Clause
// The statements of a picture or an array beside its numbers: applied or refused in words, never left out. The files of
// tests/fuzz/corpus are the examples.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <random>

#include "forceshade/heights.h"
#include "rendering/heights/samples.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::heights {
namespace {

using height::Edge;
using height::Interpolant;
using tests::TemporaryDirectory;

Source source(const std::filesystem::path& file, float scale = 2) {
  return {file, 0.5F, scale, Edge::clamp, Interpolant::bilinear};
}

// The heights, or the words of the refusal.
struct Loaded {
  std::vector<float> heights;
  std::string refusal;
};

Loaded loaded(const Source& from) {
  try {
    const auto grid = load(from);
    EXPECT_EQ(grid->pitch, from.pitch);
    EXPECT_EQ(grid->values.size(), std::size_t{grid->columns} * grid->rows);
    return {grid->values, ""};
  } catch (const Error& error) {
    const std::string words = error.what(), place = from.file.string() + ": ";
    EXPECT_TRUE(words.starts_with(place)) << words;
    return {{}, words.substr(std::min(words.size(), place.size()))};
  }
}

Loaded of_bytes(const std::string& bytes) {
  const TemporaryDirectory directory;
  return loaded(source(directory.write("grid", bytes)));
}

Loaded of_corpus(const std::string& name) {
  return loaded(source(std::string(FORCESHADE_SOURCE_DIR "/tests/fuzz/corpus/") + name));
}

std::string corpus(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(FORCESHADE_SOURCE_DIR "/tests/fuzz/corpus/") + name, std::ios::binary).rdbuf();
  return text.str();
}

// Top row 0 1 2, bottom row 3 4 5, doubled: the bottom row comes first.
const std::vector<float> kHeights{6, 8, 10, 0, 2, 4};

std::string numbers() {
  const std::vector<float> upwards{3, 4, 5, 0, 1, 2};
  return {reinterpret_cast<const char*>(upwards.data()), upwards.size() * sizeof(float)};
}

TEST(grid_files, that_say_nothing_odd_are_loaded) {
  for (const char* name : {"npy/little.npy",   "npy/big.npy",        "npy/binary64.npy",
                           "npy/version2.npy", "npy/version3.npy",   "pfm/little.pfm",
                           "pfm/big.pfm",      "pfm/crlf.pfm",       "tiff/little.tif",
                           "tiff/big.tif",     "tiff/deflate.tif",   "tiff/packbits.tif",
                           "tiff/int16.tif",   "tiff/int32_big.tif", "tiff/binary64.tif",
                           "tiff/tiles.tif",   "tiff/tiles_big.tif", "tiff/tiles_lzw.tif",
                           "npy/int8.npy",     "npy/uint8.npy",      "npy/int16_big.npy",
                           "npy/uint16.npy",   "npy/int32.npy",      "npy/uint32_big.npy",
                           "npy/int64.npy",    "npy/uint64.npy",     "npy/binary64_by_column.npy"}) {
    const Loaded got = of_corpus(name);
    EXPECT_EQ(got.refusal, "") << name;
    EXPECT_EQ(got.heights, kHeights) << name;
  }
}

TEST(grid_files, that_say_something_odd_are_refused_in_words) {
  const std::vector<std::pair<const char*, const char*>> expected{
      {"npy/version9.npy", "is of NPY version 9.0; expected 1.0, 2.0 or 3.0"},
      {"npy/twice.npy", "has no NPY header: expected a dictionary of descr, fortran_order and shape"},
      {"npy/left_over.npy", "goes on after its last number"},
      {"pfm/left_over.pfm", "goes on for 3 bytes after its last number"},
      {"pfm/truncated.pfm", "is truncated"},
      {"pfm/scale.pfm", "declares a scale of -2.5; expected 1 or -1, whose sign is the order of bytes"},
      {"pfm/minus.pfm", "has no PFM header: expected a number of columns, got \"-3\""},
      {"pfm/declares_much.pfm", "declares 32768 x 32768 samples; expected 67108864 in all at most"},
      {"png/4.png", "is not 8 or 16 bit greyscale"},
      {"png/colour.png", "is not 8 or 16 bit greyscale"},
      {"png/alpha.png", "is not 8 or 16 bit greyscale"},
      {"png/palette.png", "is not 8 or 16 bit greyscale"},
      {"png/interlaced.png", "is interlaced"},
      {"png/transparent.png", "has a transparent level (tRNS); expected greyscale alone"},
      {"png/not_square.png", "has pixels that are not square (pHYs); expected one pitch"},
      {"png/not_square_ratio.png", "has pixels that are not square (pHYs); expected one pitch"},
      {"png/not_square_subject.png", "has pixels that are not square (sCAL); expected one size"},
      {"png/exif.png", "has Exif data (eXIf), which may turn it; expected none"},
      {"png/scaled.png", "has a scale of its own (pCAL); expected none"},
      {"png/animated.png", "is animated (acTL); expected one picture"},
      {"png/left_over.png", "goes on after its end"},
      {"png/declares_much.png", "declares 32768 x 32768 samples; expected 67108864 in all at most"},
      {"tiff/turned.tif", "declares orientation 4; expected 1, the first row on top"},
      {"tiff/white_is_zero.tif", "declares photometric interpretation 0; expected 1, greyscale with 0 black"},
      {"tiff/two_pages.tif", "has more than one page; expected one"},
      {"tiff/page_without_end.tif", "has more than one page; expected one"},
      {"tiff/page_below.tif", "has more than one page; expected one"},
      {"tiff/not_square.tif", "has pixels that are not square; expected one resolution"},
      {"tiff/16_bits.tif",
       "has 1 samples a pixel of 16 bits and sample format 3; expected 1 of 8, 16 or 32 bits, whole (1 or 2), or of 32 or 64, "
       "binary (3)"},
      {"tiff/declares_much.tif", "declares 32768 x 32768 samples; expected 67108864 in all at most"}};
  for (const auto& [name, words] : expected) EXPECT_EQ(of_corpus(name).refusal, words) << name;
}

// The brightness at which a picture is shown states nothing about heights: rendering/heights/formats.md.
TEST(grid_files, of_any_gamma_have_the_heights_of_their_numbers) {
  const Loaded plain = of_corpus("png/8.png");
  EXPECT_EQ(plain.heights.size(), 6U) << plain.refusal;
  for (const char* name : {"png/gamma.png", "png/srgb.png", "png/square_subject.png"})
    EXPECT_EQ(of_corpus(name).heights, plain.heights) << name;
}

TEST(grid_files, of_pfm_may_end_their_words_in_any_white_space_and_their_numbers_nowhere_else) {
  const std::vector<std::string> ends{"\n", "\r\n", " ", "\t", "\r"};
  for (const std::string& a : ends)
    for (const std::string& b : ends)
      for (const std::string& c : ends) {
        const std::string head = "Pf" + a + "3" + b + "2" + a + "-1.0" + c;
        const Loaded got = of_bytes(head + numbers());
        EXPECT_EQ(got.heights, kHeights) << head << got.refusal;
        EXPECT_EQ(of_bytes(head + numbers() + "\n").refusal, "goes on for 1 bytes after its last number") << head;
        EXPECT_EQ(of_bytes(head + numbers().substr(1)).refusal, "is truncated") << head;
      }
  // A carriage return and a line feed end one line, whatever the first number's bytes are.
  std::string odd = numbers();
  odd[0] = '\n';
  EXPECT_EQ(of_bytes("Pf 3 2 -1\r\n" + odd).heights.size(), 6U);
  EXPECT_EQ(of_bytes("Pf 3 2 -1\r" + odd).refusal, "is truncated");
  for (const char* scale : {"0", "-0", "nan", "inf", "-2", "0.5", "1e999", "-1x", "--1", ""})
    EXPECT_NE(of_bytes("Pf\n3 2\n" + std::string(scale) + "\n" + numbers()).refusal, "") << scale;
}

TEST(grid_files, of_tiff_are_loaded_in_one_orientation_only) {
  const std::string turned = corpus("tiff/turned.tif");
  const std::string entry("\x12\x01\x03\0\x01\0\0\0\x04", 9);
  const std::size_t at = turned.find(entry);
  ASSERT_NE(at, std::string::npos);
  int taken = 0;
  for (int orientation = 0; orientation < 12; ++orientation) {
    std::string file = turned;
    file[at + 8] = static_cast<char>(orientation);
    const Loaded got = of_bytes(file);
    // libtiff reads a number that is no orientation, 0 or above 8, as the usual one, with a warning.
    if (orientation >= 2 && orientation <= 8) {
      EXPECT_NE(got.refusal, "") << orientation;
    } else if (got.refusal.empty()) {
      EXPECT_EQ(got.heights, kHeights) << orientation;
      ++taken;
    }
  }
  EXPECT_GE(taken, 1);
}

TEST(grid_files, of_npy_are_loaded_in_three_versions_only) {
  const std::string little = corpus("npy/little.npy"), second = corpus("npy/version2.npy");
  for (int major = 0; major < 256; ++major)
    for (const int minor : {0, 1, 255}) {
      std::string file = major == 1 ? little : second;
      file[6] = static_cast<char>(major);
      file[7] = static_cast<char>(minor);
      EXPECT_EQ(of_bytes(file).refusal.empty(), major >= 1 && major <= 3 && minor == 0) << major << '.' << minor;
    }
}

// Each byte of the length counts.
TEST(grid_files, of_npy_have_a_header_of_64_KiB_at_most) {
  const std::string second = corpus("npy/version2.npy");
  const std::size_t end = second.find('\n') + 1;
  for (const auto& [length, is_loaded] : {std::pair{1U << 16, true}, {(1U << 16) + 1, false}, {1U << 24, false}}) {
    std::string file = second.substr(0, 8);
    for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(length >> shift & 0xFF);
    file += second.substr(12, end - 13);
    file.resize(12 + (1U << 16) - (is_loaded ? 1 : 0), ' ');
    const Loaded got = of_bytes(file + '\n' + second.substr(end));
    EXPECT_EQ(got.heights, is_loaded ? kHeights : std::vector<float>()) << length << got.refusal;
    EXPECT_EQ(got.refusal, is_loaded ? "" : "has no NPY header") << length;
  }
}

// Bytes behind a whole file are refused. A TIFF's parts lie anywhere, so it has no end.
TEST(grid_files, with_bytes_left_over_are_refused) {
  std::mt19937 random(11);
  for (const char* name : {"npy/little.npy", "npy/binary64.npy", "pfm/little.pfm", "pfm/crlf.pfm", "png/8.png", "png/16.png"}) {
    const std::string whole = corpus(name);
    EXPECT_EQ(of_bytes(whole).refusal, "") << name;
    for (int i = 0; i < 40; ++i) {
      std::string more = whole;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(i) * 3; ++k) more += static_cast<char>(random());
      EXPECT_NE(of_bytes(more).refusal, "") << name << ' ' << i;
    }
  }
}

// Every bit of a PNG is in its signature, in a length, or under a checksum: none may change a height.
TEST(grid_files, of_png_with_one_bit_changed_are_refused) {
  for (const char* name : {"png/8.png", "png/gamma.png"}) {
    const std::string whole = corpus(name);
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      std::string changed = whole;
      changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
      EXPECT_NE(of_bytes(changed).refusal, "") << name << ", bit " << bit;
    }
  }
}

TEST(grid_files, are_not_scaled_to_nothing) {
  const std::filesystem::path file = FORCESHADE_SOURCE_DIR "/tests/fuzz/corpus/npy/little.npy";
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float scale : {0.0F, -0.0F, 0x1.fffffep-31F, -0x1p-149F, kInfinity, -kInfinity, std::nanf("")})
    EXPECT_TRUE(loaded(source(file, scale)).refusal.starts_with("is to be scaled by ")) << scale;
  for (const float scale : {0x1p-30F, -0x1p-30F, -2.0F, 2000.0F}) EXPECT_EQ(loaded(source(file, scale)).refusal, "") << scale;
}

// A picture of 32768 x 32768 that a megabyte could hold: refused before memory is taken for its samples.
TEST(grid_files, beyond_the_most_samples_take_no_memory) {
  EXPECT_EQ(kMostSamples, 67108864U);
  const auto memory = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;  // KiB
  };
  std::string png = corpus("png/declares_much.png");
  // A text chunk makes the file as large as its samples need, compressed.
  std::string text = "tEXt" + std::string("k\0", 2) + std::string(1'100'000, ' ');
  const auto big_endian = [](std::uint32_t n) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> shift & 0xFF);
    return bytes;
  };
  const auto sum =
      static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
  png.insert(png.size() - 12, big_endian(static_cast<std::uint32_t>(text.size() - 4)) + text + big_endian(sum));
  const TemporaryDirectory directory;
  const std::string file = directory.write("large.png", png);
  const auto before = memory();
  EXPECT_EQ(loaded(source(file)).refusal, "declares 32768 x 32768 samples; expected 67108864 in all at most");
  EXPECT_LT(memory() - before, 50000);
}

TEST(grid_files, may_have_as_many_samples_as_stated_and_no_more) {
  const auto room = [](std::uint64_t columns, std::uint64_t rows) {
    return of_bytes("Pf\n" + std::to_string(columns) + ' ' + std::to_string(rows) + "\n-1\n").refusal;
  };
  const std::string too_many = " samples; expected 67108864 in all at most";
  EXPECT_EQ(room(8193, 8192), "declares 8193 x 8192" + too_many);
  EXPECT_EQ(room(32768, 2049), "declares 32768 x 2049" + too_many);
  EXPECT_TRUE(room(8192, 8192).find("bytes can hold") != std::string::npos) << room(8192, 8192);
  EXPECT_TRUE(room(32768, 2048).find("bytes can hold") != std::string::npos) << room(32768, 2048);
}

}  // namespace
}  // namespace forceshade::heights
