// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer: every way in which it can be called; and a rendering, which is a renderer with the identity of what it renders,
// and all that a device is driven with. This program's and third-party renderers are held against the exact definition,
// certified and driven through it. The library is forceshade::renderer, of the component run; it links nothing of the exact
// side.
//
//   const auto built = rendering_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F});
//   const auto session = std::get<Rendering>(built).renderer.open();
//   const Eigen::Vector3f force = session->step({0, 0, -1}).force;  // N, at mm
//
// Errors: rendering_of() returns a ParameterError, which names the first number outside its domain. Functions may throw
// std::bad_alloc.
//
// Threads: a Renderer's functions are called from several threads at once; each session belongs to one at a time.
//
// Not promised: that a rendering is certified. run.h looks for a certificate.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "forceshade/description.h"
#include "forceshade/fast.h"
#include "forceshade/identity.h"

namespace forceshade {

// A renderer's functions. Every one is called from several threads at once.
struct Renderer {
  // A session for one path, which one thread uses at a time.
  std::function<std::unique_ptr<fast::Session>()> open;

  // The forces at the positions, into a span of the same length, by one instruction set's code. Empty where a renderer has no
  // such call.
  std::function<fast::BatchResult(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces,
                                  fast::InstructionSet set)>
      batch = {};

  // True if a call for one position, too, has code of its own in each instruction set: a batch of one then stands for the
  // single call on a machine whose widest set is that one.
  bool single_depends_on_set = false;
};

Renderer renderer_of(const fast::Law& law);
Renderer renderer_of(const fast::HeightMapField& map);
Renderer renderer_of(const fast::GodObject& god_object);  // it has no batch call: the force depends on the path

// A renderer of an object, and where the object is in the ticks of each path.
struct MovingRenderer {
  Renderer renderer;
  std::shared_ptr<const scene::Motion> motion;
};

// A scene of them, by fast::SceneSession, whose conditions it has. It has no batch call either. Its open() throws
// std::runtime_error under a fast::arithmetic_fault().
std::variant<Renderer, ParameterError> renderer_of(std::vector<MovingRenderer> objects);

// A session that answers with a function. Where that throws, the answer is a NaN, invalid, and exception_of() says what.
std::unique_ptr<fast::Session> answering(std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate);

// The exception that the function of answering() threw at the last step, in words; empty where it threw nothing, and of any
// other session, whose step() cannot throw.
std::optional<std::string> exception_of(const fast::Session& session);

// The words of the exception that is being handled.
std::string current_exception_words();

// A renderer and what it renders.
struct Rendering {
  Identity identity;
  Renderer renderer;
  // Ticks per second for which the motion of its objects was made, Hz: run() of run.h refuses another rate. None: any.
  std::optional<double> rate_hz = {};
  float stiffness = 0;              // N/mm: the largest of what it renders; 0: not known
  damping::Described damping = {};  // which run() of run.h puts behind the sessions: they are without it
};

// By the fast path. The error names the first number that is outside its domain (docs/laws.md, docs/height-maps.md,
// docs/god-object.md).
std::variant<Rendering, ParameterError> rendering_of(LawId law, const Parameters& parameters);

// name: of the map's file. stiffness: N/mm.
std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const HeightMap& map, height::Mode mode,
                                                     float stiffness);

// name: of the mesh's file.
std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const MeshRendering& mesh);

// name: of the scene's file.
std::variant<Rendering, ParameterError> rendering_of(const std::string& name, const DescribedScene& scene);

// The rendering of any of these.
std::variant<Rendering, ParameterError> rendering_of(const Description& description);

}  // namespace forceshade
