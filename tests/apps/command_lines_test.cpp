// SPDX-License-Identifier: BSD-3-Clause
// Every option of every command with values that do not go with it: exit code 2, and words that help. refused.cases has rows of
// them.

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

// With \n in the place of a line feed, and \xHH in that of a byte.
std::string unescaped(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text.compare(i, 2, "\\n") == 0)
      bytes += '\n', ++i;
    else if (text.compare(i, 2, "\\x") == 0)
      bytes += static_cast<char>(std::stoi(text.substr(i + 2, 2), nullptr, 16)), i += 3;
    else
      bytes += text[i];
  return bytes;
}

// A row of refused.cases, in a folder with the files that rows name.
class Row : public testing::Test {
 public:
  explicit Row(std::string line) : line_(std::move(line)) {}

 private:
  void SetUp() override {
    const auto write = [&](const char* name, const char* text) { std::ofstream(here_.file(name)) << text; };
    std::filesystem::create_directory(here_.file("directory"));
    write("empty", "");
    write("hill.toml", "render = \"height-map\"\n[[part]]\nshape = \"gaussian\"\nx_mm = 2e4\nheight_mm = 3\nsigma_mm = 5\n");
    write("knots.toml", "render = \"height-map\"\n[[part]]\nshape = \"polygons\"\nnegated = false\nknots_mm = [[0, 0]]\n");
    write("waves.toml",
          "render = \"height-map\"\n[[part]]\nshape = \"grating\"\nheight_mm = 1\nwave_x_rad_per_mm = 1\n"
          "wave_y_rad_per_mm = 1e9\n");
    write("corner.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  }

  void TestBody() override {
    std::vector<std::string> parts;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 3) {
      end = line_.find(" | ", begin);
      parts.push_back(line_.substr(begin, end - begin));
    }
    while (parts.size() > 2 && parts[2].starts_with("< ")) {
      const std::size_t name_ends = parts[2].find(' ', 2);
      here_.write(parts[2].substr(2, name_ends - 2), unescaped(parts[2].substr(name_ends + 1)));
      parts.erase(parts.begin() + 2);
    }
    ASSERT_GE(parts.size(), 3U) << line_;
    const std::ptrdiff_t before = here_.entries();
    const CommandRun run = run_command(here_, words_of(parts[1]));
    EXPECT_EQ(std::to_string(run.code), parts[0]) << line_ << '\n' << run.err;
    EXPECT_EQ(run.out, "") << line_;
    EXPECT_TRUE(run.err.starts_with("forceshade: ") || run.err.starts_with("*** DRIVING")) << line_ << '\n' << run.err;
    for (std::size_t i = 2; i < parts.size(); ++i) {
      const bool is_answered = !parts[i].starts_with("! ");
      EXPECT_EQ(run.err.find(is_answered ? parts[i] : parts[i].substr(2)) != std::string::npos, is_answered) << line_ << '\n'
                                                                                                             << run.err;
    }
    expect_readable(run.err, line_);
    EXPECT_EQ(here_.entries(), before + 2) << line_;  // its output, its errors and no file of its own
  }

  std::string line_;
  const TemporaryDirectory here_;
};

// Named by what is typed.
const int rows = [] {
  std::ifstream table(FORCESHADE_SOURCE_DIR "/tests/apps/refused.cases");
  int count = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t typed = line.find(" | ") + 3;
    const std::string name =
        std::to_string(++count) + '_' +
        std::regex_replace(line.substr(typed, line.find(" | ", typed) - typed), std::regex("[^A-Za-z0-9]+"), "_");
    testing::RegisterTest("refused", name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [line]() -> testing::Test* { return new Row(line); });
  }
  return count;
}();

TEST(command_lines, has_rows_of_what_is_refused) {
  EXPECT_GT(rows, 230);
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
      {"laws", "--radius 1 --width 1"},
      {"force", "in.csv --law wall --stiffness 1"},
      {"energy", "--law wall --depth 1"},
      {"plot", "--law bump-1p --out in.csv/none"},
      {"properties", "--law wall --cases 1"},
      {"certify", "--law bump-1p --points 1 --cases 1 --out in.csv/none"},
      {"drive", "--law wall --certificate none --device null --seconds 0.001 --pace none"},
      {"device", ""},
      {"device check", "null --seconds 0.1"},
      {"device try", "null --stiffness 1"},
      {"recording check", "none.fsr"},
      {"recording export", "none.fsr"},
      {"mesh check", "none.off --unit mm"},
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
        const bool is_file = option == "--json" || option == "--junit" || option == "--out" || option == "--out";
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
                           "laws --radius 1 --width 1 --digits 9999",
                           "laws --json",
                           "laws --radius 15.24 --width 25.4 --theta-critical 40",
                           "laws --radius 1 --width 1 --theta-critical 9 --json -",
                           "force in.csv --law wall --stiffness 1",
                           "energy --law wall --depth 1",
                           "energy --law wall --depth 1 --json -",
                           "plot force --law wall --out pictures --overwrite",
                           "properties --law wall --cases 1",
                           "drive --law wall --certificate none --device null --seconds 0.001 --pace none --out run.fsr",
                           "drive --law wall --certificate none --device null --seconds 0.001 --pace none --out -",
                           "drive --law wall --certificate none --device null --seconds 0.001 --pace none --json -",
                           "recording check run.fsr",
                           "recording check run.fsr --json -",
                           "recording check run.fsr --law wall",
                           "mesh make cube --out -",
                           "recording export run.fsr"}) {
    const CommandRun full = run_command(here, words_of(line), "/dev/full");
    EXPECT_EQ(full.code, 2) << line;
    EXPECT_NE(full.err.find("standard output: cannot write: No space left on device"), std::string::npos) << line << full.err;
    if (std::string(line).find("run.fsr") != std::string::npos && std::string(line).starts_with("drive")) continue;
    EXPECT_EQ(run_command(here, words_of(line)).code, 0) << line;
  }
}

TEST(command_lines, a_command_that_fails_leaves_no_folder) {
  const TemporaryDirectory here;
  std::ofstream(here.file("map.toml")) << "render = \"height-map\"\n";
  here.write("bad.csv", "x_mm,y_mm,z_mm\n0,0,a\n");
  here.write("its.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n");
  for (const char* line : {"plot bad.csv --mesh its.obj --unit mm --out a/b/c", "certify --law wall --points x --out a/b/c",
                           "certify plan --exhaustive lines --law wall --out a/b/c",
                           "plot energy --law wall --radius x --out a/b/c", "certify --height-map map.toml --out a/b/c"}) {
    EXPECT_EQ(run_command(here, words_of(line)).code, 2) << line;
    EXPECT_FALSE(std::filesystem::exists(here.file("a"))) << line;
  }
  // One that was there, or in which something was written, stays.
  std::filesystem::create_directory(here.file("a"));
  EXPECT_EQ(run_command(here, words_of("certify --height-map map.toml --out a/b/c")).code, 2);
  EXPECT_TRUE(std::filesystem::exists(here.file("a")));
  EXPECT_FALSE(std::filesystem::exists(here.file("a/b")));
  EXPECT_EQ(run_command(here, words_of("plot force --law wall --out a/b/c")).code, 0);
  EXPECT_TRUE(std::filesystem::exists(here.file("a/b/c/wall-force.png")));
}

TEST(command_lines, laws_shows_the_figure_of_the_thesis_only_for_bumps_of_the_thesis) {
  const TemporaryDirectory here;
  const auto has_table = [&](const char* line) {
    const CommandRun run = run_command(here, words_of(line));
    EXPECT_EQ(run.code, 0) << line;
    return run.out.find("figure 5-5") != std::string::npos;
  };
  EXPECT_TRUE(has_table("laws --radius 600mil --width 1in --theta-critical 40"));
  EXPECT_FALSE(has_table("laws --radius 601mil --width 1in --theta-critical 40"));
  EXPECT_FALSE(has_table("laws --radius 600mil --width 1.1in --theta-critical 40"));
}

}  // namespace
}  // namespace forceshade::tests
