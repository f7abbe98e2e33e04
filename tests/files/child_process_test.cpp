// SPDX-License-Identifier: BSD-3-Clause
// A program in a process of its own, within its limits and beyond them.

#include "files/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/words.h"

namespace forceshade::files {
namespace {

// A shell and two further processes, which are counted five times a second.
constexpr const char* kThreeProcesses = "sleep 1000 & sleep 1000 & read line; echo $line";

TEST(child_process, may_have_as_many_processes_as_it_is_allowed) {
  ChildProcess program(kThreeProcesses, {.threads = 3, .grace = std::chrono::milliseconds(1)}, "program");
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  EXPECT_EQ(program.ask("still there"), "still there");
}

TEST(child_process, is_ended_where_it_has_one_more) {
  ChildProcess program(kThreeProcesses, {.answer = std::chrono::minutes(10), .threads = 2}, "program");
  EXPECT_EQ(tests::thrown_by<ProcessFailed>([&] { program.hear(); }),
            "the program had more than 2 processes and threads, and ended without an answer");
}

// In files, whose limit is in megabytes.
TEST(child_process, writes_as_much_as_it_is_allowed) {
  for (const auto& [bytes, result] : {std::pair{"2000000", "0"}, {"2200000", "1"}}) {
    const std::string command = std::string("file=$(mktemp); head -c ") + bytes +
                                " /dev/zero 2> /dev/null > $file; test $? -eq 0; result=$?; rm $file; read line; echo $result";
    ChildProcess program(command, {.file_megabytes = 2}, "program");
    EXPECT_EQ(program.ask(""), result) << bytes;
  }
}

}  // namespace
}  // namespace forceshade::files
