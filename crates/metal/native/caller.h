// Included after a shader's text: hands arguments to its entry point, whose types the text alone states.
#pragma once
#undef kernel
#undef vertex
#undef fragment
#undef device
#undef thread
#undef threadgroup
#undef constant
#undef static_cast
#include "call.h"

namespace msl_host {
template <int I, class... P> struct nth;
template <class A, class... P> struct nth<0, A, P...> { typedef A type; };
template <int I, class A, class... P> struct nth<I, A, P...> : nth<I - 1, P...> {};
template <int I, class F> struct parameter_;
template <int I, class R, class... P> struct parameter_<I, R (*)(P...)> : nth<I, P...> {};
template <int I, class F> using parameter = msl::bare<typename parameter_<I, F>::type>;

// Becomes a reference to whatever the entry point takes.
struct buffer {
  void* at;
  template <class T> operator T&() const { return *(T*)at; }
};
struct texture {
  const msl_texture* at;
  template <class T> operator T() const { T t; t.own = at; return t; }
};

template <class V> inline V of_words(const unsigned*& words) {
  typedef msl::scalar<V> T;
  V v;
  for (int i = 0; i < msl::size<V>; i++) {
    unsigned word = *words++;
    T one;
    if constexpr (__is_same(T, float) || __is_same(T, half)) one = (T)__builtin_bit_cast(float, word); else one = (T)word;
    if constexpr (msl::is_vector<V>) v[i] = one; else v = one;
  }
  return v;
}
template <class V> inline void to_words(unsigned*& words, const V& v) {
  typedef msl::scalar<V> T;
  for (int i = 0; i < msl::size<V>; i++) {
    T one = msl::element(v, i);
    if constexpr (__is_same(T, float) || __is_same(T, half)) *words++ = __builtin_bit_cast(unsigned, (float)one); else *words++ = (unsigned)one;
  }
}
template <class V> inline V of_ids(const unsigned* ids) {
  if constexpr (msl::is_vector<V>) { V v; for (int i = 0; i < msl::size<V>; i++) v[i] = ids[i]; return v; } else return ids[0];
}
} // namespace msl_host
