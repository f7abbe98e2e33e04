// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace forceshade::world {
namespace {

// The growth of the share of an order from a frame to the next: five times what is allowed.
constexpr double kMostGrowth = 0.01;
constexpr Ns kWake = 50'000;  // from a frame to the tick that follows it, of a thread that may go on

std::string ms(Ns time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", static_cast<double>(time) * 1e-6);
  return text;
}

// The force is a part of the order, by direction and size.
bool covers(const Eigen::Vector3d& order, const Eigen::Vector3d& force) {
  const double size = order.norm();
  if (size == 0) return force.isZero(0);
  const double share = force.dot(order) / (size * size);
  return share >= 0 && share <= 1 + 1e-6 && (force - share * order).norm() <= 1e-6 * (1 + size);
}

bool is_same(const std::array<float, 3>& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3f rounded = b.cast<float>();
  return a[0] == rounded.x() && a[1] == rounded.y() && a[2] == rounded.z();
}

}  // namespace

Judge::Judge(World& world, Arm& arm) : world_(world), arm_(arm) {
  orders_.reserve(20'000);
  samples_.reserve(20'000);
  arm_.on_sent = [this](const Arm::Sent& it) { sent(it); };
  arm_.on_misuse = [this](const char* words) { violate(4, words); };
}

void Judge::violate(int rule, std::string words) {
  if (violations_.size() < 10) violations_.push_back({rule, std::move(words)});
}

void Judge::sent(const Arm::Sent& sent) {
  const Ns now = world_.now();
  const bool stood_still = world_.held_until() > sent_before_;
  const double size = sent.force.norm();
  if (!(size <= arm_.peak * (1 + 1e-6))) violate(1, "a force of " + std::to_string(size) + " N was sent");
  if (size > 0) {
    if (!obeyed_) violate(1, "a force was sent to an arm that is not ready");
    const auto order =
        std::find_if(orders_.rbegin(), orders_.rend(), [&](const Order& it) { return covers(it.force, sent.force); });
    if (order == orders_.rend()) {
      violate(1, "a force that no order covers was sent");
    } else if (now - order->time > kWatchdog + kSend) {
      if (!stood_still || was_excused_) violate(2, "a force was sent that was ordered " + ms(now - order->time) + " ago");
      was_excused_ = true;
    } else {
      was_excused_ = false;
    }
  }
  grown(sent.force, now);
  sent_before_ = now;
  obeyed_ = sent.obeys;
}

// The share of its order that a frame sends, as little as it can be, against that of the frame before, as much as it can be: of
// the orders that a force may follow, which one it does is not known.
void Judge::grown(const Eigen::Vector3d& force, Ns now) {
  const double size = force.norm();
  double least = std::numeric_limits<double>::infinity(), most = 0;
  bool follows_zero = orders_.empty();
  for (auto order = orders_.rbegin(); order != orders_.rend(); ++order) {
    if (order != orders_.rbegin() && now - order->time > kWatchdog + kSend) break;
    follows_zero |= order->force.isZero(0);
    if (size == 0 || !covers(order->force, force)) continue;
    least = std::min(least, order->force.norm());
    most = std::max(most, order->force.norm());
  }
  if (most > 0 && size / most > share_before_ + kMostGrowth)
    violate(9, "the share of an order that was sent grew from " + std::to_string(share_before_) + " to " +
                   std::to_string(size / most));
  share_before_ = size > 0 ? std::min(1.0, size / least) : follows_zero ? 1 : 0;
}

// The force that is felt depends on frames alone, so that it is enough to look while time goes on.
void Judge::look() {
  felt_until_ = std::max(felt_until_, arm_.felt_until());
  const Ns now = world_.now();
  if (!arm_.can_be_reached()) unreached_ = now;
  if (arm_.felt().isZero(0)) return;
  const Ns ordered = orders_.empty() ? 0 : orders_.back().time;
  const double age = static_cast<double>(now - ordered) * 1e-6;
  const Ns most = arm_.plan().longest_force + kSend;
  if (now - ordered <= most) return;
  // Nothing of this machine can end the force where machine or frames stand still, or nothing reaches the arm.
  const bool stood_still = now - ordered - (world_.stood_still() - stood_still_) <= most;
  if (stood_still || now - unreached_ < 2 * kFrame || (world_.held_until() > ordered && now - world_.held_until() < 2 * kFrame))
    without_watchdog_ = std::max(without_watchdog_, age);
  else
    violate(3, "a force is felt " + ms(now - ordered) + " after the last order");
}

void Judge::ordered(const Eigen::Vector3f& force) {
  orders_.push_back({world_.now(), force.cast<double>()});
  stood_still_ = world_.stood_still();
  if (!held_button_ && !force.isZero(0)) violate(1, "a force was ordered while the dead-man button was let go");
}

void Judge::read(const device::ReadResult& result) {
  const auto* reading = std::get_if<device::Reading>(&result);
  if (reading == nullptr) return;
  if (reading->time < last_reading_) violate(5, "a reading is older than the one before");
  last_reading_ = reading->time;
  read_ = Arm::frame_of(reading->position.y());
  held_button_ = (reading->buttons & 1U) != 0;
}

// A tick begins soon after the first frame that it could follow, or after the loop was let go on.
void Judge::woken(Ns frame) {
  if (frame == last_frame_) return;
  const bool is_first = std::exchange(last_frame_, frame) == 0;
  if (is_first || read_ + 1 >= arm_.sent().size() || arm_.sent()[read_ + 1].answered == 0) return;
  const Ns free = std::max(arm_.sent()[read_ + 1].answered, world_.held_until());
  if (world_.now() > free + kWake) violate(5, "the loop slept " + ms(world_.now() - free) + " beside a frame that was there");
}

void Judge::conclude(Outcome& outcome) {
  outcome.felt_until = felt_until_;
  outcome.without_watchdog = without_watchdog_;
  outcome.stays = !arm_.felt().isZero(0);
  const auto& sent = arm_.sent();
  if (outcome.stays && arm_.can_be_reached() && !arm_.plan().may_be_lost) violate(3, "a force is felt at the end");
  if (outcome.end == World::End::dead && !world_.exit_code(0)) return;
  if (!sent.empty() && !arm_.is_closed() && arm_.can_be_reached()) violate(4, "the arm was not closed");
  if (outcome.end == World::End::never) violate(8, "the session does not end");
  for (int thread = 0; thread < world_.threads(); ++thread)
    if (!world_.is_over(thread) && world_.name(thread) != kPartner &&
        !(!arm_.can_be_reached() && world_.name(thread) == "calls"))
      violate(8, "the thread \"" + world_.name(thread) + "\" is left");
  if (outcome.end == World::End::dead || !outcome.refused.empty()) return;
  const device::ServoResult& result = outcome.result;
  if (result.end_reason == device::EndReason::device_fault && *result.fault == '\0') violate(8, "an end without words");
  const device::PassivityAccount& account = result.account;
  const double most = result.passivity_settings.epsilon + account.dissipated + account.forgiven + 1e-3;
  if (!samples_.empty() && arm_.work() > most)
    violate(6, "the hand was given " + std::to_string(arm_.work()) + " mJ, at most " + std::to_string(most) + " are its own");
  for (std::size_t k = 0; k + 1 < samples_.size(); ++k) {
    const device::Sample& sample = samples_[k];
    if (sample.tick != k) violate(7, "the record lacks tick " + std::to_string(k));
    if (k >= orders_.size() || !is_same(sample.force, orders_[k].force))
      return violate(7, "the record of tick " + std::to_string(k) + " differs from its order");
    const std::size_t frame = Arm::frame_of(static_cast<double>(sample.position[1]));
    if (frame >= sent.size() || !is_same(sample.sent_acting, sent[frame].force) ||
        (frame > 0 && !is_same(sample.sent_acted, sent[frame - 1].force)))
      return violate(7, "the record of tick " + std::to_string(k) + " differs from what was sent");
    const std::size_t before = k > 0 ? Arm::frame_of(static_cast<double>(samples_[k - 1].position[1])) : frame - 1;
    outcome.repeated += frame == before ? 1 : 0;
    outcome.skipped += frame > before ? frame - before - 1 : 0;
    if (orders_[k].force.isZero(0)) continue;
    ++outcome.pushed;
    outcome.one_later += frame + 1 < sent.size() && is_same(sample.force, sent[frame + 1].force) ? 1 : 0;
  }
  const bool was_started = result.ticks > 0 || !samples_.empty();
  if (was_started && samples_.size() != result.ticks + 1) violate(7, "not every tick is in the record");
}

}  // namespace forceshade::world
