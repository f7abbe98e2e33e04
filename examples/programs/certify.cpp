// SPDX-License-Identifier: BSD-3-Clause
// Certifies your own renderer against the exact wall, at a million points and with other stiffnesses: certify FILE.
#include <forceshade/certify.h>
#include <forceshade/properties.h>

#include <cstdio>
#include <fstream>

using namespace forceshade;

Renderer my_wall(LawId, const Parameters& wall) {
  return properties::renderer_answering([stiffness = wall.stiffness](const Eigen::Vector3f& p) -> properties::Rendered {
    if (!(p.array().abs() <= 1e4F).all()) return {{0, 0, 0}, Status::invalid};
    if (!(p.z() <= -0x1p-30F)) return {{0, 0, 0}, Status::free};  // nearer to 0 than the position quantum is 0
    return {{0, 0, stiffness * -p.z()}, Status::contact};         // N/mm, mm; N
  });
}

int main(int argc, char** argv) {
  if (argc != 2) return std::puts("usage: certify FILE"), 2;
  const std::shared_ptr<properties::Subject> subject = properties::law_subject(LawId::wall, {.stiffness = 0.5F}, my_wall);
  const auto certificate = properties::certify(
      {.subjects = {subject}}, [](auto, double) {}, false);
  std::ofstream(argv[1]) << properties::to_json(*certificate);
  return std::puts(certificate->held() ? "held" : "failed"), certificate->held() ? 0 : 1;
}
