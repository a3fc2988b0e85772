// Packed vectors: aligned as their scalars are.
#pragma once

#include "msl_conversions.h"

#define MSL_PACKED(T, N) \
struct packed_##T##N { \
  T at[N]; \
  packed_##T##N() = default; \
  packed_##T##N(const T##N& v) { for (int i = 0; i < N; i++) at[i] = v[i]; } \
  operator T##N() const { T##N v; for (int i = 0; i < N; i++) v[i] = at[i]; return v; } \
  T& operator[](int i) { return at[i]; } \
  T operator[](int i) const { return at[i]; } \
}; \
namespace msl { template <> struct packed<packed_##T##N> { typedef T##N vector; }; }
MSL_PACKED(float, 2) MSL_PACKED(float, 3) MSL_PACKED(float, 4)
MSL_PACKED(int, 2) MSL_PACKED(int, 3) MSL_PACKED(int, 4)
MSL_PACKED(uint, 2) MSL_PACKED(uint, 3) MSL_PACKED(uint, 4)
MSL_PACKED(half, 2) MSL_PACKED(half, 3) MSL_PACKED(half, 4)
