// SPDX-License-Identifier: BSD-3-Clause
// The C interface gives what the C++ one gives, bit for bit, for one position, many and a path, without allocating.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "forceshade.h"
#include "forceshade/fast.h"
#include "forceshade/law.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/subjects.h"
#include "tests/support/allocations.h"
#include "tests/support/temporary_directory.h"

namespace forceshade {
namespace {

using tests::batch_of;
using tests::bits_of;
using tests::law_of;
using tests::positions;
using tests::tetrahedron;

constexpr Parameters kBump{15.24F, 25.4F, 0.5F};

TEST(c_interface, gives_the_bits_and_the_status_of_each_law_for_one_position_many_and_a_path) {
  constexpr std::size_t kCount = 4000;
  for (const LawName& law : kLaws) {
    const auto right = std::get<fast::Law>(fast::Law::build(law.id, kBump));
    const forceshade_subject subject = law_of(std::string(law.name));
    forceshade_session session{};
    ASSERT_EQ(forceshade_session_open(subject, &session), FORCESHADE_OK);
    const std::vector<float> at = positions(kCount, 7);
    std::vector<float> forces(at.size());
    std::vector<forceshade_status> statuses(kCount, 99);
    std::size_t invalid = 0, expected_invalid = 0;
    const forceshade_batch batch = batch_of(at, forces, statuses);
    ASSERT_EQ(forceshade_forces(subject, &batch, &invalid), FORCESHADE_OK);
    for (std::size_t i = 0; i < kCount; ++i) {
      const fast::Evaluation answer = right.evaluate({at[3 * i], at[3 * i + 1], at[3 * i + 2]});
      const std::array<float, 3> force{answer.force.x(), answer.force.y(), answer.force.z()};
      std::array<float, 3> one{}, step{};
      forceshade_status status = 99, step_status = 99;
      ASSERT_EQ(forceshade_force(subject, &at[3 * i], one.data(), &status), FORCESHADE_OK);
      ASSERT_EQ(forceshade_session_step(session, &at[3 * i], step.data(), &step_status), FORCESHADE_OK);
      ASSERT_EQ(bits_of(one.data()), bits_of(force.data())) << law.name;
      ASSERT_EQ(bits_of(step.data()), bits_of(force.data())) << law.name;
      ASSERT_EQ(bits_of(&forces[3 * i]), bits_of(force.data())) << law.name;
      const auto expected = static_cast<forceshade_status>(answer.status);
      ASSERT_EQ(status, expected);
      ASSERT_EQ(step_status, expected);
      ASSERT_EQ(statuses[i], expected) << law.name << " " << i;
      expected_invalid += expected == FORCESHADE_INVALID ? 1 : 0;
    }
    EXPECT_EQ(invalid, expected_invalid);
    EXPECT_GT(invalid, 0U);
    EXPECT_EQ(forceshade_session_close(session), FORCESHADE_OK);
    EXPECT_EQ(forceshade_subject_free(subject), FORCESHADE_OK);
  }
}

std::vector<float> hill(std::uint32_t columns, std::uint32_t rows) {
  std::vector<float> heights;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) heights.push_back(static_cast<float>((i * 7 + j * 5) % 11) / 8);
  return heights;
}

TEST(c_interface, makes_a_height_map_of_samples_however_they_lie) {
  constexpr std::uint32_t kColumns = 9, kRows = 6;
  const std::vector<float> heights = hill(kColumns, kRows);
  std::vector<float> transposed(heights.size());
  for (std::uint32_t j = 0; j < kRows; ++j)
    for (std::uint32_t i = 0; i < kColumns; ++i) transposed[i * kRows + j] = heights[j * kColumns + i];
  forceshade_height_map map{.size = sizeof map,
                            .heights = heights.data(),
                            .columns = kColumns,
                            .rows = kRows,
                            .column_stride = 4,
                            .row_stride = 4 * kColumns,
                            .pitch = 0.5F,
                            .interpolant = "bilinear",
                            .edge = nullptr,
                            .render = "height-map",
                            .stiffness = 0.5F};
  forceshade_subject rows{}, columns{}, spline{};
  ASSERT_EQ(forceshade_height_map_new(&map, &rows), FORCESHADE_OK) << forceshade_message();
  map.heights = transposed.data();
  map.column_stride = 4 * kRows;
  map.row_stride = 4;
  ASSERT_EQ(forceshade_height_map_new(&map, &columns), FORCESHADE_OK);
  map.interpolant = nullptr;
  ASSERT_EQ(forceshade_height_map_new(&map, &spline), FORCESHADE_OK);

  height::Grid grid{kColumns, kRows, 0.5F, height::Edge::clamp, height::Interpolant::bilinear, heights};
  const auto right = std::get<fast::HeightMapField>(
      fast::HeightMapField::build({{{std::make_shared<const height::Grid>(grid)}}}, height::Mode::true_height, 0.5F));
  const std::vector<float> at = positions(2000, 5);
  int contacts = 0, different = 0;
  for (std::size_t i = 0; i < at.size() / 3; ++i) {
    std::array<float, 3> by_rows{}, by_columns{}, by_spline{};
    forceshade_status status = 99;
    ASSERT_EQ(forceshade_force(rows, &at[3 * i], by_rows.data(), &status), FORCESHADE_OK);
    ASSERT_EQ(forceshade_force(columns, &at[3 * i], by_columns.data(), nullptr), FORCESHADE_OK);
    ASSERT_EQ(forceshade_force(spline, &at[3 * i], by_spline.data(), nullptr), FORCESHADE_OK);
    const fast::Evaluation answer = right.evaluate({at[3 * i], at[3 * i + 1], at[3 * i + 2]});
    const std::array<float, 3> force{answer.force.x(), answer.force.y(), answer.force.z()};
    ASSERT_EQ(bits_of(by_rows.data()), bits_of(force.data()));
    ASSERT_EQ(bits_of(by_columns.data()), bits_of(force.data()));
    ASSERT_EQ(status, static_cast<forceshade_status>(answer.status));
    contacts += answer.status == Status::contact ? 1 : 0;
    different += bits_of(by_spline.data()) != bits_of(force.data()) ? 1 : 0;
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(different, 10) << "a spline is another surface";
  for (const forceshade_subject subject : {rows, columns, spline}) forceshade_subject_free(subject);
}

std::string text_of(forceshade_subject subject, int what) {
  std::size_t length = 0;
  EXPECT_EQ(forceshade_subject_text(subject, what, nullptr, 0, &length), FORCESHADE_OK);
  std::string text(length + 1, '?');
  EXPECT_EQ(forceshade_subject_text(subject, what, text.data(), text.size(), nullptr), FORCESHADE_OK);
  EXPECT_EQ(text.back(), '\0');
  text.pop_back();
  return text;
}

TEST(c_interface, says_what_a_subject_is) {
  const forceshade_subject law = law_of("bump-2p"), mesh = tetrahedron("none");
  EXPECT_EQ(text_of(law, FORCESHADE_KIND), "law");
  EXPECT_EQ(text_of(law, FORCESHADE_NAME), "bump-2p");
  EXPECT_EQ(text_of(law, FORCESHADE_PARAMETERS), "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm");
  EXPECT_EQ(text_of(law, FORCESHADE_DIGEST), "");
  EXPECT_EQ(text_of(mesh, FORCESHADE_KIND), "mesh");
  EXPECT_EQ(text_of(mesh, FORCESHADE_NAME), "triangles");
  EXPECT_EQ(text_of(mesh, FORCESHADE_DIGEST).size(), 64U);
  char cut[4] = "???";
  EXPECT_EQ(forceshade_subject_text(law, FORCESHADE_NAME, cut, sizeof cut, nullptr), FORCESHADE_OK);
  EXPECT_STREQ(cut, "bum");
  forceshade_subject_free(law);
  forceshade_subject_free(mesh);
}

TEST(c_interface, reads_subject_files_and_their_texts) {
  const tests::TemporaryDirectory folder;
  const std::string text = "law = \"bump-2p\"\nradius = 15.24\nwidth = 25.4\nstiffness = 0.5\n";
  forceshade_subject of_file{}, of_text{};
  ASSERT_EQ(forceshade_subject_read(folder.write("bump.toml", text).c_str(), &of_file), FORCESHADE_OK) << forceshade_message();
  ASSERT_EQ(forceshade_subject_parse(text.data(), text.size(), "bump.toml", &of_text), FORCESHADE_OK) << forceshade_message();
  for (const forceshade_subject subject : {of_file, of_text}) {
    EXPECT_EQ(text_of(subject, FORCESHADE_PARAMETERS), "radius 15.24 mm, width 25.4 mm, stiffness 0.5 N/mm");
    forceshade_subject_free(subject);
  }
}

TEST(c_interface, allocates_nothing_where_it_gives_forces) {
  constexpr std::size_t kCount = 2000;
  const forceshade_subject law = law_of("bump-2p-shaded"), mesh = tetrahedron("vertex");
  forceshade_session session{};
  ASSERT_EQ(forceshade_session_open(mesh, &session), FORCESHADE_OK);
  const std::vector<float> at = positions(kCount, 9);
  std::vector<float> forces(at.size());
  std::vector<forceshade_status> statuses(kCount);
  const forceshade_batch batch = batch_of(at, forces, statuses);
  forceshade_state state{};
  state.size = sizeof state;
  const std::size_t before = tests::allocations();
  for (std::size_t i = 0; i < kCount; ++i) {
    forceshade_force(law, &at[3 * i], &forces[3 * i], &statuses[i]);
    forceshade_session_step(session, &at[3 * i], &forces[3 * i], &statuses[i]);
  }
  forceshade_forces(law, &batch, nullptr);
  forceshade_session_steps(session, &batch, nullptr);
  forceshade_session_state(session, &state);
  forceshade_session_resume(session, &state);
  forceshade_session_reset(session);
  forceshade_force({12345}, at.data(), forces.data(), nullptr);  // errors neither
  EXPECT_EQ(tests::allocations(), before);
  forceshade_session_close(session);
  forceshade_subject_free(law);
  forceshade_subject_free(mesh);
}

TEST(c_interface, says_what_the_library_is) {
  EXPECT_EQ(forceshade_version(), static_cast<std::uint32_t>(FORCESHADE_VERSION_MINOR) << 8U);
  EXPECT_STREQ(forceshade_library_digest(), fast::library_digest()) << "the same objects, in a shared library";
  EXPECT_EQ(forceshade_arithmetic_fault(), nullptr);
  for (const char* feature : {"laws", "height-maps", "meshes", "states", "scenes", "device-loop", "subject-files",
                              "image-files", "csv-files", "certificates", "corner-normals", "exact-side"})
    EXPECT_EQ(forceshade_has(feature), 1);
  for (const char* none : {"teapots", "", " ", "subject-files certificates", "exact", "side"})
    EXPECT_EQ(forceshade_has(none), 0);
  EXPECT_EQ(forceshade_has(nullptr), 0);
  EXPECT_EQ(forceshade_has("avx2"), fast::is_available(fast::InstructionSet::avx2) ? 1 : 0);
  EXPECT_STREQ(forceshade_name_of_result(FORCESHADE_BAD_HANDLE), "BAD_HANDLE");
  EXPECT_STREQ(forceshade_name_of_result(FORCESHADE_FAILED), "FAILED");
  EXPECT_STREQ(forceshade_name_of_result(FORCESHADE_NOT_COVERED), "NOT_COVERED");
  EXPECT_STREQ(forceshade_name_of_result(FORCESHADE_LEFT_OUT), "LEFT_OUT");
  EXPECT_STREQ(forceshade_name_of_result(13), "");
  EXPECT_STREQ(forceshade_name_of_result(-1), "");
}

}  // namespace
}  // namespace forceshade
