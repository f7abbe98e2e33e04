// SPDX-License-Identifier: BSD-3-Clause
#include "apps/progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/live_line.h"
#include "apps/tell.h"
#include "text/formatted.h"

namespace forceshade::apps {
namespace {

constexpr std::chrono::milliseconds kQuiet{500}, kRedrawn{100};
constexpr std::chrono::minutes kLogged{1};

// "1:05:09"
std::string hours(double seconds) {
  const long long whole = std::llround(seconds);
  return formatted("%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

ProgressLine::ProgressLine(std::string name)
    : ProgressLine(std::move(name), isatty(STDERR_FILENO) != 0, [] { return Clock::now(); }) {}

ProgressLine::ProgressLine(std::string name, bool is_terminal, std::function<Clock::time_point()> now)
    : name_(std::move(name)), is_terminal_(is_terminal), now_(std::move(now)), start_(now_()), drawn_(start_) {}

ProgressLine::~ProgressLine() {
  if (!shown_.empty()) draw_line("");
}

std::string ProgressLine::words(double done, const std::string& details) const {
  std::string text = formatted("%.1f %%", 100 * done);
  const double seconds = std::chrono::duration<double>(now_() - start_).count(), ahead = done - begun_.value_or(0);
  if (ahead > 0) text += "  " + hours(seconds * (1 - done) / ahead) + " left";
  if (!details.empty()) text += "  " + details;
  return text;
}

void ProgressLine::draw(double done, const std::string& details) {
  if (!begun_) begun_ = done;
  const Clock::time_point now = now_();
  if (!is_terminal_) {
    if (now - drawn_ < kLogged) return;
    drawn_ = now;
    tell(name_ + ": " + words(done, details));
    return;
  }
  if (now - start_ < kQuiet || now - drawn_ < kRedrawn) return;
  drawn_ = now;
  if (std::string text = words(done, details) + "  Ctrl-C stops  " + name_; text != shown_) draw_line(shown_ = std::move(text));
}

}  // namespace forceshade::apps
