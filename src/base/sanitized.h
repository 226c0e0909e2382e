// SPDX-License-Identifier: MIT
#pragma once

// PLUMB_SANITIZED is defined where AddressSanitizer is compiled in: g++ has a macro for it, clang++ a feature.

#if defined(__SANITIZE_ADDRESS__)
#define PLUMB_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PLUMB_SANITIZED
#endif
#endif
