// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A program that somebody else wrote, which answers lines with lines, in bounded time and memory whatever it does.

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace forceshade::files {

// The program did not answer as it has to: what() says how it ended, that it took too long, or what it wrote instead.
struct ProcessFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ProcessLimits {
  std::chrono::milliseconds answer{10'000};          // for one line
  std::size_t longest_line = std::size_t{1} << 24U;  // bytes
  std::size_t memory = std::size_t{2} << 30U;        // bytes that it may write to, of each of its processes
  unsigned long threads = 512;                       // of all its processes together
  unsigned processor_seconds = 600, file_megabytes = 64;
  int ended_well = 0;                  // its exit code after goodbye
  std::chrono::milliseconds grace{0};  // that it has to end by itself once its input is at its end
};

// In a session of its own, with pipes to its standard streams. One thread at a time.
class ChildProcess {
 public:
  // command: a line for /bin/sh. whose: what messages call it; it has to outlive this. Throws std::system_error where no
  // process can be made.
  ChildProcess(const std::string& command, const ProcessLimits& limits, const char* whose);
  // After the grace ends it, and all that it has started, also what has left its session. So it goes, too, where this process
  // is killed.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Sends a line, which has no end of its own, and waits for one. Throws ProcessFailed; then no further call is of use.
  std::string ask(std::string_view line);

  // The next line, which it writes without a request. Throws ProcessFailed; then no further call is of use.
  std::string hear();

  // From now on it has so long for an answer.
  void set_answer_time(std::chrono::milliseconds answer) { limits_.answer = answer; }

  // Sends a line that is not answered, closes the pipe, and waits until the program has ended, at most as long as for an
  // answer. Throws ProcessFailed where it writes a line, does not end, or ends with another code than that of the limits.
  void say_goodbye(std::string_view line);

  // The end of one that may have failed: sends it what it still takes of these lines and closes the pipe, whatever it writes
  // meanwhile. How it ended: "ended", or words that follow "it". No further call is of use.
  std::string dismiss(std::string_view lines) noexcept;

 private:
  bool transfer(std::string_view& rest, std::int64_t until);  // false at the end of its output
  std::string next_line(std::string_view& rest);
  [[noreturn]] void fail(const std::string& words);
  std::string how_it_ended(std::int64_t until);

  ProcessLimits limits_;
  const char* whose_;
  pid_t keeper_ = -1;          // its parent (keeper.h)
  std::optional<int> status_;  // of the program, once it has ended
  int to_ = -1, from_ = -1, errors_ = -1, control_ = -1, reports_ = -1;
  std::string said_, last_words_;  // what it wrote and was not read; the end of what it wrote to standard error
};

}  // namespace forceshade::files
