// SPDX-License-Identifier: MIT
#pragma once

// Flush-to-zero and denormals-are-zero, as Embree asks of every thread that traces rays: denormal numbers are slow,
// and with one mode everywhere the same sample has the same bits on every thread.

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace plumb {

class FlushDenormals {
public:
#if defined(__SSE2__)
    FlushDenormals() : saved_(_mm_getcsr())
    {
        _mm_setcsr(saved_ | 0x8040u);
    } // FTZ is bit 15, DAZ bit 6
    ~FlushDenormals()
    {
        _mm_setcsr(saved_);
    }
#else
    FlushDenormals() = default;
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
#if defined(__SSE2__)
    unsigned saved_;
#endif
};

} // namespace plumb
