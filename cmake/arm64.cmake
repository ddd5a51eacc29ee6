# Toolchain: 64-bit Arm on an x86 Debian, with its cross compiler (crossbuild-essential-arm64); programs run under QEMU
# (qemu-user-static). Libraries for Arm stand in a folder of their own, EQUIPOISE_ARM64_ROOT, since Debian's development
# packages of NetCDF exclude each other: docs/evidence/systems.md says how it is made.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(EQUIPOISE_ARM64_ROOT "/opt/arm64-root" CACHE PATH "Where Debian's arm64 libraries are unpacked")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES EQUIPOISE_ARM64_ROOT)

set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_SYSROOT ${EQUIPOISE_ARM64_ROOT})
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${EQUIPOISE_ARM64_ROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${EQUIPOISE_ARM64_ROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${EQUIPOISE_ARM64_ROOT}/usr/share/pkgconfig)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64-static;-L;${EQUIPOISE_ARM64_ROOT})
