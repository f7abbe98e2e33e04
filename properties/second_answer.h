// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that a renderer's answer is a function of the path, and of no more of it than its definition's is.

#include <span>

#include "forceshade/properties.h"
#include "properties/rendered.h"

namespace forceshade::properties {

// "at x = ... mm the renderer gives two answers for one input: ..." where the renderer, asked again in new sessions, does not
// give `answer` at the end of this path: it is random, or its sessions share state. Empty where it does each time.
Violation second_answer(const Subject& subject, std::span<const Eigen::Vector3f> path, const Rendered& answer);

// "at x = ... mm the renderer gives two answers: ..." where its answer at the end of this path differs from that in a session
// that has seen no earlier position, and the exact force does not: it keeps state that its definition does not have. Empty
// where it does not. exact: the force at the end of the path.
Violation undeclared_memory(const Subject& subject, std::span<const Eigen::Vector3f> path, const Rendered& answer,
                            const reference::Rounded& exact);

// The first of the two that finds something. path: not empty.
Violation inconsistency(const Subject& subject, std::span<const Eigen::Vector3f> path, const Rendered& answer,
                        const reference::Rounded& exact);

}  // namespace forceshade::properties
