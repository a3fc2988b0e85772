// Conversions and constructors, whose names are macros in the end (`msl_words.h`).
#pragma once

#include "msl_traits.h"

namespace msl {
// Packed vectors convert to their vectors first.
template <class P> struct packed { typedef P vector; };
template <class D, class A> inline D cast(const A& a) {
  typedef bare<D> R;
  if constexpr (is_vector<D> && is_vector<A>) {
    static_assert(size<D> == size<A>, "vectors of different sizes");
    R r; for (int i = 0; i < size<D>; i++) r[i] = (scalar<D>)element(a, i); return r;
  } else if constexpr (is_vector<D> && !is_vector<typename packed<A>::vector>) {
    R r; for (int i = 0; i < size<D>; i++) r[i] = (scalar<D>)a; return r;
  } else if constexpr (is_vector<typename packed<A>::vector> && !is_vector<A>) return cast<D>((typename packed<A>::vector)a);
  else return (R)a;
}
template <class T> inline void put(T*, int&) {}
template <class T, class A, class... R> inline void put(T* to, int& n, const A& a, const R&... rest) {
  typedef typename packed<A>::vector V; V v = a;
  for (int i = 0; i < size<V>; i++) to[n++] = (T)element(v, i);
  put(to, n, rest...);
}
template <class... A> constexpr int total = (0 + ... + size<typename packed<A>::vector>);
template <class V> inline V make() { return V{}; }
template <class V, class A> inline V make(const A& a) { return cast<V>(a); }
template <class V, class A, class B, class... R> inline V make(const A& a, const B& b, const R&... rest) {
  static_assert(total<A, B, R...> == size<V>, "a constructor's arguments do not fill the vector");
  scalar<V> parts[4]; int n = 0; put(parts, n, a, b, rest...);
  V v; for (int i = 0; i < size<V>; i++) v[i] = parts[i]; return v;
}
} // namespace msl

#define MSL_VECTORS(T) typedef msl::vec<T, 2> T##2; typedef msl::vec<T, 3> T##3; typedef msl::vec<T, 4> T##4;
MSL_VECTORS(int) MSL_VECTORS(bool) MSL_VECTORS(half) MSL_VECTORS(short) MSL_VECTORS(ushort) MSL_VECTORS(char) MSL_VECTORS(uchar) MSL_VECTORS(long) MSL_VECTORS(ulong)
#define MSL_MAKERS(T) \
template <class... A> inline T##2 msl_make_##T##2(const A&... a) { return msl::make<T##2>(a...); } \
template <class... A> inline T##3 msl_make_##T##3(const A&... a) { return msl::make<T##3>(a...); } \
template <class... A> inline T##4 msl_make_##T##4(const A&... a) { return msl::make<T##4>(a...); }
MSL_MAKERS(float) MSL_MAKERS(uint) MSL_MAKERS(int) MSL_MAKERS(bool) MSL_MAKERS(half) MSL_MAKERS(short) MSL_MAKERS(ushort) MSL_MAKERS(char) MSL_MAKERS(uchar) MSL_MAKERS(long) MSL_MAKERS(ulong)

template <class D, class A> inline D as_type(const A& a) {
  static_assert(sizeof(D) == sizeof(A), "as_type between sizes");
  D d; __builtin_memcpy(&d, &a, sizeof d); return d;
}
