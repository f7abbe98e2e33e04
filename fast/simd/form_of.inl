// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The form in which a batch evaluates each law: FormOf<Definition>::Type. For the files that have a Pack alone.

#include "fast/laws/all.h"
#include "fast/simd/bump_form.inl"
#include "fast/simd/cylinder_form.inl"
#include "fast/simd/wall_form.inl"

namespace forceshade::fast {
namespace {

template <class Definition>
struct FormOf;

template <class Form>
struct IsForm {
  using Type = Form;
};

template <>
struct FormOf<Wall> : IsForm<WallForm> {};
template <>
struct FormOf<Cylinder> : IsForm<CylinderForm<Cylinder>> {};
template <>
struct FormOf<BumpCylinder> : IsForm<CylinderForm<BumpCylinder>> {};
template <>
struct FormOf<Bump1p> : IsForm<WallForm> {};
template <>
struct FormOf<Bump2p> : IsForm<BumpForm<Bump2p, GapOfSides, NormalOfSides>> {};
template <>
struct FormOf<Bump3p> : IsForm<BumpForm<Bump3p, GapOfSidesAndTop, NormalOfSidesAndTop>> {};
template <>
struct FormOf<Bump1pShaded> : IsForm<BumpForm<Bump1pShaded, GapOfPlane, NormalOfCylinder>> {};
template <>
struct FormOf<Bump2pShaded> : IsForm<BumpForm<Bump2pShaded, GapOfSides, NormalOfCylinder>> {};
template <>
struct FormOf<Bump3pShaded> : IsForm<BumpForm<Bump3pShaded, GapOfSidesAndTop, NormalOfCylinder>> {};

}  // namespace
}  // namespace forceshade::fast
