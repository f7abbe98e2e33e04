// SPDX-License-Identifier: BSD-3-Clause
#include "apps/live_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "apps/live_line.h"
#include "run/rule_names.h"

namespace forceshade::apps {
namespace {

constexpr std::chrono::milliseconds kBetweenDrawings{100};

double length_of(const std::array<float, 3>& force) {
  return std::hypot(static_cast<double>(force[0]), static_cast<double>(force[1]), static_cast<double>(force[2]));
}

}  // namespace

LiveView::LiveView(double full_force) : full_force_(full_force), thread_("live view", [this] { follow(); }) {}

LiveView::~LiveView() {
  stopping_ = true;
  thread_.join();
  std::fprintf(stderr, "\r\033[K");
}

void LiveView::push(const device::Sample& sample) noexcept {
  if (sample.wall_ns - window_start_ > std::chrono::nanoseconds(kBetweenDrawings).count()) {
    window_start_ = sample.wall_ns;
    shown_.worst_wakeup = 0;
    shown_.limited = 0;
  }
  shown_.last = sample;
  shown_.worst_wakeup = std::max(shown_.worst_wakeup, sample.wakeup_ns);
  shown_.limited = static_cast<std::uint16_t>(shown_.limited | sample.limited);
  mailbox_.publish(shown_);
}

void LiveView::follow() {
  Shown before;
  while (!stopping_) {
    system::sleep_for(kBetweenDrawings);
    const Shown now = mailbox_.latest();
    if (now.last.tick > before.last.tick) draw(before, now);
    before = now;
  }
}

void LiveView::draw(const Shown& before, const Shown& now) const {
  const double seconds = static_cast<double>(now.last.wall_ns - before.last.wall_ns) / 1e9;
  const double rate = static_cast<double>(now.last.tick - before.last.tick) / std::max(seconds, 1e-9);
  draw_line(live_line({static_cast<double>(now.last.wall_ns) / 1e9, rate, static_cast<double>(now.worst_wakeup) / 1e3,
                       length_of(now.last.force), full_force_, now.last.energy, run::joined_rule_names(now.limited)},
                      room_for_a_line()));
}

}  // namespace forceshade::apps
