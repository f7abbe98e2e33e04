// SPDX-License-Identifier: BSD-3-Clause
// The batch loop, included once by each fast/batch_<set>.cpp inside namespace forceshade::fast, over that file's Pack.
// It runs the laws' own first stage; IEEE arithmetic makes every instruction set agree with the scalar call bit for bit.

namespace {

template <class Definition>
bool answer_block(const Definition& law, std::size_t count, const float* x, const float* z, float* fx, float* fz) {
  return answer(typename FormOf<Definition>::Type(law), count, x, z, fx, fz);
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
