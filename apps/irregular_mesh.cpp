// SPDX-License-Identifier: BSD-3-Clause
#include "apps/irregular_mesh.h"

#include <nlohmann/json.hpp>

#include "text/joined.h"
#include "text/number_text.h"

namespace forceshade::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPlaces = mesh::Irregularities::kListed;

std::string words_of_point(const mesh::Vertex& point) {
  return "(" + shortest(point[0]) + ", " + shortest(point[1]) + ", " + shortest(point[2]) + ") mm";
}

template <class Numbers>
std::string words_of_faces(const Numbers& faces) {
  return (faces.size() == 1 ? "face " : "faces ") + joined(faces, ", ", in_digits, " and ");
}

Json json_of_point(const mesh::Vertex& point) {
  return {point[0], point[1], point[2]};
}

}  // namespace

std::vector<Row> rows_of(const mesh::Irregularities& found) {
  std::vector<Row> rows;
  if (found.equal_vertices > 0)
    rows.emplace_back("equal vertices",
                      std::to_string(found.equal_vertices) + " with the coordinates of one before them, and count as that");
  for (std::size_t i = 0; i < found.kinds.size(); ++i) {
    const auto& [count, places] = found.kinds[i];
    if (count == 0) continue;
    const auto place_of = [](const auto& it) { return words_of_faces(it.triangles) + " near " + words_of_point(it.near); };
    const std::string words = std::to_string(count) + ": " + joined(places, "; ", place_of);
    rows.emplace_back(mesh::kIrregularityNames[i], count > places.size() ? words + "; ..." : words);
  }
  if (!found.is_complete) rows.emplace_back("pairs of faces", "too many are near each other to look at all of them");
  return rows;
}

std::vector<Row> rows_of(const mesh::Borders& borders, float nearer_than) {
  std::vector<Row> rows{{"borders", borders.edges == 0
                                        ? "none"
                                        : std::to_string(borders.edges) + " edges with one face, " +
                                              shortest(static_cast<float>(borders.length)) +
                                              " mm in all, around which a hand can go where nothing else touches them"}};
  if (nearer_than == 0 || borders.edges == 0) return rows;
  const auto words_of_crack = [](const mesh::Crack& crack) {
    return words_of_faces(crack.triangles) + ", " + shortest(static_cast<float>(crack.distance)) + " mm apart near " +
           words_of_point(crack.near);
  };
  const std::string words = std::to_string(borders.cracks.size()) +
                            " pairs of faces have such edges nearer to each other than " + shortest(nearer_than) +
                            " mm without touching" + (borders.cracks.empty() ? "" : ", and a hand can pass: ") +
                            joined(first_of(kPlaces, borders.cracks), "; ", words_of_crack);
  rows.emplace_back("cracks", borders.cracks.size() > kPlaces ? words + "; ..." : words);
  return rows;
}

Json json_of(const mesh::Irregularities& found) {
  Json json{{"equal_vertices", found.equal_vertices}, {"all_pairs", found.is_complete}};
  for (std::size_t i = 0; i < found.kinds.size(); ++i) {
    Json places = Json::array();
    for (const auto& [triangles, near] : found.kinds[i].places)
      places.push_back({{"faces", triangles}, {"near_mm", json_of_point(near)}});
    json[std::string(mesh::kIrregularityNames[i])] = {{"count", found.kinds[i].count}, {"first", places}};
  }
  return json;
}

Json json_of(const mesh::Borders& borders, float nearer_than) {
  Json json{{"edges", borders.edges}, {"length_mm", borders.length}};
  if (nearer_than == 0) return json;
  json["nearer_than_mm"] = nearer_than;
  json["cracks"] = Json::array();
  for (const mesh::Crack& crack : borders.cracks)
    json["cracks"].push_back(
        {{"faces", crack.triangles}, {"distance_mm", crack.distance}, {"near_mm", json_of_point(crack.near)}});
  return json;
}

}  // namespace forceshade::apps
