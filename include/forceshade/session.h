// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One path of the hand through a renderer: what a servo loop drives, and what is compared with the exact definition. Your
// own renderer derives from Session.
//
//   class Wall final : public fast::Session {  // at z = 0, of 0.5 N/mm
//    public:
//     fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
//       if (!(position.array().abs() <= 1e4F).all()) return {{0, 0, 0}, Status::invalid};
//       if (!(position.z() < 0)) return {};
//       return {{0, 0, -0.5F * position.z()}, Status::contact};
//     }
//   };
//   Wall wall;
//   const Eigen::Vector3f force = wall.step({0, 0, -2}).force;  // (0, 0, 1) N
//
// Positions are in mm and forces in N, in the frame of docs/laws.md: x right, y into the page, z up. A session belongs to one
// thread at a time.
//
// Not promised: that a force of a session that is not this program's is right. The supervisor of the servo loop limits
// whatever a session gives (docs/safety.md), and properties.h checks it.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <utility>

#include "forceshade/damping.h"
#include "forceshade/law.h"

namespace forceshade::fast {

// The arithmetic that decided an answer, the cheapest first.
enum class Stage { binary64, double_double, wide };

struct Evaluation {
  Eigen::Vector3f force{0, 0, 0};  // N; zero where the status is free or invalid
  Status status = Status::free;
  Stage stage = Stage::binary64;
  damping::Limits damping = {};  // of what is touched, for damping behind the renderer
};

// Holds whatever the renderer remembers of the path so far.
class Session {
 public:
  virtual ~Session() = default;

  // position: mm, the next one of the path, which may be any numbers. Without allocation, lock or exception.
  virtual Evaluation step(const Eigen::Vector3f& position) noexcept = 0;

  // Brings what the next step will probably use into the caches, for a loop that has time before it reads the position. Changes
  // no later answer. Without allocation, lock or exception; takes no longer than a step.
  virtual void look_ahead() noexcept {}

  // Marks an exchange of renderers while the loop runs: the lower 32 bits hold the number of the one that answered the last
  // step, the upper ones that of the one that waits to take its place and followed the same step. Else 0. Recorded with every
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
