// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Describes what is to be rendered: a law, a height map, a mesh, or a scene of such objects that move, with every number that
// determines its force.
//
//   const Description bump{"bump-2p", DescribedLaw{LawId::bump_2p, {15.24F, 25.4F, 0.5F}}};  // mm, mm, N/mm
//   const auto built = rendering_of(bump);  // of renderer.h
//   const auto session = std::get<Rendering>(built).renderer.open();
//
// Not promised: that a number is in its domain, which is looked at when a renderer is built.

#include <string>
#include <variant>
#include <vector>

#include "forceshade/damping.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "forceshade/scene.h"

namespace forceshade {

struct DescribedLaw {
  LawId law{};
  Parameters parameters;
};

struct DescribedHeightMap {
  HeightMap map;
  height::Mode mode{};
  float stiffness = 0;  // K, N/mm
};

struct MovingObject;

// Objects whose places in each tick are given before the path begins (docs/scenes.md).
struct DescribedScene {
  std::vector<MovingObject> objects;  // 1 to scene::kMostObjects
  float rate = 1000;                  // ticks per second for which their motions were made, Hz
  float stiffness = 0;                // K of the objects that say none of their own, N/mm
};

struct Description {
  std::string name;  // for people: the law's, or that of the file of a height map, mesh or scene
  std::variant<DescribedLaw, DescribedHeightMap, MeshRendering, DescribedScene> what;
  damping::Described damping = {};  // behind it, of no part in its identity or a certificate (docs/damping.md)

  // The result of the case for what it is, which is called with the members of `what` and gives one type. It does not compile
  // while a kind has no case.
  template <class... Cases>
  auto visit(const Cases&... cases) const {
    struct All : Cases... {
      using Cases::operator()...;
    };
    return std::visit(All{cases...}, what);
  }

  // True if it has objects with motions, whose poses are those of the tick.
  bool moves() const { return std::holds_alternative<DescribedScene>(what); }

  // K, N/mm.
  float stiffness() const {
    return visit([](const DescribedLaw& law) { return law.parameters.stiffness; },
                 [](const auto& other) { return other.stiffness; });
  }
};

struct MovingObject {
  std::string name;  // that no other object of the scene has
  Description what;
  scene::Motion motion;  // of the tick in which a path begins, and the following ones
};

}  // namespace forceshade
