// SPDX-License-Identifier: MIT
#ifdef __SANITIZE_ADDRESS__

// Read by AddressSanitizer as the program starts; what the environment's ASAN_OPTIONS say goes before it. The sanitizer
// takes thread-local storage of a library that was loaded on demand, as OpenImageIO is, for a block with a header of
// glibc's before it; where glibc 2.36 placed it in the static block there is none, and its search for leaks reads from a
// wild address.
extern "C" const char* __asan_default_options()
{
    return "intercept_tls_get_addr=0";
}

#endif
