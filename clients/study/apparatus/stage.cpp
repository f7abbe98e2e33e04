// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/stage.h"

#include <bit>
#include <utility>

#include "system/system.h"

namespace forceshade::apparatus {
namespace {

fast::Evaluation answer_of(std::optional<Placed>& placed, const Eigen::Vector3f& position) noexcept {
  return placed ? placed->session->step(position - placed->origin) : fast::Evaluation{};
}

bool is_same(const fast::Evaluation& a, const fast::Evaluation& b) noexcept {
  const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
  return a.status == b.status && bits(a.force.x()) == bits(b.force.x()) && bits(a.force.y()) == bits(b.force.y()) &&
         bits(a.force.z()) == bits(b.force.z());
}

}  // namespace

Stimulus::Answer Stimulus::step(const Eigen::Vector3f& position) noexcept {
  Answer answer{answer_of(left, position), {}, {}};
  // A single one is the same on either side, so that it can be exchanged with two.
  answer.right = right ? answer_of(right, position) : answer.left;
  answer.felt = position.x() < seam ? answer.left : answer.right;
  return answer;
}

void Stimulus::look_ahead() noexcept {
  for (const std::optional<Placed>* placed : {&left, &right})
    if (*placed) (*placed)->session->look_ahead();
}

Stage::~Stage() {
  delete offered_.load();
  delete retired_.load();
  delete withdrawn_.load();
}

void Stage::offer(std::unique_ptr<Stimulus> next) {
  system::step();
  delete offered_.exchange(next.release(), std::memory_order_acq_rel);
  collect();
}

void Stage::collect() {
  system::step();
  delete retired_.exchange(nullptr, std::memory_order_acq_rel);
  system::step();
  delete withdrawn_.exchange(nullptr, std::memory_order_acq_rel);
}

fast::Evaluation Stage::step(const Eigen::Vector3f& position) noexcept {
  // A place for each that goes: where it is not empty, the loop goes on with what it has.
  const auto left = [](std::unique_ptr<Stimulus>& old, std::atomic<Stimulus*>& place) {
    if (!old) return true;
    system::step();
    if (place.load(std::memory_order_acquire) != nullptr) return false;
    system::step();
    place.store(old.release(), std::memory_order_release);
    return true;
  };
  system::step();
  if (offered_.load(std::memory_order_relaxed) != nullptr && left(pending_, withdrawn_))
    pending_.reset(offered_.exchange(nullptr, std::memory_order_acq_rel));

  const Stimulus::Answer now = current_ ? current_->step(position) : Stimulus::Answer{};
  if (pending_) {
    const Stimulus::Answer next = pending_->step(position);
    if (is_same(now.left, next.left) && is_same(now.right, next.right) && is_same(now.felt, next.felt) &&
        left(current_, retired_))
      current_ = std::move(pending_);
  }
  const auto number = [](const std::unique_ptr<Stimulus>& of) -> std::uint64_t { return of ? of->number : 0; };
  shown_.store(number(pending_) << 32 | number(current_), std::memory_order_relaxed);
  return now.felt;
}

void Stage::look_ahead() noexcept {
  for (Stimulus* stimulus : {current_.get(), pending_.get()})
    if (stimulus != nullptr) stimulus->look_ahead();
}

}  // namespace forceshade::apparatus
