// What fragments of a quad know of each other, and discarding.
#pragma once

#include "msl_interface.h"
#include "msl_math.h"

namespace metal {
inline void discard_fragment() { msl_discard(); }
template <class V> inline V msl_derivative(const V& v, int axis) {
  V lane[4]; msl_quad(&v, sizeof v, lane);
  int own = msl_lane(), low = axis ? own & 1 : own & 2, high = axis ? low + 2 : low + 1;
  return lane[high] - lane[low];
}
template <class V> inline V dfdx(V v) { return msl_derivative(v, 0); }
template <class V> inline V dfdy(V v) { return msl_derivative(v, 1); }
template <class V> inline V fwidth(V v) { return abs(dfdx(v)) + abs(dfdy(v)); }
} // namespace metal
