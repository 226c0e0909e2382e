// SPDX-License-Identifier: MIT
#pragma once

// Flush-to-zero and denormals-are-zero, as Embree asks of every thread that traces rays: denormal numbers are slow,
// and with one mode everywhere the same sample has the same bits on every thread.

#include <cstdint>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace plumb {

class FlushDenormals {
public:
    FlushDenormals() : saved_(mode()) { set_mode(saved_ | flush); }
    ~FlushDenormals() { set_mode(saved_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
#if defined(__SSE2__)
    using Mode = unsigned;
    static constexpr Mode flush = 0x8040; // of results: bit 15; of operands: bit 6
    static Mode mode()
    {
        return _mm_getcsr();
    }
    static void set_mode(Mode mode)
    {
        _mm_setcsr(mode);
    }
#elif defined(__aarch64__)
    using Mode = std::uint64_t;
    static constexpr Mode flush = 1u << 24; // of both
    static Mode mode()
    {
        Mode mode = 0;
        asm volatile("mrs %0, fpcr" : "=r"(mode));
        return mode;
    }
    static void set_mode(Mode mode)
    {
        asm volatile("msr fpcr, %0" : : "r"(mode) : "memory");
    }
#else
    using Mode = unsigned;
    static constexpr Mode flush = 0;
    static Mode mode()
    {
        return 0;
    }
    static void set_mode(Mode) {}
#endif

    Mode saved_;
};

} // namespace plumb
