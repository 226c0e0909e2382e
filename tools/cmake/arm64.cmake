# SPDX-License-Identifier: MIT
# A toolchain for CMake: compiles for 64-bit ARM on another machine, with Debian's cross compiler; QEMU runs the programs.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
