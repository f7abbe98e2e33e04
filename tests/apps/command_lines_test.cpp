// SPDX-License-Identifier: BSD-3-Clause
// Every option of every command with values that do not go with it: exit code 2, and words that help.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "apps/command_line.h"
#include "tests/support/command_run.h"

namespace forceshade::tests {
namespace {

// Fails where a message holds a library's notation, an unreadable number, or an error named "Success".
void expect_readable(std::string message, const std::string& line, const std::string& users_own = "") {
  message = std::regex_replace(message, std::regex("got \"[^\"]*\""), "");
  for (std::size_t at; !users_own.empty() && (at = message.find(users_own)) != std::string::npos;)
    message.erase(at, users_own.size());
  for (const char* unreadable : {"->", "[0-9]{21}", "Success", "std::", "basic_", "bad_alloc", "e\\+0[0-8]\\b", "FAILED",
                                 "Could not convert", "\\bINT\\b|\\bUINT\\b", "0\\.0000000"})
    EXPECT_FALSE(std::regex_search(message, std::regex(unreadable))) << line << "\nholds " << unreadable << ": " << message;
}

struct Refused {
  const char* line;
  std::vector<const char*> words;
  std::vector<const char*> not_words = {};
};

void expect_refused(const TemporaryDirectory& here, const Refused& refused) {
  const CommandRun run = run_command(here, words_of(refused.line));
  EXPECT_EQ(run.code, 2) << refused.line << '\n' << run.err;
  EXPECT_EQ(run.out, "") << refused.line;
  EXPECT_TRUE(run.err.starts_with("forceshade: ") || run.err.starts_with("*** DRIVING")) << refused.line << '\n' << run.err;
  for (const char* words : refused.words)
    EXPECT_NE(run.err.find(words), std::string::npos) << refused.line << "\nexpected " << words << ": " << run.err;
  for (const char* words : refused.not_words)
    EXPECT_EQ(run.err.find(words), std::string::npos) << refused.line << "\nunexpected " << words << ": " << run.err;
  expect_readable(run.err, refused.line);
}

TEST(command_lines, a_refusal_says_what_was_expected_and_what_was_got) {
  const TemporaryDirectory here;
  std::filesystem::create_directory(here.file("directory"));
  std::ofstream(here.file("empty")).flush();
  std::ofstream(here.file("hill.toml"))
      << "render = \"height-map\"\n[[part]]\nshape = \"gaussian\"\nx_mm = 2e4\nheight_mm = 3\n"
         "sigma_mm = 5\n";
  std::ofstream(here.file("knots.toml")) << "render = \"height-map\"\n[[part]]\nshape = \"polygons\"\nnegated = false\n"
                                            "knots_mm = [[0, 0]]\n";
  std::ofstream(here.file("waves.toml")) << "render = \"height-map\"\n[[part]]\nshape = \"grating\"\nheight_mm = 1\n"
                                            "wave_x_rad_per_mm = 1\nwave_y_rad_per_mm = 1e9\n";
  std::ofstream(here.file("corner.off")) << "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::vector<Refused> all{
      {"properties --seed 18446744073709551616", {"--seed: expected a whole number from 0 to", "got \"18446744073709551616\""}},
      {"properties --seed=-1", {"--seed", "got \"-1\""}},
      {"properties --seed 1.5", {"--seed", "got \"1.5\""}},
      {"properties --cases 1e3", {"expected a whole number from 1 to 1000000000, got \"1e3\""}, {"not in range"}},
      {"properties --cases 1 --cases 1", {"--cases: expected once, got several times"}},
      {"properties --cases", {"--cases: expected a value after it"}},
      {"properties --cases ''", {"--cases: expected a value, got an empty one"}},
      {"certify --points 1e6 --out o", {"--points", "got \"1e6\""}, {"not in range"}},
      {"certify --threads 0 --out o", {"--threads", "got \"0\""}},
      {"geometry --radius 1 --width 1 --digits 0x10", {"--digits", "got \"0x10\""}},
      {"geometry --radius 100000 --width 1", {"radius is 100000 mm; expected 0.1 to 10000 mm"}},
      {"geometry --radius 1 --width nan", {"--width: expected a length such as", "got \"nan\""}},
      {"force --law wall --stiffness 1 --digits 5", {"--digits: expected --path reference"}},
      {"force --height-map hill.toml --stiffness 1 --digits 5", {"--digits", "expected without"}},
      {"force --law wall --stiffness 1 --path x", {"--path: expected one of fast, reference; got \"x\""}},
      {"force --height-map directory --stiffness 1", {"directory"}},
      {"force --height-map hill.toml --stiffness 1", {"hill.toml: line 4: centre x is 20000 mm"}},
      {"force --height-map knots.toml --stiffness 1", {"knots.toml: line 5: number of knots is 1"}},
      {"force --height-map waves.toml --stiffness 1", {"waves.toml: line 6: wave y is"}},
      {"polygons --height-map hill.toml --from 0 --to 1 --theta-critical 9", {"hill.toml: line 4: centre x is 20000 mm"}},
      {"polygons --height-map hill.toml --theta-critical 9", {"hill.toml: line 4: centre x is 20000 mm"}},
      {"polygons --radius 1 --width 1 --theta-critical nan",
       {"--theta-critical: expected an angle such as 30, 30deg or 0.5rad, got \"nan\""}},
      {"force --law wall --radius 5", {"--radius: has no effect on the law wall, which has no bump; expected none"}},
      {"properties --law wall --width 5", {"--width: has no effect on the law wall"}},
      {"drive --law wall --radius 5 --uncertified --device null", {"--radius: has no effect on the law wall"}},
      {"force --mesh corner.off --unit mm --shading none --crease 30",
       {"--crease: has no effect with the shading none and the contact direct; expected the shading vertex or texture:FILE, or "
        "the "
        "contact sub-goal, beside it"}},
      {"force --mesh corner.off --unit mm --shading edge --crease 30", {"--crease: has no effect with the shading edge"}},
      {"force --mesh corner.off --unit mm --shading none --friction 0.5 --crease 30",
       {"--crease: has no effect with the shading none and the contact friction"}},
      {"force --mesh corner.off --unit mm --texture-scale 1",
       {"--texture-scale: expected the shading texture:FILE beside it, got vertex"}},
      {"certify --exhaustive --mesh corner.off --unit mm --out o",
       {"--exhaustive: expected --law, got --mesh, which has"},
       {"height"}},
      {"certify --exhaustive --scene scene.toml --out o", {"--exhaustive: expected --law, got --scene, which has"}},
      {"conform --law wall --recording r.csv --points 10", {"--recording: expected without --points, got both"}},
      {"conform --law wall --recording r.csv --seed 10", {"--recording: expected without --seed, got both"}},
      {"conform --law wall --recording r.csv --timing", {"--recording: expected without --timing, got both"}},
      {"conform --law wall --recording r.csv --max-answer-time 1",
       {"--recording: expected without --max-answer-time, got both"}},
      {"conform --law wall --recording r.csv --answer-timeout 1", {"--recording: expected without --answer-timeout, got both"}},
      {"experiment check p.toml", {"\"experiment\" is no command any more; expected 'forceshade-study experiment'"}},
      {"analyze results", {"expected 'forceshade-study analyze', a program that is built in clients/study"}},
      {"conform compare none.json neither.json", {"none.json: cannot be read: No such file"}, {"neither"}},
      {"energy --law wall --depth 1 --radius nan", {"--radius: expected a length such as", "got \"nan\""}},
      {"energy --law wall --depth 1 --along y", {"--along: expected --height-map beside it"}},
      {"energy --height-map hill.toml --depth 1 --along z", {"--along: expected one of x, y; got \"z\""}},
      {"plot --law wall --from 1 --out o", {"--from: expected --height-map beside it"}},
      {"plot --law wall --at 1 --out o", {"--at: expected --height-map beside it"}},
      {"plot --law wall --what x --out o", {"--what: expected one of force, directions, geometry, energy, all; got \"x\""}},
      {"figures --out ''", {"--out: expected a value, got an empty one"}},
      {"drive --law wall --uncertified --device null --seconds 0", {"--seconds: expected a number from 0.0001 to 1000000000"}},
      {"drive --law wall --uncertified --device null --seconds inf", {"--seconds", "got \"inf\""}},
      {"drive --law wall --uncertified --device null --rate 1e6", {"--rate: expected a number from 100 to 10000, got \"1e6\""}},
      {"drive --law wall --uncertified --device null --cpu 1000", {"--cpu: expected one of the processors", "got 1000"}},
      {"drive --law wall --uncertified --device null --cpu=-1", {"--cpu", "got \"-1\""}},
      {"drive --law wall --uncertified --device null --free-run --cpu 0", {"--cpu", "expected without"}},
      {"drive --law wall --uncertified --device null --pace hand", {"--pace: expected one of device, clock; got \"hand\""}},
      {"drive --law wall --uncertified --device null --free-run --pace clock", {"--pace", "expected without"}},
      {"drive --law wall --uncertified --device null --dead-man 0", {"expected none, because the device has no buttons"}},
      {"drive --law wall --uncertified --device null --passivity 2", {"expected one of damping, tank, observer; got \"2\""}},
      {"drive --law wall --uncertified --device null --record - --json -", {"--record and --json: expected two files"}},
      {"drive --law wall --device null --certificate directory", {"directory: cannot be read: Is a directory"}},
      {"drive --law wall --device null --certificate none", {"none: cannot be read: No such file or directory"}},
      {"drive --law wall --device null --certificate empty", {"empty: cannot be read: it is empty; expected a certificate"}},
      {"drive --law wall --device null --free-run=x", {"--free-run: expected no value, got \"x\""}},
      {"laws extra", {"laws: expected no further word, got \"extra\""}},
      {"energy --stifness 1", {"energy: unknown option \"--stifness\"; the nearest is --stiffness"}},
      {"energy --law wall --depht=1", {"energy: unknown option \"--depht\"; the nearest is --depth"}},
      {"energy --nothing-like-it", {"energy: unknown option \"--nothing-like-it\""}, {"nearest"}},
      {"device chekc null", {"device: expected a command: list, check, try; got \"chekc\"; the nearest is check"}},
      {"record info run.fsr", {"unknown command \"record\"", "the nearest is recording"}},
      {"recording info", {"recording info: expected file, got none"}},
      {"polygons --theta-critical 181", {"expected an angle from 0.000001 to 180 degrees, got \"181\""}},
      {"polygons --theta-critical 4rad", {"expected an angle from 0.000001 to 180 degrees, got \"4rad\""}},
      {"lawss", {"unknown command \"lawss\"; expected one of: laws"}},
  };
  for (const Refused& refused : all) expect_refused(here, refused);
}

// The options of a command with the word in capitals that stands for the value in its help; flags are left out.
std::set<std::string> options_in_help(const std::string& help) {
  std::set<std::string> options;
  const std::regex line("\n  (--[a-z-]+) [A-Za-z[]");
  for (std::sregex_iterator at(help.begin(), help.end(), line), end; at != end; ++at) options.insert((*at)[1]);
  return options;
}

// The command as a function, in a process of its own: some thousands of them begin in a tenth of the time that the program
// takes to be loaded.
CommandRun run_function(const TemporaryDirectory& here, const std::vector<std::string>& words) {
  return run_in_child(here, "", [&] { return apps::run_command_line(words); });
}

// Each option with a wrong value. A command line that is fine but for that ends with exit code 2 and names the option
// or the value; a value that happens to be fine is run.
TEST(command_lines, every_option_of_every_command_refuses_what_it_cannot_read) {
  const TemporaryDirectory here;
  std::ofstream(here.file("in.csv")) << "x_mm,y_mm,z_mm\n0,0,-1\n";
  // The command ends soon with any value of an option.
  const std::map<std::string, std::string> commands{
      {"geometry", "--radius 1 --width 1"},
      {"polygons", "--radius 1 --width 1 --theta-critical 170"},
      {"force", "--law wall --stiffness 1 --input in.csv"},
      {"energy", "--law wall --depth 1"},
      {"plot", "--law bump-1p --out in.csv/none"},
      {"figures", "--out in.csv/none"},
      {"properties", "--law wall --cases 1"},
      {"certify", "--law bump-1p --points 1 --cases 1 --out in.csv/none"},
      {"drive", "--law wall --uncertified --device null --seconds 0.001 --free-run"},
      {"device list", ""},
      {"device check", "null --seconds 0.1"},
      {"device try", "null --stiffness 1"},
      {"recording info", "none.fsr"},
      {"recording export", "none.fsr"},
      {"mesh check", "none.off --unit mm"},
      {"mesh info", "none.off --unit mm"},
      {"mesh repair", "none.off --unit mm --out -"},
      {"mesh make", "cube --out -"},
  };
  const std::vector<std::string> values{"",    "x",   "nan", "-inf",     "1e999", "99999999999999999999999", "1e3", "-1",
                                        "0x1", "1,5", "1 2", "\xff\xfe", "%n%s"};
  int refused = 0;
  for (const auto& [command, line] : commands) {
    std::vector<std::string> help = words_of(command);
    help.emplace_back("--help");
    std::vector<std::string> fine = words_of(command);
    for (const std::string& word : words_of(line)) fine.push_back(word);
    const std::string err_of_fine = run_function(here, fine).err;  // of a file or folder that is missing
    const std::set<std::string> options = options_in_help(run_function(here, help).out);
    EXPECT_FALSE(options.empty()) << command;
    for (const std::string& option : options)
      for (const std::string& value : values) {
        const bool is_file = option == "--json" || option == "--junit" || option == "--record" || option == "--out";
        if (is_file && !value.empty()) continue;
        if (option == "--json") continue;  // its value may be left out, and an empty one counts as left out
        std::vector<std::string> words = words_of(command);
        const std::vector<std::string> others = words_of(line);
        for (std::size_t i = 0; i < others.size(); ++i)
          if (others[i] == option)
            ++i;
          else
            words.push_back(others[i]);
        words.push_back(option + '=' + value);
        if (value.empty()) words.back() = option, words.emplace_back("");
        const CommandRun run = run_function(here, words);
        const std::string what = command + ' ' + option + " \"" + value + "\"\n" + run.err;
        EXPECT_TRUE(run.code == 0 || run.code == 2) << what << run.code;
        EXPECT_TRUE(run.code == 2 || !value.empty()) << what;
        if (run.code != 2 || run.err == err_of_fine) continue;
        ++refused;
        expect_readable(run.err, what, value);
        EXPECT_EQ(run.out, "") << what;
        const std::string name = option.substr(2);
        const std::string shown = value == "\xff\xfe" ? "\\xff\\xfe" : value;
        EXPECT_TRUE(run.err.find(name) != std::string::npos || run.err.find(shown) != std::string::npos) << what;
      }
  }
  EXPECT_GT(refused, 400);
}

// Also where a file is missing, so that nothing is printed, help and version.
TEST(command_lines, no_command_is_fine_when_standard_output_is_not) {
  const TemporaryDirectory here;
  std::ofstream(here.file("in.csv")) << "x_mm,y_mm,z_mm\n0,0,-1\n";
  for (const char* line : {"--help",
                           "--version",
                           "certify --help",
                           "laws",
                           "geometry --radius 1 --width 1 --digits 9999",
                           "geometry --json",
                           "polygons --radius 15.24 --width 25.4 --theta-critical 40",
                           "polygons --radius 1 --width 1 --theta-critical 9 --json -",
                           "force --law wall --stiffness 1 --input in.csv",
                           "energy --law wall --depth 1",
                           "energy --law wall --depth 1 --json -",
                           "plot --law wall --what force --out pictures --overwrite",
                           "properties --law wall --cases 1",
                           "certify --exhaustive --law wall --sweeps heights --shards 1/2048 --out sweeps",
                           "drive --law wall --uncertified --device null --seconds 0.001 --free-run --record run.fsr",
                           "drive --law wall --uncertified --device null --seconds 0.001 --free-run --record -",
                           "drive --law wall --uncertified --device null --seconds 0.001 --free-run --json -",
                           "recording info run.fsr",
                           "recording info run.fsr --json -",
                           "recording verify run.fsr",
                           "mesh make cube --out -",
                           "recording export run.fsr"}) {
    const CommandRun full = run_command(here, words_of(line), "/dev/full");
    EXPECT_EQ(full.code, 2) << line;
    EXPECT_NE(full.err.find("standard output: cannot write: No space left on device"), std::string::npos) << line << full.err;
    std::filesystem::remove(here.file("sweeps/exhaustive-1-of-2048.json"));
    if (std::string(line).find("run.fsr") != std::string::npos && std::string(line).starts_with("drive")) continue;
    EXPECT_EQ(run_command(here, words_of(line)).code, 0) << line;
  }
}

TEST(command_lines, a_command_that_fails_leaves_no_folder) {
  const TemporaryDirectory here;
  std::ofstream(here.file("map.toml")) << "render = \"height-map\"\n";
  for (const char* line :
       {"certify --exhaustive --law wall --shards 3/2 --out a/b/c",
        "certify --exhaustive --law wall --sweeps lines --out a/b/c", "plot --law wall --what energy --radius x --out a/b/c",
        "certify --exhaustive --height-map map.toml --out a/b/c"}) {
    EXPECT_EQ(run_command(here, words_of(line)).code, 2) << line;
    EXPECT_FALSE(std::filesystem::exists(here.file("a"))) << line;
  }
  // One that was there, or in which something was written, stays.
  std::filesystem::create_directory(here.file("a"));
  EXPECT_EQ(run_command(here, words_of("certify --exhaustive --law wall --shards 3/2 --out a/b/c")).code, 2);
  EXPECT_TRUE(std::filesystem::exists(here.file("a")));
  EXPECT_FALSE(std::filesystem::exists(here.file("a/b")));
  EXPECT_EQ(run_command(here, words_of("plot --law wall --what force --out a/b/c")).code, 0);
  EXPECT_TRUE(std::filesystem::exists(here.file("a/b/c/wall-force.png")));
}

TEST(command_lines, polygons_shows_the_figure_of_the_thesis_only_for_bumps_of_the_thesis) {
  const TemporaryDirectory here;
  const auto has_table = [&](const char* line) {
    const CommandRun run = run_command(here, words_of(line));
    EXPECT_EQ(run.code, 0) << line;
    return run.out.find("figure 5-5") != std::string::npos;
  };
  EXPECT_TRUE(has_table("polygons --radius 600mil --width 1in --theta-critical 40"));
  EXPECT_FALSE(has_table("polygons --radius 601mil --width 1in --theta-critical 40"));
  EXPECT_FALSE(has_table("polygons --radius 600mil --width 1.1in --theta-critical 40"));
}

}  // namespace
}  // namespace forceshade::tests
