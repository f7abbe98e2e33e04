// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The regularity of a device's frames: rate, longest gap and share of late ones, window by window.

#include <cstdint>
#include <optional>
#include <string>

namespace forceshade::device {

class FrameTimes {
 public:
  struct Window {
    double rate = 0;         // Hz, on average
    double longest_gap = 0;  // s
    double late = 0;         // share of the gaps that are longer than one and a half periods
  };

  // rate: as it should be, in Hz. frames: in a window, at least 1.
  FrameTimes(double rate, int frames) noexcept : period_(1 / rate), frames_(frames) {}

  // A frame began, at this time in ns. The window that it completes.
  std::optional<Window> add(std::int64_t time) noexcept {
    if (!begin_) {
      begin_ = last_ = time;
      return std::nullopt;
    }
    const double gap = static_cast<double>(time - last_) * 1e-9;
    last_ = time;
    ++count_;
    if (gap > longest_) longest_ = gap;
    if (gap > 1.5 * period_) ++late_;
    if (count_ < frames_) return std::nullopt;
    const Window window{.rate = count_ / (static_cast<double>(time - *begin_) * 1e-9),
                        .longest_gap = longest_,
                        .late = static_cast<double>(late_) / count_};
    restart();
    begin_ = time;
    return window;
  }

  // The next frame begins a window.
  void restart() noexcept {
    begin_.reset();
    count_ = late_ = 0;
    longest_ = 0;
  }

 private:
  double period_;  // s
  int frames_, count_ = 0, late_ = 0;
  std::optional<std::int64_t> begin_;
  std::int64_t last_ = 0;
  double longest_ = 0;  // s
};

// The quality of a device's frames for the user: numbers, and a grade.
std::string words_of(const FrameTimes::Window& seen);
const char* grade_of(const FrameTimes::Window& seen) noexcept;

}  // namespace forceshade::device
