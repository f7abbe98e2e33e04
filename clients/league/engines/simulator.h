// SPDX-License-Identifier: BSD-3-Clause
// Reads the lines that `forceshade conform simulator` writes (docs/conformance-protocol.md) and answers with those of an
// engine.
#pragma once

#include <array>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace simulator {

using nlohmann::json;
using Vector = std::array<double, 3>;

struct Scene {
  double units_per_metre, rate_Hz, friction, radius, mass_kg;
  Vector gravity, position, velocity;
  bool turns, is_box;
  Vector half, centre;           // of a box
  std::vector<Vector> vertices;  // of a mesh
  std::vector<std::array<int, 3>> triangles;
};

struct Contact {
  Vector normal;  // on the sphere, out of the ground
  double force;   // or impulse
};

struct Motion {
  Vector position, velocity;
  std::vector<Contact> contacts;
};

struct About {
  std::string name, version, reports, constraint;
  std::size_t binary;
  std::string sides;
  double smallest_radius_m;
  std::string settings;
};

// JSON has no number that is not finite: null stands for NaN, both ways.
inline double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}
inline Vector vector(const json& value) {
  return {number(value.at(0)), number(value.at(1)), number(value.at(2))};
}

inline Scene scene_of(const json& text) {
  const json &ground = text.at("ground"), &sphere = text.at("sphere");
  Scene scene{number(text.at("units_per_metre")),
              number(text.at("rate_Hz")),
              number(text.at("friction")),
              number(sphere.at("radius")),
              number(sphere.at("mass_kg")),
              vector(text.at("gravity")),
              vector(sphere.at("position")),
              vector(sphere.at("velocity")),
              sphere.at("turns"),
              ground.contains("box"),
              {},
              {},
              {},
              {}};
  if (scene.is_box) {
    scene.half = vector(ground["box"].at("half"));
    scene.centre = vector(ground["box"].at("centre"));
    return scene;
  }
  for (const json& at : ground.at("vertices")) scene.vertices.push_back(vector(at));
  ground.at("triangles").get_to(scene.triangles);
  return scene;
}

inline json line_of(const Motion& motion) {
  json contacts = json::array();
  for (const auto& [n, force] : motion.contacts) contacts.push_back({n[0], n[1], n[2], force});
  return {{"position", motion.position}, {"velocity", motion.velocity}, {"contacts", contacts}};
}

// World is built from a Scene, and World::step(Vector force) gives the state after the step.
template <class World>
int simulate(const About& about) {
  const json hello = {
      {"forceshade", "conform 1"},    {"kind", "simulator"},       {"name", about.name},
      {"version", about.version},     {"reports", about.reports},  {"constraint", about.constraint},
      {"binary", about.binary},       {"sides", about.sides},      {"smallest_radius_m", about.smallest_radius_m},
      {"speed_cap_m_per_s", nullptr}, {"settings", about.settings}};
  Scene scene;
  std::unique_ptr<World> world;
  for (std::string line; std::getline(std::cin, line);) {
    const json asked = json::parse(line);
    if (asked.contains("goodbye")) return 0;
    json answer = hello;
    if (asked.contains("scene")) scene = scene_of(asked["scene"]);
    if (asked.contains("scene") || asked.value("reset", false)) world = std::make_unique<World>(scene);
    if (asked.contains("applied")) {
      answer = {{"motion", json::array()}};
      for (const json& force : asked["applied"]) answer["motion"].push_back(line_of(world->step(vector(force))));
    }
    std::cout << answer << std::endl;
  }
  return 0;
}

}  // namespace simulator
