// Mathematical functions: the C library's in single precision.
#pragma once

#include "msl_components.h"

namespace metal {
MSL_F1(sin, __builtin_sinf(x)) MSL_F1(cos, __builtin_cosf(x)) MSL_F1(tan, __builtin_tanf(x))
MSL_F1(asin, __builtin_asinf(x)) MSL_F1(acos, __builtin_acosf(x)) MSL_F1(atan, __builtin_atanf(x))
MSL_F1(sinh, __builtin_sinhf(x)) MSL_F1(cosh, __builtin_coshf(x)) MSL_F1(tanh, __builtin_tanhf(x))
MSL_F1(asinh, __builtin_asinhf(x)) MSL_F1(acosh, __builtin_acoshf(x)) MSL_F1(atanh, __builtin_atanhf(x))
MSL_F1(exp, __builtin_expf(x)) MSL_F1(exp2, __builtin_exp2f(x)) MSL_F1(log, __builtin_logf(x)) MSL_F1(log2, __builtin_log2f(x))
MSL_F1(sqrt, __builtin_sqrtf(x)) MSL_F1(rsqrt, 1.0f / __builtin_sqrtf(x))
MSL_F1(floor, __builtin_floorf(x)) MSL_F1(ceil, __builtin_ceilf(x)) MSL_F1(trunc, __builtin_truncf(x))
MSL_F1(rint, __builtin_rintf(x)) MSL_F1(round, __builtin_roundf(x))
MSL_F1(fract, __builtin_fminf(x - __builtin_floorf(x), 0x1.fffffep-1f))
MSL_F1(fabs, __builtin_fabsf(x))
MSL_F1(sign, x > (T)0 ? (T)1 : x < (T)0 ? (T)-1 : (T)0)
MSL_F1(saturate, x < (T)1 ? (x > (T)0 ? x : (T)0) : x >= (T)1 ? (T)1 : (T)0)
MSL_F2(min, y < x ? y : x) MSL_F2(max, x < y ? y : x)
MSL_F2(pow, __builtin_powf(x, y)) MSL_F2(powr, __builtin_powf(x, y)) MSL_F2(atan2, __builtin_atan2f(x, y))
MSL_F2(fmod, __builtin_fmodf(x, y)) MSL_F2(step, y < x ? (T)0 : (T)1)
MSL_F3(clamp, x < y ? y : z < x ? z : x) MSL_F3(mix, x + (y - x) * z) MSL_F3(fma, __builtin_fmaf(x, y, z))
template <class A> inline A abs(A a) {
  typedef msl::scalar<A> T;
  auto one = [](T x) -> T {
    if constexpr (__is_same(T, float)) return __builtin_fabsf(x);
    else return (T)(x < (T)0 ? (T)-x : x);
  };
  if constexpr (msl::is_vector<A>) { A r; for (int i = 0; i < msl::size<A>; i++) r[i] = one(a[i]); return r; }
  else return one(a);
}
template <class A, class B, class C> inline widest<A, B, C> smoothstep(A low, B high, C x) {
  auto t = saturate((x - low) / (high - low));
  typedef msl::scalar<decltype(t)> T;
  return t * t * ((T)3.0f - (T)2.0f * t);
}
template <class V> inline msl::scalar<V> dot(V a, V b) { auto s = a[0] * b[0]; for (int i = 1; i < msl::size<V>; i++) s = s + a[i] * b[i]; return s; }
template <class V> inline msl::scalar<V> length(V a) { if constexpr (msl::is_vector<V>) return sqrt(dot(a, a)); else return abs(a); }
template <class V> inline msl::scalar<V> distance(V a, V b) { return length(a - b); }
template <class V> inline V normalize(V a) { return a / length(a); }
template <class V> inline V cross(V a, V b) { return V(msl::make<V>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])); }
template <class V> inline V reflect(V i, V n) { return i - n * ((msl::scalar<V>)2.0f * dot(n, i)); }
template <class V> inline V refract(V i, V n, msl::scalar<V> eta) {
  typedef msl::scalar<V> T;
  T d = dot(n, i), k = (T)1.0f - eta * eta * ((T)1.0f - d * d);
  return k < (T)0.0f ? V((T)0.0f) : i * eta - n * (eta * d + sqrt(k));
}
template <class V> inline V faceforward(V n, V i, V reference) { return dot(reference, i) < (msl::scalar<V>)0 ? n : -n; }
template <class V> inline bool all(const V& v) { if constexpr (msl::is_vector<V>) { for (int i = 0; i < msl::size<V>; i++) if (!v[i]) return false; return true; } else return v; }
template <class V> inline bool any(const V& v) { if constexpr (msl::is_vector<V>) { for (int i = 0; i < msl::size<V>; i++) if (v[i]) return true; return false; } else return v; }
template <class A, class B, class C> inline widest<A, B> select(const A& a, const B& b, const C& c) {
  typedef widest<A, B> W; typedef msl::scalar<W> T;
  if constexpr (msl::is_vector<W>) { W r; for (int i = 0; i < msl::size<W>; i++) r[i] = msl::element(c, i) ? (T)msl::element(b, i) : (T)msl::element(a, i); return r; }
  else return c ? (T)b : (T)a;
}
#define MSL_TEST(name, result) \
template <class A> inline msl::vector<bool, msl::size<A>> name(const A& a) { \
  if constexpr (msl::is_vector<A>) { msl::vector<bool, msl::size<A>> r; for (int i = 0; i < msl::size<A>; i++) { float x = a[i]; r[i] = (result); } return r; } \
  else { float x = a; return (result); } \
}
MSL_TEST(isnan, __builtin_isnan(x)) MSL_TEST(isinf, __builtin_isinf(x)) MSL_TEST(isfinite, __builtin_isfinite(x)) MSL_TEST(isnormal, __builtin_isnormal(x)) MSL_TEST(signbit, __builtin_signbit(x))
template <class A, class B> inline A ldexp(A a, B b) { A r; if constexpr (msl::is_vector<A>) { for (int i = 0; i < msl::size<A>; i++) r[i] = __builtin_ldexpf(a[i], msl::element(b, i)); } else r = __builtin_ldexpf(a, b); return r; }
template <class A, class B> inline A frexp(A a, B& exponent) {
  if constexpr (msl::is_vector<A>) { A r; for (int i = 0; i < msl::size<A>; i++) { int e = 0; r[i] = __builtin_frexpf(a[i], &e); exponent[i] = e; } return r; }
  else { int e = 0; A r = __builtin_frexpf(a, &e); exponent = e; return r; }
}
template <class A> inline A modf(A a, A& whole) { whole = trunc(a); return select(a - whole, A(a * (msl::scalar<A>)0.0f), isinf(a)); }
inline float determinant(const float2x2& m) { return m[0][0] * m[1][1] - m[1][0] * m[0][1]; }
inline float determinant(const float3x3& m) { return dot(m[0], cross(m[1], m[2])); }
inline float determinant(const float4x4& m) {
  auto minor = [&](int a, int b, int c, int i, int j, int k) {
    return m[i][a] * (m[j][b] * m[k][c] - m[k][b] * m[j][c]) - m[j][a] * (m[i][b] * m[k][c] - m[k][b] * m[i][c]) + m[k][a] * (m[i][b] * m[j][c] - m[j][b] * m[i][c]);
  };
  return m[0][0] * minor(1, 2, 3, 1, 2, 3) - m[1][0] * minor(1, 2, 3, 0, 2, 3) + m[2][0] * minor(1, 2, 3, 0, 1, 3) - m[3][0] * minor(1, 2, 3, 0, 1, 2);
}
} // namespace metal
