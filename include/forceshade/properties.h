// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The properties that a haptic renderer must have, run on generated cases of this program's or a third-party renderer. A case
// that fails is made as simple as it can be. The library is forceshade::properties, of the component properties, with the exact
// side.
//
//   const auto my_wall = [](const Eigen::Vector3f& p) -> properties::Rendered {  // 0.5 N/mm at z = 0
//     if (!(p.array().abs() <= 1e4F).all()) return {{0, 0, 0}, Status::invalid};
//     if (!(p.z() <= -0x1p-30F)) return {{0, 0, 0}, Status::free};
//     return {{0, 0, 0.5F * -p.z()}, Status::contact};
//   };
//   const auto subject = properties::law_subject(LawId::wall, {.stiffness = 0.5F}, my_wall);
//   for (const properties::PropertyResult& result : properties::run_properties(*subject, 1000, 1))
//     std::printf("%s: %s\n", result.name.c_str(), result.held ? "holds" : result.counterexample.c_str());
//
// A check and a certificate are of a subject: one notion for laws, height maps and whatever else renders a force. It is a
// rendering, which is all that a device is driven with, the exact definition of its force along a path, and what may be
// expected of both. Your own kind derives from Subject (tests/subjects/sticky_wall.h is an example with memory). Lengths
// are in mm, forces in N, energies in mJ.
//
// Errors: a property that does not hold is a result; what a renderer throws is a violation. Parameters outside their domain
// throw std::invalid_argument.
//
// Threads: a subject is const and may be called from several threads. A Chooser belongs to the call that got it.
// run_properties() and run_property() may run in several threads at once.
//
// Not promised: that a property which held for the drawn cases holds for all. The same seed gives the same cases of one
// version.

#include <Eigen/Core>
#include <algorithm>
#include <any>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "forceshade/fast.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "forceshade/reference.h"
#include "forceshade/renderer.h"

namespace forceshade::properties {

// A renderer's answer.
struct Rendered {
  Eigen::Vector3f force{0, 0, 0};  // N
  Status status = Status::free;
};

// position (mm) -> force, the same for the same position. What it throws fails the property that called it.
using ForceAt = std::function<Rendered(const Eigen::Vector3f& position)>;

// The violation of a property, in words with numbers in hexfloat and decimal; empty where the property holds.
using Violation = std::optional<std::string>;

// The way in which a position was chosen; every count of a run is broken down by it.
enum class Aim { any_bits, volume, surface, facet_line, quantum, domain_end, tie, axis, few_bits };

std::string_view name_of(Aim aim);

// A position and how it was chosen.
struct Aimed {
  Eigen::Vector3f position;
  Aim aim;
};

// An endless, repeatable stream of positions at which to compare.
class Positions {
 public:
  virtual ~Positions() = default;
  virtual Aimed next() = 0;
};

// One path through the definition. One thread at a time.
class ReferenceSession {
 public:
  virtual ~ReferenceSession() = default;

  // position: mm, the next one of the path. Throws std::domain_error where the definition cannot be decided.
  virtual reference::Rounded step(const Eigen::Vector3f& position) = 0;

  // The components of the exact force (N) of the last step, each correctly rounded to so many significant decimal digits;
  // nothing where the definition has no digits.
  virtual std::optional<std::array<std::string, 3>> decimal(unsigned) const { return std::nullopt; }
};

// The source of a property's cases. draw: any case, the same for the same seed. simpler: cases that are simpler than
// this one, the simplest first, and never one that leads back to it; it is called after the property has ended, and none is
// simpler where it is empty.
template <class Case>
struct Generator {
  std::function<Case(std::uint64_t seed)> draw;
  std::function<std::vector<Case>(const Case&)> simpler = nullptr;
};

// The source from which a property draws its case, all at once or bit by bit: const int i = choose(integers(0, 2)). While a
// failure is made simpler, the property gets simpler values here. What it draws may depend on what it has drawn before.
class Chooser {
 public:
  virtual ~Chooser() = default;

  template <class Case>
  Case operator()(const Generator<Case>& generator) {
    const auto simpler = [its = generator.simpler](const std::any& value) {
      std::vector<std::any> values;
      if (its)
        for (auto&& one : its(std::any_cast<const Case&>(value))) values.emplace_back(Case(std::move(one)));
      return values;
    };
    const auto draw = [&generator](std::uint64_t seed) -> std::any { return generator.draw(seed); };
    return std::any_cast<Case>(next({draw, simpler}));
  }

 private:
  // generator: draw may be called during this call only, simpler also later. Returns what it drew, or something simpler.
  virtual std::any next(const Generator<std::any>& generator) = 0;
};

// From low to high, both included. The simplest is 0, or the one that is nearest to it. Throws std::invalid_argument for an
// empty range.
Generator<int> integers(int low, int high);

// The list without some of its elements, at least so many: a path or a polygon that is simpler.
template <class T>
std::vector<std::vector<T>> shorter(const std::vector<T>& list, std::size_t least) {
  std::vector<std::vector<T>> lists;
  const auto without = [&](std::size_t from, std::size_t size) {
    lists.push_back(list);
    const auto first = lists.back().begin() + static_cast<std::ptrdiff_t>(from);
    lists.back().erase(first, first + static_cast<std::ptrdiff_t>(size));
  };
  for (std::size_t size = list.size() - std::min(list.size(), least); size > 0; size /= 2) {
    without(list.size() - size, size);
    for (std::size_t from = 0; from + size < list.size(); from += size) without(from, size);
  }
  return lists;
}

// A property: it draws a case, and says what the case violates.
using Property = std::function<Violation(Chooser& choose)>;

// A property beside the four by which a subject is certified.
struct FurtherProperty {
  std::string name;
  Property check;
};

// The expected features of the force: its jumps, in words; true if its direction is a unit vector; true if no loop gives
// energy.
struct Expected {
  std::vector<std::string> jumps;
  bool has_unit_directions = true;
  bool is_conservative = false;
};

class Subject;

// A subject of the same kind with other parameters, and these in words: "K = 0.25 N/mm: ".
struct DrawnSubject {
  std::unique_ptr<Subject> subject;
  std::string parameters;
};

// Everything is const and may be called from several threads at once.
class Subject {
 public:
  virtual ~Subject() = default;

  // The renderer that is checked, and the identity of what it renders.
  virtual const Rendering& rendering() const = 0;
  const Identity& identity() const { return rendering().identity; }
  const Renderer& renderer() const { return rendering().renderer; }

  // Its parts in words, a line each, as of a height map. Empty where the identity says all.
  virtual std::vector<std::string> parts() const { return {}; }

  // A path through the exact definition.
  virtual std::unique_ptr<ReferenceSession> open_reference() const = 0;

  // The positions to check: an endless stream, the same for the same seed. This must outlive it.
  virtual std::unique_ptr<Positions> positions(std::uint64_t seed) const = 0;

  // A path to compare along, for equivalence; two positions where the force depends on nothing but the position.
  virtual std::vector<Eigen::Vector3f> draw_path(Chooser& choose) const = 0;

  // The properties, each on a case that it draws.
  virtual Violation check_continuity(Chooser& choose) const = 0;
  virtual Violation check_unit_normals(Chooser& choose) const = 0;
  virtual Violation check_passivity(Chooser& choose) const = 0;
  // Closed paths that belong to passivity whatever is drawn.
  virtual std::vector<std::function<Violation()>> fixed_loops() const { return {}; }
  virtual std::vector<FurtherProperty> further_properties() const { return {}; }

  virtual Expected expected() const = 0;
  // The energy of loops by their depth. Throws reference::NotEnclosed, Interrupted.
  virtual std::vector<LoopEnergy> energies(const Monitor& monitor) const = 0;

  // The subject with parameters from all of the domain.
  virtual DrawnSubject with_drawn_parameters(std::uint64_t seed) const = 0;
  // The number of `points` to compare with one set of them.
  virtual std::uint64_t points_of_a_set(std::uint64_t points) const = 0;
};

// Makes the renderer of a law with these parameters, which are in its domain.
using RenderLaw = std::function<Renderer(LawId law, const Parameters& parameters)>;

// Makes the renderer of a height map, which is in the domain with this stiffness (N/mm).
using RenderHeightMap = std::function<Renderer(const HeightMap& map, height::Mode mode, float stiffness)>;

// Opens a session that should be of a god-object with this stiffness (N/mm).
using OpenTicks = std::function<std::unique_ptr<fast::TickSession>(float stiffness)>;

// A law as a subject: rendered by the fast path; by your own function, and with drawn parameters by the fast path; or by your
// own renderer for any parameters. They throw std::invalid_argument for parameters outside the law's domain.
std::unique_ptr<Subject> law_subject(LawId law, const Parameters& parameters);
std::unique_ptr<Subject> law_subject(LawId law, const Parameters& parameters, ForceAt force_at);
std::unique_ptr<Subject> law_subject(LawId law, const Parameters& parameters, RenderLaw render);

// The same of a height map. name: of its file; stiffness: N/mm.
std::unique_ptr<Subject> height_map_subject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness);
std::unique_ptr<Subject> height_map_subject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness,
                                            ForceAt force_at);
std::unique_ptr<Subject> height_map_subject(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness,
                                            RenderHeightMap render);

// A god-object on a mesh as a subject, rendered by the fast path or by your own sessions. name: of the mesh's file. They throw
// std::invalid_argument where a side refuses it.
std::unique_ptr<Subject> mesh_subject(const std::string& name, const MeshRendering& rendering);
std::unique_ptr<Subject> mesh_subject(const std::string& name, const MeshRendering& rendering, OpenTicks open);

// A scene of objects that move, rendered by the fast path. name: of its file. It throws the same.
std::unique_ptr<Subject> scene_subject(const std::string& name, const DescribedScene& scene);

// Any of these as a subject, rendered by the fast path.
std::unique_ptr<Subject> subject_of(const Description& description);

// A renderer without a batch call. What it gives is counted as decided by binary64.
Renderer renderer_answering(const ForceAt& force_at);

// Before each case with the property's name, and when the property is finished: the share of it that is done, in [0, 1].
using OnCase = std::function<void(const std::string& property, double done)>;

// Called when a property is finished.
using PropertyDone = std::function<void(const PropertyResult&)>;

// Equivalence, continuity, unit normals, passivity, each on `cases` generated cases (passivity, whose case is a whole loop, on
// a tenth of them, and on the subject's fixed loops), then the subject's further properties. The same seed gives the same
// cases. Where a renderer is random, keeps state that its definition does not have, or throws, the words of equivalence say
// that. Throws std::invalid_argument for fewer cases than one, which would hold of whatever is checked. Once `stop` is set,
// nothing is checked any more, and what is returned says nothing.
std::vector<PropertyResult> run_properties(const Subject& subject, int cases, std::uint64_t seed,
                                           const PropertyDone& done = nullptr, const OnCase& on_case = nullptr,
                                           const std::atomic<bool>* stop = nullptr);

// One property of your own. What it throws is a violation, too. The first case that fails is made simpler, one value that it
// drew after the other, as long as it fails and kSimplerCases have not been tried. Where it holds when it is tried again, the
// words say so.
PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed, const Property& property);
inline constexpr int kSimplerCases = 5000;

}  // namespace forceshade::properties
