// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One path through a renderer: what a servo loop drives, and what is compared with the reference.

#include <cstdint>
#include <memory>
#include <utility>

#include "fast/evaluate.h"

namespace forceshade::fast {

// Holds whatever the renderer remembers of the path so far. One thread at a time.
class Session {
 public:
  virtual ~Session() = default;

  // position: mm, the next one of the path. Without allocation, lock or exception.
  virtual Evaluation step(const Eigen::Vector3f& position) noexcept = 0;

  // Brings what the next step will probably use into the caches, for a loop that has time before it reads the position. Changes
  // no later answer. Without allocation, lock or exception; takes no longer than a step.
  virtual void look_ahead() noexcept {}

  // Where renderers can be exchanged while the loop runs: in the lower 32 bits the number of the one that answered the last
  // step, in the upper ones of the one that waits to take its place and followed the same step. Else 0. Recorded with every
  // tick.
  virtual std::uint64_t shown() const noexcept { return 0; }
};

// The session of a field, whose force depends on nothing but the position: a law or a height map.
template <class Field>
class FieldSession final : public Session {
 public:
  explicit FieldSession(Field field) noexcept : field_(std::move(field)) {}

  Evaluation step(const Eigen::Vector3f& position) noexcept override { return field_.evaluate(position); }

 private:
  Field field_;
};

template <class Field>
std::unique_ptr<Session> session_of(Field field) {
  return std::make_unique<FieldSession<Field>>(std::move(field));
}

}  // namespace forceshade::fast
