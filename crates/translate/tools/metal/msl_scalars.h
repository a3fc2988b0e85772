// Scalars by their names in Metal; `half` is IEEE binary16, each operation rounded once.
#pragma once

typedef unsigned int uint;
typedef unsigned short ushort;
typedef unsigned char uchar;
typedef unsigned long ulong;
typedef unsigned long size_t;
typedef unsigned char uint8_t;
typedef unsigned short uint16_t;
typedef unsigned int uint32_t;
typedef unsigned long uint64_t;
typedef signed char int8_t;
typedef short int16_t;
typedef int int32_t;
typedef long int64_t;

template <bool C> struct only {};
template <> struct only<true> { typedef bool type; };

struct half {
  ushort bits;
  half() = default;
  template <class A, bool = typename only<__is_arithmetic(A)>::type()> half(A a) : bits(round((float)a)) {}
  operator float() const {
    uint sign = (uint)(bits & 0x8000) << 16, exponent = bits >> 10 & 31, fraction = bits & 1023;
    if (exponent == 0) {
      float tiny = (float)fraction * 0x1p-24f;
      return sign ? -tiny : tiny;
    }
    uint word = sign | (exponent == 31 ? 255 : exponent + 112) << 23 | fraction << 13;
    return __builtin_bit_cast(float, word);
  }
  static ushort round(float value) {
    uint word = __builtin_bit_cast(uint, value), sign = word >> 16 & 0x8000, magnitude = word & 0x7fffffff;
    if (magnitude > 0x7f800000) return sign | 0x7e00;
    if (magnitude >= 0x477ff000) return sign | 0x7c00;
    if (magnitude < 0x38800000) return sign | (ushort)__builtin_rintf(__builtin_fabsf(value) * 0x1p24f);
    magnitude += 0xfff + (magnitude >> 13 & 1);
    return sign | (magnitude - 0x38000000) >> 13;
  }
  half operator-() const { half r; r.bits = bits ^ 0x8000; return r; }
  half& operator+=(half b) { return *this = half((float)*this + (float)b); }
  half& operator-=(half b) { return *this = half((float)*this - (float)b); }
  half& operator*=(half b) { return *this = half((float)*this * (float)b); }
  half& operator/=(half b) { return *this = half((float)*this / (float)b); }
  friend half operator+(half a, half b) { return half((float)a + (float)b); }
  friend half operator-(half a, half b) { return half((float)a - (float)b); }
  friend half operator*(half a, half b) { return half((float)a * (float)b); }
  friend half operator/(half a, half b) { return half((float)a / (float)b); }
  friend bool operator<(half a, half b) { return (float)a < (float)b; }
  friend bool operator>(half a, half b) { return (float)a > (float)b; }
  friend bool operator<=(half a, half b) { return (float)a <= (float)b; }
  friend bool operator>=(half a, half b) { return (float)a >= (float)b; }
  friend bool operator==(half a, half b) { return (float)a == (float)b; }
  friend bool operator!=(half a, half b) { return (float)a != (float)b; }
};
inline half operator""h(long double value) { return half((float)value); }
inline half operator""h(unsigned long long value) { return half((float)value); }
