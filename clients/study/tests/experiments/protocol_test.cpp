// SPDX-License-Identifier: BSD-3-Clause
// Protocols from TOML files: the meaning of each key, and the words for a mistake.

#include "study/experiments/protocol.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "files/input_file.h"
#include "study/tests/experiments/example_protocols.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

// The words for kMatching with a part replaced, without the file's name.
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
            "10: unit: expected mm, cm, m or in, got \"ft\"");
  for (const char* unit : {"mm", "cm", "m", "in"})
    EXPECT_EQ(said("{ name = \"d\", variants = [{ radius_mil = 600, " + mesh + '"' + unit + "\" }, { radius_mil = 1400, " +
                   mesh + '"' + unit + "\" }] }"),
              "");
}

}  // namespace
}  // namespace forceshade::experiments
