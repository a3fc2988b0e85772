// Vectors of float and uint are clang's own (`ext_vector_type`). All others are `msl::vec`: a comparison of clang's vectors gives a
// vector of int, 0 or -1, and such a vector must mean truth and nothing else.
#pragma once

#include "msl_scalars.h"

typedef float float2 __attribute__((ext_vector_type(2)));
typedef float float3 __attribute__((ext_vector_type(3)));
typedef float float4 __attribute__((ext_vector_type(4)));
typedef uint uint2 __attribute__((ext_vector_type(2)));
typedef uint uint3 __attribute__((ext_vector_type(3)));
typedef uint uint4 __attribute__((ext_vector_type(4)));

namespace msl {
typedef int mask2 __attribute__((ext_vector_type(2)));
typedef int mask3 __attribute__((ext_vector_type(3)));
typedef int mask4 __attribute__((ext_vector_type(4)));

template <bool C, class A, class B> struct pick { typedef A type; };
template <class A, class B> struct pick<false, A, B> { typedef B type; };
template <class A> struct bare_ { typedef A type; };
template <class A> struct bare_<const A> { typedef A type; };
template <class A> struct bare_<A&> : bare_<A> {};
template <class A> struct bare_<A&&> : bare_<A> {};
template <class A> using bare = typename bare_<A>::type;

template <class T, int N> struct fields;
template <class T> struct fields<T, 2> { union { T at[2]; struct { T x, y; }; struct { T r, g; }; }; };
template <class T> struct alignas(4 * sizeof(T)) fields<T, 3> { union { T at[3]; struct { T x, y, z; }; struct { T r, g, b; }; }; };
template <class T> struct fields<T, 4> { union { T at[4]; struct { T x, y, z, w; }; struct { T r, g, b, a; }; }; };

template <class T, int N> struct vec;

// Swizzles are properties, so that none takes room.
#define MSL_S2(a, i, b, j) __declspec(property(get = get_##a##b)) vec<T, 2> a##b; vec<T, 2> get_##a##b() const { return of(i, j); }
#define MSL_S3(a, i, b, j, c, k) __declspec(property(get = get_##a##b##c)) vec<T, 3> a##b##c; vec<T, 3> get_##a##b##c() const { return of(i, j, k); }
#define MSL_S4(a, i, b, j, c, k, d, l) __declspec(property(get = get_##a##b##c##d)) vec<T, 4> a##b##c##d; vec<T, 4> get_##a##b##c##d() const { return of(i, j, k, l); }
#define MSL_S4_2(p, i, q, j, r, k) MSL_S4(p, i, q, j, r, k, x, 0) MSL_S4(p, i, q, j, r, k, y, 1)
#define MSL_S4_3(p, i, q, j, r, k) MSL_S4_2(p, i, q, j, r, k) MSL_S4(p, i, q, j, r, k, z, 2)
#define MSL_S4_4(p, i, q, j, r, k) MSL_S4_3(p, i, q, j, r, k) MSL_S4(p, i, q, j, r, k, w, 3)
#define MSL_S3_2(p, i, q, j) MSL_S3(p, i, q, j, x, 0) MSL_S3(p, i, q, j, y, 1) MSL_S4_2(p, i, q, j, x, 0) MSL_S4_2(p, i, q, j, y, 1)
#define MSL_S3_3(p, i, q, j) MSL_S3(p, i, q, j, x, 0) MSL_S3(p, i, q, j, y, 1) MSL_S3(p, i, q, j, z, 2) MSL_S4_3(p, i, q, j, x, 0) MSL_S4_3(p, i, q, j, y, 1) MSL_S4_3(p, i, q, j, z, 2)
#define MSL_S3_4(p, i, q, j) MSL_S3(p, i, q, j, x, 0) MSL_S3(p, i, q, j, y, 1) MSL_S3(p, i, q, j, z, 2) MSL_S3(p, i, q, j, w, 3) MSL_S4_4(p, i, q, j, x, 0) MSL_S4_4(p, i, q, j, y, 1) MSL_S4_4(p, i, q, j, z, 2) MSL_S4_4(p, i, q, j, w, 3)
#define MSL_S2_2(p, i) MSL_S2(p, i, x, 0) MSL_S2(p, i, y, 1) MSL_S3_2(p, i, x, 0) MSL_S3_2(p, i, y, 1)
#define MSL_S2_3(p, i) MSL_S2(p, i, x, 0) MSL_S2(p, i, y, 1) MSL_S2(p, i, z, 2) MSL_S3_3(p, i, x, 0) MSL_S3_3(p, i, y, 1) MSL_S3_3(p, i, z, 2)
#define MSL_S2_4(p, i) MSL_S2(p, i, x, 0) MSL_S2(p, i, y, 1) MSL_S2(p, i, z, 2) MSL_S2(p, i, w, 3) MSL_S3_4(p, i, x, 0) MSL_S3_4(p, i, y, 1) MSL_S3_4(p, i, z, 2) MSL_S3_4(p, i, w, 3)
#define MSL_SWIZZLES_2 MSL_S2_2(x, 0) MSL_S2_2(y, 1)
#define MSL_SWIZZLES_3 MSL_S2_3(x, 0) MSL_S2_3(y, 1) MSL_S2_3(z, 2)
#define MSL_SWIZZLES_4 MSL_S2_4(x, 0) MSL_S2_4(y, 1) MSL_S2_4(z, 2) MSL_S2_4(w, 3)

// What every size of `vec` has. Of truth, what a comparison gave is converted.
#define MSL_VEC_BODY(N) \
  using fields<T, N>::at; \
  vec() = default; \
  vec(T s) { for (int i = 0; i < N; i++) at[i] = s; } \
  template <class M, class = typename only<__is_same(T, bool) && __is_same(M, mask##N)>::type> vec(const M& m) { for (int i = 0; i < N; i++) at[i] = m[i] != 0; } \
  T& operator[](int i) { return at[i]; } \
  T operator[](int i) const { return at[i]; } \
  template <class... I> vec<T, sizeof...(I)> of(I... i) const { vec<T, sizeof...(I)> r; int n = 0; ((r.at[n++] = at[i]), ...); return r; } \
  MSL_SWIZZLES_##N \
  friend vec operator+(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] + b.at[i]); return r; } \
  friend vec operator-(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] - b.at[i]); return r; } \
  friend vec operator*(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] * b.at[i]); return r; } \
  friend vec operator/(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] / b.at[i]); return r; } \
  friend vec operator%(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] % b.at[i]); return r; } \
  friend vec operator&(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] & b.at[i]); return r; } \
  friend vec operator|(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] | b.at[i]); return r; } \
  friend vec operator^(vec a, vec b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] ^ b.at[i]); return r; } \
  friend vec operator<<(vec a, uint##N b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] << b[i]); return r; } \
  friend vec operator>>(vec a, uint##N b) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)(a.at[i] >> b[i]); return r; } \
  friend vec operator-(vec a) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)-a.at[i]; return r; } \
  friend vec operator~(vec a) { vec r; for (int i = 0; i < N; i++) r.at[i] = (T)~a.at[i]; return r; } \
  friend mask##N operator!(vec a) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] ? 0 : -1; return r; } \
  friend mask##N operator<(vec a, vec b) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] < b.at[i] ? -1 : 0; return r; } \
  friend mask##N operator>(vec a, vec b) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] > b.at[i] ? -1 : 0; return r; } \
  friend mask##N operator<=(vec a, vec b) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] <= b.at[i] ? -1 : 0; return r; } \
  friend mask##N operator>=(vec a, vec b) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] >= b.at[i] ? -1 : 0; return r; } \
  friend mask##N operator==(vec a, vec b) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] == b.at[i] ? -1 : 0; return r; } \
  friend mask##N operator!=(vec a, vec b) { mask##N r; for (int i = 0; i < N; i++) r[i] = a.at[i] != b.at[i] ? -1 : 0; return r; }
template <class T> struct vec<T, 2> : fields<T, 2> { MSL_VEC_BODY(2) };
template <class T> struct vec<T, 3> : fields<T, 3> { MSL_VEC_BODY(3) };
template <class T> struct vec<T, 4> : fields<T, 4> { MSL_VEC_BODY(4) };
} // namespace msl
