// Barriers and atomics. Threads run one at a time, so what is atomic is plain.
#pragma once

#include "msl_interface.h"
#include "msl_scalars.h"

namespace metal {
enum memory_order { memory_order_relaxed };
enum class mem_flags { mem_none, mem_device, mem_threadgroup, mem_texture, mem_threadgroup_imageblock, mem_object_data };
inline void threadgroup_barrier(mem_flags) { msl_barrier(); }
template <class T> struct msl_atomic { T value; };
typedef msl_atomic<int> atomic_int;
typedef msl_atomic<uint> atomic_uint;
typedef msl_atomic<ulong> atomic_ulong;
typedef msl_atomic<float> atomic_float;
template <class T> inline T atomic_load_explicit(const msl_atomic<T>* a, memory_order) { return a->value; }
template <class T, class V> inline void atomic_store_explicit(msl_atomic<T>* a, V v, memory_order) { a->value = (T)v; }
template <class T, class V> inline T atomic_exchange_explicit(msl_atomic<T>* a, V v, memory_order) { T old = a->value; a->value = (T)v; return old; }
template <class T, class V> inline bool atomic_compare_exchange_weak_explicit(msl_atomic<T>* a, T* expected, V v, memory_order, memory_order) {
  T old = a->value; bool same = old == *expected; if (same) a->value = (T)v; else *expected = old; return same;
}
#define MSL_ATOMIC(name, result) template <class T, class V> inline T atomic_##name##_explicit(msl_atomic<T>* a, V v, memory_order) { T x = a->value, y = (T)v; a->value = (result); return x; }
MSL_ATOMIC(fetch_add, x + y) MSL_ATOMIC(fetch_sub, x - y) MSL_ATOMIC(fetch_and, x & y) MSL_ATOMIC(fetch_or, x | y) MSL_ATOMIC(fetch_xor, x ^ y)
MSL_ATOMIC(fetch_min, y < x ? y : x) MSL_ATOMIC(fetch_max, x < y ? y : x)
} // namespace metal
