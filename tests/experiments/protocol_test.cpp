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

// Every key has a value of its own, so that none can stand for another.
TEST(protocol, has_the_value_of_each_key) {
  const tests::TemporaryDirectory directory;
  directory.write("a.toml", "");
  directory.write("b.off", "");
  const std::filesystem::path file = directory.write("p.toml", R"(experiment = "matching"
name = "the name"
language = "texts.toml"
width_mil = 1010
stiffness_N_per_mm = 0.75
spacing_mil = 1512
practice_trials = 3
trials_before_break = 17
resume = "block"
block_order = "random"
reference = { law = "bump-2p", name = "two" }
stimuli = [
  { law = "bump-1p-shaded", name = "flat" },
  { name = "maps", variants = [
    { radius_mil = 700, height-map = "a.toml" },
    { radius_mil = 901, height-map = "a.toml" },
    { radius_mil = 1300, height-map = "a.toml" },
    { radius_mil = 1501, height-map = "a.toml" },
  ] },
]
vision = [false, true]
reference_radii_mil = [901, 700]
large_initial_radius_mil = 1501
small_initial_radius_mil = 700
repetitions = 5
radius_step_mil = 31
least_radius_mil = 560
largest_radius_mil = 1999
bigger = "larger-radius"
)");
  const Protocol protocol = read_protocol(file);
  const std::filesystem::path folder = file.parent_path();
  EXPECT_EQ(protocol.file, file);
  EXPECT_EQ(protocol.name, "the name");
  EXPECT_EQ(protocol.language, folder / "texts.toml");
  EXPECT_EQ(protocol.width, 1010);
  EXPECT_EQ(protocol.stiffness, 0.75F);
  EXPECT_EQ(protocol.spacing, 1512);
  EXPECT_EQ(protocol.practice_trials, 3);
  EXPECT_EQ(protocol.trials_before_break, 17);
  EXPECT_EQ(protocol.resume, Resume::block);
  EXPECT_EQ(protocol.block_order, BlockOrder::random);
  EXPECT_EQ(protocol.reference.name, "two");
  EXPECT_EQ(protocol.reference.law, LawId::bump_2p);
  ASSERT_EQ(protocol.stimuli.size(), 2U);
  EXPECT_EQ(protocol.stimuli[0].name, "flat");
  EXPECT_EQ(protocol.stimuli[0].kind, StimulusKind::law);
  EXPECT_EQ(protocol.stimuli[0].law, LawId::bump_1p_shaded);
  EXPECT_EQ(protocol.stimuli[1].name, "maps");
  EXPECT_EQ(protocol.stimuli[1].kind, StimulusKind::height_map);
  std::vector<Mil> radii;
  for (const Variant& variant : protocol.stimuli[1].variants) {
    radii.push_back(variant.radius);
    EXPECT_EQ(variant.file, folder / "a.toml");
    EXPECT_EQ(variant.unit, "");
  }
  EXPECT_EQ(radii, (std::vector<Mil>{700, 901, 1300, 1501}));
  EXPECT_EQ(protocol.vision, (std::vector<bool>{false, true}));
  EXPECT_EQ(protocol.reference_radii, (std::vector<Mil>{901, 700}));
  EXPECT_EQ(protocol.large_initial_radius, 1501);
  EXPECT_EQ(protocol.small_initial_radius, 700);
  EXPECT_EQ(protocol.repetitions, 5);
  EXPECT_EQ(protocol.radius_step, 31);
  EXPECT_EQ(protocol.least_radius, 560);
  EXPECT_EQ(protocol.largest_radius, 1999);
  EXPECT_EQ(protocol.bigger, Bigger::larger_radius);
  EXPECT_EQ(protocol.trials(), 2 * 2 * 2 * 3 * 5);
  const Parameters parameters = protocol.parameters(2000);
  EXPECT_FLOAT_EQ(parameters.radius, 50.8F);
  EXPECT_FLOAT_EQ(parameters.width, 25.654F);
  EXPECT_EQ(parameters.stiffness, 0.75F);
  EXPECT_EQ(&protocol.stimulus("maps"), &protocol.stimuli[1]);
  EXPECT_EQ(&protocol.stimulus("two"), &protocol.reference);
  EXPECT_EQ(protocol.stepped(protocol.stimuli[0], 1000, 1), 1031);
  EXPECT_EQ(protocol.stepped(protocol.stimuli[0], 1000, -1), 969);
  EXPECT_EQ(protocol.stepped(protocol.stimuli[0], 1990, 1), 1999);
  EXPECT_EQ(protocol.stepped(protocol.stimuli[0], 570, -1), 560);
  EXPECT_EQ(protocol.stepped(protocol.stimuli[1], 901, 1), 1300);
  EXPECT_EQ(protocol.stepped(protocol.stimuli[1], 901, -1), 700);
  // Other words for the keys that have two, and nothing for those that may be left out.
  const Protocol other = read_protocol(directory.write("q.toml", kMatching));
  EXPECT_EQ(other.resume, Resume::trial);
  EXPECT_EQ(other.block_order, BlockOrder::as_listed);
  EXPECT_EQ(other.bigger, Bigger::higher);
  EXPECT_EQ(other.practice_trials, 0);
  EXPECT_EQ(other.trials_before_break, 0);
  EXPECT_EQ(other.stimuli[0].name, "bump-1p-shaded");
}

// The names of stimuli of each kind follow from their files, and files are sought in a folder that is given instead.
TEST(protocol, of_a_classification_has_stimuli_of_each_kind) {
  const tests::TemporaryDirectory directory;
  const std::string text = R"(experiment = "classification"
name = "c"
language = "e"
width_mil = 1000
stiffness_N_per_mm = 1
resume = "block"
repetitions = 3
radii_mil = [800, 600]
stimuli = [
  { height-map = "hill.toml" },
  { mesh = "ball.off", unit = "in" },
  { subject = "thing.toml" },
  { law = "bump-2p" },
]
)";
  const std::string file = directory.write("c.toml", text);
  EXPECT_THROW(read_protocol(file), Error) << "the files are not there";
  const Protocol protocol = read_protocol(file, "/elsewhere", Files::may_be_missing);
  EXPECT_EQ(protocol.language, "/elsewhere/e");
  ASSERT_EQ(protocol.stimuli.size(), 4U);
  const std::array<StimulusKind, 4> kinds{StimulusKind::height_map, StimulusKind::mesh, StimulusKind::subject,
                                          StimulusKind::law};
  const std::array<const char*, 4> names{"hill", "ball", "thing", "bump-2p"};
  const std::array<const char*, 3> files{"/elsewhere/hill.toml", "/elsewhere/ball.off", "/elsewhere/thing.toml"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(protocol.stimuli[i].kind, kinds[i]) << names[i];
    EXPECT_EQ(protocol.stimuli[i].name, names[i]);
    ASSERT_EQ(protocol.stimuli[i].variants.size(), i < 3 ? 1U : 0U);
    if (i == 3) continue;
    EXPECT_EQ(protocol.stimuli[i].variants[0].file, files[i]);
    EXPECT_EQ(protocol.stimuli[i].variants[0].unit, i == 1 ? "in" : "");
    EXPECT_EQ(protocol.radii_of(protocol.stimuli[i]), std::vector<Mil>{0});
  }
  EXPECT_EQ(protocol.radii_of(protocol.stimuli[3]), (std::vector<Mil>{800, 600}));
  EXPECT_EQ(protocol.trials(), 5 * 3);
  EXPECT_EQ(protocol.bumps(),
            (std::vector<Bump>{{"hill", 0, 0}, {"ball", 0, 0}, {"thing", 0, 0}, {"bump-2p", 600, 0}, {"bump-2p", 800, 0}}));
}

// Each key takes the ends of its range and nothing beyond.
TEST(protocol, takes_numbers_up_to_the_ends_of_their_ranges) {
  struct Range {
    std::string key, line, least, below, largest, above, words;
  };
  const std::vector<Range> ranges{
      {"stiffness_N_per_mm", "stiffness_N_per_mm = 0.5", "0.001", "0.00099", "1000", "1000.01", "a number, 0.001 to 1000"},
      {"repetitions", "repetitions = 1", "1", "0", "1000", "1001", "a whole number, 1 to 1000"},
      {"practice_trials", "bigger = ", "0", "-1", "1000", "1001", "a whole number, 0 to 1000"},
      {"trials_before_break", "bigger = ", "0", "-1", "100000", "100001", "a whole number, 0 to 100000"},
      {"spacing_mil", "spacing_mil = 1500", "1000", "998", "787400", "787402", "a whole number, 1000 to 787400"},
      {"radius_step_mil", "radius_step_mil = 300", "1", "0", "393700", "393701", "a whole number, 1 to 393700"},
      {"large_initial_radius_mil", "large_initial_radius_mil = 1400", "600", "599", "2000", "2001", "a whole number, "},
      {"small_initial_radius_mil", "small_initial_radius_mil = 600", "520", "519", "1400", "1401", "a whole number, "},
      {"least_radius_mil", "least_radius_mil = 520", "500", "499", "600", "601", ""},
      {"largest_radius_mil", "largest_radius_mil = 2000", "1400", "1399", "393700", "393701", "a whole number, 1400 to 393700"},
  };
  for (const auto& [key, line, least, below, largest, above, words] : ranges) {
    const auto said = [&](const std::string& value) {
      return words_with(line, key + " = " + value + (line.starts_with(key) ? "" : "\n" + line));
    };
    EXPECT_EQ(said(least), "") << key;
    if (key != "largest_radius_mil") {
      EXPECT_EQ(said(largest), "") << key;
    }
    EXPECT_NE(said(below).find(words), std::string::npos) << key << ": " << said(below);
    EXPECT_NE(said(below), "") << key;
    EXPECT_NE(said(above).find(words), std::string::npos) << key << ": " << said(above);
    EXPECT_NE(said(above), "") << key;
  }
  EXPECT_EQ(words_with("width_mil = 1000", "width_mil = 0"), "4: width_mil: expected a whole number, 1 to 787400, got 0");
  EXPECT_EQ(words_with("[600, 1400]", "[3, 1400]"),
            "12: reference_radii_mil: expected a list of different whole numbers, each 4 to 393700, got 3");
  EXPECT_EQ(words_with("[600, 1400]", "[600, 519]"),
            "12: reference_radii_mil: expected radii from least_radius_mil to largest_radius_mil, got 519");
}

TEST(protocol, says_what_is_wrong_with_stimuli) {
  const std::string law = "{ law = \"bump-1p-shaded\" }";
  EXPECT_EQ(words_with(law, law + ", " + law), "10: name: \"bump-1p-shaded\" is the name of an earlier stimulus, too");
  EXPECT_EQ(words_with(law, law + ", { law = \"bump-2p\" }, { law = \"bump-3p\", name = \"bump-1p-shaded\" }"),
            "10: name: \"bump-1p-shaded\" is the name of an earlier stimulus, too");
  EXPECT_EQ(words_with(law, "{ name = \"a\" }"), "10: law: is missing: expected law, height-map, mesh, subject or variants");
  EXPECT_EQ(words_with(law, "{ law = \"bump-2p\", name = \"bump-cylinder\" }"),
            "9: reference: has the name of another stimulus, bump-cylinder");
  EXPECT_EQ(words_with(law, "{ law = \"bump-cylinder\" }"), "") << "the same bump as the reference";
  EXPECT_EQ(words_with(law, "{ law = \"bump-1p-shaded\", mesh = \"a.off\" }"), "10: unknown key mesh");
  EXPECT_EQ(words_with("radius_step_mil = 300\nleast_radius_mil = 520\nlargest_radius_mil = 2000",
                       "radius_step_mil = 1\nleast_radius_mil = 520\nlargest_radius_mil = 10521"),
            "16: radius_step_mil: expected at most 10000 steps between the limits, got more");
  EXPECT_EQ(words_with("radius_step_mil = 300\nleast_radius_mil = 520\nlargest_radius_mil = 2000",
                       "radius_step_mil = 1\nleast_radius_mil = 520\nlargest_radius_mil = 10520"),
            "");
  EXPECT_EQ(words_with("repetitions = 1\n", "repetitions = 1000\n"), "");
  std::string many =
      "[600, 700, 800, 900, 1000, 1100, 1200, 1300, 1400, 610, 620, 630, 640, 650, 660, 670, 680, 690, 710, 720, "
      "730, 740, 750, 760, 770, 780, 790, 810, 820, 830, 840, 850, 860, 870]";
  EXPECT_EQ(words_with("[600, 1400]\nlarge_initial_radius_mil = 1400\nsmall_initial_radius_mil = 600\nrepetitions = 1\n",
                       many + "\nlarge_initial_radius_mil = 1400\nsmall_initial_radius_mil = 600\nrepetitions = 1000\n"),
            "15: repetitions: expected at most 100000 trials, got 102000");
  const tests::TemporaryDirectory directory;
  directory.write("a.toml", "");
  directory.write("b.off", "");
  const auto said = [&](const std::string& stimulus) {
    std::string text = kMatching;
    text.replace(text.find(law), law.size(), stimulus);
    const std::string file = directory.write("p.toml", text);
    try {
      read_protocol(file);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what()).substr(file.size() + 1);
    }
  };
  const std::string map = "height-map = \"a.toml\"", mesh = "mesh = \"b.off\", unit = ";
  EXPECT_EQ(said("{ name = \"d\", variants = [{ radius_mil = 600, " + map + " }, { radius_mil = 600, " + map + " }] }"),
            "10: radius_mil: expected more than the 600 of the variant before it");
  EXPECT_EQ(said("{ variants = [{ radius_mil = 600, " + map + " }] }"), "10: name: is missing: variants need one");
  EXPECT_EQ(said("{ name = \"d\", variants = [{ radius_mil = 600, " + map + " }, { radius_mil = 700, " + mesh + "\"m\" }] }"),
            "10: variants: expected height maps, meshes or subjects, got more than one of these");
  EXPECT_EQ(said("{ name = \"d\", variants = [{ radius_mil = 600, " + map + " }] }"),
            "10: stimuli: stimulus d has no variant of 1400 mil");
  EXPECT_EQ(said("{ name = \"d\", variants = [{ radius_mil = 600, " + mesh + "\"ft\" }] }"),
            "10: unit: expected mm, m or in, got \"ft\"");
  for (const char* unit : {"mm", "m", "in"})
    EXPECT_EQ(said("{ name = \"d\", variants = [{ radius_mil = 600, " + mesh + '"' + unit + "\" }, { radius_mil = 1400, " +
                   mesh + '"' + unit + "\" }] }"),
              "");
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
  // What may stand in braces: numbers of blocks in the texts of blocks, of trials in that of a break, keys everywhere.
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
