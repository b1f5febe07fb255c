#pragma once

/// Whole numbers of 128 bits: products of two of 64 bits, as the grids of rates have them.
namespace inslab::time {

__extension__ using Whole = __int128;

/// The greatest common divisor of two numbers above 0.
constexpr Whole common_divisor(Whole a, Whole b) {
  while (b != 0) {
    const Whole rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

}  // namespace inslab::time
