// SPDX-License-Identifier: BSD-3-Clause
// The order of the trials, the random numbers behind it, and the texts of a session's screens.

#include "study/experiments/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "files/input_file.h"
#include "study/experiments/language.h"
#include "study/experiments/protocol.h"
#include "study/experiments/random.h"
#include "study/tests/experiments/example_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

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

// Each text of the file in the place that its key names.
TEST(language, has_the_text_of_each_key) {
  const tests::TemporaryDirectory directory;
  const std::vector<std::string> headings{"matching",
                                          "classification",
                                          "practice",
                                          "block_with_vision",
                                          "block_without_vision",
                                          "classification_block",
                                          "break",
                                          "resumed",
                                          "end",
                                          "match",
                                          "satisfy",
                                          "classify",
                                          "question"};
  std::string text =
      "language = \"name\"\npictures = [\"p1\", \"p2\", \"p3\", \"p4\"]\n"
      "questions_after_matching = [\"m1\", \"m2\"]\nquestions_after_classification = [\"c1\"]\n";
  for (const std::string& heading : headings)
    text += '[' + heading + "]\ntitle = \"title of " + heading + "\"\ntext = \"text of " + heading + "\"\n";
  text += "[labels]\n";
  for (const char* label : {"trial", "practice", "reference", "matching", "different", "same"})
    text += std::string(label) + " = \"label " + label + "\"\n";
  const Language read = read_language(directory.write("l.toml", text));
  EXPECT_EQ(read.name, "name");
  const std::vector<const Heading*> read_headings{&read.matching,
                                                  &read.classification,
                                                  &read.practice,
                                                  &read.block_with_vision,
                                                  &read.block_without_vision,
                                                  &read.classification_block,
                                                  &read.pause,
                                                  &read.resumed,
                                                  &read.end,
                                                  &read.match,
                                                  &read.satisfy,
                                                  &read.classify,
                                                  &read.question};
  for (std::size_t i = 0; i < headings.size(); ++i) {
    EXPECT_EQ(read_headings[i]->title, "title of " + headings[i]);
    EXPECT_EQ(read_headings[i]->text, "text of " + headings[i]);
  }
  EXPECT_EQ(read.questions_after_matching, (std::vector<std::string>{"m1", "m2"}));
  EXPECT_EQ(read.questions_after_classification, std::vector<std::string>{"c1"});
  EXPECT_EQ(read.labels.trial, "label trial");
  EXPECT_EQ(read.labels.practice, "label practice");
  EXPECT_EQ(read.labels.reference, "label reference");
  EXPECT_EQ(read.labels.matching, "label matching");
  EXPECT_EQ(read.labels.different, "label different");
  EXPECT_EQ(read.labels.same, "label same");
  EXPECT_EQ(read.pictures, (std::vector<std::string>{"p1", "p2", "p3", "p4"}));
  // Names that may stand in braces: numbers of blocks in texts of blocks, of trials in that of a break, keys everywhere.
  const auto refuses = [&](const std::string& heading, const std::string& place) {
    std::string changed = text;
    const std::string from = "text of " + heading + '"';
    changed.replace(changed.find(from), from.size(), '{' + place + "}\"");
    try {
      read_language(directory.write("changed.toml", changed));
      return false;
    } catch (const Error&) {
      return true;
    }
  };
  for (const std::string& heading : headings) {
    for (const char* key : {"smaller", "bigger", "done", "enter", "erase"}) EXPECT_FALSE(refuses(heading, key)) << heading;
    const bool is_block = heading.find("block") != std::string::npos;
    for (const char* place : {"block", "blocks"}) EXPECT_EQ(refuses(heading, place), !is_block) << heading;
    for (const char* place : {"trial", "trials"}) EXPECT_EQ(refuses(heading, place), heading != "break") << heading;
  }
  for (const char* list : {"[\"p1\", \"p2\", \"p3\"]", "[\"p1\", \"p2\", \"p3\", \"p4\", \"p5\"]"}) {
    std::string changed = text;
    changed.replace(changed.find("[\"p1\""), std::string("[\"p1\", \"p2\", \"p3\", \"p4\"]").size(), list);
    EXPECT_THROW(read_language(directory.write("changed.toml", changed)), Error) << list;
  }
}

// Fewer trials of practice than a block has, and more: then its conditions come again in the same order.
TEST(order, of_a_long_practice_repeats_the_conditions) {
  const tests::TemporaryDirectory directory;
  const auto practice_of = [&](const std::string& trials) {
    const Protocol protocol = read_protocol(directory.write("p.toml", kMatching + "practice_trials = " + trials + '\n'));
    const std::vector<Block> blocks = order(protocol, 3);
    EXPECT_EQ(blocks.size(), 2U);
    EXPECT_EQ(blocks[0].number, 0);
    EXPECT_TRUE(blocks[0].is_practice);
    EXPECT_FALSE(blocks[1].is_practice);
    for (const Trial& trial : blocks[0].trials) EXPECT_EQ(trial.number, 0);
    return blocks[0].trials;
  };
  const std::vector<Trial> all = practice_of("14"), few = practice_of("2");
  ASSERT_EQ(all.size(), 14U);
  ASSERT_EQ(few.size(), 2U);
  std::set<std::pair<Mil, InitialRadius>> conditions;
  for (std::size_t i = 0; i < 6; ++i) conditions.insert({all[i].radius, all[i].initial});
  EXPECT_EQ(conditions.size(), 6U);
  for (std::size_t i = 0; i < 14; ++i) EXPECT_EQ(all[i], all[i % 6]);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(few[i], all[i]);
}

}  // namespace
}  // namespace forceshade::experiments
