// Functions that work component by component: a scalar beside a vector is spread.
#pragma once

#include "msl_names.h"

namespace metal {
template <class... A> struct widest_;
template <class A> struct widest_<A> { typedef msl::bare<A> type; };
template <class A, class B> struct common { typedef decltype(true ? A() : B()) type; };
template <class A> struct common<half, A> { typedef half type; };
template <class A> struct common<A, half> { typedef half type; };
template <> struct common<half, half> { typedef half type; };
template <> struct common<half, float> { typedef float type; };
template <> struct common<float, half> { typedef float type; };
template <class A, class B, bool V> struct wider { typedef typename msl::pick<msl::is_vector<A>, A, B>::type type; };
template <class A, class B> struct wider<A, B, false> { typedef typename common<A, B>::type type; };
template <class A, class B, class... R> struct widest_<A, B, R...> : widest_<typename wider<msl::bare<A>, msl::bare<B>, msl::is_vector<A> || msl::is_vector<B>>::type, R...> {};
template <class... A> using widest = typename widest_<A...>::type;

#define MSL_F1(name, result) \
template <class A> inline A name(A a) { \
  typedef msl::scalar<A> T; \
  if constexpr (msl::is_vector<A>) { A r; for (int i = 0; i < msl::size<A>; i++) { T x = a[i]; r[i] = (T)(result); } return r; } \
  else { T x = a; return (T)(result); } \
}
#define MSL_F2(name, result) \
template <class A, class B> inline widest<A, B> name(A a, B b) { \
  typedef widest<A, B> W; typedef msl::scalar<W> T; \
  if constexpr (msl::is_vector<W>) { W r; for (int i = 0; i < msl::size<W>; i++) { T x = (T)msl::element(a, i), y = (T)msl::element(b, i); r[i] = (T)(result); } return r; } \
  else { T x = (T)a, y = (T)b; return (T)(result); } \
}
#define MSL_F3(name, result) \
template <class A, class B, class C> inline widest<A, B, C> name(A a, B b, C c) { \
  typedef widest<A, B, C> W; typedef msl::scalar<W> T; \
  if constexpr (msl::is_vector<W>) { W r; for (int i = 0; i < msl::size<W>; i++) { T x = (T)msl::element(a, i), y = (T)msl::element(b, i), z = (T)msl::element(c, i); r[i] = (T)(result); } return r; } \
  else { T x = (T)a, y = (T)b, z = (T)c; return (T)(result); } \
}
} // namespace metal
