// Bits of integers.
#pragma once

#include "msl_components.h"

namespace metal {
template <class T> constexpr int bits_of = 8 * sizeof(T);
MSL_F1(popcount, sizeof(T) == 8 ? __builtin_popcountll(x) : __builtin_popcount((uint)x & (uint)(~0ull >> (64 - bits_of<T>))))
MSL_F1(clz, x == 0 ? bits_of<T> : sizeof(T) == 8 ? __builtin_clzll(x) : __builtin_clz((uint)x & (uint)(~0ull >> (64 - bits_of<T>))) - (32 - bits_of<T>))
MSL_F1(ctz, x == 0 ? bits_of<T> : sizeof(T) == 8 ? __builtin_ctzll(x) : __builtin_ctz((uint)x))
MSL_F1(reverse_bits, sizeof(T) == 8 ? __builtin_bitreverse64(x) : __builtin_bitreverse32((uint)x) >> (sizeof(T) == 8 ? 0 : 32 - bits_of<T>))
template <class A> inline A extract_bits(A a, uint offset, uint count) {
  typedef msl::scalar<A> T;
  auto one = [&](T x) -> T { if (count == 0) return 0; uint up = bits_of<T> - offset - count; return (T)((T)((ulong)x << up) >> (bits_of<T> - count)); };
  if constexpr (msl::is_vector<A>) { A r; for (int i = 0; i < msl::size<A>; i++) r[i] = one(a[i]); return r; } else return one(a);
}
template <class A> inline A insert_bits(A base, A insert, uint offset, uint count) {
  typedef msl::scalar<A> T;
  ulong mask = count == 0 ? 0 : (~0ul >> (64 - count)) << offset;
  auto one = [&](T b, T i) -> T { return (T)(((ulong)b & ~mask) | (((ulong)i << offset) & mask)); };
  if constexpr (msl::is_vector<A>) { A r; for (int i = 0; i < msl::size<A>; i++) r[i] = one(base[i], insert[i]); return r; } else return one(base, insert);
}
} // namespace metal
