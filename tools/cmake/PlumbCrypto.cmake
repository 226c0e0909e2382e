# SPDX-License-Identifier: MIT
# Defines OpenSSL::Crypto, for SHA-256. The static library if there is one: of it the linker takes some 20 KB, while to load the
# shared one takes as long as a third of the program's start.

set(OPENSSL_USE_STATIC_LIBS TRUE)
find_package(OpenSSL QUIET COMPONENTS Crypto)
if(NOT TARGET OpenSSL::Crypto)
  set(OPENSSL_USE_STATIC_LIBS FALSE)
  find_package(OpenSSL REQUIRED COMPONENTS Crypto)
endif()
unset(OPENSSL_USE_STATIC_LIBS)
