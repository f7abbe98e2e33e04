// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// This program's own renderer as a renderer under test, which is opened on any scene, and can be spoiled in one thing.

#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "forceshade/damped.h"
#include "forceshade/meshes.h"
#include "forceshade/properties.h"
#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

using Json = nlohmann::ordered_json;

// Changes a force that was right; is_first: of its path.
using Spoil = std::function<void(const Eigen::Vector3f& position, Eigen::Vector3f& force, bool is_first)>;
// For each opening: what is rendered may be changed, and the hello.
using Spoiler = std::function<Spoil(Description& scene, Json& hello)>;

inline std::array<float, 3> numbers_of(const Json& texts) {
  std::array<float, 3> numbers{};
  for (std::size_t i = 0; i < 3; ++i) numbers[i] = std::strtof(texts[i].get_ref<const std::string&>().c_str(), nullptr);
  return numbers;
}

// The mesh of the scene, with all else as in this rendering.
inline MeshRendering mesh_in(const Json& scene, MeshRendering rendering) {
  const Json& its = scene.at("mesh");
  mesh::TriangleMesh mesh;
  for (const Json& vertex : its.at("vertices_mm")) mesh.vertices.push_back(numbers_of(vertex));
  its.at("triangles").get_to(mesh.triangles);
  rendering.normals.clear();
  if (its.contains("corner_normals"))
    for (const Json& corners : its.at("corner_normals"))
      rendering.normals.push_back({numbers_of(corners[0]), numbers_of(corners[1]), numbers_of(corners[2])});
  rendering.checked = std::get<mesh::CheckedMesh>(mesh::check_any(std::move(mesh)));
  rendering.sides = scene.at("parameters").at("sides") == "both" ? mesh::Sides::both : mesh::Sides::front;
  if (scene.at("parameters").at("shading") == "none") rendering.shading = mesh::Shading::none;
  if (!scene.at("parameters").contains("contact")) rendering.contact = mesh::kUsualContact;
  if (!its.contains("materials")) rendering.materials = {};
  return rendering;
}

class OwnRenderer final : public RendererUnderTest {
 public:
  OwnRenderer(Description its, const Json& scene, const Spoiler& spoiler) {
    if (auto* mesh = std::get_if<MeshRendering>(&its.what)) *mesh = mesh_in(scene, *mesh);
    Json hello{{"kind", "renderer"},
               {"name", "own"},
               {"version", "1"},
               {"memory", "path"},
               {"answers", "force"},
               {"claims", "definition"},
               {"length_unit", "mm"},
               {"force_unit", "N"},
               {"frame", {"x", "y", "z"}},
               {"domain_mm", 10000},
               {"rate_Hz", nullptr},
               {"loop_energy_mJ", nullptr},
               {"sides", mesh::kSidesNames},
               {"shading", mesh::kShadingNames},
               {"meshes", "any"},
               {"proxy_radius_mm", 0}};
    if (spoiler) spoil_ = spoiler(its, hello);
    subject_ = properties::subject_of(its);
    hello_ = hello_of(hello, scene);
  }

  const Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                       std::span<const std::uint32_t> periods) override {
    if (is_reset || !session_)
      session_.emplace(
          subject_->renderer().open(),
          std::get<fast::Damping>(fast::Damping::build(hello_.damping.value_or(damping::Parameters{.rate = 1000}))));
    std::vector<Eigen::Vector3f> forces;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      forces.push_back(session_->step_after(periods.empty() ? 1 : periods[i], positions[i]).force);
      if (spoil_) spoil_(positions[i], forces.back(), is_reset && i == 0);
    }
    return forces;
  }

  void say_goodbye() override {}

 private:
  std::unique_ptr<properties::Subject> subject_;
  std::optional<fast::DampedSession> session_;
  Hello hello_;
  Spoil spoil_;
};

inline OpenRenderer own_renderer(const Description& description, const Spoiler& spoiler = nullptr) {
  return [=](const Json& scene) { return std::make_unique<OwnRenderer>(description, scene, spoiler); };
}

}  // namespace forceshade::conformance
