// SPDX-License-Identifier: BSD-3-Clause
#include "files/lines.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstring>
#include <exception>

#include "files/csv.h"
#include "files/printable.h"
#include "system/system.h"

namespace forceshade::files {
namespace {

constexpr std::size_t kLastWords = 2000, kLastLine = 300;
constexpr std::chrono::milliseconds kToBeEnded{5000};  // once its grace is over

std::string seconds(std::chrono::milliseconds time) {
  return shortest(static_cast<double>(time.count()) / 1000) + " s";
}

}  // namespace

void Lines::wish(std::int64_t until, std::string_view to_send) {
  until_ = until;
  sent_ = to_send;
  taken_ = 0;
}

void Lines::ask(std::string_view line, std::int64_t now) {
  if (!said_.empty()) fail("wrote without having been asked: " + shown(said_));
  hear(now);
  sent_ = line;
  sent_ += '\n';
}

void Lines::hear(std::int64_t now) {
  wish_ = Wish::line;
  wish(now + system::in_ns(limits_.answer), "");
}

void Lines::say_goodbye(std::string_view line, std::int64_t now) {
  hear(now);
  wish_ = Wish::goodbye;
  sent_ = line;
  sent_ += '\n';
}

void Lines::dismiss(std::string_view lines, std::int64_t now) {
  wish_ = Wish::dismissal;
  wish(now + system::in_ns(limits_.grace + kToBeEnded), lines);
}

void Lines::complained(std::string_view bytes) {
  last_words_ += bytes;
  if (last_words_.size() > kLastWords) last_words_.erase(0, last_words_.size() - kLastWords);
}

std::optional<std::string> Lines::result(std::int64_t now) {
  if (wish_ == Wish::dismissal) said_.clear();
  if (wish_ == Wish::goodbye && !said_.empty()) fail("wrote after goodbye: " + shown(said_));
  if (wish_ == Wish::line) {
    const std::size_t end = said_.find('\n', looked_at_);
    looked_at_ = said_.size();
    if (std::min(end, said_.size()) > limits_.longest_line)
      fail("wrote a line of more than " + std::to_string(limits_.longest_line) + " bytes: " + shown(said_));
    if (end != std::string::npos) {
      std::string line = said_.substr(0, end);
      said_.erase(0, end + 1);
      looked_at_ = 0;
      if (line.ends_with('\r')) line.pop_back();
      if (!to_send().empty()) fail("answered before it was asked: " + shown(line));
      return line;
    }
  }
  if (wish_ == Wish::line && limits_.stop != nullptr && *limits_.stop) fail("was not waited for any longer");
  if (has_ended_output_ ? !end_ && now < until_ : now < until_) return std::nullopt;
  const std::string end = how_it_ended();
  if (wish_ == Wish::dismissal) return end;
  if (!has_ended_output_) fail("did not answer within " + seconds(limits_.answer));
  if (wish_ == Wish::line) fail(end.starts_with("could not be started") ? end : end + " without an answer");
  if (end != "ended") fail(end);
  return "";
}

std::string Lines::how_it_ended() const {
  if (!has_ended_output_) return "could not be ended";
  if (!end_) return "closed its output, and did not end";
  if (!*end_)
    return wish_ == Wish::dismissal ? "did not end within " + seconds(limits_.grace) + ", and was ended"
                                    : "ended the process that watches it";
  const int status = **end_;
  if (status == kTooMany) return "had more than " + std::to_string(limits_.threads) + " processes and threads, and ended";
  if (WIFSIGNALED(status))
    return "was killed by signal " + std::to_string(WTERMSIG(status)) + " (" + ::strsignal(WTERMSIG(status)) + ")";
  if (WEXITSTATUS(status) == 127) return "could not be started: the shell knows no such command";
  if (WEXITSTATUS(status) == limits_.ended_well) return "ended";
  return WEXITSTATUS(status) == 0 ? "ended too early" : "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

void Lines::fail(const std::string& words) const {
  const std::size_t end = last_words_.find_last_not_of('\n');
  const std::size_t begin = end == std::string::npos ? end : last_words_.rfind('\n', end);
  const std::string last = end == std::string::npos ? "" : last_words_.substr(begin == std::string::npos ? 0 : begin + 1);
  throw ProcessFailed(
      std::string("the ") + whose_ + ' ' + words +
      (last.empty() ? "" : "; it wrote last on standard error: " + shown(last.substr(0, last.find('\n')), kLastLine)));
}

std::string LineProgram::result() {
  for (;;) {
    if (const auto its = lines_.result(system::now())) return *its;
    move(lines_.until());
  }
}

// A line that was there before the request is no answer to it.
std::string LineProgram::ask(std::string_view line) {
  move(0);
  lines_.ask(line, system::now());
  return result();
}

std::string LineProgram::hear() {
  lines_.hear(system::now());
  return result();
}

void LineProgram::say_goodbye(std::string_view line) {
  lines_.say_goodbye(line, system::now());
  result();
}

std::string LineProgram::dismiss(std::string_view lines) noexcept try {
  lines_.dismiss(lines, system::now());
  move(0);  // it is sent what it takes, however late this process is
  return result();
} catch (const std::exception&) {
  return "could not be ended";
}

}  // namespace forceshade::files
