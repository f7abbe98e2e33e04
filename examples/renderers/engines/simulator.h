// SPDX-License-Identifier: BSD-3-Clause
// Reads the lines that `forceshade conform --simulator` writes (docs/conformance-protocol.md) and answers with those of an engine.
#pragma once

#include <array>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace simulator {

using nlohmann::json;
using Vector = std::array<double, 3>;

// JSON has no number that is not finite: null stands for NaN, both ways.
inline double number(const json& value) { return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>(); }
inline Vector vector(const json& value) { return {number(value.at(0)), number(value.at(1)), number(value.at(2))}; }

struct Contact {
  Vector normal;  // on the sphere, out of the ground
  double force;   // or impulse
};

struct Motion {
  Vector position, velocity;
  std::vector<Contact> contacts;
};

// World is built from a scene, and World::step(Vector force) gives the state after the step.
template <class World>
int simulate(const json& about) {
  json hello = {{"forceshade", "conform 1"}, {"kind", "simulator"}};
  hello.update(about);
  json scene;
  std::unique_ptr<World> world;
  for (std::string line; std::getline(std::cin, line);) {
    const json asked = json::parse(line);
    if (asked.contains("goodbye")) return 0;
    json answer = hello;
    try {
      if (asked.contains("scene")) scene = asked["scene"];
      if (asked.contains("scene") || asked.value("reset", false)) {
        world.reset();
        world = std::make_unique<World>(scene);
      }
    } catch (const std::exception& error) {
      answer.update({{"accepts", false}, {"reason", error.what()}});
    }
    if (asked.contains("applied")) {
      answer = {{"motion", json::array()}};
      for (const json& force : asked["applied"]) {
        const Motion after = world->step(vector(force));
        json contacts = json::array();
        for (const auto& [n, force_on_it] : after.contacts) contacts.push_back({n[0], n[1], n[2], force_on_it});
        answer["motion"].push_back({{"position", after.position}, {"velocity", after.velocity}, {"contacts", std::move(contacts)}});
      }
    }
    std::cout << answer << std::endl;
  }
  return 0;
}

}  // namespace simulator
