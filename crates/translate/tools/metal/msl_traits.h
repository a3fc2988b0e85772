// What a type is made of: the scalar and the size of anything, and the vector of a scalar and a size.
#pragma once

#include "msl_vectors.h"

namespace msl {
// Scalar type and size of anything; a mask counts as truth.
template <class T> struct traits { typedef T scalar; static constexpr int size = 1; static constexpr bool is_vector = false; };
template <class T, int N> struct traits<vec<T, N>> { typedef T scalar; static constexpr int size = N; static constexpr bool is_vector = true; };
#define MSL_TRAITS(V, T, N) template <> struct traits<V> { typedef T scalar; static constexpr int size = N; static constexpr bool is_vector = true; };
MSL_TRAITS(float2, float, 2) MSL_TRAITS(float3, float, 3) MSL_TRAITS(float4, float, 4)
MSL_TRAITS(uint2, uint, 2) MSL_TRAITS(uint3, uint, 3) MSL_TRAITS(uint4, uint, 4)
MSL_TRAITS(mask2, bool, 2) MSL_TRAITS(mask3, bool, 3) MSL_TRAITS(mask4, bool, 4)
template <class V> constexpr bool is_vector = traits<bare<V>>::is_vector;
template <class V> constexpr int size = traits<bare<V>>::size;
template <class V> using scalar = typename traits<bare<V>>::scalar;
template <class V> inline scalar<V> element(const V& v, int i) { if constexpr (is_vector<V>) return (scalar<V>)v[i]; else return v; }

// The vector of a scalar type and a size.
template <class T, int N> struct vector_ { typedef vec<T, N> type; };
template <class T> struct vector_<T, 1> { typedef T type; };
template <> struct vector_<float, 2> { typedef float2 type; };
template <> struct vector_<float, 3> { typedef float3 type; };
template <> struct vector_<float, 4> { typedef float4 type; };
template <> struct vector_<uint, 2> { typedef uint2 type; };
template <> struct vector_<uint, 3> { typedef uint3 type; };
template <> struct vector_<uint, 4> { typedef uint4 type; };
template <class T, int N> using vector = typename vector_<T, N>::type;
} // namespace msl
