// SPDX-License-Identifier: BSD-3-Clause
// A program in a process of its own, within its limits and beyond them.

#include "files/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

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

}  // namespace
}  // namespace forceshade::files
