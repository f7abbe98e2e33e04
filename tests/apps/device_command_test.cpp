// SPDX-License-Identifier: BSD-3-Clause
// forceshade device, and what drive says of its device, as users call them.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "device/kinds.h"
#include "forceshade/recording.h"
#include "tests/support/command_run.h"
#include "tests/support/pseudo_terminal.h"
#include "tests/support/wait_until.h"

namespace forceshade::tests {
namespace {

using nlohmann::json;

constexpr const char* kPrompt = "Press Enter when this is done, or Ctrl-C to end here. ";

void expect_holds(const std::string& text, const std::vector<std::string>& all_words) {
  for (const std::string& words : all_words) EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
}

void set_driver_folder(const TemporaryDirectory& here) {
  ::setenv("GTDD_HOME", here.path().c_str(), 1);
}

// The command on a terminal of its own, in the directory.
PseudoTerminal on_terminal(const TemporaryDirectory& here, const std::string& line) {
  return PseudoTerminal([&] {
    std::vector<std::string> words = words_of(line);
    words.insert(words.begin(), FORCESHADE_COMMAND);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (::chdir(here.path().c_str()) == 0) ::execv(argv[0], argv.data());
    return 127;
  });
}

TEST(device_list, names_the_devices_that_are_set_up_and_the_folder_that_was_read) {
  const TemporaryDirectory here;
  set_driver_folder(here);
  const CommandRun none = run_command(here, words_of("device"));
  EXPECT_EQ(none.code, 0);
  expect_holds(none.out,
               {"replay:FILE.csv", "simulated[:MODEL", "phantom[:NAME]",
                "through the vendor's driver (never tried on hardware)\n", "haply[:ID]", "premium-1.5 premium-1.0 omni",
                "No device is set up for the vendor's driver: " + here.file("config") + ": No such file or directory"});
  std::filesystem::create_directory(here.file("config"));
  expect_holds(run_command(here, words_of("device")).out, {here.file("config") + " is empty"});
  here.write("config/Left arm.config", "");
  here.write("config/\x1b[2J.config", "");
  const CommandRun two = run_command(here, words_of("device --json -"));
  const json listed = json::parse(two.out);
  EXPECT_EQ(listed["folder"], here.file("config"));
  EXPECT_EQ(listed["problem"], "");
  EXPECT_EQ(listed["names"], (json{"\x1b[2J", "Left arm"}));
  EXPECT_EQ(listed["models"].size(), 3U);
  EXPECT_EQ(listed["kinds"].size(), device::kinds().size());
  expect_holds(run_command(here, words_of("device")).out, {"  \"phantom:Left arm\"\n", "phantom:\\x1b[2J"});
}

TEST(device_check, finds_nothing_wrong_with_a_simulated_device) {
  const TemporaryDirectory here;
  const CommandRun run = run_command(here, words_of("device check simulated:omni --seconds 0.2 --json check.json"));
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  expect_holds(run.out,
               {"device             ok                model omni", "update rate        ok                1000.0 readings",
                "kinematics         ok", "buttons            cannot be checked the device has none", "\nwaking ", "\nkernel ",
                "\nscheduling ", "\nmemory ", "\ngovernor ", "held: 0 of 12 checks wrong"});
  const json check = json::parse(here.read("check.json"));
  EXPECT_EQ(check["held"], true);
  EXPECT_EQ(check["checks"].size(), 12U);
  EXPECT_NEAR(check["rate_hz"].get<double>(), 1000, 1e-6);
}

TEST(device_check, prints_nothing_but_json_where_that_goes_to_standard_output) {
  const TemporaryDirectory here;
  const CommandRun run = run_command(here, words_of("device check null --seconds 0.2 --json -"));
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(json::parse(run.out)["device"], "null");
  expect_holds(run.err, {"without any force"});
}

TEST(device_check, says_all_that_is_wrong_with_a_driver_that_is_not_there) {
  const TemporaryDirectory here;
  set_driver_folder(here);
  ::setenv("FORCESHADE_HD_LIBRARY", "/nowhere/libHD.so", 1);
  const CommandRun run = run_command(here, words_of("device check --json check.json"));
  ::unsetenv("FORCESHADE_HD_LIBRARY");
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  expect_holds(run.out,
               {here.file("config"), "device nodes", "opening            wrong             the PHANToM's driver library",
                "/nowhere/libHD.so: ", "FAILED: 1 of 3 checks wrong"});
  EXPECT_EQ(json::parse(here.read("check.json"))["held"], false);
}

TEST(device_check, looks_through_the_drivers_library) {
  const TemporaryDirectory here;
  set_driver_folder(here);
  std::filesystem::create_directory(here.file("config"));
  here.write("config/Left arm.config", "");
  ::setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  const CommandRun run = run_command(here, {"device", "check", "phantom:Right arm", "--seconds", "0.2", "--in-reset-pose"});
  ::unsetenv("FORCESHADE_HD_LIBRARY");
  // Its frames hang on the machine, so only the name is sure to be wrong.
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  expect_holds(run.out,
               {"device names       wrong             " + here.file("config") + " holds Left arm, and not \"Right arm\"",
                "device             ok                model "});
}

TEST(device_try, leads_through_a_first_contact_and_keeps_its_recording) {
  const TemporaryDirectory here;
  ASSERT_EQ(run_command(here, words_of("certify --law wall --stiffness 0.05 --out cert")).code, 0);
  const std::string tried =
      "device try simulated --certificate cert/certificate.json --dead-man none --seconds 2 --json try.json";
  EXPECT_EQ(run_command(here, words_of(tried + " --stiffness 0.1")).code, 1) << "not covered";
  PseudoTerminal terminal = on_terminal(here, tried);
  expect_holds(terminal.shown_until(kPrompt), {"step 1 of 2", "0.05 N/mm, never more than 0.5 N", "emergency switch"});
  EXPECT_EQ(here.read("try.json"), "");
  terminal.type("\n");
  expect_holds(terminal.shown_until("rise again.\r\n" + std::string(kPrompt)), {"step 2 of 2", "let go of the stylus"});
  terminal.type("\n");
  EXPECT_EQ(terminal.end(), 0) << terminal.shown();
  expect_holds(terminal.shown(), {"2000 (time up)", "felt              a wall in ", "of 0.5 N"});
  const json run = json::parse(here.read("try.json"));
  EXPECT_EQ(run["law"], "wall");
  EXPECT_EQ(run["device"]["model"], "premium-1.5");
  EXPECT_NE(run["certificate_digest"], nullptr);
  const double peak = run["peak_force_N"];
  EXPECT_GT(peak, 0.05);
  EXPECT_LE(peak, 0.5);
  // Dated, and whole.
  std::vector<std::string> recordings;
  for (const auto& entry : std::filesystem::directory_iterator(here.path()))
    if (entry.path().extension() == ".fsr") recordings.push_back(entry.path().string());
  ASSERT_EQ(recordings.size(), 1U);
  EXPECT_NE(recordings[0].find("forceshade-try-20"), std::string::npos);
  recorder::Recording recording(recordings[0]);
  EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>{});
  EXPECT_EQ(recording.metadata().at("device_model"), "premium-1.5");
  EXPECT_FALSE(recording.metadata().contains("device_serial"));
}

// A hand that means to be 30 mm below the plane: the law gives more than 2 N, and the peak is 0.5 N.
TEST(device_try, never_pushes_with_more_than_half_a_newton) {
  const TemporaryDirectory here;
  here.write("deep.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,4\n1,0,0,4\n2,0,0,-30\n4,0,0,-30\n");
  PseudoTerminal terminal = on_terminal(here,
                                        "device try simulated:premium-1.5:deep.csv --certificate none --dead-man none "
                                        "--stiffness 0.2 --out deep.fsr");
  terminal.shown_until(kPrompt);
  terminal.type("\n");
  terminal.shown_until("rise again.\r\n" + std::string(kPrompt));
  terminal.type("\n");
  EXPECT_EQ(terminal.end(), 0) << terminal.shown();
  expect_holds(terminal.shown(), {"limited by peak force", "end of data"});
  recorder::Recording recording(here.file("deep.fsr"));
  float most = 0, desired = 0;
  recording.for_each_chunk([&](std::span<const device::Sample> samples) {
    for (const device::Sample& sample : samples) {
      most = std::max(most, std::hypot(sample.force[0], sample.force[1], sample.force[2]));
      desired = std::max(desired, std::hypot(sample.law_force[0], sample.law_force[1], sample.law_force[2]));
    }
  });
  EXPECT_GT(desired, 2.0F);
  EXPECT_LE(most, 0.5F);
  EXPECT_GT(most, 0.49F);
}

TEST(device_try, ends_without_a_run_where_a_step_is_not_done) {
  const TemporaryDirectory here;
  PseudoTerminal terminal = on_terminal(here, "device try simulated --certificate none --dead-man none");
  terminal.shown_until(kPrompt);
  terminal.type("\x03");
  EXPECT_EQ(terminal.end(), 130) << terminal.shown();
  expect_holds(terminal.shown(), {"interrupted: the run had not begun"});
  EXPECT_EQ(here.entries(), 0);
}

TEST(device_try, needs_a_button_to_hold_down) {
  const TemporaryDirectory here;
  PseudoTerminal terminal = on_terminal(here, "device try simulated --certificate none");
  terminal.shown_until(kPrompt);
  terminal.type("\n");
  EXPECT_EQ(terminal.end(), 2) << terminal.shown();
  expect_holds(terminal.shown(), {"--dead-man: expected none, because the device has no buttons, got \"0\""});
  ::setenv("FORCESHADE_HD_LIBRARY", STAND_IN_HD, 1);
  PseudoTerminal with_buttons = on_terminal(here, "device try phantom --certificate none --dead-man none --in-reset-pose");
  ::unsetenv("FORCESHADE_HD_LIBRARY");
  with_buttons.shown_until(kPrompt);
  with_buttons.type("\n");
  EXPECT_EQ(with_buttons.end(), 2) << with_buttons.shown();
  expect_holds(with_buttons.shown(), {"--dead-man: expected a button from 0 to "});
  EXPECT_EQ(here.entries(), 0);
}

TEST(device_try, refuses_what_is_not_gentle_or_not_certified) {
  const TemporaryDirectory here;
  const auto refused = [&](const char* line, int code, const std::vector<std::string>& words) {
    const CommandRun run = run_command(here, words_of(line));
    EXPECT_EQ(run.code, code) << line << run.err;
    EXPECT_EQ(run.out, "") << line;
    expect_holds(run.err, words);
  };
  refused("device try simulated --stiffness 0.201", 2, {"expected at most 0.2 N/mm for a first contact, got 0.201"});
  refused("device try simulated --stiffness 0", 2, {"--stiffness"});
  refused("device try simulated", 1, {"no certificate was given", "certify --law wall --stiffness 0.05 --out DIR"});
  refused("device try simulated --certificate none --out run.csv", 2,
          {"--out: expected a name that ends in .fsr", "\"run.csv\""});
  refused("device try simulated --dead-man 16", 2, {"--dead-man", "\"16\""});
  refused("device try", 2, {"expected device, got none"});
  EXPECT_EQ(here.entries(), 2);  // .out and .err
}

// From a hand above the wall that lowers the tip onto it after half a second, and stays until somebody ends the run.
std::string rehearsal(const TemporaryDirectory& here) {
  here.write("press.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,3\n0.5,0,0,3\n1,0,0,-6\n3600,0,0,-6\n");
  return "drive --law wall --certificate none --device simulated:premium-1.5:press.csv --dead-man 1 --out "
         "run.fsr";
}

constexpr const char* kKeys = "the key 1 does so with button 1";

bool has_force(const device::Sample& sample) {
  return sample.force != std::array<float, 3>{0, 0, 0};
}

bool is_down(const device::Sample& sample) {
  return (sample.buttons & 2U) != 0;
}

// Also while it is being made.
std::vector<device::Sample> recorded(const TemporaryDirectory& here) {
  std::vector<device::Sample> all;
  recorder::Recording(here.file("run.fsr")).for_each_chunk([&](std::span<const device::Sample> chunk) {
    all.insert(all.end(), chunk.begin(), chunk.end());
  });
  return all;
}

TEST(drive, rehearses_a_dead_man_switch_by_keys_on_a_simulated_device) {
  const TemporaryDirectory here;
  PseudoTerminal terminal = on_terminal(here, rehearsal(here));
  terminal.shown_until(kKeys);
  terminal.type("x01");  // x is no button, and 0 is another one
  wait_until([&] { return std::ranges::any_of(recorded(here), has_force); });
  terminal.type("\x03");
  EXPECT_EQ(terminal.end(), 0) << terminal.shown();
  for (const device::Sample& sample : recorded(here)) EXPECT_TRUE(is_down(sample) || !has_force(sample)) << sample.tick;
}

TEST(drive, gives_no_force_after_the_key_of_the_dead_man_switch_was_typed_again) {
  const TemporaryDirectory here;
  PseudoTerminal terminal = on_terminal(here, rehearsal(here));
  terminal.shown_until(kKeys);
  terminal.shown_until("dead-man switch");  // in contact, and the button is up
  terminal.type("1");
  wait_until([&] { return is_down(recorded(here).back()); });
  terminal.type("1");
  wait_until([&] { return !is_down(recorded(here).back()); });
  terminal.type("\x03");
  EXPECT_EQ(terminal.end(), 0) << terminal.shown();
  for (const device::Sample& sample : recorded(here)) EXPECT_TRUE(is_down(sample) || !has_force(sample)) << sample.tick;
}

TEST(drive, says_in_summary_and_recording_where_the_law_lies) {
  const TemporaryDirectory here;
  const std::string line =
      "drive --law wall --certificate none --pace none --overwrite --device simulated --seconds 0.1 --out run.fsr --json "
      "run.json";
  const CommandRun placed = run_command(here, words_of(line + " --place=-5,1in,0.1,x90,z-90deg"));
  EXPECT_EQ(placed.code, 0) << placed.err;
  expect_holds(placed.out, {"placement         origin at -5,25.4,0.1 mm, x, y, z along -y,+z,-x of the device\n"});
  const json summary = json::parse(here.read("run.json"));
  EXPECT_EQ(summary["placement"]["origin_mm"], (json{-5.0, static_cast<double>(25.4F), static_cast<double>(0.1F)}));
  EXPECT_EQ(summary["placement"]["axes"], "-y,+z,-x");
  const recorder::Recording recording(here.file("run.fsr"));
  EXPECT_EQ(recording.metadata().at("origin_mm"), "-5,25.4,0.1");
  EXPECT_EQ(recording.metadata().at("axes"), "-y,+z,-x");
  const CommandRun usual = run_command(here, words_of(line));
  EXPECT_EQ(usual.code, 0) << usual.err;
  EXPECT_EQ(usual.out.find("placement"), std::string::npos);
  EXPECT_EQ(json::parse(here.read("run.json"))["placement"], (json{{"origin_mm", {0.0, 0.0, 0.0}}, {"axes", "+x,+y,+z"}}));
  EXPECT_EQ(recorder::Recording(here.file("run.fsr")).metadata().at("axes"), "+x,+y,+z");
  const CommandRun refused = run_command(here, words_of("drive --law wall --certificate none --device null --place z45"));
  EXPECT_EQ(refused.code, 2);
  expect_holds(refused.err, {"--place: expected an axis and a multiple of 90 degrees, such as z90 or x-90,z180, got \"z45\""});
}

// Outside of a wall there is no force, whatever is said to be the reason.
TEST(recording_check, finds_another_status_beside_the_same_force) {
  for (const Status status : {Status::free, Status::contact, Status::invalid}) {
    const TemporaryDirectory here;
    recorder::Recorder recorder(here.file("run.fsr"), {{"law", "wall"}, {"stiffness_N_per_mm", "0.5"}});
    for (std::uint64_t tick = 0; tick < 3; ++tick)
      recorder.push(
          {.tick = tick, .position = {0, 0, 1}, .status = static_cast<std::uint8_t>(tick == 1 ? status : Status::free)});
    recorder.close("time up");
    const CommandRun check = run_command(here, words_of("recording check run.fsr --law wall"));
    EXPECT_EQ(check.code, status == Status::free ? 0 : 1) << check.err;
    expect_holds(check.out,
                 {"computed again: 3 ticks, 0 in contact, " + std::string(status == Status::free ? "0" : "1") + " differ"});
  }
}

// The tripping tick, which has no force, and the 200 ms before it.
TEST(drive, keeps_the_last_200_ms_before_a_trip) {
  const TemporaryDirectory here;
  // Free, then 6 mm deep, then torn 120 mm sideways within 10 ms.
  here.write("torn.csv", "t_s,x_mm,y_mm,z_mm\n0,0,0,3\n0.19,0,0,3\n0.3,0,0,-6\n1.5,0,0,-6\n1.51,120,0,-6\n2,120,0,-6\n");
  const std::string line =
      "drive --law wall --certificate none --pace none --device simulated:premium-1.5:torn.csv --out torn.fsr --json ";
  const CommandRun run = run_command(here, words_of(line + "torn.json"));
  EXPECT_EQ(run.code, 3) << run.err;
  expect_holds(run.out, {"last tick         ", " mm/s; force 0.000 N, one tick before ", "before the end    201 ticks kept"});
  const json summary = json::parse(here.read("torn.json"));
  const std::size_t trip = summary["supervisor"]["trip"]["tick"];
  const json& ticks = summary["last_ticks"];
  ASSERT_EQ(ticks.size(), 201U);
  for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i]["tick"], trip - 200 + i);
  EXPECT_EQ(ticks[200]["tripped"], "velocity");
  EXPECT_EQ(ticks[200]["force_N"], (json{0.0, 0.0, 0.0}));
  EXPECT_GT(ticks[200]["law_force_N"][2], 0.5);
  EXPECT_EQ(ticks[199]["tripped"], nullptr);
  EXPECT_GT(ticks[199]["force_N"][2], 0.5);
  EXPECT_EQ(ticks[0]["position_mm"].size(), 3U);
  EXPECT_EQ(ticks[200]["t_s"].is_number(), true);
  EXPECT_EQ(summary["device"], (json{{"name", "simulated:premium-1.5:torn.csv"}, {"model", "premium-1.5"}}));
  EXPECT_EQ(summary["signal"], nullptr);
}

}  // namespace
}  // namespace forceshade::tests
