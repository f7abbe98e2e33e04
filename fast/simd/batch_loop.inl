// SPDX-License-Identifier: BSD-3-Clause
// The batch loop, included once by each fast/batch_<set>.cpp inside namespace forceshade::fast, over that file's Pack.
// It runs the laws' own first stage; IEEE arithmetic makes every instruction set agree with the scalar call bit for bit.

namespace {

// Rounding has a loop of its own: in the first one it would wait for square roots and divisions, and what waits is in the way
// of the next step. Laws that need no rounding test are rounded at once.
template <class Definition>
bool answer_block(const Definition& definition, const float* x, const float* z, float* fx, float* fz) {
  using Two = Pair<Pack>;
  constexpr int kWindow = doubt_window(Definition::kErrorBound);
  const Definition law = definition;  // a copy that the stores below cannot alias
  alignas(64) double near_x[kBlock], near_z[kBlock];
  Watch watch;
  Two::Mask doubt = never<Two>();
  for (std::size_t i = 0; i < kBlock; i += Two::kLanes) {
    watch.coordinates(x + i);
    watch.coordinates(z + i);
    const FirstStage<Two> force = law.first_stage(Two::load(x + i), Two::load(z + i));
    doubt = doubt | force.doubt;
    if constexpr (kWindow == 0) {
      (force.x + Two(0)).store(fx + i);  // + 0 turns -0 into +0
      (force.z + Two(0)).store(fz + i);
    } else {
      force.x.store(near_x + i);
      force.z.store(near_z + i);
    }
  }
  if constexpr (kWindow > 0) {
    for (std::size_t i = 0; i < kBlock; i += Pack::kLanes) {
      const Pack force_x = Pack::load(near_x + i);
      const Pack force_z = Pack::load(near_z + i);
      watch.rounding<kWindow>(force_x);
      watch.rounding<kWindow>(force_z);
      (force_x + Pack(0)).store(fx + i);
      (force_z + Pack(0)).store(fz + i);
    }
  }
  // Not &&: g++ would gather the watch in a second pass.
  return (static_cast<int>(!doubt.any()) & static_cast<int>(watch.is_free_of_hazards<kWindow>())) != 0;
}

const char* fault_here() {
  return arithmetic_fault_here();
}

template <class... Definition>
constexpr BlocksOf<Definition...> filled(LawList<Definition...>) {
  return {BlockOf<Definition>{&answer_block<Definition>}..., &take_rows_apart, &put_rows_together, &fault_here};
}

constexpr BlockTable kBlocks = filled(Laws());

}  // namespace
