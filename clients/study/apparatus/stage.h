// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One renderer, or two side by side with the plane x = 0 between them, that another thread exchanges while the loop runs.

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "forceshade/session.h"

namespace forceshade::apparatus {

// A path through a renderer whose origin lies somewhere in the device's frame, mm. It is given the difference, rounded to
// binary32 once for each coordinate.
struct Placed {
  std::unique_ptr<fast::Session> session;
  Eigen::Vector3f origin{0, 0, 0};
};

// The surfaces felt until the next exchange. Without a right one the left one acts everywhere; without either none does.
struct Stimulus {
  std::uint32_t number = 0;  // recorded with every tick; positive
  std::optional<Placed> left, right;
  float seam = 0;  // mm: where x is smaller the left one is felt, else the right one

  // The answers at a position of the path. `felt` is that of the side at the position: both follow the path, because the force
  // of a renderer with memory depends on how the tip came to where it is.
  struct Answer {
    fast::Evaluation left, right, felt;
  };
  Answer step(const Eigen::Vector3f& position) noexcept;
  void look_ahead() noexcept;
};

// A stimulus takes the place of the one before at the first tick at which both give the same force and status, to the bit, on
// either side: when the tip is in free space, or on a part of the plane that both have. So no exchange changes a force: nothing
// jumps under a resting hand, no energy is given, no transient says which way the shape was changed, and a renderer with a
// memory, such as a god-object, is never begun inside its object. Until then the earlier stimulus stays, and an offer that
// comes meanwhile replaces the one that waits.
//
// The loop's thread allocates, locks, frees and waits for nothing. One other thread offers and collects.
class Stage final : public fast::Session {
 public:
  // Nothing is felt.
  Stage() = default;
  // Not while a loop runs.
  ~Stage() override;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // Called by the other thread. An exchange waits where what an earlier one retired has not been collected.
  void offer(std::unique_ptr<Stimulus> next);
  // Called by the other thread, often: destroys what the loop no longer uses.
  void collect();

  // Called by the loop.
  fast::Evaluation step(const Eigen::Vector3f& position) noexcept override;
  void look_ahead() noexcept override;
  // The number of what answered the last step, and of what waits; 0 for none. By any thread.
  std::uint64_t shown() const noexcept override { return shown_.load(std::memory_order_relaxed); }

 private:
  std::atomic<Stimulus*> offered_ = nullptr;
  std::atomic<Stimulus*> retired_ = nullptr, withdrawn_ = nullptr;  // was felt; was replaced before it was felt
  std::atomic<std::uint64_t> shown_ = 0;
  static_assert(std::atomic<Stimulus*>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);

  // The loop's.
  std::unique_ptr<Stimulus> current_, pending_;
};

}  // namespace forceshade::apparatus
