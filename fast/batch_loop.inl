// SPDX-License-Identifier: BSD-3-Clause
// The batch loop, included once by each fast/batch_<set>.cpp inside namespace forceshade::fast, over that file's Pack.
// It runs the laws' own first stage; IEEE arithmetic makes every instruction set agree with the scalar call bit for bit.

namespace {

template <class Definition>
bool answer_block(const Definition& definition, const float* x, const float* z, float* fx, float* fz) {
  const Definition law = definition;  // a copy that the stores below cannot alias
  const Pack zero(0.0), limit(static_cast<double>(kLargestCoordinate)), quantum(static_cast<double>(kPositionQuantum));
  Pack::Mask attention = never<Pack>();
  for (std::size_t i = 0; i < kBlock; i += Pack::kLanes) {
    const Pack raw_x = Pack::load(x + i);
    const Pack raw_z = Pack::load(z + i);
    const Pack size_x = absolute(raw_x);
    const Pack size_z = absolute(raw_z);
    const FirstStage<Pack> force =
        law.first_stage(select(size_x >= quantum, raw_x, zero), select(size_z >= quantum, raw_z, zero));
    const Pack::Mask valid = (size_x <= limit) & (size_z <= limit);
    attention = attention | !valid | force.doubt | rounding_is_in_doubt<Definition::kErrorBound>(force.x) |
                rounding_is_in_doubt<Definition::kErrorBound>(force.z);
    (select(force.contact, force.x, zero) + zero).store(fx + i);  // + 0 turns -0 into +0
    (select(force.contact, force.z, zero) + zero).store(fz + i);
  }
  return !attention.any();
}

constexpr BlockTable kBlocks{
    &answer_block<Wall>,         &answer_block<Cylinder>,     &answer_block<BumpCylinder>,
    &answer_block<Bump1p>,       &answer_block<Bump2p>,       &answer_block<Bump3p>,
    &answer_block<Bump1pShaded>, &answer_block<Bump2pShaded>, &answer_block<Bump3pShaded>,
};

}  // namespace
