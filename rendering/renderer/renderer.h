// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer: every way in which it can be called. Ours and anybody's are held against the exact definition, certified and
// driven through it.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "fast/god_object.h"
#include "fast/height_map_field.h"
#include "fast/law.h"
#include "fast/session.h"

namespace forceshade {

// Every function is called from several threads at once.
struct Renderer {
  // A session for one path, which one thread uses at a time.
  std::function<std::unique_ptr<fast::Session>()> open;

  // The forces at the positions, into a span of the same length, by one instruction set's code. Empty where a renderer has no
  // such call.
  std::function<fast::BatchResult(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces,
                                  fast::InstructionSet set)>
      batch = {};

  // Whether a call for one position, too, has code of its own in each instruction set: a batch of one then stands for the
  // single call on a machine whose widest set is that one.
  bool single_depends_on_set = false;
};

Renderer renderer_of(const fast::Law& law);
Renderer renderer_of(const fast::HeightMapField& map);
Renderer renderer_of(const fast::GodObject& god_object);  // it has no batch call: the force depends on the path

// A session that answers with a function. Where that throws, the answer is a NaN, invalid, and exception_of() says what.
std::unique_ptr<fast::Session> answering(std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate);

// What the function of answering() threw at the last step, in words; empty where it threw nothing, and of any other session,
// whose step() cannot throw.
std::optional<std::string> exception_of(const fast::Session& session);

// The words of the exception that is being handled.
std::string current_exception_words();

}  // namespace forceshade
