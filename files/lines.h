// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A dialogue with a third-party program that answers lines with lines, as bytes and times. The bytes are moved by a few lines
// elsewhere (child_process.h; in tests, a script); all decisions are here, without a process.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "forceshade/error.h"

namespace forceshade::files {

// The program did not answer as it has to: what() says how it ended, that it took too long, or what it wrote instead.
struct ProcessFailed : Error {
  using Error::Error;
};

struct ProcessLimits {
  std::chrono::milliseconds answer{10'000};          // for one line
  std::size_t longest_line = std::size_t{1} << 24U;  // bytes
  std::size_t memory = std::size_t{2} << 30U;        // bytes that it may write to, of each of its processes
  unsigned long threads = 512;                       // of all its processes together
  unsigned processor_seconds = 600, file_megabytes = 64;
  int ended_well = 0;                       // its exit code after goodbye
  std::chrono::milliseconds grace{0};       // that it has to end by itself once its input is at its end
  const std::atomic<bool>* stop = nullptr;  // once this is true, no line is waited for any longer
};

// In place of the status of a program: it was ended for having more threads than that.
inline constexpr int kTooMany = -1;

// Decides the use of the program's streams, and judges its answers. Times are system::now().
class Lines {
 public:
  // whose: what messages call the program; it has to outlive this.
  Lines(const ProcessLimits& limits, const char* whose) : limits_(limits), whose_(whose) {}

  // From now on it has so long for an answer.
  void set_answer_time(std::chrono::milliseconds answer) { limits_.answer = answer; }

  // Requests, one after another, each until result() has one.
  void ask(std::string_view line, std::int64_t now);
  void hear(std::int64_t now);
  void say_goodbye(std::string_view line, std::int64_t now);
  void dismiss(std::string_view lines, std::int64_t now);

  // The bytes to send; true if the input is closed once nothing is left to send; and the time until which the program, or
  // anything that it does, is waited for.
  std::string_view to_send() const noexcept { return std::string_view(sent_).substr(taken_); }
  bool closes_input() const noexcept { return wish_ != Wish::line && to_send().empty(); }
  bool ends_it() const noexcept { return wish_ == Wish::dismissal && closes_input(); }
  bool has_ended_output() const noexcept { return has_ended_output_; }
  std::int64_t until() const noexcept { return until_; }

  // Reports of its events. ended(): its status from the system; nothing if that is unknown.
  void took(std::size_t bytes) noexcept { taken_ += bytes; }
  void takes_no_more() noexcept { taken_ = sent_.size(); }
  void said(std::string_view bytes) { said_ += bytes; }
  void complained(std::string_view bytes);
  void ended_output() noexcept { has_ended_output_ = true; }
  void ended(std::optional<int> status) noexcept { end_ = status; }

  // The line, without its end; of a goodbye, nothing; of a dismissal, how it ended. None: it is waited for. Throws
  // ProcessFailed, but for a dismissal.
  std::optional<std::string> result(std::int64_t now);

 private:
  std::string how_it_ended() const;
  [[noreturn]] void fail(const std::string& words) const;
  void wish(std::int64_t until, std::string_view to_send);

  ProcessLimits limits_;
  const char* whose_;
  enum class Wish { line, goodbye, dismissal } wish_ = Wish::line;
  std::int64_t until_ = 0;
  std::string sent_, said_, last_words_;   // said_: what it wrote and was not read; last_words_: the end of its standard error
  std::size_t taken_ = 0, looked_at_ = 0;  // of sent_; of said_, where there is no end of a line
  bool has_ended_output_ = false;
  std::optional<std::optional<int>> end_;
};

// A program, whatever moves its bytes. One thread at a time.
class LineProgram {
 public:
  virtual ~LineProgram() = default;

  // Sends a line, which has no end of its own, and waits for one. Throws ProcessFailed; then no further call but dismiss() is
  // of use.
  std::string ask(std::string_view line);

  // The next line, which it writes without a request. Throws ProcessFailed as ask() does.
  std::string hear();

  void set_answer_time(std::chrono::milliseconds answer) { lines_.set_answer_time(answer); }

  // Sends a line that is not answered, closes the pipe, and waits until the program has ended, at most as long as for an
  // answer. Throws ProcessFailed where it writes a line, does not end, or ends with another code than that of the limits.
  void say_goodbye(std::string_view line);

  // The end of one that may have failed: sends it what it still takes of these lines and closes the pipe, whatever it writes
  // meanwhile. Returns its end: "ended", or words that follow "it". No further call is of use.
  std::string dismiss(std::string_view lines) noexcept;

 protected:
  LineProgram(const ProcessLimits& limits, const char* whose) : lines_(limits, whose) {}

  Lines lines_;

 private:
  // Tells lines_ what has happened, once it has waited for something until lines_.until(), or until a time that is over.
  virtual void move(std::int64_t until) = 0;

  std::string result();
};

}  // namespace forceshade::files
