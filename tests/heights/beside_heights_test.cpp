// SPDX-License-Identifier: BSD-3-Clause
// The statements of other programs in a picture, by which its numbers are no heights or stand elsewhere, are refused in words.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <string>
#include <vector>

#include "forceshade/heights.h"
#include "tests/heights/written_grids.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::heights {
namespace {

class BesideHeights : public ::testing::Test {
 protected:
  std::string refusal(const std::string& file) const {
    return tests::without(file + ": ", tests::thrown_by<Error>([&] {
                            EXPECT_EQ(load({file, 0.5F, 1, height::Edge::clamp, height::Interpolant::bilinear})->rows, 3U);
                          }));
  }
  std::string of_tiff(const tests::TiffOptions& options) const {
    tests::write_tiff(directory_.file("a.tif"), 3, 3, std::vector<std::uint16_t>(9, 5), options);
    return refusal(directory_.file("a.tif"));
  }

  tests::TemporaryDirectory directory_;
};

TEST_F(BesideHeights, of_any_size_are_loaded_from_a_big_tiff) {
  for (const char* mode : {"w8l", "w8b"}) {
    EXPECT_EQ(of_tiff({.mode = mode}), "") << mode;
    EXPECT_EQ(directory_.read("a.tif")[mode[2] == 'l' ? 2 : 3], '\x2b');
  }
}

TEST_F(BesideHeights, that_a_tie_point_moves_are_refused) {
  const std::string moved = "moves (ModelTiepoint) its numbers; expected heights, which scale_mm scales";
  EXPECT_EQ(of_tiff({.scale = {1, 1, 1}, .points = {0, 0, 5, 6, 7, 5}}), "") << "height 5 is number 5";
  EXPECT_EQ(of_tiff({.scale = {1, 1, 0}, .points = {0, 0, 5, 6, 7, 0}}), "");
  EXPECT_EQ(of_tiff({.scale = {1, 1, 1}, .points = {0, 0, 0, 6, 7, 100}}), moved);
  EXPECT_EQ(of_tiff({.scale = {1, 1, 1}, .points = {0, 0, 3, 6, 7, 5}}), moved);
  EXPECT_EQ(of_tiff({.points = {0, 0, 0, 6, 7, -2}}), moved);
}

TEST_F(BesideHeights, in_degrees_are_refused_by_whichever_key_says_so) {
  const std::string degrees =
      "has pixels in degrees of longitude and latitude (GTModelTypeGeoKey), which are not square; expected a projection, in a "
      "unit of length";
  EXPECT_EQ(of_tiff({.keys = {1, 1, 0, 1, 1024, 0, 1, 3}}),
            "has places around the middle of the earth (GTModelTypeGeoKey); expected a projection, in a unit of length");
  EXPECT_EQ(of_tiff({.keys = {1, 1, 0, 1, 2048, 0, 1, 4326}}), degrees);
  EXPECT_EQ(of_tiff({.keys = {1, 1, 0, 2, 2048, 0, 1, 4326, 3072, 0, 1, 32633}}), "");
  EXPECT_EQ(of_tiff({.keys = {1, 1, 0, 2, 1024, 0, 1, 1, 2048, 0, 1, 4326}}), "");
}

TEST_F(BesideHeights, of_other_programs_descriptions_are_refused) {
  const auto ome = [&](const std::string& sizes) {
    return of_tiff({.description = ("<?xml version=\"1.0\"?><OME><Pixels " + sizes + " SizeX=\"3\"/></OME>").c_str()});
  };
  const std::string not_square = "has pixels that are not square (OME's PhysicalSizeX and PhysicalSizeY); expected one size";
  EXPECT_EQ(ome("PhysicalSizeX=\"0.5\" PhysicalSizeY='0.5'"), "");
  EXPECT_EQ(ome("PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.50\" PhysicalSizeXUnit=\"µm\""), "");
  EXPECT_EQ(ome("PhysicalSizeX=\"0.5\" PhysicalSizeY = \"0.25\""), not_square);
  EXPECT_EQ(ome("PhysicalSizeY=\"0.5\""), not_square);
  EXPECT_EQ(ome("PhysicalSizeX=\"1\" PhysicalSizeXUnit=\"nm\" PhysicalSizeY=\"1\" PhysicalSizeYUnit=\"mm\""), not_square);
  EXPECT_EQ(of_tiff({.description = "{\"shape\": [3, 3]}"}), "");
  EXPECT_EQ(of_tiff({.description = "{\"shape\": [1, 3, 3, 1], \"axes\": \"ZYXS\"}"}), "");
  EXPECT_EQ(of_tiff({.description = "{\"shape\": [4, 3, 3]}"}), "has a stack of pictures (tifffile's shape); expected one");
  const std::string turned = "is turned by its XMP (tiff:Orientation); expected 1, the first row on top";
  EXPECT_EQ(of_tiff({.xmp = "<x tiff:Orientation=\"1\"/>"}), "");
  EXPECT_EQ(of_tiff({.xmp = "<x tiff:Orientation = '6'/>"}), turned);
  EXPECT_EQ(of_tiff({.xmp = "<tiff:Orientation>3</tiff:Orientation>"}), turned);
  EXPECT_EQ(of_tiff({.xmp = "<tiff:Orientation> 1 </tiff:Orientation>\n<x>"}), "");
}

TEST_F(BesideHeights, with_a_tag_that_changes_them_are_refused) {
  for (const auto& [tag, name] : std::vector<std::pair<std::uint32_t, std::string>>{{33920, "IntergraphMatrix"},
                                                                                    {50844, "RPCCoefficient"},
                                                                                    {50712, "LinearizationTable"},
                                                                                    {50714, "BlackLevel"},
                                                                                    {50717, "WhiteLevel"}})
    EXPECT_EQ(of_tiff({.others = {{tag, 9}}}),
              "has the tag " + name + ", by which a number is no height or stands elsewhere; expected heights alone");
  EXPECT_EQ(of_tiff({.others = {{33629, 1}}}), "");
  EXPECT_EQ(of_tiff({.others = {{33629, 2}}}), "has a stack of pictures (MetaMorph's UIC2); expected one");
  EXPECT_EQ(of_tiff({.known = {{TIFFTAG_IMAGEDEPTH, 1}}}), "");
  for (const std::uint32_t kind : {FILETYPE_REDUCEDIMAGE, FILETYPE_MASK})
    EXPECT_EQ(of_tiff({.known = {{TIFFTAG_SUBFILETYPE, kind}}}),
              "is a smaller copy or a mask of a picture (NewSubfileType); expected the picture");
  EXPECT_EQ(of_tiff({.known = {{TIFFTAG_SUBFILETYPE, FILETYPE_PAGE}}}), "");
}

// The text and other chunks of a PNG, in front of its samples and behind them.
TEST_F(BesideHeights, of_a_png_that_may_be_turned_or_is_a_pair_are_refused) {
  tests::TemporaryDirectory directory;
  const auto chunk = [](const std::string& type, const std::string& data) {
    const auto number = [](std::uint64_t value) {
      std::string text;
      for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift);
      return text;
    };
    const std::string both = type + data;
    return number(data.size()) + both +
           number(crc32(0, reinterpret_cast<const Bytef*>(both.data()), static_cast<uInt>(both.size())));
  };
  const std::string header("\0\0\0\3\0\0\0\3\x08\0\0\0\0", 13), rows(12, '\0');
  std::vector<Bytef> packed(100);
  uLongf size = 100;
  ASSERT_EQ(compress(packed.data(), &size, reinterpret_cast<const Bytef*>(rows.data()), rows.size()), Z_OK);
  const auto with = [&](const std::string& type, const std::string& data) {
    std::string found;
    for (const bool is_behind : {false, true}) {
      const std::string extra = chunk(type, data),
                        samples = chunk("IDAT", {reinterpret_cast<const char*>(packed.data()), size});
      const std::string words =
          refusal(directory.write("a.png", "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) +
                                               (is_behind ? samples + extra : extra + samples) + chunk("IEND", "")));
      EXPECT_TRUE(!is_behind || words == found) << words;
      found = words;
    }
    return found;
  };
  const std::string exif = "has Exif data (Raw profile), which may turn it; expected none";
  EXPECT_EQ(with("tEXt", std::string("Raw profile type exif\0\nexif\n 1\n45", 34)), exif);
  EXPECT_EQ(with("tEXt", std::string("Raw profile type APP1\0\nexif\n 1\n45", 34)), exif);
  EXPECT_EQ(with("tEXt", std::string("Raw profile type xmp\0\nxmp\n 1\n45", 32)),
            "has XMP (Raw profile), which may turn it; expected none");
  const std::string xmp("XML:com.adobe.xmp\0\0\0\0\0", 22);
  EXPECT_EQ(with("iTXt", xmp + "<x tiff:Orientation=\"1\"/>"), "");
  EXPECT_EQ(with("iTXt", xmp + "<x tiff:Orientation=\"8\"/>"),
            "is turned by its XMP (tiff:Orientation); expected 1, the first row on top");
  EXPECT_EQ(with("sTER", std::string(1, '\0')), "is a pair for two eyes (sTER); expected one picture");
  EXPECT_EQ(with("tEXt", std::string("Comment\0tiff:Orientation=\"8\"", 28)), "");
}

TEST_F(BesideHeights, that_another_file_has_in_their_place_are_named) {
  const std::string expected = "expected a PNG, TIFF, greyscale PFM or NPY file, got ";
  EXPECT_EQ(refusal(directory_.write("a.tif", "\x1f\x8b\x08")), expected + "a gzip archive");
  EXPECT_EQ(refusal(directory_.write("a.png", "\n<!DOCTYPE html>\n")), expected + "an XML or HTML file");
  EXPECT_EQ(refusal(directory_.write("a.png", "\xff\xd8\xff\xe0")), expected + "a JPEG picture");
  const std::string pipe = directory_.file("pipe.png");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), "is a named pipe; expected a file");
}

}  // namespace
}  // namespace forceshade::heights
