// SPDX-License-Identifier: BSD-3-Clause
// The stored hashes hold for this build and every instruction set it has; arithmetic that may round otherwise is refused.

#include "same_bits.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <fstream>
#include <map>
#include <set>

#include "same_bits_damping.h"
#include "same_bits_heights.h"
#include "same_bits_meshes.h"
#include "tests/support/set_control_words.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace forceshade::tests {
namespace {

std::map<std::string, std::string> stored_hashes() {
  std::map<std::string, std::string> hashes;
  std::ifstream file(FORCESHADE_SOURCE_DIR "/tests/golden/hashes.txt");
  for (std::string line; std::getline(file, line);)
    if (!line.starts_with('#')) hashes[line.substr(0, line.find(' '))] = line.substr(line.find(' ') + 1);
  return hashes;
}

TEST(same_bits, every_instruction_set_makes_the_stored_hashes) {
  const auto stored = stored_hashes();
  for (const LawName& law : kLaws) {
    const Bits bits = bits_of(law.id);
    const auto& [free, contact, invalid] = bits.statuses;
    std::printf("  %-15s %s  %zu free, %zu contact, %zu invalid\n", law.name.data(), bits.hash.c_str(), free, contact, invalid);
    EXPECT_EQ(bits.hash, stored.at(std::string(law.name))) << law.name;
    for (const fast::InstructionSet set : fast::kInstructionSets)
      EXPECT_EQ(bits.different[static_cast<std::size_t>(set)], 0U) << law.name << ", " << name_of(set);
    EXPECT_EQ(bits.nans, 0U) << law.name;
    for (const std::size_t count : bits.statuses) EXPECT_GT(count, 100'000U) << law.name;
  }
}

TEST(same_bits, every_instruction_set_makes_the_stored_hashes_of_height_maps) {
  const auto stored = stored_hashes();
  std::size_t maps = 0;
  for (const HeightScene& scene : height_scenes())
    for (const auto& [mode, name] : height::kModes) {
      if (!is_rendered(scene, mode)) continue;
      ++maps;
      const Bits bits = bits_of(scene, mode);
      const auto& [free, contact, invalid] = bits.statuses;
      const std::string what = name_of(scene, mode);
      std::printf("  %-45s %s  %zu free, %zu contact, %zu invalid\n", what.c_str(), bits.hash.c_str(), free, contact, invalid);
      ASSERT_TRUE(stored.contains(what)) << what;
      EXPECT_EQ(bits.hash, stored.at(what)) << what;
      for (const fast::InstructionSet set : fast::kInstructionSets)
        EXPECT_EQ(bits.different[static_cast<std::size_t>(set)], 0U) << what << ", " << name_of(set);
      EXPECT_EQ(bits.nans, 0U) << what;
      for (const std::size_t count : bits.statuses) EXPECT_GT(count, 10U) << what;
    }
  EXPECT_EQ(stored.size(), kLaws.size() + maps + mesh_scenes().size() + 2);
}

TEST(same_bits, a_god_object_makes_the_stored_hashes) {
  const auto stored = stored_hashes();
  for (const MeshScene& scene : mesh_scenes()) {
    const Bits bits = bits_of(scene);
    const auto& [free, contact, invalid] = bits.statuses;
    std::printf("  %-25s %s  %zu free, %zu contact, %zu invalid\n", scene.name, bits.hash.c_str(), free, contact, invalid);
    ASSERT_TRUE(stored.contains(scene.name)) << scene.name;
    EXPECT_EQ(bits.hash, stored.at(scene.name)) << scene.name;
    EXPECT_EQ(bits.nans, 0U) << scene.name;
    for (const std::size_t count : bits.statuses) EXPECT_GT(count, 100U) << scene.name;
  }
}

void expect_stored(const Bits& bits, const std::string& name) {
  const auto& [free, contact, invalid] = bits.statuses;
  std::printf("  %s  %zu free, %zu contact, %zu invalid\n", bits.hash.c_str(), free, contact, invalid);
  EXPECT_EQ(bits.hash, stored_hashes().at(name));
  EXPECT_EQ(bits.nans, 0U);
  for (const std::size_t count : bits.statuses) EXPECT_GT(count, 100U);
}

TEST(same_bits, objects_that_move_make_the_stored_hash) {
  expect_stored(bits_of_moving_objects(), "scene-of-moving-objects");
}

TEST(same_bits, damping_makes_the_stored_hash) {
  expect_stored(bits_of_damping(), "damping");
}

// A kind that is added to height::Shape has to be among the scenes.
TEST(same_bits, every_kind_of_height_map_has_a_hash) {
  std::set<std::size_t> kinds;
  for (const HeightScene& scene : height_scenes())
    if (scene.map.parts.size() == 1) kinds.insert(scene.map.parts.front().shape.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<height::Shape>);
}

// Returns true if building was refused on account of the arithmetic, of laws and of height maps alike.
bool is_refused() {
  const auto is_on_its_account = [](const auto& built) {
    const auto* error = std::get_if<ParameterError>(&built);
    if (error == nullptr || error->arithmetic_fault == nullptr || fast::arithmetic_fault() == nullptr) return false;
    EXPECT_EQ(error->message(),
              std::string("found ") + fast::arithmetic_fault() + "; expected the arithmetic of IEEE 754, rounded to nearest");
    return true;
  };
  const bool is_law = is_on_its_account(fast::Law::build(LawId::wall, {0, 0, 1}));
  const bool is_height_map =
      is_on_its_account(fast::HeightMapField::build({{{height::Plane{}}}}, height::Mode::true_height, 1));
  EXPECT_EQ(is_law, is_height_map);
  return is_law && is_height_map;
}

TEST(same_bits, nothing_is_built_while_rounding_is_not_to_nearest) {
  EXPECT_FALSE(is_refused());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const bool refused = is_refused();
    std::fesetround(FE_TONEAREST);
    EXPECT_TRUE(refused) << mode;
  }
}

// The look raises exceptions itself; they do not trap, and what traps afterwards is as before.
TEST(same_bits, the_look_at_the_arithmetic_works_where_exceptions_trap) {
  for (const unsigned traps : {0x0080U, 0x0100U, 0x0200U, 0x0400U, 0x0800U, 0x1000U, 0x1F80U}) {
    const char *fault = "", *rounded_up = "";
    bool are_still_set = false;
    {
      const SetControlWords set({.mxcsr = kNoTraps & ~traps});
      fault = fast::arithmetic_fault();
      are_still_set = set.are_still_set();
    }
    {
      const SetControlWords set({.mxcsr = 0x4000U | (kNoTraps & ~traps)});
      rounded_up = fast::arithmetic_fault();
    }
    EXPECT_EQ(fault, nullptr) << traps;
    EXPECT_TRUE(are_still_set) << traps;
    if (FORCESHADE_HAS_CONTROL_WORDS) {
      EXPECT_STREQ(rounded_up, "rounding other than to nearest") << traps;
    }
  }
}

// A caller must look for this fault: a law does not.
TEST(same_bits, a_mode_set_after_building_is_a_fault_while_it_lasts) {
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::bump_1p_shaded, {15.24F, 25.4F, 0.7F}));
  const auto forces = [&] {
    std::vector<Eigen::Vector3f> all;
    for (int i = 1; i < 100; ++i) all.push_back(law.force({0.1F * static_cast<float>(i), 0, -0.3F}));
    return all;
  };
  const auto right = forces();
  std::fesetround(FE_UPWARD);
  const auto wrong = forces();
  const char* fault = fast::arithmetic_fault();
  std::fesetround(FE_TONEAREST);
  EXPECT_STREQ(fault, "rounding other than to nearest");
  EXPECT_NE(wrong, right);
  EXPECT_EQ(fast::arithmetic_fault(), nullptr);
  EXPECT_EQ(forces(), right);
}

#if defined(__SSE2__)
TEST(same_bits, nothing_is_built_while_subnormals_are_flushed) {
  const unsigned mode = _mm_getcsr();
  for (const unsigned bit : {0x8000U, 0x0040U}) {  // flush to zero, denormals are zero
    _mm_setcsr(mode | bit);
    const bool refused = is_refused();
    _mm_setcsr(mode);
    EXPECT_TRUE(refused) << bit;
  }
}
#endif

}  // namespace
}  // namespace forceshade::tests
