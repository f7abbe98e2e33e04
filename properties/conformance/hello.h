// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The renderer's description of itself when it is opened: the keys of docs/conformance-protocol.md. Nothing is guessed.

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "files/child_process.h"
#include "forceshade/damping.h"

namespace forceshade::conformance {

// closest_point: the point to which the force pulls, the position itself where there is no contact.
enum class Answer { force, impulse, closest_point };

// An axis of the scene, or its opposite.
struct Axis {
  std::size_t index = 0;
  bool is_opposite = false;
};

struct Hello {
  std::string name, version;
  std::optional<std::string> refusal = {};  // why it does not render this scene; nothing where it does
  bool remembers = false;                   // its force depends on the positions before
  Answer answer = Answer::force;
  bool claims_definition = true;               // it renders the exact definition of the scene
  double millimetres = 1, newtons = 1;         // its units of length and of force
  std::array<Axis, 3> frame{{{0}, {1}, {2}}};  // its own axes, in the scene
  float domain = 10'000;                       // mm: it answers positions whose coordinates are at most so large
  std::optional<double> rate = {};             // Hz: each position is a tick; nothing where time does not matter
  std::optional<double> loop_energy = {};      // mJ: the most that a closed path gives the hand; nothing where it may be any
  std::optional<damping::Parameters> damping = {};                     // with which it damps its forces (docs/damping.md)
  nlohmann::ordered_json declared = nlohmann::ordered_json::object();  // these keys, for a report

  bool has_own_units() const;  // true unless it gives forces in N for positions in mm, both in the frame of the scene
};

// The hello of a renderer that is opened on this scene (scene.h). Throws files::ProcessFailed, with the key and what was
// expected.
Hello hello_of(const nlohmann::ordered_json& said, const nlohmann::ordered_json& scene);

}  // namespace forceshade::conformance
