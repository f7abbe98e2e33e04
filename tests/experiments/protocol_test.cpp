// SPDX-License-Identifier: BSD-3-Clause
// Protocols and texts from TOML files, and the order of the trials.

#include "study/experiments/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "study/experiments/error.h"
#include "study/experiments/language.h"
#include "study/experiments/order.h"
#include "study/experiments/random.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

const std::filesystem::path kExamples = FORCESHADE_SOURCE_DIR "/examples/experiments";

const std::string kMatching = R"(experiment = "matching"
name = "m"
language = "english.toml"
width_mil = 1000
stiffness_N_per_mm = 0.5
spacing_mil = 1500
resume = "trial"
block_order = "as-listed"
reference = { law = "bump-cylinder" }
stimuli = [{ law = "bump-1p-shaded" }]
vision = [true]
reference_radii_mil = [600, 1400]
large_initial_radius_mil = 1400
small_initial_radius_mil = 600
repetitions = 1
radius_step_mil = 300
least_radius_mil = 520
largest_radius_mil = 2000
bigger = "higher"
)";

// What is said of kMatching with a part replaced, without the file's name.
std::string words_with(const std::string& from, const std::string& to) {
  const tests::TemporaryDirectory directory;
  std::string text = kMatching;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string file = directory.write("p.toml", text);
  try {
    read_protocol(file);
    return "";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(file + ":")) << error.what();
    return std::string(error.what()).substr(file.size() + 1);
  }
}

TEST(protocol, the_matching_example_is_table_5_1) {
  const Protocol protocol = read_protocol(kExamples / "matching.toml");
  EXPECT_EQ(protocol.experiment, Experiment::matching);
  EXPECT_EQ(protocol.trials() * 5, 2400);  // five subjects
  EXPECT_EQ(protocol.reference.law, LawId::bump_cylinder);
  EXPECT_EQ(protocol.stimuli.size(), 4U);
  EXPECT_EQ(protocol.width, 1000);
  EXPECT_FLOAT_EQ(protocol.parameters(1000).radius, 25.4F);
}

TEST(protocol, the_classification_example_is_table_5_2) {
  const Protocol protocol = read_protocol(kExamples / "classification.toml");
  EXPECT_EQ(protocol.trials() * 5, 2520);
  EXPECT_EQ(protocol.bumps().size(), 21U);
}

TEST(protocol, a_mistake_is_named_with_line_and_key) {
  EXPECT_EQ(words_with("\"matching\"", "\"matchin\""),
            "1: experiment: expected one of matching, classification, got 'matchin'; the nearest is matching");
  EXPECT_EQ(words_with("width_mil = 1000\n", ""), "1: key width_mil is missing");
  EXPECT_EQ(words_with("width_mil", "width_mils"), "1: key width_mil is missing; the nearest is width_mils");
  EXPECT_EQ(words_with("spacing_mil = 1500", "spacing_mil = 1501"), "6: spacing_mil: expected an even number, got 1501");
  EXPECT_EQ(words_with("0.5", "nan"), "5: stiffness_N_per_mm: expected a number, 0.001 to 1000, got nan");
  EXPECT_EQ(words_with("[600, 1400]", "[600, 600]"),
            "12: reference_radii_mil: expected a list of different whole numbers, each 4 to 393700, got 600");
  EXPECT_EQ(words_with("repetitions = 1", "repetitions = 1.5"), "15: repetitions: expected a whole number, 1 to 1000, got 1.5");
  EXPECT_EQ(words_with("vision = [true]", "vision = [true, true]"),
            "11: vision: expected a list of true, false or both, each once, got true");
  EXPECT_EQ(words_with("bigger =", "colour = 1\nbigger ="), "19: unknown key colour");
  EXPECT_EQ(words_with("bump-1p-shaded", "bump-9p"),
            "10: law: expected the name of a law as `forceshade laws` lists them, got \"bump-9p\"; the nearest is bump-1p");
}

TEST(protocol, a_condition_that_cannot_be_rendered_is_refused) {
  EXPECT_EQ(words_with("least_radius_mil = 520", "least_radius_mil = 499"),
            "17: least_radius_mil: expected half the width of 1000 mil or more");
  EXPECT_EQ(words_with("[600, 1400]", "[600, 2100]"),
            "12: reference_radii_mil: expected radii from least_radius_mil to largest_radius_mil, got 2100");
  EXPECT_EQ(words_with("width_mil = 1000", "width_mil = 1300"),
            "10: stimuli: expected half the width of 1300 mil or more, got 600");
  EXPECT_TRUE(words_with("{ law = \"bump-1p-shaded\" }", "{ height-map = \"none.toml\" }")
                  .starts_with("10: height-map: expected a file, found none at "));
}

// Height maps and meshes have variants instead of radii; the keys go from one to the next.
TEST(protocol, stimuli_that_are_no_laws_have_variants) {
  const tests::TemporaryDirectory directory;
  directory.write("a.toml", "");
  directory.write("b.off", "");
  std::string text = kMatching;
  const std::string law = "{ law = \"bump-1p-shaded\" }";
  const std::string variants =
      "{ name = \"dome\", variants = [{ radius_mil = 600, mesh = \"b.off\", unit = \"mm\" }, { radius_mil = 1400, mesh = "
      "\"b.off\", unit = \"mm\" }] }";
  text.replace(text.find(law), law.size(), variants);
  const Protocol protocol = read_protocol(directory.write("p.toml", text));
  const Stimulus& dome = protocol.stimulus("dome");
  EXPECT_EQ(dome.kind, StimulusKind::mesh);
  EXPECT_EQ(protocol.stepped(dome, 600, 1), 1400);
  EXPECT_EQ(protocol.stepped(dome, 1400, 1), 1400);
  EXPECT_EQ(protocol.stepped(dome, 600, -1), 600);
  EXPECT_EQ(
      words_with(law, "{ name = \"d\", variants = [{ radius_mil = 600, mesh = \"b.off\", unit = \"ft\" }] }").substr(0, 3),
      "10:");
  // One shape, whatever the radius, can be classified.
  const Protocol single = read_protocol(directory.write(
      "c.toml",
      "experiment = \"classification\"\nname = \"c\"\nlanguage = \"e\"\nwidth_mil = 1000\nstiffness_N_per_mm = 1\nresume = "
      "\"block\"\nrepetitions = 3\nstimuli = [{ height-map = \"a.toml\" }]\n"));
  EXPECT_EQ(single.trials(), 3);
  EXPECT_EQ(single.bumps(), (std::vector<Bump>{{"a", 0, 0}}));
}

TEST(protocol, all_bumps_that_the_keys_reach_are_listed) {
  const tests::TemporaryDirectory directory;
  const Protocol protocol = read_protocol(directory.write("p.toml", kMatching));
  std::set<Mil> radii;
  for (const Bump& bump : protocol.bumps())
    if (bump.stimulus == "bump-1p-shaded") radii.insert(bump.radius);
  // By hand: 600 and 1400 in steps of 300, from them to the limits 520 and 2000, and back from these.
  EXPECT_EQ(radii, (std::set<Mil>{520, 600, 800, 820, 900, 1100, 1120, 1200, 1400, 1420, 1500, 1700, 1720, 1800, 2000}));
}

TEST(language, both_examples_are_complete) {
  for (const char* file : {"english.toml", "german.toml"}) {
    const Language language = read_language(kExamples / file);
    EXPECT_EQ(language.pictures.size(), 4U);
    EXPECT_EQ(language.questions_after_matching.size(), 5U);  // thesis 5.5.2
  }
}

TEST(language, an_unknown_place_in_braces_is_refused) {
  const tests::TemporaryDirectory directory;
  std::ifstream in(kExamples / "english.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.replace(text.find("{smaller} to make"), 9, "{small}  ");
  const std::string file = directory.write("l.toml", text);
  try {
    read_language(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("text: expected nothing in braces but {smaller}"), std::string::npos)
        << error.what();
  }
}

// First outputs for the seed 1234567, as published on Rosetta Code.
TEST(random, is_splitmix64) {
  const std::array<std::uint64_t, 5> published{6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                               4593380528125082431U, 16408922859458223821U};
  std::uint64_t state = 1234567;
  for (const std::uint64_t expected : published) EXPECT_EQ(mixed(state += Random::kIncrement), expected);
  EXPECT_NE(Random(42).next(), Random(42, 1).next());
}

TEST(random, draws_every_number_equally_often) {
  Random random(3);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70'000; ++i) ++counts[random.below(7)];
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 500);  // more than five standard deviations
}

// A change of the generator or of the shuffle would give recorded seeds another meaning. A separate program in Python gave the
// same four trials.
TEST(order, a_seed_means_the_same_order_for_ever) {
  const std::vector<Block> blocks = order(read_protocol(kExamples / "classification.toml"), 1995);
  ASSERT_EQ(blocks.size(), 2U);
  std::string beginning;
  for (int i = 0; i < 4; ++i) {
    const Trial& trial = blocks[1].trials[static_cast<std::size_t>(i)];
    beginning += trial.stimulus + ' ' + std::to_string(trial.radius) + ' ' + std::to_string(trial.repetition) + ", ";
  }
  EXPECT_EQ(beginning, "bump-3p-shaded 600 7, bump-1p 1000 21, bump-2p-shaded 600 5, bump-cylinder 1400 24, ");
}

TEST(order, each_condition_of_table_5_1_occurs_exactly_as_often_as_stated) {
  const Protocol protocol = read_protocol(kExamples / "matching.toml");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Block> blocks = order(protocol, seed);
    ASSERT_EQ(blocks.size(), 9U);
    EXPECT_TRUE(blocks[0].is_practice);
    EXPECT_EQ(blocks[0].trials.size(), 4U);
    std::map<std::tuple<std::string, bool, Mil, InitialRadius>, std::set<int>> repetitions;
    std::set<std::pair<std::string, bool>> kinds;
    int number = 0;
    for (std::size_t i = 1; i < blocks.size(); ++i) {
      const Block& block = blocks[i];
      EXPECT_EQ(block.number, static_cast<int>(i));
      EXPECT_EQ(block.trials.size(), 60U);
      EXPECT_TRUE(kinds.insert({block.trials[0].stimulus, block.vision}).second);
      for (const Trial& trial : block.trials) {
        EXPECT_EQ(trial.number, ++number);
        EXPECT_EQ(trial.stimulus, block.trials[0].stimulus);
        const bool is_large = trial.initial == InitialRadius::large, is_small = trial.initial == InitialRadius::small;
        EXPECT_EQ(trial.initial_radius, is_large ? 1400 : is_small ? 600 : trial.radius);
        const std::tuple condition(trial.stimulus, block.vision, trial.radius, trial.initial);
        EXPECT_TRUE(repetitions[condition].insert(trial.repetition).second);
      }
    }
    EXPECT_EQ(number, 480);
    EXPECT_EQ(repetitions.size(), 2U * 4 * 5 * 3);
    for (const auto& [condition, its] : repetitions) EXPECT_EQ(its, (std::set<int>{1, 2, 3, 4}));
  }
}

TEST(order, each_condition_of_table_5_2_occurs_exactly_as_often_as_stated) {
  const std::vector<Block> blocks = order(read_protocol(kExamples / "classification.toml"), 7);
  std::map<std::pair<std::string, Mil>, std::set<int>> repetitions;
  for (const Trial& trial : blocks.back().trials) repetitions[{trial.stimulus, trial.radius}].insert(trial.repetition);
  EXPECT_EQ(blocks.back().trials.size(), 504U);
  EXPECT_EQ(repetitions.size(), 21U);
  for (const auto& [condition, its] : repetitions) EXPECT_EQ(its.size(), 24U);
}

// Every place of the order is open to every condition: over many seeds, each stimulus is about as often the first.
TEST(order, seeds_give_different_orders) {
  const Protocol protocol = read_protocol(kExamples / "classification.toml");
  std::map<std::string, int> first;
  for (std::uint64_t seed = 0; seed < 700; ++seed) ++first[order(protocol, seed).back().trials.front().stimulus];
  EXPECT_EQ(first.size(), 7U);
  for (const auto& [stimulus, count] : first) EXPECT_NEAR(count, 100, 50) << stimulus;  // 5 standard deviations of 9.3
}

// The practice is shuffled by the seed, too: not always by the same permutation of the first block's order.
TEST(order, of_the_practice_is_another_one_for_each_seed) {
  const Protocol protocol = read_protocol(kExamples / "classification.toml");
  std::set<std::ptrdiff_t> places;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const std::vector<Block> blocks = order(protocol, seed);
    ASSERT_TRUE(blocks[0].is_practice);
    Trial first = blocks[0].trials.front();
    const auto same = std::ranges::find_if(blocks[1].trials, [&](Trial trial) {
      trial.number = 0;
      return trial == first;
    });
    ASSERT_NE(same, blocks[1].trials.end());
    places.insert(same - blocks[1].trials.begin());
  }
  EXPECT_GT(places.size(), 1U);
}

}  // namespace
}  // namespace forceshade::experiments
