// SPDX-License-Identifier: BSD-3-Clause
// The output of a third-party program, as bytes that come in any pieces and at any time: no process is made.

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/lines.h"

namespace forceshade::files {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr ProcessLimits kLimits{
    .answer = std::chrono::milliseconds(10), .longest_line = 40, .threads = 3, .grace = std::chrono::milliseconds(100)};

// A program that was asked for a line, and takes what it is sent.
Lines asked(std::int64_t now = 0) {
  Lines lines(kLimits, "program");
  lines.ask("x", now);
  lines.took(2);
  return lines;
}

constexpr const char* kWaits = "it is waited for";

// The line, or the reason why it is missing, or kWaits.
std::string result_of(Lines& lines, std::int64_t now = 0) {
  try {
    return lines.result(now).value_or(kWaits);
  } catch (const ProcessFailed& failure) {
    return failure.what();
  }
}

// A program's output and end, and the result at the latest when its time is up.
struct Said {
  std::string output, error;
  bool ends_output;
  std::optional<std::optional<int>> status;
  std::string result;
};

const std::vector<Said>& all_said() {
  static const std::vector<Said> all{
      {"an answer\n", "", false, {}, "an answer"},
      {"an answer\r\n", "", false, {}, "an answer"},
      {"\n", "", false, {}, ""},
      {"first\nsecond\n", "", false, {}, "first"},
      {"no end", "", false, {}, "the program did not answer within 0.01 s"},
      {"", "a word\n", false, {}, "the program did not answer within 0.01 s; it wrote last on standard error: \"a word\""},
      {std::string(41, '['), "", false, {}, "the program wrote a line of more than 40 bytes: "},
      {std::string(41, '[') + '\n', "", false, {}, "the program wrote a line of more than 40 bytes: "},
      {std::string(40, '[') + '\n', "", false, {}, std::string(40, '[')},
      {"", "", true, {}, "the program closed its output, and did not end without an answer"},
      {"half", "one\nno arm is connected\n\n", true, 1 << 8,
       "the program ended with exit code 1 without an answer; it wrote last on standard error: \"no arm is connected\""},
      {"", "", true, SIGABRT, "the program was killed by signal 6 (Aborted) without an answer"},
      {"", "", true, 0, "the program ended without an answer"},
      {"", "", true, 127 << 8, "the program could not be started: the shell knows no such command"},
      {"", "", true, kTooMany, "the program had more than 3 processes and threads, and ended without an answer"},
      {"", "", true, std::optional<int>(), "the program ended the process that watches it without an answer"},
      {"last\n", "", true, 0, "last"},
  };
  return all;
}

void end(Lines& lines, const Said& said) {
  lines.complained(said.error);
  if (said.ends_output) lines.ended_output();
  if (said.status) lines.ended(*said.status);
}

TEST(program_lines, are_the_same_however_their_bytes_are_split) {
  long tried = 0;
  for (const Said& said : all_said()) {
    SCOPED_TRACE(said.output + "/" + said.error);
    for (std::size_t first = 0; first <= said.output.size(); ++first)
      for (std::size_t second = first; second <= said.output.size(); ++second, ++tried) {
        Lines lines = asked();
        std::string result = kWaits;
        const std::string_view all = said.output;
        for (const std::string_view piece : {all.substr(0, first), all.substr(first, second - first), all.substr(second)}) {
          lines.said(piece);
          if (result == kWaits) result = result_of(lines);
        }
        end(lines, said);
        if (result == kWaits) result = result_of(lines, 10 * kMillisecond);
        if (!said.result.ends_with(": ")) {
          ASSERT_EQ(result, said.result) << first << ' ' << second;
        } else {
          ASSERT_TRUE(result.starts_with(said.result)) << result;
        }
      }
  }
  std::printf("%ld splits\n", tried);
}

TEST(program_lines, wait_for_no_answer_once_they_are_to_stop_but_give_one_that_is_there) {
  std::atomic<bool> stop = false;
  ProcessLimits limits = kLimits;
  limits.stop = &stop;
  Lines lines(limits, "program");
  lines.ask("x", 0);
  lines.took(2);
  EXPECT_EQ(result_of(lines), kWaits);
  stop = true;
  EXPECT_EQ(result_of(lines), "the program was not waited for any longer");
  lines.said("late, but there\n");
  EXPECT_EQ(result_of(lines), "late, but there");
}

TEST(program_lines, show_the_last_words_of_a_program_to_the_reason_behind_a_long_path) {
  const std::string reason = "cannot open " + std::string(200, 'p') + ": no such file";
  Lines lines = asked();
  lines.complained(reason + '\n');
  EXPECT_EQ(result_of(lines, 10 * kMillisecond),
            "the program did not answer within 0.01 s; it wrote last on standard error: \"" + reason + '"');
  Lines talker = asked();
  for (int i = 0; i < 300; ++i) talker.complained("warming up\n");
  talker.complained("no arm is connected\n");
  EXPECT_EQ(result_of(talker, 10 * kMillisecond),
            "the program did not answer within 0.01 s; it wrote last on standard error: \"no arm is connected\"");
}

TEST(program_lines, wait_until_the_time_of_an_answer_is_up_and_no_longer) {
  Lines lines = asked(kMillisecond);
  EXPECT_EQ(lines.until(), 11 * kMillisecond);
  EXPECT_EQ(result_of(lines, 11 * kMillisecond - 1), kWaits);
  EXPECT_EQ(result_of(lines, 11 * kMillisecond), "the program did not answer within 0.01 s");
  Lines in_time = asked();
  in_time.said("late, but there\n");
  EXPECT_EQ(result_of(in_time, kMillisecond * 1000), "late, but there");
  Lines patient(kLimits, "program");
  patient.set_answer_time(std::chrono::milliseconds(30));
  patient.hear(0);
  EXPECT_EQ(patient.until(), 30 * kMillisecond);
}

TEST(program_lines, that_nobody_asked_for_are_refused) {
  Lines lines = asked();
  lines.said("one\ntwo\n");
  EXPECT_EQ(result_of(lines), "one");
  EXPECT_THROW(lines.ask("y", 0), ProcessFailed);
  Lines early(kLimits, "program");
  early.ask("x", 0);
  early.took(1);
  early.said("one\n");
  EXPECT_EQ(result_of(early), "the program answered before it was asked: \"one\"");
}

TEST(program_lines, of_a_goodbye_end_in_silence) {
  const auto after_goodbye = [](const std::function<void(Lines&)>& act, std::int64_t now) {
    Lines lines(kLimits, "program");
    lines.say_goodbye("bye", 0);
    EXPECT_FALSE(lines.closes_input());
    EXPECT_EQ(lines.to_send(), "bye\n");
    lines.took(4);
    EXPECT_TRUE(lines.closes_input());
    EXPECT_FALSE(lines.ends_it());
    act(lines);
    return result_of(lines, now);
  };
  const auto ends = [](std::optional<int> status) {
    return [=](Lines& lines) {
      lines.ended_output();
      lines.ended(status);
    };
  };
  EXPECT_EQ(after_goodbye(ends(0), 0), "");
  EXPECT_EQ(after_goodbye(ends(2 << 8), 0), "the program ended with exit code 2");
  EXPECT_EQ(after_goodbye([](Lines& lines) { lines.said("x"); }, 0), "the program wrote after goodbye: \"x\"");
  EXPECT_EQ(after_goodbye([](Lines&) {}, 10 * kMillisecond), "the program did not answer within 0.01 s");
  EXPECT_EQ(after_goodbye([](Lines& lines) { lines.ended_output(); }, 10 * kMillisecond),
            "the program closed its output, and did not end");
}

// A dismissal is sent to its end, whatever the program wrote before and writes meanwhile.
TEST(program_lines, of_a_dismissal_are_sent_to_the_end_whatever_it_writes) {
  for (const Said& said : all_said()) {
    Lines lines = asked();
    lines.said(said.output);
    end(lines, said);
    result_of(lines, 10 * kMillisecond);
    lines.dismiss("zero\nend\n", 0);
    EXPECT_EQ(lines.to_send(), "zero\nend\n");
    EXPECT_FALSE(lines.closes_input() || lines.ends_it());
    lines.took(5);
    lines.said("whatever it likes");
    EXPECT_EQ(lines.to_send(), "end\n");
    lines.took(4);
    EXPECT_TRUE(lines.closes_input() && lines.ends_it());
    if (!said.status) {
      EXPECT_EQ(lines.result(5099 * kMillisecond), std::nullopt);
      lines.ended_output();
      lines.ended(std::nullopt);
      EXPECT_EQ(lines.result(0), "did not end within 0.1 s, and was ended");
    } else {
      EXPECT_NE(lines.result(0), std::nullopt);
    }
  }
  Lines stuck(kLimits, "program");
  stuck.dismiss("zero\n", 0);
  EXPECT_EQ(stuck.result(5100 * kMillisecond), "could not be ended");
  Lines broken(kLimits, "program");
  broken.dismiss("zero\n", 0);
  broken.takes_no_more();
  EXPECT_TRUE(broken.ends_it());
}

}  // namespace
}  // namespace forceshade::files
