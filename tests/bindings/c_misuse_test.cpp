// SPDX-License-Identifier: BSD-3-Clause
// Every misuse of the C interface is an error with a sentence, and never a crash.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "forceshade.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/misuse.h"
#include "tests/bindings/subjects.h"

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();

// All zeros, but for its size.
template <class Struct>
Struct sized() {
  Struct its{};
  its.size = sizeof its;
  return its;
}

using forceshade::tests::Misuse;
using forceshade::tests::misuses_of_batches;
using forceshade::tests::Use;

const std::vector<float> kHeights(16, 0.25F);

class CMisuse : public testing::Test {
 protected:
  CMisuse() {
    map.heights = kHeights.data();
    map.columns = map.rows = 4;
    map.column_stride = 4;
    map.row_stride = 16;
    map.pitch = map.stiffness = 0.5F;

    forceshade_law_new("bump-2p", &law, &bump);
    forceshade_mesh_new(&mesh, &tetrahedron);
    forceshade_session_open(bump, &of_bump);
    forceshade_session_open(tetrahedron, &of_mesh);
    forceshade_law_new("wall", &law, &freed);
    forceshade_session_open(freed, &closed);
    forceshade_subject_free(freed);
    forceshade_session_close(closed);
  }
  ~CMisuse() override {
    forceshade_session_close(of_bump);
    forceshade_session_close(of_mesh);
    forceshade_subject_free(bump);
    forceshade_subject_free(tetrahedron);
  }

  // A law, map, mesh, batch or state that is right but for what `change` does to it.
  template <class Struct, class Call>
  static Use with(Struct its, const std::function<void(Struct&)>& change, const Call& call) {
    change(its);
    return [its, call]() mutable { return call(its); };
  }
  auto new_law(const char* name, const std::function<void(forceshade_law&)>& change) const {
    return with<forceshade_law>(law, change, [name](forceshade_law& its) {
      forceshade_subject made{42};
      const forceshade_result result = forceshade_law_new(name, &its, &made);
      EXPECT_EQ(made.handle, 42U) << "nothing is written where nothing is made";
      return result;
    });
  }
  auto new_map(const std::function<void(forceshade_height_map&)>& change) const {
    return with<forceshade_height_map>(map, change, [](forceshade_height_map& its) {
      forceshade_subject made{};
      return forceshade_height_map_new(&its, &made);
    });
  }
  auto new_mesh(const std::function<void(forceshade_mesh&)>& change) const {
    return with<forceshade_mesh>(mesh, change, [](forceshade_mesh& its) {
      forceshade_subject made{};
      return forceshade_mesh_new(&its, &made);
    });
  }
  auto forces(const std::function<void(forceshade_batch&)>& change) {
    return with<forceshade_batch>(batch, change,
                                  [this](forceshade_batch& its) { return forceshade_forces(bump, &its, nullptr); });
  }
  auto steps(const std::function<void(forceshade_batch&)>& change) {
    return with<forceshade_batch>(batch, change,
                                  [this](forceshade_batch& its) { return forceshade_session_steps(of_mesh, &its, nullptr); });
  }
  auto advance(const std::function<void(forceshade_batch&)>& change) {
    return with<forceshade_batch>(
        batch, change, [this](forceshade_batch& its) { return forceshade_advance(tetrahedron, states.data(), &its, nullptr); });
  }
  auto resume(forceshade_session session, const std::function<void(forceshade_state&)>& change) const {
    return with<forceshade_state>(sized<forceshade_state>(), change,
                                  [session](forceshade_state& its) { return forceshade_session_resume(session, &its); });
  }

  static std::vector<Use> every_use_of(forceshade_subject subject) {
    static std::array<float, 3> at{}, force{};
    static std::array<char, 8> text{};
    static forceshade_session session{};
    static forceshade_damping damping = sized<forceshade_damping>();
    static const forceshade_batch none = sized<forceshade_batch>();
    return {[=] { return forceshade_force(subject, at.data(), force.data(), nullptr); },
            [=] { return forceshade_forces(subject, &none, nullptr); },
            [=] { return forceshade_advance(subject, nullptr, &none, nullptr); },
            [=] { return forceshade_session_open(subject, &session); },
            [=] { return forceshade_subject_text(subject, FORCESHADE_KIND, text.data(), text.size(), nullptr); },
            [=] { return forceshade_certificate_covers("absent.json", subject); },
            [=] { return forceshade_subject_damping(subject, 1000, &damping); },
            [=] { return forceshade_subject_free(subject); }};
  }
  static std::vector<Use> every_use_of(forceshade_session session) {
    static std::array<float, 3> at{}, force{};
    static forceshade_state state = sized<forceshade_state>();
    static const forceshade_batch none = sized<forceshade_batch>();
    static const forceshade_damping damping{sizeof damping, 1000, 1, 1, 2, 0, 0.25F};
    static forceshade_damping_state damped = sized<forceshade_damping_state>();
    return {[=] { return forceshade_session_step(session, at.data(), force.data(), nullptr); },
            [=] { return forceshade_session_damped_step(session, &damping, &damped, 1, at.data(), force.data(), nullptr); },
            [=] { return forceshade_session_steps(session, &none, nullptr); },
            [=] { return forceshade_session_reset(session); },
            [=] { return forceshade_session_state(session, &state); },
            [=] { return forceshade_session_resume(session, &state); },
            [=] { return forceshade_session_close(session); }};
  }

  forceshade_law law{sizeof(forceshade_law), 15.24F, 25.4F, 0.5F};
  forceshade_height_map map = sized<forceshade_height_map>();
  forceshade_mesh mesh = forceshade::tests::tetrahedron_mesh();
  std::array<float, 6> at{1, 2, 3, 4, 5, 6}, to{};
  std::array<forceshade_status, 2> statuses{};
  std::array<forceshade_state, 2> states{sized<forceshade_state>(), sized<forceshade_state>()};
  forceshade_state small{};
  forceshade_batch batch = forceshade::tests::batch_of(at, to, statuses);
  forceshade_subject bump{}, tetrahedron{}, freed{};
  forceshade_session of_bump{}, of_mesh{}, closed{};
};

// A word of characters of four bytes each is shortened to 64 bytes at most.
TEST_F(CMisuse, cuts_no_character) {
  for (const std::string before : {"", "a", "ab", "abc"}) {
    std::string word = before;
    for (int i = 0; i < 30; ++i) word += "\xF0\x9F\x99\x82";
    const std::string kept = word.substr(0, before.size() + (before.empty() ? 64U : 60U));
    forceshade_subject made{};
    EXPECT_EQ(forceshade_law_new(word.c_str(), &law, &made), FORCESHADE_BAD_VALUE);
    EXPECT_TRUE(std::string(forceshade_message()).ends_with(", got \"" + kept + '"')) << forceshade_message();
    forceshade_mesh its = mesh;
    its.sides = word.c_str();
    EXPECT_EQ(forceshade_mesh_new(&its, &made), FORCESHADE_BAD_VALUE);
    EXPECT_TRUE(std::string(forceshade_message()).ends_with(", got \"" + kept + '"')) << forceshade_message();
  }
  forceshade_mesh none = mesh;
  none.triangle_count = 0;
  forceshade_subject made{};
  EXPECT_EQ(forceshade_mesh_new(&none, &made), FORCESHADE_BAD_VALUE);
  EXPECT_TRUE(std::string(forceshade_message()).ends_with("vertices")) << "no line feed at the end of a sentence";
}

TEST_F(CMisuse, of_every_kind_has_its_result_and_its_sentence) {
  forceshade_subject made{};
  forceshade_scene scene{};
  std::array<float, 3> position{}, force{};
  std::array<std::uint32_t, 12> other{};
  std::copy_n(mesh.triangles, 12, other.begin());
  other[0] = 7;
  std::array<float, 12> flat{};
  std::array<float, 12> nan{};
  std::copy_n(mesh.vertices, 12, nan.begin());
  nan[4] = kNan;
  std::vector<float> steep(16, 0.25F);
  steep[5] = kNan;
  const auto null = FORCESHADE_NULL_POINTER, size = FORCESHADE_BAD_SIZE, value = FORCESHADE_BAD_VALUE,
             input = FORCESHADE_BAD_INPUT, kind = FORCESHADE_WRONG_KIND;
  std::vector<Misuse> misuses{
      {"law name null", [&] { return forceshade_law_new(nullptr, &law, &made); }, null, "NULL"},
      {"law parameters null", [&] { return forceshade_law_new("wall", nullptr, &made); }, null, "NULL"},
      {"law made null", [&] { return forceshade_law_new("wall", &law, nullptr); }, null, "NULL"},
      {"law unknown", new_law("bump-4p", [](auto&) {}), value, "got \"bump-4p\""},
      {"law empty name", new_law("", [](auto&) {}), value, "got \"\""},
      {"law size 0", new_law("wall", [](auto& its) { its.size = 0; }), size, "forceshade_law.size is 0"},
      {"law size small", new_law("wall", [](auto& its) { its.size -= 4; }), size, "expected sizeof(forceshade_law)"},
      {"law radius 0", new_law("bump-2p", [](auto& its) { its.radius = 0; }), value, "radius is 0 mm; expected 0.1 to 10000"},
      {"law radius NaN", new_law("bump-2p", [](auto& its) { its.radius = kNan; }), value, "radius is nan"},
      {"law radius infinite", new_law("bump-2p", [](auto& its) { its.radius = kInfinite; }), value, "radius is inf"},
      {"law width wide", new_law("bump-2p", [](auto& its) { its.width = 31; }), value, "width is 31 mm"},
      {"law width negative", new_law("bump-2p", [](auto& its) { its.width = -1; }), value, "width is -1 mm"},
      {"law stiffness 0", new_law("wall", [](auto& its) { its.stiffness = 0; }), value, "stiffness is 0 N/mm"},
      {"law stiffness NaN", new_law("wall", [](auto& its) { its.stiffness = kNan; }), value, "stiffness is nan"},
      {"law stiffness stiff", new_law("wall", [](auto& its) { its.stiffness = 1001; }), value, "stiffness is 1001 N/mm"},

      {"map null", [&] { return forceshade_height_map_new(nullptr, &made); }, null, "NULL"},
      {"map made null", [&] { return forceshade_height_map_new(&map, nullptr); }, null, "NULL"},
      {"map heights null", new_map([](auto& its) { its.heights = nullptr; }), null, "heights"},
      {"map size", new_map([](auto& its) { its.size = 8; }), size, "forceshade_height_map.size is 8"},
      {"map one column", new_map([](auto& its) { its.columns = 1; }), size, "columns and rows are 1 and 4"},
      {"map no rows", new_map([](auto& its) { its.rows = 0; }), size, "4 and 0"},
      {"map wide", new_map([](auto& its) { its.columns = 40000; }), size, "expected 2 to 32768"},
      {"map large", new_map([](auto& its) { its.columns = its.rows = 32768; }), size, "67108864 samples"},
      {"map stride", new_map([](auto& its) { its.column_stride = 3; }), size, "multiples of 4"},
      {"map row stride", new_map([](auto& its) { its.row_stride = 17; }), size, "multiples of 4"},
      {"map pitch 0", new_map([](auto& its) { its.pitch = 0; }), value, "pitch"},
      {"map pitch NaN", new_map([](auto& its) { its.pitch = kNan; }), value, "pitch"},
      {"map height NaN", new_map([&](auto& its) { its.heights = steep.data(); }), value,
       "column 1, row 1 is nan; expected -10000"},
      {"map interpolant", new_map([](auto& its) { its.interpolant = "linear"; }), value, "interpolant: expected bilinear or"},
      {"map edge", new_map([](auto& its) { its.edge = ""; }), value, "edge: expected clamp or tile, got \"\""},
      {"map render", new_map([](auto& its) { its.render = "shaded"; }), value, "render: expected height-map, "},
      {"map stiffness", new_map([](auto& its) { its.stiffness = -1; }), value, "stiffness is -1"},

      {"mesh null", [&] { return forceshade_mesh_new(nullptr, &made); }, null, "NULL"},
      {"mesh made null", [&] { return forceshade_mesh_new(&mesh, nullptr); }, null, "NULL"},
      {"mesh vertices null", new_mesh([](auto& its) { its.vertices = nullptr; }), null, "vertices"},
      {"mesh triangles null", new_mesh([](auto& its) { its.triangles = nullptr; }), null, "triangles"},
      {"mesh size", new_mesh([](auto& its) { its.size = 0; }), size, "forceshade_mesh.size is 0"},
      {"mesh too many", new_mesh([](auto& its) { its.triangle_count = std::size_t{1} << 40U; }), size,
       "expected 268435456 at most"},
      {"mesh too many vertices", new_mesh([](auto& its) { its.vertex_count = (std::size_t{1} << 28U) + 1; }), size,
       "268435457"},
      {"scene of too many", [&] { return forceshade_scene_open(&bump, SIZE_MAX, &scene); }, value, "expected 1 to 32"},
      {"mesh empty", new_mesh([](auto& its) { its.triangle_count = 0; }), value, "cannot be rendered"},
      {"mesh index", new_mesh([&](auto& its) { its.triangles = other.data(); }), value, "cannot be rendered"},
      {"mesh flat", new_mesh([&](auto& its) { its.vertices = flat.data(); }), value, "cannot be rendered"},
      {"mesh NaN", new_mesh([&](auto& its) { its.vertices = nan.data(); }), value, "cannot be rendered"},
      {"mesh sides", new_mesh([](auto& its) { its.sides = "back"; }), value, "sides: expected front or both, got \"back\""},
      {"mesh shading", new_mesh([](auto& its) { its.shading = "smooth"; }), value, "shading: expected none, vertex or edge"},
      {"mesh texture", new_mesh([](auto& its) { its.shading = "texture"; }), value, "shading: expected"},
      {"mesh contact", new_mesh([](auto& its) { its.contact = "x"; }), value, "contact: expected direct, sub-goal or"},
      {"mesh crease", new_mesh([](auto& its) { its.crease = 181; }), value, "crease is 181"},
      {"mesh crease NaN", new_mesh([](auto& its) { its.crease = std::nan(""); }), value, "crease is nan"},
      {"mesh stiffness", new_mesh([](auto& its) { its.stiffness = kNan; }), value, "stiffness is nan"},

      {"certificate null", [&] { return forceshade_certificate_covers(nullptr, bump); }, null, "file is NULL"},
      {"certificate absent", [&] { return forceshade_certificate_covers("no.json", bump); }, input, "no.json"},
      {"certificate a folder", [&] { return forceshade_certificate_covers("/", bump); }, input, "/"},
      {"certificate of no JSON", [&] { return forceshade_certificate_covers(FORCESHADE_SOURCE_DIR "/LICENSE", bump); }, input,
       "LICENSE"},

      {"force position null", [&] { return forceshade_force(bump, nullptr, force.data(), nullptr); }, null, "NULL"},
      {"force null", [&] { return forceshade_force(bump, position.data(), nullptr, nullptr); }, null, "NULL"},
      {"force of a mesh", [&] { return forceshade_force(tetrahedron, position.data(), force.data(), nullptr); }, kind, "path"},
      {"forces of a mesh", [&] { return forceshade_forces(tetrahedron, &batch, nullptr); }, kind, "path"},
      {"batch null", [&] { return forceshade_forces(bump, nullptr, nullptr); }, null, "batch is NULL"},
      {"steps batch null", [&] { return forceshade_session_steps(of_mesh, nullptr, nullptr); }, null, "batch is NULL"},
      {"text what", [&] { return forceshade_subject_text(bump, 4, nullptr, 0, nullptr); }, value, "what is 4"},
      {"text what negative", [&] { return forceshade_subject_text(bump, -1, nullptr, 0, nullptr); }, value, "what is -1"},
      {"text buffer null", [&] { return forceshade_subject_text(bump, 0, nullptr, 5, nullptr); }, null, "text is NULL"},

      {"open made null", [&] { return forceshade_session_open(bump, nullptr); }, null, "NULL"},
      {"step position null", [&] { return forceshade_session_step(of_mesh, nullptr, force.data(), nullptr); }, null, "NULL"},
      {"step force null", [&] { return forceshade_session_step(of_mesh, position.data(), nullptr, nullptr); }, null, "NULL"},
      {"state null", [&] { return forceshade_session_state(of_mesh, nullptr); }, null, "NULL"},
      {"resume null", [&] { return forceshade_session_resume(of_mesh, nullptr); }, null, "NULL"},
      {"resume size", resume(of_mesh, [](auto& its) { its.size = 4; }), size, "sizeof(forceshade_state)"},
      {"resume place", resume(of_mesh, [](auto& its) { its.place = 5; }), value, "place"},
      {"resume side", resume(of_mesh, [](auto& its) { its.side = 2; }), value, "side"},
      {"resume meeting", resume(of_mesh, [](auto& its) { its.meeting = 8; }), value, "meeting"},
      {"resume meeting of another place", resume(of_mesh, [](auto& its) { its.meeting = FORCESHADE_MEETS_EDGE; }), value,
       "meeting"},
      {"advance batch null", [&] { return forceshade_advance(tetrahedron, states.data(), nullptr, nullptr); }, null,
       "batch is NULL"},
      {"advance states null", [&] { return forceshade_advance(tetrahedron, nullptr, &batch, nullptr); }, null, "NULL"},
      {"advance states size", [&] { return forceshade_advance(tetrahedron, &small, &batch, nullptr); }, size,
       "sizeof(forceshade_state)"},
      {"resume a law", resume(of_bump, [](auto& its) { its.place = FORCESHADE_IN_TRIANGLE; }), kind, "remembers nothing"},
  };
  add(misuses, forceshade::tests::misuses_of_files(&forceshade_subject_read, &forceshade_subject_parse));
  add(misuses, misuses_of_batches("batch ", [this](const auto& change) { return forces(change); }));
  add(misuses, misuses_of_batches("steps batch ", [this](const auto& change) { return steps(change); }));
  add(misuses, misuses_of_batches("advance batch ", [this](const auto& change) { return advance(change); }));
  add_handles<forceshade_subject>(
      misuses, "subject", {{0}, {1}, {UINT64_MAX}, {bump.handle + 1000000}, {bump.handle ^ (std::uint64_t{1} << 40U)}, freed},
      [](forceshade_subject subject) { return every_use_of(subject); });
  add_handles<forceshade_session>(misuses, "session",
                                  {{0}, {7}, {UINT64_MAX}, {of_mesh.handle ^ (std::uint64_t{1} << 33U)}, closed},
                                  [](forceshade_session session) { return every_use_of(session); });
  expect_each(misuses, &forceshade_message, 150);
  // All that was made is as it was.
  EXPECT_EQ(forceshade_forces(bump, &batch, nullptr), FORCESHADE_OK);
  EXPECT_EQ(forceshade_session_steps(of_mesh, &batch, nullptr), FORCESHADE_OK);
}

// One thread's batch takes some time; another's calls meet it there. Whoever is second gets the error, and nothing breaks.
TEST_F(CMisuse, two_threads_in_one_session_is_an_error_for_the_second) {
  std::vector<float> many(3 * 200000, 1), forces(many.size());
  forceshade_batch all = batch;
  all.count = many.size() / 3;
  all.positions = many.data();
  all.forces = forces.data();
  all.statuses = nullptr;
  std::atomic<bool> stop = false;
  std::atomic<int> refused = 0;
  std::thread other([&] {
    while (!stop) forceshade_session_steps(of_mesh, &all, nullptr);
  });
  std::array<float, 3> force{};
  std::string words;
  for (int i = 0; i < 10000000 && refused < 20; ++i)
    if (const forceshade_result result = forceshade_session_step(of_mesh, at.data(), force.data(), nullptr);
        result != FORCESHADE_OK) {
      EXPECT_EQ(result, FORCESHADE_BUSY);
      words = forceshade_message();
      ++refused;
    }
  stop = true;
  other.join();
  EXPECT_EQ(refused, 20);
  EXPECT_EQ(words, "another thread is in this session, which is for one at a time");
  EXPECT_EQ(forceshade_session_step(of_mesh, at.data(), force.data(), nullptr), FORCESHADE_OK);
}

// Threads that open, step and close sessions, and now and then close one that another has closed.
TEST_F(CMisuse, threads_that_close_each_others_sessions_get_errors_and_nothing_else) {
  std::vector<std::atomic<std::uint64_t>> shared(8);
  std::vector<std::thread> threads;
  std::atomic<int> other_results = 0;
  for (unsigned t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      std::array<float, 3> force{};
      for (unsigned i = 0; i < 20000; ++i) {
        std::atomic<std::uint64_t>& slot = shared[(i * 5 + t) % shared.size()];
        forceshade_session session{slot.load()};
        forceshade_result result = FORCESHADE_OK;
        switch ((i + t) % 3) {
          case 0:
            result = forceshade_session_open(tetrahedron, &session);
            if (const std::uint64_t before = slot.exchange(session.handle)) forceshade_session_close({before});
            break;
          case 1: result = forceshade_session_step(session, at.data(), force.data(), nullptr); break;
          default: result = forceshade_session_close(session);
        }
        if (result != FORCESHADE_OK && result != FORCESHADE_BUSY && result != FORCESHADE_BAD_HANDLE) ++other_results;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(other_results, 0);
  for (const auto& slot : shared) forceshade_session_close({slot.load()});
}

TEST_F(CMisuse, an_arithmetic_that_is_not_ieee_754_is_refused_where_something_is_made_or_opened) {
  std::fesetround(FE_UPWARD);
  forceshade_subject made{};
  forceshade_session opened{};
  const forceshade_result of_law = forceshade_law_new("wall", &law, &made), of_session = forceshade_session_open(bump, &opened);
  const char* const fault = forceshade_arithmetic_fault();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(of_law, FORCESHADE_BAD_ARITHMETIC);
  EXPECT_EQ(of_session, FORCESHADE_BAD_ARITHMETIC) << forceshade_message();
  EXPECT_NE(fault, nullptr);
}

}  // namespace
